// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather.hpp"

#include <algorithm>
#include <cstddef>

#include "solver/lanes.hpp"

namespace crackle {
namespace {

/// Forces of one body while they are added up, slot by slot; both components at once.
struct RunningSum {
    Pair force{};
    double torque = 0.0;

    CRACKLE_INLINE void add(const char* forces, std::uint32_t slot) {
        static constexpr double senses[2] = {1.0, -1.0};  // on i, on j
        const auto number = [](const char* at) { return *reinterpret_cast<const double*>(at); };
        const std::size_t side = slot & 8;
        const double sense = number(reinterpret_cast<const char*>(senses) + side);
        force += Pair{sense, sense} * load_as<Pair>(forces + (slot - side));
        torque += number(forces + offsetof(PointForce, torque_i) + slot);
    }
    BodyForce total() const { return {force[0], force[1], torque}; }
};

/// Bodies with equally many slots.
/// @tparam Slots of each body; -1: as many as `slots_of_each`
template <int Slots>
void gather_bodies(World& world, const BodyIndex* bodies, std::int64_t count, int slots_of_each) {
    const char* const forces = reinterpret_cast<const char*>(world.point_forces.data());
    const auto slots_of = [&](BodyIndex b) { return world.body_slots.data() + world.body_begin[b]; };
    BodyForce* const sums = world.forces.data();
    const int slots = Slots >= 0 ? Slots : slots_of_each;
    std::int64_t n = 0;
    if constexpr (Slots < 0) {
        // Two at a time: in a long sum every addition waits for the one before.
        for (; n + 1 < count; n += 2) {
            const std::uint32_t *const own = slots_of(bodies[n]), *const other = slots_of(bodies[n + 1]);
            RunningSum sum, sum_of_other;
            for (int s = 0; s < slots; ++s) {
                sum.add(forces, own[s]);
                sum_of_other.add(forces, other[s]);
            }
            sums[bodies[n]] = sum.total();
            sums[bodies[n + 1]] = sum_of_other.total();
        }
    }
    for (; n < count; ++n) {
        const std::uint32_t* const own = slots_of(bodies[n]);
        RunningSum sum;
        for (int s = 0; s < slots; ++s) sum.add(forces, own[s]);
        sums[bodies[n]] = sum.total();
    }
}

}  // namespace

// Bodies of a block are taken by their number of slots: a loop whose end cannot be foreseen would cost
// more than the sum.
void gather_forces(World& world) {
    const auto count = static_cast<std::int64_t>(world.bodies.size());
    const BodyIndex* const order = world.gather_order.data();
    const std::uint32_t* const begin = world.body_begin.data();
    const auto slots_of = [&](BodyIndex b) { return static_cast<int>(begin[b + 1] - begin[b]); };
#pragma omp for schedule(static) nowait
    for (std::int64_t first = 0; first < count; first += gather_block) {
        const std::int64_t last = std::min(first + gather_block, count);
        for (std::int64_t n = first, end = n; n < last; n = end) {
            const int slots = slots_of(order[n]);
            while (end < last && slots_of(order[end]) == slots) ++end;
            switch (slots) {
                case 0:
                    gather_bodies<0>(world, order + n, end - n, slots);
                    break;
                case 1:
                    gather_bodies<1>(world, order + n, end - n, slots);
                    break;
                case 2:
                    gather_bodies<2>(world, order + n, end - n, slots);
                    break;
                case 3:
                    gather_bodies<3>(world, order + n, end - n, slots);
                    break;
                case 4:
                    gather_bodies<4>(world, order + n, end - n, slots);
                    break;
                case 5:
                    gather_bodies<5>(world, order + n, end - n, slots);
                    break;
                case 6:
                    gather_bodies<6>(world, order + n, end - n, slots);
                    break;
                default:
                    gather_bodies<-1>(world, order + n, end - n, slots);
            }
        }
    }
}

}  // namespace crackle
