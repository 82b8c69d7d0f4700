// SPDX-License-Identifier: GPL-3.0-or-later
// Forces on a block of the packer's discs, compiled once per instruction set. See disc_assembly.hpp.
// Tested by tests/specimens/packing/packing_test.cpp.

#include <algorithm>
#include <array>
#include <bit>

#include "solver/base/instruction_set.hpp"
#include "solver/base/lanes.hpp"
#include "specimens/packing/disc_assembly.hpp"

namespace crackle {
namespace {

/// Loading lane_count entries from position lane_count - n gives a mask for the first n lanes.
constexpr auto first_lanes = [] {
    std::array<LaneBit, std::size_t{2} * lane_count> bits{};
    std::fill_n(bits.begin(), lane_count, LaneBit{-1});
    return bits;
}();

}  // namespace

/// Sums over listed pairs; each pair occurs twice, once for each disc.
struct DiscAssembly::PairSums {
    Pair virial{};
    double overlap = 0.0;
    std::size_t contacts = 0;
};

template <>
void DiscAssembly::measure_pairs<InstructionSet::CRACKLE_SET>(std::size_t begin, std::size_t end, PairPush* pushes,
                                                              PairSums& sums) const {
    for (std::size_t first = begin; first < end; first += lane_count) {
        const double *own_place[lane_count], *own_size[lane_count], *place[lane_count], *size[lane_count];
        for (std::size_t l = 0; l < lane_count; ++l) {
            const Disc &own = discs[owners_[first + l]], &other = discs[neighbours_[first + l]];
            own_place[l] = &own.x;
            own_size[l] = &own.radius;
            place[l] = &other.x;
            size[l] = &other.radius;
        }
        Lanes own_x, own_y, own_radius, x, y, radius, unused;
        gather_pairs(own_place, own_x, own_y);
        gather_pairs(own_size, own_radius, unused);
        gather_pairs(place, x, y);
        gather_pairs(size, radius, unused);
        const Lanes dx = x - own_x, dy = y - own_y, reach = own_radius + radius;
        const Lanes square = dx * dx + dy * dy, distance = root(square);
        const LaneBits here =
            load_as<LaneBits>(first_lanes.data() + lane_count - std::min<std::size_t>(end - first, lane_count));
        const LaneBits touching = (square < reach * reach) & here;
        const Lanes overlap = lanes_of(bits_of(reach - distance) & touching);
        // Discs with coincident centres exert no force on each other, since its direction is undefined; their
        // neighbours separate them.
        const Lanes pull = lanes_of(bits_of(overlap / distance) & (distance > 0.0));
        const Lanes pull_x = pull * dx, pull_y = pull * dy;
        PairPush* const push = pushes + (first - begin);
        store_quads(push, pull_x, pull_y, pull_x * dx, pull_y * dy);
        for (std::size_t l = 0; l < lane_count; ++l) {
            sums.virial += load_as<Pair>(&push[l].virial_x);
            sums.overlap += overlap[l];
        }
        sums.contacts += static_cast<std::size_t>(std::popcount(mask_of(touching)));
    }
}

template <>
AssemblySums DiscAssembly::compute_block<InstructionSet::CRACKLE_SET>(std::size_t begin, std::size_t end,
                                                                      const DiscMotion* motion, PairPush* pushes) {
    clear_upper_halves();
    AssemblySums sums;
    PairSums pairs;
    std::size_t measured_from = 0;
    double power = 0.0, speed_square = 0.0, pull_square = 0.0, speed_pull = 0.0, largest_force = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
        if ((i - begin) % assembly_chunk == 0) {
            measured_from = list_begin_[i];
            measure_pairs<InstructionSet::CRACKLE_SET>(list_begin_[i], list_begin_[std::min(end, i + assembly_chunk)],
                                                       pushes, pairs);
        }
        const Disc disc = discs[i];
        Pair pushed{};
        for (std::size_t k = list_begin_[i]; k < list_begin_[i + 1]; ++k)
            pushed -= load_as<Pair>(&pushes[k - measured_from].x);
        Vec2 force{pushed[0], pushed[1]};
        const auto touch_wall = [&](double distance, double& component, double sign, double& virial, bool platen) {
            const double overlap = disc.radius - distance;
            if (overlap <= 0.0) return;
            component += sign * overlap;
            virial += overlap * distance;
            (platen ? sums.platen_overlap : sums.overlap) += overlap;
            (platen ? sums.platen_contacts : sums.contacts) += 1.0;
        };
        touch_wall(disc.x, force.x, 1.0, sums.virial_x, false);
        touch_wall(width - disc.x, force.x, -1.0, sums.virial_x, false);
        touch_wall(disc.y, force.y, 1.0, sums.virial_y, true);
        touch_wall(height - disc.y, force.y, -1.0, sums.virial_y, true);
        forces[i] = force;
        largest_force = std::max(largest_force, dot(force, force));
        if (motion == nullptr) continue;
        const Vec2 velocity = motion->velocity[i], pull = motion->inverse_mass[i] * force;
        power += dot(force, velocity);
        speed_square += dot(velocity, velocity);
        pull_square += dot(pull, pull);
        speed_pull += dot(velocity, pull);
    }
    sums.virial_x += 0.5 * pairs.virial[0];
    sums.virial_y += 0.5 * pairs.virial[1];
    sums.platen_overlap += 0.5 * pairs.overlap;
    sums.platen_contacts += 0.5 * static_cast<double>(pairs.contacts);
    sums.largest_force = largest_force;
    sums.power = power;
    sums.speed_square = speed_square;
    sums.pull_square = pull_square;
    sums.speed_pull = speed_pull;
    return sums;
}

}  // namespace crackle
