// SPDX-License-Identifier: GPL-3.0-or-later
// Division of a world's steps among threads, and timing of the steps. Nothing in this file affects results or is saved.
// Tested by tests/solver/stepping/sweep_test.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "solver/world/points.hpp"
#include "solver/world/profile.hpp"

namespace crackle {

/// Number of points that a force pass gives to a thread at a time. It is fixed, so that sums over blocks do not depend
/// on the number of threads.
inline constexpr PointIndex block_points = 256;

/// Largest squared surface speed among a group of bodies, m2/s2.
struct Speeds {
    double fastest = 0.0;
    double sum_of_excess = 0.0;  // sum of 0·speed: 0, or NaN if any speed is infinite or NaN

    /// Adds a body to the group. @param squared the squared surface speed of the body, m2/s2
    void add(double squared) {
        sum_of_excess += 0.0 * squared;
        fastest = std::max(fastest, squared);
    }
    /// Adds another group of bodies to this one.
    void add(const Speeds& others) {
        sum_of_excess += others.sum_of_excess;
        fastest = std::max(fastest, others.fastest);
    }
    /// @return `fastest`, or NaN if any speed is not finite
    double checked() const { return sum_of_excess == 0.0 ? fastest : std::numeric_limits<double>::quiet_NaN(); }
};

/// Order in which the threads process points and bodies in a step (stepping/sweep.cpp).
struct SweepPlan {
    bool valid = false;
    std::size_t largest_kind = 0;  // kind of contact point that has the most points

    /// A range of blocks of points of the largest kind, with the bodies that have their last point of this kind in
    /// these blocks.
    struct Chunk {
        PointIndex end_block;    // end of the range of blocks
        std::uint32_t end_body;  // end of the chunk's bodies in `order`
    };
    std::vector<Chunk> chunks;
    std::vector<std::uint32_t> thread_chunks;  // index of each thread's first chunk, then the total number of chunks
    std::vector<BodyIndex> order;  // bodies of the chunks, then bodies shared by threads, then driven bodies
    // Index into `order` of the first body that is shared by threads: its points of the largest kind lie in chunks of
    // several threads.
    std::uint32_t late_begin = 0;
    std::uint32_t driven_begin = 0;  // index into `order` of the first driven body
    bool free_ones_turn = false;     // whether some undriven body has a frame that rotates with it

    // The following members are used only with several threads. They hold force contributions that a thread cannot add
    // immediately, because another thread must add its own first.
    std::vector<std::uint16_t> owner;  // for each body: thread that adds forces to it
    std::vector<std::uint8_t>
        defers;  // for each block of the largest kind of point: whether it has points on bodies of other threads
    std::vector<BodyForce> deferred;            // force contributions to bodies owned by other threads
    std::vector<std::uint32_t> deferred_begin;  // for each thread: index of its first entry in `deferred`
    std::vector<std::uint32_t> sources;  // indices into `deferred`, by body, for bodies in `order` from late_begin on
    std::vector<std::uint32_t> sources_begin;
    std::vector<PointForce> smaller_kinds;  // forces of the points of all kinds except the largest kind

    /// Progress of one thread in the current step.
    struct alignas(64) Share {
        Speeds speeds;
        std::uint32_t moved_end = 0;  // index into `order`: end of the thread's bodies that have already moved
        bool held = false;            // whether the bodies of this thread must not move until bond events are recorded
    };
    std::vector<Share> shares;
};

/// Threads, and data that they keep from step to step; not part of the saved state.
struct Workers {
    int threads = 1;
    SweepPlan plan;
    std::vector<std::int64_t> blocks_done;  // for each thread: number of blocks of points processed
    std::vector<std::uint8_t> marks;        // for each body; all 0 except during count_new_points()
    Profile* profile = nullptr;             // timing of phases; null if phases are not timed
    bool one_by_one = false;  // process points one at a time, as a reference that batches must reproduce byte for byte
    // Called between the iterations of linear solves; an exception thrown by it ends the solve.
    std::function<void()> while_solving;

    /// Calls while_solving, if set, to poll for interrupts. An exception that it throws ends the linear solve.
    void hear() const {
        if (while_solving) while_solving();
    }
};

}  // namespace crackle
