// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/stepping/sweep.hpp"

#include <omp.h>

#include <algorithm>
#include <limits>
#include <span>

#include "solver/base/lanes.hpp"
#include "solver/world/profile.hpp"

namespace crackle {
namespace {

/// So many that forces are added up, and bodies moved, while they are in the first cache.
constexpr std::uint32_t bodies_of_chunk = 128;

/// First of `count` that is thread `thread`'s.
std::uint32_t share_begin(std::uint32_t count, std::size_t thread, std::size_t threads) {
    return static_cast<std::uint32_t>(std::uint64_t{count} * thread / threads);
}

/// The thread whose share has one of `count`.
std::size_t share_of(std::uint32_t one, std::uint32_t count, std::size_t threads) {
    return ((one + std::uint64_t{1}) * threads - 1) / count;
}

bool has_partner(std::size_t kind) { return static_cast<PointKind>(kind) != PointKind::element_wall; }

/// Of points from `begin` to `end`, of one kind, where those end that are added up four at a time.
PointIndex end_of_fours(const World& world, std::size_t kind, PointIndex begin, PointIndex end) {
    if (static_cast<PointKind>(kind) != PointKind::element_outline) return begin;
    return std::clamp(world.points.fours_end, begin, end);
}

/// Calls visit(point, body) for each contribution of the points of the largest kind to a body, in the order in which
/// they are added up.
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

/// Blocks of the largest kind that have a body's points; of one that has none, any.
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

/// Who adds to which body, and where the others leave what they have for it.
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
    // Where there are no points one empty block stands for them.
    const PointIndex blocks = std::max(PointIndex{1}, blocks_of_kind(world, plan.largest_kind));
    const std::vector<BlockSpan> spans = block_spans(world, blocks);

