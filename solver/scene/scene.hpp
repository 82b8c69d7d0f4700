// SPDX-License-Identifier: GPL-3.0-or-later
// A scene describes the system to be simulated as plain data, without derived values. Readers fill it, validate()
// checks it, and build_world() converts it into the flat arrays used by a step.
//
// Units: any consistent set (SI in the shipped cases, cgs in the DEMseg guide's decks). Strictly 2D: masses and
// stiffnesses are per unit thickness (density kg/m2, mass kg, stiffness N/m, force N, stress N/m).
// Tested by tests/solver/demseg/geometry_test.cpp.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/base/names.hpp"
#include "solver/base/vec2.hpp"
#include "solver/laws/bond_law.hpp"
#include "solver/scene/joint.hpp"

namespace crackle {

/// Whether a number is 0 or has a magnitude between 1e-30 and 1e30. This covers physical quantities in any units, and
/// products of several such numbers remain finite.
inline bool is_a_size(double number) {
    constexpr double smallest = 1e-30, largest = 1e30;
    return number == 0.0 || (std::abs(number) >= smallest && std::abs(number) <= largest);
}

/// Value of a number that has not been set; validate() refuses it.
inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

/// Constants of a material. The constants of a contact follow from both materials.
struct Material {
    double density = unset;           ///< kg/m2, > 0
    double normal_stiffness = unset;  ///< k_n, N/m, > 0; with StiffnessUnits::area the contact modulus, Pa
    double shear_stiffness = unset;   ///< k_s, >= 0, N/m, or Pa with StiffnessUnits::area
    double normal_damping = 0.0;      ///< c_n, N s/m, >= 0
    double shear_damping = 0.0;       ///< c_s, N s/m, >= 0
    /// Damping ratio h, >= 0. If given, c_n = 2h·sqrt(k_n·m_eff) and c_s = 2h·sqrt(k_s·m_eff) replace normal_damping
    /// and shear_damping.
    std::optional<double> damping_ratio;
    double friction_angle = 0.0;  ///< φ, degrees, 0 <= φ < 90; μ = tan φ
    // Constants of bonds, as in BondConstants; those that the bond law does not use are 0.
    double tensile_strength = 0.0;         ///< N, or Pa, >= 0
    double cohesion = 0.0;                 ///< N, or Pa, >= 0
    double residual_friction_angle = 0.0;  ///< degrees; at most φ

    /// The tensile strength, cohesion and residual friction angle as one value.
    BondConstants bond_constants() const { return {tensile_strength, cohesion, residual_friction_angle}; }

    friend bool operator==(const Material&, const Material&) = default;

    CRACKLE_FIELDS(density, normal_stiffness, shear_stiffness, normal_damping, shear_damping, damping_ratio,
                   friction_angle, tensile_strength, cohesion, residual_friction_angle);
};

/// Values for contacts between two materials (in either order) that replace those derived from the materials.
struct MaterialPair {
    int a = 0, b = 0;  ///< indices into Scene::materials; equal for contacts within one material
    std::optional<double> normal_stiffness = {};  ///< N/m, or Pa, > 0
    std::optional<double> shear_stiffness = {};   ///< N/m, or Pa, >= 0
    std::optional<double> friction_angle = {};    ///< degrees, 0 <= φ < 90
    BondConstants bond = {};
};

/// A circle of a body.
struct CircleElement {
    Vec2 centre;            ///< m
    double radius = unset;  ///< m, > 0
    double angle = 0.0;     ///< rad; stored only for output, without effect on the motion
};

/// A rigid body, which consists either of circles (one, or several as a clump) or of a chain of segments (open, or
/// closed as a polygon).
struct Body {
    int id = 0;         ///< unique number from the input
    int material = 0;   ///< index into Scene::materials
    Vec2 velocity;      ///< m/s
    double spin = 0.0;  ///< rad/s, counter-clockwise

