// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/bond_record.hpp"

#include <algorithm>

#include "solver/base/correctly_rounded.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/world/point_order.hpp"

namespace crackle {
namespace {

/// Adds the intact faces of a world to the record. @param tensile, cohesion  N, sums to which the strengths of the
/// faces that can break are added
void record_faces(BondRecord& bonds, const World& world, double& tensile, double& cohesion) {
    const Faces& faces = world.faces;
    for (FaceIndex k = 0; k < faces.size(); ++k) {
        if (faces.broken_at[k] != no_face) continue;
        const auto [i, j] = faces.bodies[k];
        const FaceSprings springs = faces.springs[k];
        const FaceLaw& law = faces.law_of(k);
        ++bonds.contacts_initial;
        bonds.points.push_back(PointKind::bonded_face, {i, j, k, k});
        bonds.overlaps.push_back(0.0);
        bonds.shares.push_back(
            static_cast<float>(springs.normal / world.settings.laws[law_between(world, i, j)].normal_stiffness));
        if (!law.can_break()) continue;
        tensile += springs.length * faces.strength_share[k] * law.tensile_strength;
        cohesion += springs.length * faces.strength_share[k] * law.cohesion;
    }
    bonds.kind_begin.back() = static_cast<PointIndex>(bonds.points.size());
}

void record_points(BondRecord& bonds, const World& world) {
    double overlap = 0.0, tension = 0.0, tensile = 0.0, cohesion = 0.0;
    bonds.points.pairs.reserve(static_cast<std::size_t>(world.bonds.initial));
    bonds.overlaps.reserve(static_cast<std::size_t>(world.bonds.initial));
    const bool own_shares = !world.points.stiffness_share.empty();
    struct BondOfKind {
        ContactPoint point;
        double overlap;
        float share;
    };
    std::vector<BondOfKind> of_kind;
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        of_kind.clear();
        for (PointIndex k = begin; k < end; ++k) {
            const ContactPoint point = world.points.contact[k];
            const PointState& state = world.points.state[k];
            if ((state.flags & point_touching) != 0) ++bonds.contacts_initial;
            if ((state.flags & point_bonded) == 0) continue;
            const ContactLaw law = law_of(world, k);
            const double bond_overlap = world.points.bond_overlap[k];
            of_kind.push_back(
                {point, bond_overlap, own_shares ? static_cast<float>(share_of_stiffness(world, k)) : 1.0F});
            if (bonds.facts().strengths_are_given && (state.flags & point_held) == 0) {
                tensile += law.tensile_strength;
                cohesion += law.cohesion;
            }
            const double back_tension = law.normal_stiffness * bond_overlap;
            overlap += world.points.bond_overlap[k];
            tension += back_tension;
        }
        std::ranges::sort(of_kind, {}, [](const BondOfKind& one) { return key_of(K, one.point); });
        for (const BondOfKind& one : of_kind) {
            bonds.points.push_back(K, one.point);
            bonds.overlaps.push_back(one.overlap);
            if (own_shares) bonds.shares.push_back(one.share);
        }
        bonds.kind_begin[static_cast<std::size_t>(K) + 1] = static_cast<PointIndex>(bonds.points.size());
    });
    bonds.kind_begin.back() = static_cast<PointIndex>(bonds.points.size());
    record_faces(bonds, world, tensile, cohesion);
    if (bonds.points.empty()) return;
    bonds.mean_overlap = overlap / static_cast<double>(bonds.points.size());
    bonds.mean_back_tension = tension / static_cast<double>(bonds.points.size());
    bonds.mean_back_tension_interface = tension / static_cast<double>(world.bonds.interfaces_initial);
    const auto breakable = static_cast<double>(world.bonds.initial - world.bonds.held);
    if (bonds.facts().strengths_are_given && breakable > 0.0) {
        bonds.mean_tensile_strength = tensile / breakable;
        bonds.mean_cohesion = cohesion / breakable;
    }
}

}  // namespace

BondRecord record_bonds(const World& world, const std::vector<SpecimenTrace>& traces, double grip) {
    BondRecord bonds;
    bonds.law = world.settings.bond_law;
    bonds.thick = world.settings.thick;
    bonds.grip = grip;
    bonds.start.reserve(world.bodies.size());
    for (const BodyState& body : world.bodies.state) bonds.start.push_back({body.x, body.y, body.angle});
    record_points(bonds, world);
    bonds.traces = traces;
    if (!traces.empty()) {
        bonds.trace_faces = find_trace_faces(world);
        bonds.face_of_bond = faces_of_bonds(bonds.trace_faces, bonds.points);
    }
    return bonds;
}

BodyState placed_body(const World& world, const BondRecord& bonds, BodyIndex b, double x, double y, double angle) {
    BodyState body{x, y, 0.0, 0.0, 0.0, {0.0, 0.0}, angle};
    if (world.bodies.info(b).single_circle) {
        body.shape[0] = world.bodies.state[b].shape[0];  // the radius, which never changes
        return body;
    }
    const double turn = angle - bonds.start[b].angle;
    body.shape[0] = correctly_rounded::cos(turn);
    body.shape[1] = correctly_rounded::sin(turn);
    return body;
}

}  // namespace crackle
