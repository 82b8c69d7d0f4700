// SPDX-License-Identifier: GPL-3.0-or-later
// What a loaded specimen was when loading began: everything that a measurement refers back to.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "solver/world/world.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/setup/loading_rate.hpp"
#include "specimens/setup/platen.hpp"
#include "specimens/setup/trace_faces.hpp"

namespace crackle {

/// A rigid body that holds or drives the specimen.
struct SetupPart {
    BodyIndex body = 0;
    std::uint32_t face = 2;  ///< its first corners, which are drawn
    bool wall = false;       ///< presses a side, neither holds nor drives

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("body", s.body);
        visit("face", s.face);
        visit("wall", s.wall);
    }
};

struct TestSetup {
    std::string kind = "compression";
    bool uniaxial = true;     ///< stress and strain are those of the rock, TestKind
    bool compression = true;  ///< the driving part moves against its axis
    std::string specimen;     ///< circles, delaunay, voronoi
    bool polygons = false;
    double width = 0.0, height = 0.0;          // m, initial
    int axis = 1;                              ///< of the driving part's way: 0 x, 1 y
    double section = 0.0, length = 0.0;        // m, of nominal stress and strain, Apparatus
    double stress_intensity = 0.0;             ///< sqrt(m), K_I over the nominal stress; 0 without a notch
    double notch = 0.0, span = 0.0;            // m; 0: none
    double area = 0.0;                         // m2, of what is tested
    double middle = 0.0, middle_height = 0.0;  // m, of the packing's box, in which the specimen lies symmetrically
    double normal_force = 0.0;                 // N, on the driving part across its way
    double normal_spring = 0.0;                // N/m, by which it grows as that part rises
    double bond_thick = 0.0;                   // m
    double mesh_gap = 0.0;                     // m
    int bottom_id = 0, top_id = 0;             // as in outputs
    BodyIndex bottom = 0, top = 0;             // in the world: the first support, and what drives
    std::vector<SetupPart> parts;              ///< all, a support first, the driving one last
    double top_start = 0.0;                    // m, place of the driving part's centroid along its axis
    double top_height = 0.0;                   // m, its y
    std::vector<BodyIndex> left, right;        ///< side particles in the middle half of the height
    double gauge_length = 0.0;                 ///< m, initial distance of their mean x; 0 if a side has none

    std::int64_t particles = 0, segments = 0, centres = 0;
    std::int64_t contacts_initial = 0;         ///< contact points that touch when loading begins
    double mean_bond_overlap = 0.0;            // m, over bonded points
    double mean_back_tension = 0.0;            // N, over bonded points
    double mean_back_tension_interface = 0.0;  // N, over pairs of bodies
    bool coulomb_bonds = false;
    double mean_tensile_strength = 0.0, mean_cohesion = 0.0;  // N, over bonded points that can break, coulomb bonds
    double grip = 0.0;                                        // m, depth at each end whose bonds never break
    double low_end = 0.0;                                     // m, y of the specimen's lower face
    /// Bonded particles about the two ends of the axial gauge length, the specimen without its grips (without the outer
    /// tenths where there are none), and the distance of their mean y, m; 0 where an end has none.
    std::vector<BodyIndex> gauge_bottom, gauge_top;
    double gauge_height = 0.0;
    double confining_pressure = 0.0;       // N/m, on the sides; 0: none
    double stable_time_step = 0.0;         // s, exact, when bonds were made
    bool stable_time_step_proved = false;  ///< by factorisation; else it is a bound
    double time_step_bound = 0.0;          // s, kept up during the run; when loading began

    RateRule rate_rule;

    std::vector<StartPlace> start;  ///< by body
    /// Points bonded when loading began, by kind and in the order in which a world lists its points (point_order.hpp).
    ContactList bonds;
    std::vector<double> bond_overlaps;                          ///< δ0 of each, m
    std::array<PointIndex, point_kinds + 1> bond_kind_begin{};  ///< into bonds
    std::vector<float> bond_shares;  ///< of each bond, of the law's stiffness; empty where all are 1
    std::vector<std::string> notices;
    std::vector<std::pair<std::string, double>> packing;  ///< figures of the packing by name; empty for a particle file

    std::vector<MineralShare> minerals;  ///< empty of a rock of one material

    std::vector<SpecimenTrace> traces;     ///< of joints, by number
    std::vector<TraceFace> trace_faces;    ///< by bodies
    std::vector<std::int32_t> bond_faces;  ///< of each bond, into trace_faces; -1: on none. Empty without traces

    /// Of the bodies of a face.
    FacePlaces start_of(const TraceFace& face) const { return {start[face.i], start[face.j]}; }
    /// Of a bond; -1: it is through the rock.
    std::int32_t trace_of(PointIndex bond) const {
        const std::int32_t face = bond_faces.empty() ? -1 : bond_faces[bond];
        return face < 0 ? -1 : trace_faces[static_cast<std::size_t>(face)].trace;
    }

