// SPDX-License-Identifier: GPL-3.0-or-later
// The bonds of a specimen at the start of loading, and its joint traces.
// Tested by tests/specimens/setup/setup_test.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "solver/scene/scene.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/setup/trace_faces.hpp"

namespace crackle {

/// Points bonded at the start of loading, and the positions of the bodies when these bonds were made.
struct BondRecord {
    BondLaw law = BondLaw::back_tension;
    double thick = 0.0;                 // m, thickness of segments
    double grip = 0.0;                  // m, depth at each end within which bonds never break
    std::int64_t contacts_initial = 0;  ///< number of contact points that touch when loading starts

    double mean_overlap = 0.0;                 // mean over bonded points, m
    double mean_back_tension = 0.0;            // mean over bonded points, N
    double mean_back_tension_interface = 0.0;  // mean over pairs of bodies, N
    double mean_tensile_strength = 0.0,
           mean_cohesion = 0.0;  // means over bonded points that can break, N; 0 if strengths are not given

    std::vector<StartPlace> start;  ///< initial positions, by body
    /// The bonded points, sorted by kind and then in the world's order of points (point_order.hpp).
    ContactList points;
    std::vector<double> overlaps;                         ///< m, initial overlap δ0 of each bond
    std::array<PointIndex, bond_kinds + 1> kind_begin{};  ///< for each kind, index of its first bond
    std::vector<float> shares;  ///< for each bond, fraction of the law's stiffness; empty if all are 1

    std::vector<SpecimenTrace> traces;   ///< joint traces, by index
    std::vector<TraceFace> trace_faces;  ///< sorted by their bodies
    std::vector<std::int32_t>
        face_of_bond;  ///< for each bond, index into trace_faces, or -1 if it lies on no face; empty without traces

    /// Initial positions of the two bodies of a face.
    FacePlaces start_of(const TraceFace& face) const { return {start[face.i], start[face.j]}; }
    /// Index of a bond's trace; -1 if the bond lies in the rock.
    std::int32_t trace_of(PointIndex bond) const {
        const std::int32_t face = face_of_bond.empty() ? -1 : face_of_bond[bond];
        return face < 0 ? -1 : trace_faces[static_cast<std::size_t>(face)].trace;
    }
    /// Overlap at which a broken bond bears no force, m.
    double rest_overlap(PointIndex bond) const {
        return facts().from_rest_overlap ? std::max(overlaps[bond], 0.0) : 0.0;
    }
    /// Properties of the bonds' law.
    const BondLawFacts& facts() const { return facts_of(law); }
};

/// Records the bonds of a world and the positions of its bodies. Requires compute_forces().
/// @param grip  m, depth at each end within which bonds never break
BondRecord record_bonds(const World& world, const std::vector<SpecimenTrace>& traces, double grip);

/// Creates the state of a body from its position and angle. @param angle  rad, as in BodyState
BodyState placed_body(const World& world, const BondRecord& bonds, BodyIndex body, double x, double y, double angle);

}  // namespace crackle
