// SPDX-License-Identifier: GPL-3.0-or-later
// A membrane about a world: chains of points of bodies, straight pieces between them, and the pressure on these. Empty
// in worlds without one. solver/membrane/ wraps and presses it. Tested by tests/solver/membrane/membrane_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/world/bodies.hpp"

namespace crackle {

/// A point of a body, and the piece that leads to it from the one before.
struct MembranePoint {
    BodyIndex body;
    double x, y;     // m, from the centroid in the body's frame
    double longest;  // m, of the piece; one that is longer has parted

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("body", s.body);
        visit("x", s.x);
        visit("y", s.y);
        visit("longest", s.longest);
    }
};

struct Membrane {
    double pressure = 0.0;  // N/m of a plane, force over length
    double probe = 0.0;     // m, radius of the disc that is rolled about the bodies to find the points
    /// Bodies between which it spans, the upper faces downwards and upwards; no_body: it goes round all bodies.
    BodyIndex bottom = no_body, top = no_body;
    /// Points clockwise about the bodies. Between two platens: of the left side upwards to `left_end`, then of the
    /// right side downwards, the platens' own points at the ends of each.
    std::vector<MembranePoint> points;
    std::uint64_t left_end = 0;

    bool known = false;            // the area below
    bool parted = false;           // a piece has grown too long: wrapped anew before the next force pass
    std::int64_t list_builds = 0;  // NeighbourList::builds when it was wrapped
    double area = 0.0;             // m², enclosed, less what platens have swept, at the last force pass
    double work = 0.0;             // J, done on the bodies
    double jumped = 0.0;           // m², by which wrapping anew has changed the area, its sum; no work is done by it
    std::int64_t wrapped = 0;      // times
    std::int64_t open = 0;         // times that it could not be: the bodies do not reach from platen to platen any more

    bool present() const { return probe > 0.0; }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("pressure", s.pressure);
        visit("probe", s.probe);
        visit("bottom", s.bottom);
        visit("top", s.top);
        visit("points", s.points);
        visit("left_end", s.left_end);
        visit("known", s.known);
        visit("parted", s.parted);
        visit("list_builds", s.list_builds);
        visit("area", s.area);
        visit("work", s.work);
        visit("jumped", s.jumped);
        visit("wrapped", s.wrapped);
        visit("open", s.open);
    }
};

}  // namespace crackle
