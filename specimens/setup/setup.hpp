// SPDX-License-Identifier: GPL-3.0-or-later
// State of a specimen at the start of loading, the reference for all measurements.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/setup/loading_rate.hpp"
#include "specimens/setup/platen.hpp"
#include "specimens/setup/trace_faces.hpp"

namespace crackle {

/// A rigid body that holds or drives the specimen.
struct SetupPart {
    BodyIndex body = 0;
    std::uint32_t face = 2;  ///< number of leading corners that form its face; only the face is drawn
    bool wall = false;       ///< whether it presses on a side instead of holding or driving the specimen

    CRACKLE_FIELDS(body, face, wall);
};

/// Sizes, parts and bonds of a specimen when its loading began.
struct TestSetup {
    LoadingKind kind = LoadingKind::compression;
    bool uniaxial = true;     ///< as in TestKind: whether stress and strain are those of the rock
    bool compression = true;  ///< whether the driving part moves in the negative direction of its axis
    SpecimenKind specimen = SpecimenKind::circles;
    bool polygons = false;
    double width = 0.0, height = 0.0;          // m, initial
    int axis = 1;                              ///< axis along which the driving part moves: 0 x, 1 y
    double section = 0.0, length = 0.0;        // m, for nominal stress and strain, as in Apparatus
    double stress_intensity = 0.0;             ///< sqrt(m), K_I divided by the nominal stress; 0 without a notch
    double notch = 0.0, span = 0.0;            // m; 0 if absent
    double area = 0.0;                         // m2, of the tested part of the packing
    double middle = 0.0, middle_height = 0.0;  // m, centre of the packing's box and of the specimen's symmetry
    double normal_force = 0.0;                 // N, on the driving part, perpendicular to its motion
    double normal_spring = 0.0;                // N/m; increase of the normal force per rise of that part
    double bond_thick = 0.0;                   // m
    double mesh_gap = 0.0;                     // m
    int bottom_id = 0, top_id = 0;             // ids as in the outputs
    BodyIndex bottom = 0, top = 0;             // indices of the first support and the driving part in the world
    std::vector<SetupPart> parts;              ///< all parts: a support first, the driving part last
    double top_start = 0.0;                    // m, coordinate of the driving part's centroid along its axis
    double top_height = 0.0;                   // m, initial y of the driving part's centroid
    std::vector<BodyIndex> left, right;        ///< bodies on each side, in the middle half of the height
    double gauge_length = 0.0;  ///< m, initial distance between their mean x; 0 if a side has no such bodies

    std::int64_t particles = 0, segments = 0, centres = 0;
    std::int64_t contacts_initial = 0;         ///< number of contact points that touch when loading starts
    double mean_bond_overlap = 0.0;            // m, over bonded points
    double mean_back_tension = 0.0;            // N, over bonded points
    double mean_back_tension_interface = 0.0;  // N, over pairs of bodies
    BondLaw bond_law = BondLaw::back_tension;
    double mean_tensile_strength = 0.0,
           mean_cohesion = 0.0;  // N, over bonded points that can break; 0 if strengths are not given
    double grip = 0.0;           // m, depth at each end within which bonds never break
    double low_end = 0.0;        // m, y of the specimen's lower face
    /// Bonded particles at the two ends of the axial gauge length, and the distance between their mean y, m; 0 if an
    /// end has no particles. The gauge length excludes the grips, or without grips the outer tenths of the specimen.
    std::vector<BodyIndex> gauge_bottom, gauge_top;
    double gauge_height = 0.0;
    double confining_pressure = 0.0;       // N/m, on the sides; 0: no pressure
    double stable_time_step = 0.0;         // s, exact limit for the world as bonded
    bool stable_time_step_proved = false;  ///< whether a factorisation proved the limit; otherwise it is only a bound
    double time_step_bound = 0.0;          // s, at the start of loading; updated during the run

    RateRule rate_rule;

    std::vector<StartPlace> start;  ///< initial positions, by body
    /// Points bonded at the start of loading, sorted by kind and then in the world's order of points (point_order.hpp).
    ContactList bonds;
    std::vector<double> bond_overlaps;                          ///< m, initial overlap δ0 of each bond
    std::array<PointIndex, point_kinds + 1> bond_kind_begin{};  ///< for each kind, index of its first bond
    std::vector<float> bond_shares;  ///< for each bond, fraction of the law's stiffness; empty if all are 1
    std::vector<std::string> notices;
    std::vector<std::pair<std::string, double>>
        packing;  ///< quantities that describe the packing, by name; empty for a particle file

