// SPDX-License-Identifier: GPL-3.0-or-later
// Positions of the bodies in a frame, and of their facing surfaces at contacts: the geometry needed to plot the frame.
// Tested by tests/specimens/frames/frame_test.cpp.
#pragma once

#include <vector>

#include "solver/geometry/geometry.hpp"
#include "solver/world/world.hpp"
#include "specimens/frames/frame.hpp"

namespace crackle {

/// A frame with the rotation of each body as cosine and sine, computed once for all files of the frame.
class PlacedFrame {
  public:
    /// Computes the rotations. World, setup and frame must outlive this object.
    PlacedFrame(const World& world, const TestSetup& setup, const Frame& frame);

    /// World of the test.
    const World& world() const { return world_; }
    /// Setup of the test.
    const TestSetup& setup() const { return setup_; }
    /// The frame itself.
    const Frame& frame() const { return frame_; }
    /// Cosine and sine of a body's rotation since loading began.
    Vec2 turn(BodyIndex b) const { return turns_[b]; }
    /// Position of a body as a BodyState, without velocities.
    BodyState body(BodyIndex b) const;
    /// Current position of a point that has moved with a body since loading began, m.
    Vec2 carried(BodyIndex b, Vec2 place) const;

  private:
    const World& world_;
    const TestSetup& setup_;
    const Frame& frame_;
    std::vector<Vec2> turns_;
};

/// Rotates a vector. @param turn  cosine and sine of the angle
inline Vec2 rotated(Vec2 turn, Vec2 arm) { return {turn.x * arm.x - turn.y * arm.y, turn.y * arm.x + turn.x * arm.y}; }

/// Two surfaces that face each other at a contact point: a point on each, m, and the unit normal from i to j. Between
/// polygons, the two points are a gap width apart.
struct Facing {
    Vec2 on_i, on_j, normal;
    double gap;  // m, distance between the two points along the normal
};

/// The facing surfaces at a contact point.
/// @param i  state of the point's body_i
/// @param g  geometry computed for this state
inline Facing facing_at(const TestSetup& setup, PointKind kind, const BodyState& i, const ContactGeometry& g) {
    // The overlap of a pair of segments is a sum of several overlaps, so the gap of the mesh is used instead.
    const bool outline = kind == PointKind::element_outline && setup.specimen.polygons;
    const double gap = outline                              ? setup.bonds.thick - g.overlap
                       : kind == PointKind::segment_segment ? setup.specimen.mesh_gap
                                                            : 0.0;
    const Vec2 middle{i.x + g.aix, i.y + g.aiy}, normal{g.nx, g.ny}, half_gap = 0.5 * gap * normal;
    return {middle - half_gap, middle + half_gap, normal, gap};
}

/// The surfaces to which a bond is attached at the start of loading.
template <PointKind K>
Facing facing_at_start(const World& world, const TestSetup& setup, const ContactPoint& point) {
    const auto body = [&](BodyIndex b) {
        const StartPlace& start = setup.bonds.start[b];
        return placed_body(world, setup.bonds, b, start.x, start.y, start.angle);
    };
    const BodyState i = body(point.body_i);
    std::uint32_t feature = point.feature_j;
    return facing_at(setup, K, i, contact_geometry<K>(BodyView(world), point, i, body(point.body_j), feature));
}

/// Whether a body is a circle or a clump of circles.
inline bool is_circles(const World& world, BodyIndex b) { return world.bodies.info(b).piece_count == 0; }

}  // namespace crackle
