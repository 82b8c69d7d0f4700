// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/stepping/sweep.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "solver/base/chosen_set.hpp"
#include "solver/contact/pass.hpp"
#include "solver/stepping/sweep_shares.hpp"

namespace crackle {
namespace {

/// Number of bodies in a chunk; their data fit in the first-level cache while forces are summed and the bodies are
/// moved.
constexpr std::uint32_t bodies_of_chunk = 128;

/// Calls visit(point, body) for each force contribution of a point to a body, in the order of summation. The points are
/// those of the largest kind: the kind that has the most points.
template <class Visit>
void for_each_contribution(const World& world, Visit visit) {
    const std::size_t kind = world.workers.plan.largest_kind;
    const PointIndex begin = world.points.kind_begin[kind], end = world.points.kind_begin[kind + 1];
    const PointIndex fours = end_of_fours(world, kind, begin, end);
    for (PointIndex k = begin; k < end; k += k < fours ? 4 : 1) {
        visit(k, world.points.contact[k].body_i);
        if (has_partner(kind)) visit(k, world.points.contact[k].body_j);
    }
}

/// Range of blocks in which a body has points, among the blocks of the kind that has the most points. For a body
/// without such points, the range is one arbitrary block.
struct BlockSpan {
    PointIndex first, last;
};

std::vector<BlockSpan> block_spans(const World& world, PointIndex blocks) {
    constexpr PointIndex none = std::numeric_limits<PointIndex>::max();
    std::vector<BlockSpan> spans(world.bodies.size(), {none, 0});
    const PointIndex first_point = world.points.kind_begin[world.workers.plan.largest_kind];
    for_each_contribution(world, [&](PointIndex k, BodyIndex b) {
        const PointIndex block = (k - first_point) / block_points;
        spans[b].first = std::min(spans[b].first, block);
        spans[b].last = block;
    });
    for (std::size_t b = 0; b < spans.size(); ++b) {
        if (spans[b].first != none) continue;
        const auto any = static_cast<PointIndex>(b * std::uint64_t{blocks} / spans.size());
        spans[b] = {any, any};
    }
    return spans;
}

/// Determines which thread adds the forces on each body, and where other threads store their contributions to it.
void plan_deferred(World& world, const std::vector<BlockSpan>& spans, PointIndex blocks) {
    SweepPlan& plan = world.workers.plan;
    const auto threads = static_cast<std::size_t>(world.workers.threads);
    plan.owner.resize(spans.size());
    for (std::size_t b = 0; b < spans.size(); ++b)
        plan.owner[b] = static_cast<std::uint16_t>(share_of(spans[b].first, blocks, threads));
    std::vector<BodyIndex> deferred_for;
    plan.deferred_begin.assign(threads + 1, 0);
    plan.defers.assign(blocks, 0);
    const PointIndex first_point = world.points.kind_begin[plan.largest_kind];
    for_each_contribution(world, [&](PointIndex k, BodyIndex b) {
        const PointIndex block = (k - first_point) / block_points;
        const std::size_t thread = share_of(block, blocks, threads);
        if (plan.owner[b] == thread) return;
        plan.defers[block] = 1;
        deferred_for.push_back(b);
        plan.deferred_begin[thread + 1] = static_cast<std::uint32_t>(deferred_for.size());
    });
    for (std::size_t t = 1; t <= threads; ++t)
        plan.deferred_begin[t] = std::max(plan.deferred_begin[t], plan.deferred_begin[t - 1]);
    plan.deferred.assign(deferred_for.size(), {});

    const std::span<const BodyIndex> waiting(plan.order.begin() + plan.late_begin, plan.order.end());
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(spans.size(), none);
    for (std::uint32_t n = 0; n < waiting.size(); ++n) place[waiting[n]] = n;
    plan.sources_begin.assign(waiting.size() + 1, 0);
    for (const BodyIndex b : deferred_for) ++plan.sources_begin[place[b] + 1];
    for (std::size_t n = 1; n < plan.sources_begin.size(); ++n) plan.sources_begin[n] += plan.sources_begin[n - 1];
    plan.sources.resize(deferred_for.size());
    std::vector<std::uint32_t> next = plan.sources_begin;
    for (std::uint32_t d = 0; d < deferred_for.size(); ++d) plan.sources[next[place[deferred_for[d]]]++] = d;
}

}  // namespace

void plan_sweep(World& world) {
    SweepPlan& plan = world.workers.plan;
    if (plan.valid) return;
    const auto threads = static_cast<std::size_t>(world.workers.threads);
    const auto points_of = [&](std::size_t kind) {
        return world.points.kind_begin[kind + 1] - world.points.kind_begin[kind];
    };
    plan.largest_kind = 0;
    for (std::size_t kind = 1; kind < point_kinds; ++kind)
        if (points_of(kind) > points_of(plan.largest_kind)) plan.largest_kind = kind;
    // If there are no points, there is one empty block.
    const PointIndex blocks = std::max(PointIndex{1}, blocks_of_kind(world, plan.largest_kind));
    const std::vector<BlockSpan> spans = block_spans(world, blocks);

    // Bodies are sorted by the block after which their force is complete. Bodies whose points are divided among several
    // threads (late bodies) follow, then driven bodies. Within each group, bodies are sorted by index.
    const PointIndex late = blocks, driven = blocks + 1;
    std::vector<PointIndex> finishing(spans.size());
    for (std::size_t b = 0; b < spans.size(); ++b) {
        const bool alone = share_of(spans[b].first, blocks, threads) == share_of(spans[b].last, blocks, threads);
        finishing[b] = alone ? spans[b].last : late;
    }
    for (const ControlState& control : world.bodies.controls) finishing[control.body] = driven;
    std::vector<std::uint32_t> begin(blocks + 3, 0);
    for (const PointIndex when : finishing) ++begin[when + 1];
    for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
    plan.late_begin = begin[late];
    plan.driven_begin = begin[driven];
    plan.order.resize(spans.size());
    std::vector<std::uint32_t> next = begin;
    for (std::size_t b = 0; b < spans.size(); ++b) plan.order[next[finishing[b]]++] = static_cast<BodyIndex>(b);

    plan.free_ones_turn = std::any_of(plan.order.begin(), plan.order.begin() + plan.driven_begin,
                                      [&](BodyIndex b) { return world.bodies.names[b].shape != no_shape; });

    plan.chunks.clear();
    plan.thread_chunks.assign(1, 0);
    std::uint32_t first_body = 0;
    for (std::size_t thread = 0; thread < threads; ++thread) {
        const PointIndex end = share_begin(blocks, thread + 1, threads);
        for (PointIndex block = share_begin(blocks, thread, threads); block < end; ++block) {
            const std::uint32_t end_body = begin[block + 1];
            if (block + 1 < end && end_body - first_body < bodies_of_chunk) continue;
            plan.chunks.push_back({block + 1, end_body});
            first_body = end_body;
        }
        plan.thread_chunks.push_back(static_cast<std::uint32_t>(plan.chunks.size()));
    }
    plan.shares.assign(threads, {});
    if (threads > 1) {
        plan_deferred(world, spans, blocks);
        plan.smaller_kinds.assign(world.points.size() - points_of(plan.largest_kind), {});
    }
    plan.valid = true;
}

void clear_forces(World& world) {
    const bool consistent = world.settings.integrator == Integrator::consistent;
    if (consistent) world.bodies.last_force.swap(world.bodies.force);
    if (consistent || !world.bodies.forces_clear) std::ranges::fill(world.bodies.force, BodyForce{});
    for (const ControlState& control : world.bodies.controls) world.bodies.force[control.body] = {};
}

Sweep chosen_sweep() {
    return of_chosen_set([]<InstructionSet S>() -> Sweep { return &sweep_of<S>; });
}

Speeds move_the_rest(World& world, MoveListed move, double kick) {
    const SweepPlan& plan = world.workers.plan;
    Speeds speeds;
    const auto move_on = [&](std::uint32_t begin, std::uint32_t end) {
        speeds.add(move(world, kick, plan.order.data() + begin, end - begin));
    };
    for (std::size_t t = 0; t < plan.shares.size(); ++t) {
        speeds.add(plan.shares[t].speeds);
        move_on(plan.shares[t].moved_end, end_of_chunks(plan, t));
    }
    if (!none_held(plan)) move_on(plan.late_begin, plan.driven_begin);
    return speeds;
}

}  // namespace crackle