    // Bodies by the block they are finished after, then late ones, then driven ones; alike ones by number.
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

namespace {

/// Of a point's record what acts on i: the record itself. Its fourth number is nothing to a body.
CRACKLE_INLINE Quad on_i(const PointForce& force) { return load_as<Quad>(&force); }
/// The other side of what acts on i.
CRACKLE_INLINE Quad on_j(const Quad& record) {
    return __builtin_shufflevector(record, record, 0, 1, 3, 2) * Quad{-1.0, -1.0, 1.0, 1.0};
}
CRACKLE_INLINE void add(BodyForce& sum, const Quad& force) { store_as(&sum, load_as<Quad>(&sum) + force); }

/// Calls visit(body, force) for each contribution of some points of one kind, in the order of for_each_contribution().
/// @param forces of point `begin` and on @param fours_end as by end_of_fours()
template <bool Partner, class Visit>
CRACKLE_INLINE void visit_contributions(const World& world, PointIndex begin, PointIndex fours_end, PointIndex end,
                                        const PointForce* forces, Visit visit) {
    const ContactPoint* const points = world.points.contact.data();
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

/// The same of a kind that is known at run time alone.
template <class Visit>
CRACKLE_INLINE void visit_contributions(const World& world, std::size_t kind, PointIndex begin, PointIndex end,
                                        const PointForce* forces, Visit visit) {
    if (has_partner(kind))
        visit_contributions<true>(world, begin, end_of_fours(world, kind, begin, end), end, forces, visit);
    else
        visit_contributions<false>(world, begin, begin, end, forces, visit);
}

/// One share of a sweep, by whichever thread: do_smaller_kinds(), then do_largest_kind(), then finish_late_bodies(),
/// each once all shares have done the one before.
class Sweeper {
  public:
    Sweeper(World& world, const ContactFeatures& features, MoveListed move, double kick, std::size_t thread)
        : world_(world),
          plan_(world.workers.plan),
          features_(features),
          move_(move),
          kick_(kick),
          thread_(thread),
          threads_(std::max<std::size_t>(1, plan_.shares.size())),
          profile_(thread_ == 0 ? world.workers.profile : nullptr),
          share_(plan_.shares[thread_]),
          deferred_(threads_ == 1 ? nullptr : plan_.deferred.data() + plan_.deferred_begin[thread_]) {}

    static std::uint32_t end_of_chunks(const SweepPlan& plan, std::size_t thread) {
        const std::uint32_t chunks = plan.thread_chunks[thread + 1];
        return chunks == 0 ? 0 : plan.chunks[chunks - 1].end_body;
    }

    static bool none_held(const SweepPlan& plan) {
        return std::ranges::none_of(plan.shares, [](const SweepPlan::Share& share) { return share.held; });
    }

    void do_smaller_kinds() {
        std::size_t before = 0;  // points of kinds passed
        for (std::size_t kind = 0; kind < point_kinds; ++kind) {
            const PointIndex blocks = blocks_of_kind(world_, kind);
            if (kind == plan_.largest_kind || blocks == 0) continue;
            const ForceKernel kernel = force_kernel(features_, kind);
            PointForce at_hand[block_points];
            const PointIndex end = share_begin(blocks, thread_ + 1, threads_);
            for (PointIndex b = share_begin(blocks, thread_, threads_); b < end; ++b) {
                PointForce* const kept = plan_.smaller_kinds.data() + before + std::size_t{b} * block_points;
                const PointBlock block =
                    threads_ == 1 ? block_to_fill(kind, b, at_hand) : block_of(world_, kind, b, kept);
                compute(kernel, block);
                if (threads_ > 1) continue;  // added up when all threads have found theirs
                const PhaseTimer timer(profile_, Phase::gather);
                add_all(block, kind);
            }
            before += world_.points.kind_begin[kind + 1] - world_.points.kind_begin[kind];
        }
    }

    void do_largest_kind() {
        if (threads_ > 1) add_smaller_kinds();
        share_ = {{},
                  thread_ == 0 ? 0 : end_of_chunks(plan_, thread_ - 1),
                  world_.bonds.watch_slips || smaller_kinds_broke()};
        const std::size_t kind = plan_.largest_kind, first_block = first_block_of(world_, kind);
        const ForceKernel kernel = force_kernel(features_, kind);
        const PointIndex blocks = blocks_of_kind(world_, kind);
        PointForce at_hand[block_points];
        PointIndex b = share_begin(blocks, thread_, threads_);
        std::uint32_t body = share_.moved_end;
        for (std::uint32_t c = plan_.thread_chunks[thread_]; c < plan_.thread_chunks[thread_ + 1]; ++c) {
            const SweepPlan::Chunk& chunk = plan_.chunks[c];
            const PointIndex first = b, end = std::min(chunk.end_block, blocks);  // none where the kind has no points
            for (; b < end; ++b) {
                const PointBlock block = block_to_fill(kind, b, at_hand);
                compute(kernel, block);
                const PhaseTimer timer(profile_, Phase::gather);
                threads_ > 1 && plan_.defers[b] != 0 ? add_or_defer(block, kind) : add_all(block, kind);
            }
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

    /// Each thread goes through all of them and adds to the bodies it owns.
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

    /// A block whose forces go to where they are read later, else to where they are at hand.
    PointBlock block_to_fill(std::size_t kind, PointIndex b, PointForce* at_hand) {
        PointBlock block = block_of(world_, kind, b, at_hand);
        if (!world_.points.force.empty()) block.forces = world_.points.force.data() + block.begin;
        return block;
    }

    void compute(ForceKernel kernel, const PointBlock& block) {
        const PhaseTimer timer(profile_, Phase::force);
        kernel(world_, block);
        ++world_.workers.blocks_done[thread_];
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
    const ContactFeatures& features_;
    MoveListed move_;
    double kick_;
    std::size_t thread_, threads_;
    Profile* profile_;
    SweepPlan::Share& share_;
    BodyForce* deferred_;
};

}  // namespace

void sweep(World& world, const ContactFeatures& features, MoveListed move, double kick) {
    const std::size_t shares = world.workers.plan.shares.size();
    if (shares == 1) {  // needs no team: its barriers would cost a tenth of a small scene's step
        Sweeper sweeper(world, features, move, kick, 0);
        sweeper.do_smaller_kinds();
        return sweeper.do_largest_kind();
    }
    const bool smaller_kinds = !world.workers.plan.smaller_kinds.empty();
#pragma omp parallel num_threads(world.workers.threads)
    {
        // A team can be smaller than was asked for (OMP_THREAD_LIMIT, OMP_DYNAMIC): its threads then do several shares.
        const auto team = static_cast<std::size_t>(omp_get_num_threads());
        const auto mine = [&](auto phase) {
            for (auto share = static_cast<std::size_t>(omp_get_thread_num()); share < shares; share += team) {
                Sweeper sweeper(world, features, move, kick, share);
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

Speeds move_the_rest(World& world, MoveListed move, double kick) {
    const SweepPlan& plan = world.workers.plan;
    Speeds speeds;
    const auto move_on = [&](std::uint32_t begin, std::uint32_t end) {
        speeds.add(move(world, kick, plan.order.data() + begin, end - begin));
    };
    for (std::size_t t = 0; t < plan.shares.size(); ++t) {
        speeds.add(plan.shares[t].speeds);
        move_on(plan.shares[t].moved_end, Sweeper::end_of_chunks(plan, t));
    }
    if (!Sweeper::none_held(plan)) move_on(plan.late_begin, plan.driven_begin);
    return speeds;
}

}  // namespace crackle