    /// m, of a bond: the overlap without force once it has broken.
    double rest_overlap(PointIndex bond) const { return coulomb_bonds ? std::max(bond_overlaps[bond], 0.0) : 0.0; }

    bool confined() const { return confining_pressure > 0.0; }
    bool has_walls() const { return std::ranges::any_of(parts, &SetupPart::wall); }
    bool pressed() const { return confined() || kind == "direct_shear"; }
    bool is_platen(BodyIndex body) const {
        return std::ranges::any_of(parts, [&](const SetupPart& part) { return part.body == body; });
    }
    /// 1 where the driving part moves against its axis, else -1.
    double sense() const { return compression ? 1.0 : -1.0; }
    double axial_strain(const World& world) const;
    /// Not a number if the specimen has no side particles in the middle half of its height. Where the driving part
    /// moves along x: the rise of the upper one over the height.
    double lateral_strain(const World& world) const;
    /// Likewise by medians in place of means, from the places in `start`: what has come off a side does not count.
    double median_lateral_strain(const World& world) const;
    /// Axial strain between the ends of the axial gauge length; not a number where one has no particles.
    double gauge_strain(const World& world) const;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("kind", s.kind);
        visit("uniaxial", s.uniaxial);
        visit("compression", s.compression);
        visit("specimen", s.specimen);
        visit("polygons", s.polygons);
        visit("width", s.width);
        visit("height", s.height);
        visit("axis", s.axis);
        visit("section", s.section);
        visit("length", s.length);
        visit("stress_intensity", s.stress_intensity);
        visit("notch", s.notch);
        visit("span", s.span);
        visit("area", s.area);
        visit("middle", s.middle);
        visit("middle_height", s.middle_height);
        visit("normal_force", s.normal_force);
        visit("normal_spring", s.normal_spring);
        visit("bond_thick", s.bond_thick);
        visit("mesh_gap", s.mesh_gap);
        visit("bottom_id", s.bottom_id);
        visit("top_id", s.top_id);
        visit("bottom", s.bottom);
        visit("top", s.top);
        visit("parts", s.parts);
        visit("top_start", s.top_start);
        visit("top_height", s.top_height);
        visit("left", s.left);
        visit("right", s.right);
        visit("gauge_length", s.gauge_length);
        visit("particles", s.particles);
        visit("segments", s.segments);
        visit("centres", s.centres);
        visit("contacts_initial", s.contacts_initial);
        visit("mean_bond_overlap", s.mean_bond_overlap);
        visit("mean_back_tension", s.mean_back_tension);
        visit("mean_back_tension_interface", s.mean_back_tension_interface);
        visit("coulomb_bonds", s.coulomb_bonds);
        visit("mean_tensile_strength", s.mean_tensile_strength);
        visit("mean_cohesion", s.mean_cohesion);
        visit("grip", s.grip);
        visit("low_end", s.low_end);
        visit("gauge_bottom", s.gauge_bottom);
        visit("gauge_top", s.gauge_top);
        visit("gauge_height", s.gauge_height);
        visit("confining_pressure", s.confining_pressure);
        visit("stable_time_step", s.stable_time_step);
        visit("stable_time_step_proved", s.stable_time_step_proved);
        visit("time_step_bound", s.time_step_bound);
        visit("rate_rule", s.rate_rule);
        visit("start", s.start);
        visit("bonds", s.bonds);
        visit("bond_overlaps", s.bond_overlaps);
        visit("bond_kind_begin", s.bond_kind_begin);
        visit("bond_shares", s.bond_shares);
        visit("notices", s.notices);
        visit("packing", s.packing);
        visit("minerals", s.minerals);
        visit("traces", s.traces);
        visit("trace_faces", s.trace_faces);
        visit("bond_faces", s.bond_faces);
    }
};

/// Records the start of loading. Needs a bonded world with its platens in place and compute_forces() done.
/// @param grip share of the height at each end whose bonds never break
TestSetup record_setup(const World& world, const Specimen& specimen, const Platens& platens, const TestKind& kind,
                       double grip);

/// Forces on the driving part and on all supports along the driving part's axis, N. Needs compute_forces().
struct PartForces {
    double driver = 0.0, supports = 0.0;
};
PartForces forces_on_parts(const World& world, const TestSetup& setup);

/// Strains and gauge lengths count from where the bodies are now. Places do not: bonds hold bodies as they lay when
/// they were made, and from there the turn of a body's frame counts.
void strains_begin_at(TestSetup& setup, const World& world);

/// A body where only its place is known. @param angle rad, as BodyState's
BodyState placed_body(const World& world, const TestSetup& setup, BodyIndex body, double x, double y, double angle);

}  // namespace crackle