    std::uint32_t first_circle = 0;  ///< index of the body's first circle in Scene::circles
    std::uint32_t circle_count = 0;
    std::uint32_t first_vertex = 0;  ///< index of the body's first vertex in Scene::vertices
    std::uint32_t vertex_count = 0;  ///< 0 for bodies made of circles; a closed chain lists each corner once
    bool closed = false;             ///< whether the chain is a polygon (counter-clockwise after validation)

    /// Mass, kg. Required only for an open chain of thickness 0 outside decks, since its mass cannot be derived.
    std::optional<double> mass;
};

/// How one degree of freedom of a body is driven.
enum class Drive : std::uint8_t {
    free,          ///< follows the equation of motion
    force,         ///< value is a force (N) or moment (N m), added to gravity and contact forces
    velocity,      ///< value is a prescribed velocity (m/s, rad/s)
    displacement,  ///< value is a displacement (m, rad), reached linearly over Control::ramp_steps steps
};

/// How a degree of freedom is driven; values in N, N m, m/s, rad/s, m or rad.
struct DofControl {
    Drive drive = Drive::free;
    double value = 0.0;
    /// Spring stiffness of a Drive::force, N/m or N m/rad: the force decreases by this much per unit of displacement
    /// from the initial position.
    double stiffness = 0.0;

    friend bool operator==(const DofControl&, const DofControl&) = default;

    CRACKLE_FIELDS(drive, value, stiffness);
};

/// Drives of the three degrees of freedom of a body.
struct Control {
    int body = 0;  ///< index into Scene::bodies
    DofControl x, y, rotation;
    std::int64_t ramp_steps = 0;  ///< duration of a Drive::displacement, in steps
};

/// Half-planes that bound the domain. Bodies can touch them but are never bonded to them.
enum class Wall : std::uint8_t { left = 0, right = 1, bottom = 2, top = 3 };

/// The rectangle in which bodies lie, and its walls.
struct Domain {
    double x1 = unset, x2 = unset, y1 = unset, y2 = unset;     ///< m
    std::array<bool, 4> wall_present{true, true, true, true};  ///< whether each wall exists, indexed by Wall

    CRACKLE_FIELDS(x1, x2, y1, y2, wall_present);
};

/// Contact law of segments and polygons. Contacts between circles and contacts with walls are the same in all laws.
enum class SegmentLaw : std::uint8_t {
    rounded,     ///< a vertex against the whole outline of the other body (geometry/geometry.hpp)
    demseg,      ///< the DEMseg guide's law for each pair of elements; adds the overlaps of a pair's discs
                 ///< (geometry/guide_segments.hpp)
    demseg_mean  ///< the same law with the mean of these overlaps in place of their sum
};

constexpr auto list_names(SegmentLaw) { return in_order("rounded", "demseg", "demseg_mean"); }

/// The quantities to which the stiffnesses and strengths of a material refer.
enum class StiffnessUnits : std::uint8_t {
    point,  ///< a contact point: N/m and N
    area    ///< a unit area of a face: contact modulus and stresses, Pa; each point has its own factors
            ///< (geometry/contact_share.hpp)
};

constexpr auto list_names(StiffnessUnits) { return in_order("point", "area"); }

/// How the first and last steps of a contact are integrated.
enum class Integrator : std::uint8_t {
    leapfrog,   ///< these steps are integrated like all others, as in the DEMseg guide
    consistent  ///< opening and closing conserve energy (contact/opening.hpp); applies to unbonded points, except the
                ///< segment kinds of the DEMseg guide's law, whose force has no potential
};

constexpr auto list_names(Integrator) { return in_order("leapfrog", "consistent"); }

/// Which contacts are computed between two driven bodies.
enum class DrivenContacts : std::uint8_t {
    none,         ///< no contacts; driven bodies pass through each other
    unless_held,  ///< all contacts except those between two bodies that are held in all degrees of freedom, where
                  ///< forces have no effect
    all           ///< all contacts, also between held bodies, because their forces and energies are needed
};

/// First kick of leapfrog. It is a half kick, except in decks, which start with a full kick as in the DEMseg guide (n
/// steps of free fall then cover n(n+1)/2 gΔt²).
enum class FirstKick : std::uint8_t { half, full };

/// Options for comparing a run with the linear solution, in which the state at bonding does not change.
struct IntactOptions {
    bool no_breaking = false;      ///< bonds never break
    bool no_sliding = false;       ///< contacts have no Coulomb limit
    bool no_new_contacts = false;  ///< only bonded points have forces