    std::vector<MineralShare> minerals;  ///< empty for a rock with a single material

    std::vector<SpecimenTrace> traces;   ///< joint traces, by index
    std::vector<TraceFace> trace_faces;  ///< sorted by their bodies
    std::vector<std::int32_t>
        bond_faces;  ///< for each bond, index into trace_faces, or -1 if it lies on no face; empty without traces

    /// Initial positions of the two bodies of a face.
    FacePlaces start_of(const TraceFace& face) const { return {start[face.i], start[face.j]}; }
    /// Index of a bond's trace; -1 if the bond lies in the rock.
    std::int32_t trace_of(PointIndex bond) const {
        const std::int32_t face = bond_faces.empty() ? -1 : bond_faces[bond];
        return face < 0 ? -1 : trace_faces[static_cast<std::size_t>(face)].trace;
    }

    /// Overlap at which a broken bond carries no force, m.
    double rest_overlap(PointIndex bond) const {
        return bond_facts().from_rest_overlap ? std::max(bond_overlaps[bond], 0.0) : 0.0;
    }
    /// Properties of the specimen's bond law.
    const BondLawFacts& bond_facts() const { return facts_of(bond_law); }

    /// Whether a pressure acts on its sides.
    bool confined() const { return confining_pressure > 0.0; }
    /// Whether walls press its sides.
    bool has_walls() const { return std::ranges::any_of(parts, &SetupPart::wall); }
    /// Whether a force other than that of the driving part does work on the specimen.
    bool pressed() const { return confined() || test_kind(kind).shear_box; }
    /// Whether a body holds or drives the specimen.
    bool is_platen(BodyIndex body) const {
        return std::ranges::any_of(parts, [&](const SetupPart& part) { return part.body == body; });
    }
    /// 1 if the driving part moves in the negative direction of its axis, else -1.
    double sense() const { return compression ? 1.0 : -1.0; }
    /// Strain along the path of the driving part, positive in the direction of the test.
    double axial_strain(const World& world) const;
    /// Lateral strain; NaN if a side has no particles in the middle half of the height. If the driving part moves along
    /// x, it is the rise of that part divided by the height.
    double lateral_strain(const World& world) const;
    /// As lateral_strain(), with medians of the displacements since `start` instead of means: particles that have
    /// broken off a side do not affect it.
    double median_lateral_strain(const World& world) const;
    /// Axial strain between the ends of the axial gauge length; NaN if an end has no particles.
    double gauge_strain(const World& world) const;

    CRACKLE_FIELDS(kind, uniaxial, compression, specimen, polygons, width, height, axis, section, length,
                   stress_intensity, notch, span, area, middle, middle_height, normal_force, normal_spring, bond_thick,
                   mesh_gap, bottom_id, top_id, bottom, top, parts, top_start, top_height, left, right, gauge_length,
                   particles, segments, centres, contacts_initial, mean_bond_overlap, mean_back_tension,
                   mean_back_tension_interface, bond_law, mean_tensile_strength, mean_cohesion, grip, low_end,
                   gauge_bottom, gauge_top, gauge_height, confining_pressure, stable_time_step, stable_time_step_proved,
                   time_step_bound, rate_rule, start, bonds, bond_overlaps, bond_kind_begin, bond_shares, notices,
                   packing, minerals, traces, trace_faces, bond_faces);
};

/// Records the state at the start of loading. Requires a bonded world with its platens in place, after
/// compute_forces().
/// @param grip  fraction of the height at each end whose bonds never break
TestSetup record_setup(const World& world, const Specimen& specimen, const Platens& platens, LoadingKind kind,
                       double grip);

/// Forces on the driving part and on all supports, along the driving part's axis, N. Requires compute_forces().
struct PartForces {
    double driver = 0.0, supports = 0.0;
};
/// Forces of the last calculated step, N.
PartForces forces_on_parts(const World& world, const TestSetup& setup);

/// Makes the current positions the reference of strains and gauge lengths. The positions in `start` are kept: bonds
/// refer to the positions in which they were made, and rotations are measured from them.
void strains_begin_at(TestSetup& setup, const World& world);

/// Creates the state of a body of which only the position is known. @param angle  rad, as in BodyState
BodyState placed_body(const World& world, const TestSetup& setup, BodyIndex body, double x, double y, double angle);

}  // namespace crackle
