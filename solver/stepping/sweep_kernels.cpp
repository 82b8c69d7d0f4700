// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/stepping/sweep_test.cpp.
#include <omp.h>

#include <algorithm>

#include "solver/base/instruction_set.hpp"
#include "solver/base/lanes.hpp"
#include "solver/contact/kernels.hpp"
#include "solver/stepping/sweep.hpp"
#include "solver/stepping/sweep_shares.hpp"
#include "solver/world/profile.hpp"

namespace crackle {
namespace {

/// Force of a point on body i: the point's record itself, whose fourth number is not used.
CRACKLE_INLINE Quad on_i(const PointForce& force) { return load_as<Quad>(&force); }
/// Force of a point on body j, opposite to the force on body i.
CRACKLE_INLINE Quad on_j(const Quad& record) {
    return __builtin_shufflevector(record, record, 0, 1, 3, 2) * Quad{-1.0, -1.0, 1.0, 1.0};
}
CRACKLE_INLINE void add(BodyForce& sum, const Quad& force) { store_as(&sum, load_as<Quad>(&sum) + force); }

/// Calls visit(body, force) for each force contribution of the points from `begin` to `end` of one kind, in the order
/// of for_each_contribution().
/// @param forces the forces of the points from `begin` on @param fours_end the result of end_of_fours()
template <bool Partner, class Visit>
CRACKLE_INLINE void visit_contributions(const World& world, PointIndex begin, PointIndex fours_end, PointIndex end,
                                        const PointForce* forces, Visit visit) {
    const BodyPair* const points = world.points.contact.pairs.data();
    PointIndex k = begin;
    if constexpr (Partner) {
        for (; k < fours_end; k += 4, forces += 4) {
            const BodyIndex a = points[k].body_i, b = points[k].body_j;
            const auto on_a = [&](PointIndex l) {
                const Quad force = on_i(forces[l]);
                return points[k + l].body_i == a ? force : on_j(force);
            };
            const Quad sum = (on_a(0) + on_a(1)) + (on_a(2) + on_a(3));
            visit(a, sum);
            visit(b, on_j(sum));
        }
    }
    for (; k < end; ++k, ++forces) {
        const Quad force = on_i(*forces);
        visit(points[k].body_i, force);
        if constexpr (Partner) visit(points[k].body_j, on_j(force));
    }
}

/// Visits the force contributions of a kind known only at run time.
template <class Visit>
CRACKLE_INLINE void visit_contributions(const World& world, std::size_t kind, PointIndex begin, PointIndex end,
                                        const PointForce* forces, Visit visit) {
    if (has_partner(kind))
        visit_contributions<true>(world, begin, end_of_fours(world, kind, begin, end), end, forces, visit);
    else
        visit_contributions<false>(world, begin, begin, end, forces, visit);
}

/// One share of a sweep, processed in three phases: do_smaller_kinds(), do_largest_kind(), finish_late_bodies(). A
/// phase starts only after all shares have completed the previous one. Any thread can process a share.
class Sweeper {
  public:
    Sweeper(World& world, const PassView& view, MoveListed move, double kick, std::size_t thread)
        : world_(world),
          plan_(world.workers.plan),
          view_(view),
          move_(move),
          kick_(kick),
          thread_(thread),
          threads_(std::max<std::size_t>(1, plan_.shares.size())),
          profile_(thread_ == 0 ? world.workers.profile : nullptr),
          share_(plan_.shares[thread_]),
          deferred_(threads_ == 1 ? nullptr : plan_.deferred.data() + plan_.deferred_begin[thread_]) {
        clear_upper_halves();
    }

