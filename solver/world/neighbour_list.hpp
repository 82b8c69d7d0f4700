// SPDX-License-Identifier: GPL-3.0-or-later
// What a world knows of its neighbour list besides the points: where bodies were when it was built, how far they may
// move until it is rebuilt (neighbours/).
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/array.hpp"

namespace crackle {

/// Widest common skin as a share of the median bounding radius: an intact specimen strains by less, and few idle points
/// are listed.
inline constexpr double skin_share = 0.1;

/// Where a body's centroid was when the neighbour list was built, m.
struct ListReference {
    double x, y;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("x", s.x);
        visit("y", s.y);
    }
};

struct NeighbourList {
    double skin = 0.0;         // m
    double widest_skin = 0.0;  // m; in a bonded world the skin follows the motion up to this; 0: it stays as given
    /// How far a body's surface may move until the list is rebuilt, m: half the skin that it was built with, or more
    /// for a fast body. By body; empty where there is no fast one.
    double half_skin = 0.0;
    Array<double> own_half_skins;
    Array<ListReference> reference;
    Array<double> reference_angles;        // rad, by Bodies::shapes
    std::vector<std::uint32_t> size_rank;  // bodies by bounding radius, largest 0; a pair is found by its larger body
    double travelled = 0.0;                // m, bound on any surface point's way since ways were last looked at
    double free_way = 0.0;                 // m, that every surface point can go from there within its half skin
    double fastest = 0.0;                  // m/s, largest surface speed in the last step
    double fastest_allowed_move = 0.0;     // m a step: half the smallest body, beyond which contacts would be missed
    bool valid = false;
    std::int64_t built_at = 0;  // step
    std::int64_t builds = 0;

    double half_skin_of(std::size_t body) const { return own_half_skins.empty() ? half_skin : own_half_skins[body]; }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("skin", s.skin);
        visit("widest_skin", s.widest_skin);
        visit("half_skin", s.half_skin);
        visit("own_half_skins", s.own_half_skins);
        visit("reference", s.reference);
        visit("reference_angles", s.reference_angles);
        visit("size_rank", s.size_rank);
        visit("travelled", s.travelled);
        visit("free_way", s.free_way);
        visit("fastest", s.fastest);
        visit("fastest_allowed_move", s.fastest_allowed_move);
        visit("valid", s.valid);
        visit("built_at", s.built_at);
        visit("builds", s.builds);
    }
};

}  // namespace crackle
