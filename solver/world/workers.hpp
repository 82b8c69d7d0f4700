// SPDX-License-Identifier: GPL-3.0-or-later
// How the steps of a world are shared out among threads, and timed. None of it changes a result and none is saved.
// Tested by tests/solver/stepping/sweep_test.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/world/points.hpp"
#include "solver/world/profile.hpp"
#include "solver/world/speeds.hpp"

namespace crackle {

/// Points a force pass hands to one thread at a time; fixed, so that sums over blocks do not depend on the threads.
inline constexpr PointIndex block_points = 256;

/// In which order a step on Workers::threads threads goes through points and bodies (stepping/sweep.cpp).
struct SweepPlan {
    bool valid = false;
    std::size_t largest_kind = 0;

    /// Some blocks of points of the largest kind, and the bodies that have no points beyond them.
    struct Chunk {
        PointIndex end_block;    // of that kind
        std::uint32_t end_body;  // into `order`
    };
    std::vector<Chunk> chunks;
    std::vector<std::uint32_t> thread_chunks;  // per thread: first of its chunks; one more at the end
    std::vector<BodyIndex> order;              // bodies of the chunks, late ones, driven ones
    std::uint32_t late_begin = 0;  // into `order`: bodies with points of the largest kind in chunks of several threads
    std::uint32_t driven_begin = 0;  // into `order`: bodies that a control drives
    bool free_ones_turn = false;     // a body that no control drives has a frame that turns with it

    // For several threads: what one cannot add to a body at once, because another's points come first.
    std::vector<std::uint16_t> owner;           // per body: thread that adds to it
    std::vector<std::uint8_t> defers;           // per block of the largest kind: has points for others' bodies
    std::vector<BodyForce> deferred;            // contributions of other threads
    std::vector<std::uint32_t> deferred_begin;  // per thread: its first in `deferred`
    std::vector<std::uint32_t> sources;         // into `deferred`, by body of `order` from late_begin on
    std::vector<std::uint32_t> sources_begin;
    std::vector<PointForce> smaller_kinds;  // forces of the points of all kinds but the largest

    /// What a thread has done of the present step.
    struct alignas(64) Share {
        Speeds speeds;
        std::uint32_t moved_end = 0;  // into `order`: bodies of its chunks moved so far end here
        bool held = false;            // its bodies stay until events of bonds are recorded
    };
    std::vector<Share> shares;
};

struct Workers {
    int threads = 1;
    SweepPlan plan;
    std::vector<std::int64_t> blocks_done;  // blocks of points that each thread has done
    std::vector<std::uint8_t> marks;        // per body, 0 but within count_new_points()
    Profile* profile = nullptr;             // times the phases where set
    bool one_by_one = false;                // no points side by side: what they must give the bytes of
    std::function<void()> while_solving;    // called between the steps of linear solves; what it throws ends them

    void hear() const {
        if (while_solving) while_solving();
    }
};

}  // namespace crackle