    friend bool operator==(const IntactOptions&, const IntactOptions&) = default;

    CRACKLE_FIELDS(no_breaking, no_sliding, no_new_contacts);
};

/// Complete description of what is simulated; build_world() validates it and builds a world from it.
struct Scene {
    std::vector<Material> materials;
    std::vector<MaterialPair> material_pairs;  ///< at most one entry for each pair of materials
    std::vector<Body> bodies;
    std::vector<CircleElement> circles;
    std::vector<Vec2> vertices;
    /// For each vertex: side of a trace on which the edge to the body's next vertex lies. Empty without joints.
    std::vector<TraceSide> edge_sides;
    std::vector<TracePiece> trace_pieces;  ///< straight parts of traces between circles; polygons use edge_sides
    std::vector<Joint> joints;
    std::vector<std::int32_t>
        trace_joints;  ///< for each trace: index into `joints`; -1 if the trace has no joint and behaves like the rock
    std::vector<Control> controls;
    Domain domain;
    DrivenContacts driven_contacts = DrivenContacts::unless_held;
    double thick = 0.0;  ///< m, >= 0, segment thickness t: a disc of radius t at each vertex acts against the bare
                         ///< outline of the other body
    SegmentLaw segment_law = SegmentLaw::rounded;
    Integrator integrator = Integrator::leapfrog;
    BondLaw bond_law = BondLaw::back_tension;
    StiffnessUnits units = StiffnessUnits::point;
    Vec2 gravity;  ///< m/s2, gravitational acceleration

    double time_step = 0.0;   ///< s; 0: chosen automatically from the stability limit and safety_factor
    double step_scale = 1.0;  ///< factor on all automatic steps, for example for a comparison with half the step
    /// Fraction of the stability limit used for an automatic step (at most loose_step_share without bonds).
    double safety_factor = 0.8;
    bool allow_unstable =
        false;  ///< allows a given time step above the stability limit, and energy that grows without a source
    FirstKick first_kick = FirstKick::half;
    IntactOptions intact;
    int threads = 1;
    double skin = 0.0;  ///< m, skin of the neighbour list; 0: derived from the sizes of the bodies

    /// Width used to compute the mass of open chains of thickness 0, m (decks: 0.1 deck units); otherwise unset.
    double bare_segment_width = unset;

    /// Adds a body with one circle. @param id the body's number in outputs @param material an index into `materials`
    /// @return the body's index in `bodies`
    std::uint32_t add_circle_body(int id, int material, const CircleElement& circle);
    /// Adds a chain body and returns its index. @param outline the corners of a polygon (closed) or vertices of an open
    /// chain, m
    std::uint32_t add_chain_body(int id, int material, const std::vector<Vec2>& outline, bool closed);
};

/// Mass, centroid and polar moment of inertia of a body (per unit thickness).
struct MassProperties {
    double mass = 0.0;    ///< kg
    Vec2 centroid;        ///< m
    double moment = 0.0;  ///< kg m2 about the centroid
};

/// Circle: m = ρπr², I = ½mr². Clump: sum with parallel-axis terms, overlaps counted twice. Closed chain: Green's
/// theorem. Open chain: m = ρ·L·w, w = 2·thick (bare_segment_width if thick = 0), I = Σ m_k(L_k²/12 + d_k²).
MassProperties mass_properties(const Scene& scene, const Body& body);

/// Checks every value and makes polygons counter-clockwise. @throws InputError stating the body, the key, the value
/// found and the values expected
void validate(Scene& scene);

/// Notices about settings that are allowed but may be unintended, one sentence each.
std::vector<std::string> scene_notices(const Scene& scene);

}  // namespace crackle
