// SPDX-License-Identifier: GPL-3.0-or-later
// Accumulates the losses of a block of contact points while its forces are computed.
// Tested by tests/solver/contact/force_test.cpp.
#pragma once

#include <cstdint>

#include "solver/base/lanes.hpp"
#include "solver/world/energy_account.hpp"
#include "solver/world/points.hpp"

namespace crackle {

/// Losses of a block of points. Dashpot losses are added to one of eight sums, selected by the point's position in the
/// block modulo 8, so that consecutive additions are independent. The number of sums is fixed, so that the result does
/// not depend on the number of lanes.
struct BlockLosses {
    static constexpr PointIndex places = 8;
    alignas(64) double dashpot[places] = {};
    double friction = 0.0, law = 0.0;
    std::uint32_t broken = 0, gained = 0;

    /// Adds the dashpot loss of a point. @param place the point's position in the block
    CRACKLE_INLINE void add_dashpots(PointIndex place, double lost) { dashpot[place % places] += lost; }
    /// Adds the dashpot losses of a batch. @param place the position of the batch's first point in the block
    CRACKLE_INLINE void add_dashpots(PointIndex place, const Lanes& lost) {
        const PointIndex first = place % places;
        if (first + lane_count <= places) {
            store_as(dashpot + first, load_as<Lanes>(dashpot + first) + lost);
        } else {
            for (PointIndex l = 0; l < lane_count; ++l) dashpot[(first + l) % places] += lost[l];
        }
    }

    // Adds the friction losses of sliding points, one after another.
    CRACKLE_INLINE void add_friction(bool slides, double lost) { friction += slides ? lost : 0.0; }
    CRACKLE_INLINE void add_friction(const LaneBits& slides, const Lanes& lost) {
        for (int l = 0; l < lane_count; ++l) friction += slides[l] != 0 ? lost[l] : 0.0;
    }

    LossBlock total() const {
        double sum = 0.0;
        for (const double one : dashpot) sum += one;
        return {sum, friction, law, broken, gained};
    }
};

}  // namespace crackle
