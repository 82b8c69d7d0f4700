// SPDX-License-Identifier: GPL-3.0-or-later
// A scene: what is to be simulated, as plain data, before any number is derived from it.
// Readers fill it, validate() checks it, build_world() turns it into the flat arrays that a step touches.
//
// Units: any consistent set (SI in what we ship, cgs in the guide's decks). Strictly 2D: masses and stiffnesses are per
// unit thickness (density kg/m2, mass kg, stiffness N/m, force N, stress N/m).
// Tested by tests/solver/demseg/geometry_test.cpp.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/vec2.hpp"
#include "solver/scene/joint.hpp"

namespace crackle {

/// Whether a number is 0 or of a size that something has in some unit, 1e-30 to 1e30: products of several such numbers
/// are still finite.
inline bool is_a_size(double number) {
    constexpr double smallest = 1e-30, largest = 1e30;
    return number == 0.0 || (std::abs(number) >= smallest && std::abs(number) <= largest);
}

/// A number not set yet; validate() refuses it.
inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

struct Material {
    double density = unset;           ///< kg/m2, > 0
    double normal_stiffness = unset;  ///< k_n, N/m, > 0; in StiffnessUnits::area the contact modulus, Pa
    double shear_stiffness = unset;   ///< k_s, N/m, >= 0; likewise
    double normal_damping = 0.0;      ///< c_n, N s/m, >= 0
    double shear_damping = 0.0;       ///< c_s, N s/m, >= 0
    /// h, >= 0: where given, c_n = 2h·sqrt(k_n·m_eff) and c_s = 2h·sqrt(k_s·m_eff) take the place of the two above.
    std::optional<double> damping_ratio;
    double friction_angle = 0.0;  ///< φ, degrees, 0 <= φ < 90; μ = tan φ
    // Under BondLaw::coulomb only; in StiffnessUnits::area strengths are stresses, Pa.
    double tensile_strength = 0.0;         ///< T of a bond, N, >= 0
    double cohesion = 0.0;                 ///< C of a bond, N, >= 0
    double residual_friction_angle = 0.0;  ///< degrees, of contacts without a bond, at most φ

    friend bool operator==(const Material&, const Material&) = default;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("density", s.density);
        visit("normal_stiffness", s.normal_stiffness);
        visit("shear_stiffness", s.shear_stiffness);
        visit("normal_damping", s.normal_damping);
        visit("shear_damping", s.shear_damping);
        visit("damping_ratio", s.damping_ratio);
        visit("friction_angle", s.friction_angle);
        visit("tensile_strength", s.tensile_strength);
        visit("cohesion", s.cohesion);
        visit("residual_friction_angle", s.residual_friction_angle);
    }
};

/// What holds between two materials in place of what they give together; unordered.
struct MaterialPair {
    int a = 0, b = 0;                             ///< indices into Scene::materials; alike for contacts within one
    std::optional<double> normal_stiffness = {};  ///< N/m, or Pa, > 0
    std::optional<double> shear_stiffness = {};   ///< N/m, or Pa, >= 0
    std::optional<double> friction_angle = {};    ///< degrees, 0 <= φ < 90
    std::optional<double> tensile_strength = {};  ///< N, or Pa, >= 0; of coulomb bonds, as the two below
    std::optional<double> cohesion = {};          ///< N, or Pa, >= 0
    std::optional<double> residual_friction_angle = {};  ///< degrees, from 0 to the friction angle
};

struct CircleElement {
    Vec2 centre;            ///< m
    double radius = unset;  ///< m, > 0
    double angle = 0.0;     ///< rad, carried along, no meaning for the physics
};

/// A rigid body: circles (one, or several as a clump), or a chain of segments (open, or closed = polygon), never both.
struct Body {
    int id = 0;         ///< the input's number; unique
    int material = 0;   ///< index into Scene::materials
    Vec2 velocity;      ///< m/s
    double spin = 0.0;  ///< rad/s, counter-clockwise

