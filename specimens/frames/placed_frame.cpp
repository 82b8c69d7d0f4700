// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/frames/placed_frame.hpp"

#include <cmath>

#include "solver/base/correctly_rounded.hpp"

namespace crackle {

PlacedFrame::PlacedFrame(const World& world, const TestSetup& setup, const Frame& frame)
    : world_(world), setup_(setup), frame_(frame), turns_(frame.bodies.size()) {
    for (std::size_t b = 0; b < turns_.size(); ++b) {
        const double turn = frame.bodies[b].angle - setup.bonds.start[b].angle;
        turns_[b] = {correctly_rounded::cos(turn), correctly_rounded::sin(turn)};
    }
}

BodyState PlacedFrame::body(BodyIndex b) const {
    const Frame::Body& place = frame_.bodies[b];
    BodyState body{place.x, place.y, 0.0, 0.0, 0.0, {0.0, 0.0}, place.angle};
    if (world_.bodies.info(b).single_circle) {
        body.shape[0] = world_.bodies.state[b].shape[0];  // the radius, which never changes
        return body;
    }
    body.shape[0] = turns_[b].x;
    body.shape[1] = turns_[b].y;
    return body;
}

Vec2 PlacedFrame::carried(BodyIndex b, Vec2 place) const {
    const Frame::Body& body = frame_.bodies[b];
    return Vec2{body.x, body.y} + rotated(turns_[b], place - Vec2{setup_.bonds.start[b].x, setup_.bonds.start[b].y});
}

}  // namespace crackle
