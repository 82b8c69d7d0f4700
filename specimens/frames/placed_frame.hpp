// SPDX-License-Identifier: GPL-3.0-or-later
// The bodies of a frame where they lay then, and surfaces of bodies that face each other: what is drawn from.
// Tested by tests/specimens/frames/frame_test.cpp.
#pragma once

#include <vector>

#include "solver/geometry/geometry.hpp"
#include "specimens/frames/frame.hpp"

namespace crackle {

/// A frame with the turn of each body, found once for all that is drawn of it. All three must outlive it.
class PlacedFrame {
  public:
    PlacedFrame(const World& world, const TestSetup& setup, const Frame& frame);

    const World& world() const { return world_; }
    const TestSetup& setup() const { return setup_; }
    const Frame& frame() const { return frame_; }
    /// Cosine and sine of what a body has turned since loading began.
    Vec2 turn(BodyIndex b) const { return turns_[b]; }
    /// As BodyState's, without velocities.
    BodyState body(BodyIndex b) const;
    /// Where a place, m, that moved along with a body since loading began is now.
    Vec2 carried(BodyIndex b, Vec2 place) const;

  private:
    const World& world_;
    const TestSetup& setup_;
    const Frame& frame_;
    std::vector<Vec2> turns_;
};

/// By a turn's cosine and sine.
inline Vec2 rotated(Vec2 turn, Vec2 arm) { return {turn.x * arm.x - turn.y * arm.y, turn.y * arm.x + turn.x * arm.y}; }

/// Where two bodies face each other at a contact point, m: points of their surfaces, which between polygons are the
/// width of the gap apart, and the unit normal from i to j.
struct Facing {
    Vec2 on_i, on_j, normal;
    double gap;  // m, of the outlines
};

/// @param i  body_i of the point, where g was found
inline Facing facing_at(const TestSetup& setup, PointKind kind, const BodyState& i, const ContactGeometry& g) {
    // A pair of segments sums up several overlaps: there the gap is that of the mesh.
    const bool outline = kind == PointKind::element_outline && setup.polygons;
    const double gap = outline                              ? setup.bond_thick - g.overlap
                       : kind == PointKind::segment_segment ? setup.mesh_gap
                                                            : 0.0;
    const Vec2 middle{i.x + g.aix, i.y + g.aiy}, normal{g.nx, g.ny}, half_gap = 0.5 * gap * normal;
    return {middle - half_gap, middle + half_gap, normal, gap};
}

/// Where a bond is held to its two bodies when loading begins.
template <PointKind K>
Facing facing_at_start(const World& world, const TestSetup& setup, const ContactPoint& point) {
    const auto body = [&](BodyIndex b) {
        const StartPlace& start = setup.start[b];
        return placed_body(world, setup, b, start.x, start.y, start.angle);
    };
    const BodyState i = body(point.body_i);
    std::uint32_t feature = point.feature_j;
    return facing_at(setup, K, i, contact_geometry<K>(world, point, i, body(point.body_j), feature));
}

/// Whether a body is a circle or a clump of circles.
inline bool is_circles(const World& world, BodyIndex b) { return world.bodies.info(b).piece_count == 0; }

}  // namespace crackle