    void do_smaller_kinds() {
        std::size_t before = 0;  // number of points of the smaller kinds already processed
        for (std::size_t kind = 0; kind < point_kinds; ++kind) {
            const PointIndex blocks = blocks_of_kind(world_, kind);
            if (kind == plan_.largest_kind || blocks == 0) continue;
            const ForceKernel kernel = force_kernel_of<InstructionSet::CRACKLE_SET>(view_.features, kind);
            PointForce at_hand[block_points];
            const PointIndex end = share_begin(blocks, thread_ + 1, threads_);
            const PointIndex first = share_begin(blocks, thread_, threads_);
            for (PointIndex b = first; b < end; ++b) {
                PointForce* const kept = plan_.smaller_kinds.data() + before + std::size_t{b} * block_points;
                const PointBlock block =
                    threads_ == 1 ? block_to_fill(kind, b, at_hand) : block_of(world_, kind, b, kept);
                {
                    const PhaseTimer timer(profile_, Phase::force);
                    kernel(view_, block);
                }
                // With several threads, forces are summed after all threads have computed theirs.
                if (threads_ > 1) continue;
                const PhaseTimer timer(profile_, Phase::gather);
                add_all(block, kind);
            }
            world_.workers.blocks_done[thread_] += end - first;
            before += world_.points.kind_begin[kind + 1] - world_.points.kind_begin[kind];
        }
    }

    void do_largest_kind() {
        if (threads_ > 1) add_smaller_kinds();
        share_ = {{},
                  thread_ == 0 ? 0 : end_of_chunks(plan_, thread_ - 1),
                  world_.bonds.watch_slips || smaller_kinds_broke()};
        const std::size_t kind = plan_.largest_kind, first_block = first_block_of(world_, kind);
        const ForceKernel kernel = force_kernel_of<InstructionSet::CRACKLE_SET>(view_.features, kind);
        const PointIndex blocks = blocks_of_kind(world_, kind);
        PointForce at_hand[block_points];
        PointIndex b = share_begin(blocks, thread_, threads_);
        std::uint32_t body = share_.moved_end;
        for (std::uint32_t c = plan_.thread_chunks[thread_]; c < plan_.thread_chunks[thread_ + 1]; ++c) {
            const SweepPlan::Chunk& chunk = plan_.chunks[c];
            // The range of blocks is empty if there are no points of this kind.
            const PointIndex first = b, end = std::min(chunk.end_block, blocks);
            for (; b < end; ++b) {
                const PointBlock block = block_to_fill(kind, b, at_hand);
                {
                    const PhaseTimer timer(profile_, Phase::force);
                    kernel(view_, block);
                }
                const PhaseTimer timer(profile_, Phase::gather);
                threads_ > 1 && plan_.defers[b] != 0 ? add_or_defer(block, kind) : add_all(block, kind);
            }
            world_.workers.blocks_done[thread_] += end - first;
            share_.held = share_.held || some_broke(first_block + first, first_block + end);
            if (move_ != nullptr && !share_.held) {
                move_on(body, chunk.end_body);
                share_.moved_end = chunk.end_body;
            }
            body = chunk.end_body;
        }
    }

    void finish_late_bodies() {
        const auto waiting = static_cast<std::uint32_t>(plan_.order.size()) - plan_.late_begin;
        const std::uint32_t begin = share_begin(waiting, thread_, threads_);
        const std::uint32_t end = share_begin(waiting, thread_ + 1, threads_);
        {
            const PhaseTimer timer(profile_, Phase::gather);
            for (std::uint32_t n = begin; n < end; ++n) {
                BodyForce& sum = world_.bodies.force[plan_.order[plan_.late_begin + n]];
                for (std::uint32_t s = plan_.sources_begin[n]; s < plan_.sources_begin[n + 1]; ++s)
                    add(sum, load_as<Quad>(&plan_.deferred[plan_.sources[s]]));
            }
        }
        if (move_ == nullptr || !none_held(plan_)) return;
        const auto free_end = [&](std::uint32_t n) { return std::min(plan_.late_begin + n, plan_.driven_begin); };
        move_on(free_end(begin), free_end(end));
    }

  private:
    bool smaller_kinds_broke() const {
        const std::size_t first = first_block_of(world_, plan_.largest_kind);
        return some_broke(0, first) ||
               some_broke(first + blocks_of_kind(world_, plan_.largest_kind), world_.account.blocks.size());
    }

