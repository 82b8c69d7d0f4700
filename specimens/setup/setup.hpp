// SPDX-License-Identifier: GPL-3.0-or-later
// State of a specimen at the start of loading, the reference for all measurements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/setup/bond_record.hpp"
#include "specimens/setup/gauges.hpp"
#include "specimens/setup/loading_rate.hpp"
#include "specimens/setup/placed_apparatus.hpp"
#include "specimens/setup/platen.hpp"

namespace crackle {

/// The tested part of a specimen, and its dimensions.
struct TestedSpecimen {
    SpecimenKind kind = SpecimenKind::circles;
    bool polygons = false;
    double width = 0.0, height = 0.0;          // m, initial
    double area = 0.0;                         // area of the tested part of the packing, m2
    double middle = 0.0, middle_height = 0.0;  // m, centre of the packing's box, about which the specimen is symmetric
    double low_end = 0.0;                      // m, y of the specimen's lower face
    double notch = 0.0;                        // m; 0 if absent
    double mesh_gap = 0.0;                     // m
    std::int64_t particles = 0;
};

/// The origin of a specimen. Results state it, but no measured value depends on it.
struct Provenance {
    std::int64_t segments = 0, centres = 0;
    std::vector<std::string> notices;
    std::vector<std::pair<std::string, double>>
        packing;                         ///< quantities that describe the packing, by name; empty for a particle file
    std::vector<MineralShare> minerals;  ///< empty for a rock with a single material
};

/// The state of a specimen at the start of loading.
struct TestSetup {
    TestedSpecimen specimen;
    PlacedApparatus apparatus;
    Gauges gauges;
    BondRecord bonds;
    Provenance origin;

    double stable_time_step = 0.0;         // s, exact stability limit of the bonded world
    bool stable_time_step_proved = false;  ///< whether a factorisation proved the limit; otherwise it is only a bound
    double time_step_bound = 0.0;          // bound at the start of loading, s; updated during the run
    RateRule rate_rule;

    /// Lateral strain; NaN if a side has no particles in the middle half of the height. If the driving part moves along
    /// x, it is the rise of that part divided by the height.
    double lateral_strain(const World& world) const;
    /// Axial strain between the ends of the axial gauge length; NaN if an end has no particles.
    double gauge_strain(const World& world) const;

    // Checkpoints store the members of all parts in this order.
    CRACKLE_FIELDS(apparatus.kind, apparatus.uniaxial, apparatus.compression, specimen.kind, specimen.polygons,
                   specimen.width, specimen.height, apparatus.axis, apparatus.section, apparatus.length,
                   apparatus.stress_intensity, specimen.notch, apparatus.span, specimen.area, specimen.middle,
                   specimen.middle_height, apparatus.normal_force, apparatus.normal_spring, bonds.thick,
                   specimen.mesh_gap, apparatus.bottom_id, apparatus.top_id, apparatus.bottom, apparatus.top,
                   apparatus.parts, apparatus.top_start, apparatus.top_height, gauges.left, gauges.right,
                   gauges.lateral_length, specimen.particles, origin.segments, origin.centres, bonds.contacts_initial,
                   bonds.mean_overlap, bonds.mean_back_tension, bonds.mean_back_tension_interface, bonds.law,
                   bonds.mean_tensile_strength, bonds.mean_cohesion, bonds.grip, specimen.low_end, gauges.bottom,
                   gauges.top, gauges.axial_length, apparatus.confining_pressure, stable_time_step,
                   stable_time_step_proved, time_step_bound, rate_rule, bonds.start, bonds.points, bonds.overlaps,
                   bonds.kind_begin, bonds.shares, origin.notices, origin.packing, origin.minerals, bonds.traces,
                   bonds.trace_faces, bonds.face_of_bond);
};

namespace detail {

/// Number of members of an aggregate.
template <class T, std::size_t Least = 0>
constexpr std::size_t members_of() {
    if constexpr (takes_at_most<T, Least>()) {
        return Least;
    } else {
        return members_of<T, Least + 1>();
    }
}

template <class... Part>
constexpr std::size_t members_with_parts() {
    return members_of<TestSetup>() - sizeof...(Part) + (members_of<Part>() + ...);
}

}  // namespace detail

/// Whether CRACKLE_FIELDS of TestSetup lists all members of its parts.
template <>
constexpr bool lists_all_fields<TestSetup>() {
    return detail::listed_fields<TestSetup>() ==
           detail::members_with_parts<TestedSpecimen, PlacedApparatus, Gauges, BondRecord, Provenance>();
}

/// Records the state at the start of loading. Requires a bonded world with its platens in place, after
/// compute_forces().
/// @param grip  fraction of the height, at each end, within which bonds never break
TestSetup record_setup(const World& world, const Specimen& specimen, const Platens& platens, LoadingKind kind,
                       double grip);

/// Makes the current positions the reference for strains and gauge lengths. The positions in `start` are kept, because
/// bonds refer to the positions in which they were made, and rotations are measured from them.
void strains_begin_at(TestSetup& setup, const World& world);

}  // namespace crackle
