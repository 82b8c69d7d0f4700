// SPDX-License-Identifier: GPL-3.0-or-later
// Division of a sweep among threads, used by the sweep's plan and kernels.
// Tested by tests/solver/stepping/sweep_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "solver/world/world.hpp"

namespace crackle {

/// Index of the first of `count` items that thread `thread` processes.
inline std::uint32_t share_begin(std::uint32_t count, std::size_t thread, std::size_t threads) {
    return static_cast<std::uint32_t>(std::uint64_t{count} * thread / threads);
}

/// Index of the thread that processes item `one` of `count`.
inline std::size_t share_of(std::uint32_t one, std::uint32_t count, std::size_t threads) {
    return ((one + std::uint64_t{1}) * threads - 1) / count;
}

inline bool has_partner(std::size_t kind) { return static_cast<PointKind>(kind) != PointKind::element_wall; }

/// End of the points that are summed in groups of four, within the points of one kind from `begin` to `end`.
inline PointIndex end_of_fours(const World& world, std::size_t kind, PointIndex begin, PointIndex end) {
    if (static_cast<PointKind>(kind) != PointKind::element_outline) return begin;
    return std::clamp(world.points.fours_end, begin, end);
}

inline std::uint32_t end_of_chunks(const SweepPlan& plan, std::size_t thread) {
    const std::uint32_t chunks = plan.thread_chunks[thread + 1];
    return chunks == 0 ? 0 : plan.chunks[chunks - 1].end_body;
}

/// Whether all bodies may move, because no thread waits for bond events to be recorded.
inline bool none_held(const SweepPlan& plan) {
    return std::ranges::none_of(plan.shares, [](const SweepPlan::Share& share) { return share.held; });
}

}  // namespace crackle