    /// Adds the forces of the smaller kinds. Every thread reads all their points, but adds forces only to the bodies
    /// that it owns.
    void add_smaller_kinds() {
        const PointForce* force = plan_.smaller_kinds.data();
        for (std::size_t kind = 0; kind < point_kinds; ++kind) {
            if (kind == plan_.largest_kind) continue;
            const PointIndex begin = world_.points.kind_begin[kind], end = world_.points.kind_begin[kind + 1];
            visit_contributions(world_, kind, begin, end, force, [&](BodyIndex b, const Quad& on_b) {
                if (owns(b)) add(world_.bodies.force[b], on_b);
            });
            force += end - begin;
        }
        if (!world_.points.force.empty() && thread_ == 0) keep_smaller_kinds();
    }

    void keep_smaller_kinds() {
        const auto largest = static_cast<std::ptrdiff_t>(world_.points.kind_begin[plan_.largest_kind]);
        std::copy_n(plan_.smaller_kinds.begin(), largest, world_.points.force.begin());
        std::copy(plan_.smaller_kinds.begin() + largest, plan_.smaller_kinds.end(),
                  world_.points.force.begin() + world_.points.kind_begin[plan_.largest_kind + 1]);
    }

    /// The block whose forces are to be computed. Its forces are stored in a shared array if other threads need them,
    /// otherwise in `at_hand`.
    PointBlock block_to_fill(std::size_t kind, PointIndex b, PointForce* at_hand) {
        PointBlock block = block_of(world_, kind, b, at_hand);
        if (!world_.points.force.empty()) block.forces = world_.points.force.data() + block.begin;
        return block;
    }

    void add_all(const PointBlock& block, std::size_t kind) {
        BodyForce* const sums = world_.bodies.force.data();
        visit_contributions(world_, kind, block.begin, block.end, block.forces,
                            [sums](BodyIndex b, const Quad& force) { add(sums[b], force); });
    }

    void add_or_defer(const PointBlock& block, std::size_t kind) {
        visit_contributions(world_, kind, block.begin, block.end, block.forces, [&](BodyIndex b, const Quad& force) {
            if (owns(b))
                add(world_.bodies.force[b], force);
            else
                store_as(deferred_++, force);
        });
    }

    void move_on(std::uint32_t begin, std::uint32_t end) {
        const PhaseTimer timer(profile_, Phase::integrate);
        share_.speeds.add(move_(world_, kick_, plan_.order.data() + begin, end - begin));
    }

    bool owns(BodyIndex b) const { return plan_.owner[b] == thread_; }

    bool some_broke(std::size_t first_block, std::size_t end_block) const {
        for (std::size_t b = first_block; b < end_block; ++b)
            if (world_.account.blocks[b].broken > 0) return true;
        return false;
    }

    World& world_;
    SweepPlan& plan_;
    const PassView& view_;
    MoveListed move_;
    double kick_;
    std::size_t thread_, threads_;
    Profile* profile_;
    SweepPlan::Share& share_;
    BodyForce* deferred_;
};

}  // namespace

template <>
void sweep_of<InstructionSet::CRACKLE_SET>(World& world, const PassView& view, MoveListed move, double kick) {
    const std::size_t shares = world.workers.plan.shares.size();
    if (shares == 1) {  // no thread team: its barriers would cost a tenth of a step in a small scene
        Sweeper sweeper(world, view, move, kick, 0);
        sweeper.do_smaller_kinds();
        return sweeper.do_largest_kind();
    }
    const bool smaller_kinds = !world.workers.plan.smaller_kinds.empty();
#pragma omp parallel num_threads(world.workers.threads)
    {
        // A team can be smaller than requested (OMP_THREAD_LIMIT, OMP_DYNAMIC); its threads then process several shares
        // each.
        const auto team = static_cast<std::size_t>(omp_get_num_threads());
        const auto mine = [&](auto phase) {
            for (auto share = static_cast<std::size_t>(omp_get_thread_num()); share < shares; share += team) {
                Sweeper sweeper(world, view, move, kick, share);
                (sweeper.*phase)();
            }
        };
        if (smaller_kinds) {
            mine(&Sweeper::do_smaller_kinds);
#pragma omp barrier
        }
        mine(&Sweeper::do_largest_kind);
#pragma omp barrier
        mine(&Sweeper::finish_late_bodies);
    }
}

}  // namespace crackle
