// SPDX-License-Identifier: GPL-3.0-or-later
// State of the neighbour list apart from its points: positions of the bodies when it was built, and how far they may
// move before it must be rebuilt (neighbours/).
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/array.hpp"
#include "solver/base/fields.hpp"

namespace crackle {

/// Widest skin used for all bodies, as a fraction of the median bounding radius. An intact specimen is strained less
/// than this fraction. With a skin of this width, the list holds few points that never touch.
inline constexpr double skin_share = 0.1;

/// Position of a body's centroid when the neighbour list was built, m.
struct ListReference {
    double x, y;

    CRACKLE_FIELDS(x, y);
};

/// Values that determine when the neighbour list must be rebuilt.
struct NeighbourList {
    double skin = 0.0;  // m
    // m, upper limit of the skin in a bonded world, where the skin adapts to the motion; 0 if the skin is fixed.
    double widest_skin = 0.0;
    /// Distance that a body's surface may move before the list is rebuilt, m: half the list's skin, or more for a fast
    /// body. `own_half_skins` is indexed by body, and is empty if there are no fast bodies.
    double half_skin = 0.0;
    Array<double> own_half_skins;
    Array<ListReference> reference;
    Array<double> reference_angles;  // rad, indexed like Bodies::shapes
    // Rank of each body by bounding radius, largest first. Each pair is found from its larger body.
    std::vector<std::uint32_t> size_rank;
    // Upper bound on the distance that any surface point has moved since displacements were last checked, m.
    double travelled = 0.0;
    // Distance by which every surface point could still move, at the last check, without leaving its half skin, m.
    double free_way = 0.0;
    double fastest = 0.0;  // m/s, largest surface speed in the last step
    // m per step: half the bounding radius of the smallest body. A faster body could pass through others without
    // contact.
    double fastest_allowed_move = 0.0;
    bool valid = false;
    std::int64_t built_at = 0;  // step at which the list was built
    std::int64_t builds = 0;

    /// Distance that a body's surface may move before the list is rebuilt, m.
    double half_skin_of(std::size_t body) const { return own_half_skins.empty() ? half_skin : own_half_skins[body]; }

    CRACKLE_FIELDS(skin, widest_skin, half_skin, own_half_skins, reference, reference_angles, size_rank, travelled,
                   free_way, fastest, fastest_allowed_move, valid, built_at, builds);
};

}  // namespace crackle