    std::uint32_t first_circle = 0;  ///< into Scene::circles
    std::uint32_t circle_count = 0;
    std::uint32_t first_vertex = 0;  ///< into Scene::vertices
    std::uint32_t vertex_count = 0;  ///< 0 for circles; a closed chain lists each corner once
    bool closed = false;             ///< polygon (counter-clockwise once validated)

    /// kg; only for an open chain of thickness 0 outside decks, whose mass cannot be derived.
    std::optional<double> mass;
};

/// How one degree of freedom of a body is driven.
enum class Drive : std::uint8_t {
    free,          ///< equation of motion alone
    force,         ///< value = force (N) or moment (N m) added to gravity and contacts
    velocity,      ///< value = velocity (m/s, rad/s), held
    displacement,  ///< value = displacement (m, rad) reached after Control::ramp_steps steps, linear in the step
};

struct DofControl {
    Drive drive = Drive::free;
    double value = 0.0;
    /// Of a force: N/m, N m/rad, by which it falls as the degree of freedom moves from where it was entered.
    double stiffness = 0.0;

    friend bool operator==(const DofControl&, const DofControl&) = default;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("drive", s.drive);
        visit("value", s.value);
        visit("stiffness", s.stiffness);
    }
};

struct Control {
    int body = 0;  ///< index into Scene::bodies
    DofControl x, y, rotation;
    std::int64_t ramp_steps = 0;  ///< for Drive::displacement
};

/// Half-planes that close the domain. They touch bodies but are never bonded to them.
enum class Wall : std::uint8_t { left = 0, right = 1, bottom = 2, top = 3 };

struct Domain {
    double x1 = unset, x2 = unset, y1 = unset, y2 = unset;     ///< m
    std::array<bool, 4> wall_present{true, true, true, true};  ///< by Wall

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("x1", s.x1);
        visit("x2", s.x2);
        visit("y1", s.y1);
        visit("y2", s.y2);
        visit("wall_present", s.wall_present);
    }
};

/// Contact law of segments and polygons; circles among themselves and walls are the same in all.
enum class SegmentLaw : std::uint8_t {
    rounded,     ///< vertex against the other's outline as a whole (geometry/geometry.hpp)
    demseg,      ///< the guide's: element by element, the disc cases of a pair added up (geometry/guide_segments.hpp)
    demseg_mean  ///< the same with the mean of the cases in contact
};

/// "rounded", "demseg" or "demseg_mean". @throws InputError on another word, naming `where`.
SegmentLaw segment_law_named(const std::string& where, const std::string& word);
const char* name_of(SegmentLaw law);

/// What a bond carries and how it fails.
enum class BondLaw : std::uint8_t {
    back_tension,  ///< the guide's: strength is the overlap at bonding, a bond slides within Coulomb's limit
    coulomb        ///< tension cut-off, cohesion and friction; sticks until it fails (contact/coulomb_bond.hpp)
};

/// "back_tension" or "coulomb". @throws InputError on another word, naming `where`.
BondLaw bond_law_named(const std::string& where, const std::string& word);
const char* name_of(BondLaw law);

/// What stiffnesses and strengths of a material are given for.
enum class StiffnessUnits : std::uint8_t {
    point,  ///< a contact point: N/m and N
    area    ///< a face: a contact modulus and stresses, Pa; a point has its share (geometry/contact_share.hpp)
};

/// "point" or "area". @throws InputError on another word, naming `where`.
StiffnessUnits stiffness_units_named(const std::string& where, const std::string& word);
const char* name_of(StiffnessUnits units);

/// How the contacts' first and last steps are taken.
enum class Integrator : std::uint8_t {
    leapfrog,   ///< like all others, as the guide does
    consistent  ///< so that opening and closing conserve energy (contact/opening.hpp); unbonded points, but not the
                ///< segment kinds of the guide's law, which have no energy to conserve
};

/// "leapfrog" or "consistent". @throws InputError on another word, naming `where`.
Integrator integrator_named(const std::string& where, const std::string& word);
const char* name_of(Integrator integrator);

/// Which contacts there are between two bodies that have a control.
enum class DrivenContacts : std::uint8_t {
    none,         ///< driven bodies pass through each other
    unless_held,  ///< all but those of two bodies that are held in every degree of freedom, which would move nothing
    all           ///< those too: somebody reads their forces and energies
};

/// First kick of leapfrog: decks start with a full one (the guide's n(n+1)/2), everything else with a half one.
enum class FirstKick : std::uint8_t { half, full };

/// Switches for comparing a run with the linear solve: everything stays as it was at bonding.
struct IntactOptions {
    bool no_breaking = false;      ///< bonds hold at any opening
    bool no_sliding = false;       ///< no Coulomb limit
    bool no_new_contacts = false;  ///< only bonded points act

    friend bool operator==(const IntactOptions&, const IntactOptions&) = default;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("no_breaking", s.no_breaking);
        visit("no_sliding", s.no_sliding);
        visit("no_new_contacts", s.no_new_contacts);
    }
};

struct Scene {
    std::vector<Material> materials;
    std::vector<MaterialPair> material_pairs;  ///< at most one of two materials
    std::vector<Body> bodies;
    std::vector<CircleElement> circles;
    std::vector<Vec2> vertices;
    /// By vertex: on which side of a trace the edge to the body's next vertex lies; empty without joints.
    std::vector<TraceSide> edge_sides;
    std::vector<TracePiece> trace_pieces;  ///< of traces among circles; polygons have edge_sides
    std::vector<Joint> joints;
    std::vector<std::int32_t> trace_joints;  ///< by trace: into joints; -1: as the rock
    std::vector<Control> controls;
    Domain domain;
    DrivenContacts driven_contacts = DrivenContacts::unless_held;
    double thick =
        0.0;  ///< segment thickness t, m, >= 0: a disc of radius t at each vertex against the other's bare outline
    SegmentLaw segment_law = SegmentLaw::rounded;
    Integrator integrator = Integrator::leapfrog;
    BondLaw bond_law = BondLaw::back_tension;
    StiffnessUnits units = StiffnessUnits::point;
    Vec2 gravity;  ///< m/s2

    double time_step = 0.0;       ///< s; 0: derived from the stiffness bound times safety_factor
    double step_scale = 1.0;      ///< of derived steps, whatever rules them: a comparison at half the step
    double safety_factor = 0.8;   ///< share of the bound taken when the step is derived (without bonds: at most
                                  ///< loose_step_share)
    bool allow_unstable = false;  ///< run a given time step above the bound, and beyond runaway energy
    FirstKick first_kick = FirstKick::half;
    IntactOptions intact;
    int threads = 1;
    double skin = 0.0;  ///< m; Verlet skin, 0: derived from the body sizes

    /// Open chains of thickness 0: width that gives them mass (decks: 0.1 deck units); unset elsewhere.
    double bare_segment_width = unset;

    std::uint32_t add_circle_body(int id, int material, const CircleElement& circle);
    /// @param outline corners of a polygon (closed) or joints of an open chain.
    std::uint32_t add_chain_body(int id, int material, const std::vector<Vec2>& outline, bool closed);
};

/// Mass, centroid and polar moment of one body of the scene (per unit thickness).
struct MassProperties {
    double mass = 0.0;    ///< kg
    Vec2 centroid;        ///< m
    double moment = 0.0;  ///< kg m2 about the centroid
};

/// Circle m = ρπr², I = ½mr²; clump: sum with parallel-axis terms, overlaps counted twice; closed chain: Green's
/// theorem; open chain: m = ρ·L·w, w = 2·thick (bare_segment_width where thick = 0), I = Σ m_k(L_k²/12 + d_k²).
MassProperties mass_properties(const Scene& scene, const Body& body);

/// Checks every value and turns clockwise polygons. @throws InputError naming body, key, what was found and expected.
void validate(Scene& scene);

/// What is allowed but may surprise, one sentence each.
std::vector<std::string> scene_notices(const Scene& scene);

}  // namespace crackle
