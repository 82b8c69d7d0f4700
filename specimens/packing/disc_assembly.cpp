// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbour list and force sum of the packer's discs. See the header.

#include "specimens/packing/disc_assembly.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "solver/base/lanes.hpp"
#include "solver/neighbours/cell_grid.hpp"

namespace crackle {
namespace {

/// Over the box; a disc pressed beyond a wall belongs to the cell at the wall. @param cell at least this wide, m
CellGrid grid_of(double width, double height, double cell, const std::vector<Disc>& discs) {
    CellLayout layout;
    layout.columns = std::max<std::size_t>(1, static_cast<std::size_t>(width / cell));
    layout.rows = std::max<std::size_t>(1, static_cast<std::size_t>(height / cell));
    layout.per_width = static_cast<double>(layout.columns) / width;
    layout.per_height = static_cast<double>(layout.rows) / height;
    return {layout, discs.size(), [&](std::size_t i) { return Vec2{discs[i].x, discs[i].y}; }};
}

/// Discs whose pairs are measured before their forces are summed: what is kept of them, some 10 kB, stays in the L1
/// cache. Divides assembly_block.
constexpr std::size_t chunk = 64;

/// From entry lane_count - n on: a mask of the first n lanes.
constexpr auto first_lanes = [] {
    std::array<LaneBit, std::size_t{2} * lane_count> bits{};
    std::fill_n(bits.begin(), lane_count, LaneBit{-1});
    return bits;
}();

}  // namespace

/// Over pairs as listed, so over each from both sides.
struct DiscAssembly::PairSums {
    Pair virial{};
    double overlap = 0.0;
    std::size_t contacts = 0;
};

DiscAssembly::DiscAssembly(double box_width, double box_height, std::vector<Disc> all, int thread_count)
    : width(box_width),
      height(box_height),
      discs(std::move(all)),
      forces(discs.size()),
      threads(thread_count),
      skin(0.0) {
    for (const Disc& disc : discs) {
        mean_radius_ += disc.radius / static_cast<double>(discs.size());
        largest_radius_ = std::max(largest_radius_, disc.radius);
        disc_area_ += std::numbers::pi * disc.radius * disc.radius;
    }
    skin = 0.3 * mean_radius_;
}

void DiscAssembly::strain(double factor_x, double factor_y) {
    width *= factor_x;
    height *= factor_y;
    for (Disc& disc : discs) {
        disc.x *= factor_x;
        disc.y *= factor_y;
    }
}

void DiscAssembly::sort_spatially() {
    const CellGrid grid = grid_of(width, height, 2.0 * mean_radius_, discs);
    std::vector<Disc> sorted;
    sorted.reserve(discs.size());
    for (const std::uint32_t i : grid.members()) sorted.push_back(discs[i]);
    discs = std::move(sorted);
    listed_at_.clear();
}

double DiscAssembly::move(const std::function<void(std::size_t begin, std::size_t end)>& place) {
    const std::size_t count = discs.size(), blocks = (count + assembly_block - 1) / assembly_block;
    const bool listed = listed_at_.size() == count;
    double largest_square = listed ? 0.0 : std::numeric_limits<double>::infinity();
    const bool parallel = count >= assembly_parallel_from;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : largest_square) if (parallel)
    for (std::size_t block = 0; block < blocks; ++block) {
        const std::size_t begin = block * assembly_block, end = std::min(count, begin + assembly_block);
        place(begin, end);
        for (std::size_t i = begin; listed && i < end; ++i) {
            const double dx = discs[i].x - listed_at_[i].x * width, dy = discs[i].y - listed_at_[i].y * height;
            largest_square = std::max(largest_square, dx * dx + dy * dy);
        }
    }
    return largest_square;
}

bool DiscAssembly::list_outdated(double largest_moved_square) const {
    // In shares of the box a uniform strain moves nothing; what it does to a pair is bounded by their listed distance.
    const double squeeze = std::max({0.0, 1.0 - width / listed_width_, 1.0 - height / listed_height_});
    const double reach = 2.0 * largest_radius_ + skin;
    return 2.0 * std::sqrt(largest_moved_square) + squeeze * reach >= skin;
}

void DiscAssembly::build_list() {
    const CellGrid grid = grid_of(width, height, 2.0 * largest_radius_ + skin, discs);
    const std::size_t count = discs.size();
    listed_at_.resize(count);
    listed_width_ = width;
    listed_height_ = height;
    // Each block of discs finds its own neighbours; then the lists are laid end to end.
    list_begin_.resize(count + 1);
    const std::size_t blocks = (count + assembly_block - 1) / assembly_block;
    found_.resize(blocks);
#pragma omp parallel for schedule(static) num_threads(threads) if (count >= assembly_parallel_from)
    for (std::size_t block = 0; block < blocks; ++block) {
        std::vector<std::uint32_t>& found = found_[block];
        found.clear();
        for (std::size_t i = block * assembly_block; i < std::min(count, (block + 1) * assembly_block); ++i) {
            const Disc& disc = discs[i];
            listed_at_[i] = {disc.x / width, disc.y / height};
            const std::size_t column = grid.column(disc.x), row = grid.row(disc.y);
            const auto before = [](std::size_t index) { return index == 0 ? 0 : index - 1; };
            const std::size_t right = std::min(column + 1, grid.last_column()),
                              above = std::min(row + 1, grid.last_row());
            grid.visit(before(column), right, before(row), above, [&](std::uint32_t j) {
                const double dx = discs[j].x - disc.x, dy = discs[j].y - disc.y;
                const double reach = disc.radius + discs[j].radius + skin;
                if (j != i && dx * dx + dy * dy < reach * reach) found.push_back(j);
            });
            list_begin_[i + 1] = static_cast<std::uint32_t>(found.size());
        }
    }
    std::vector<std::uint32_t> block_begin(blocks + 1, 0);
    for (std::size_t block = 0; block < blocks; ++block)
        block_begin[block + 1] = block_begin[block] + static_cast<std::uint32_t>(found_[block].size());
    // Whole lanes are read.
    neighbours_.resize(block_begin.back() + lane_count - 1);
    owners_.resize(neighbours_.size());
    list_begin_[0] = 0;
#pragma omp parallel for schedule(static) num_threads(threads) if (count >= assembly_parallel_from)
    for (std::size_t block = 0; block < blocks; ++block) {
        std::ranges::copy(found_[block], neighbours_.begin() + block_begin[block]);
        std::uint32_t next = block_begin[block];
        for (std::size_t i = block * assembly_block; i < std::min(count, (block + 1) * assembly_block); ++i) {
            list_begin_[i + 1] += block_begin[block];
            for (; next < list_begin_[i + 1]; ++next) owners_[next] = static_cast<std::uint32_t>(i);
        }
    }
    largest_chunk_ = 0;
    for (std::size_t i = 0; i < count; i += chunk)
        largest_chunk_ =
            std::max<std::size_t>(largest_chunk_, list_begin_[std::min(count, i + chunk)] - list_begin_[i]);
}

void DiscAssembly::measure_pairs(std::size_t begin, std::size_t end, PairPush* pushes, PairSums& sums) const {
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
        // Coincident centres have no direction: no force, the neighbours part them.
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

AssemblySums DiscAssembly::compute_block(std::size_t begin, std::size_t end, const DiscMotion* motion,
                                         PairPush* pushes) {
    AssemblySums sums;
    PairSums pairs;
    std::size_t measured_from = 0;
    double power = 0.0, speed_square = 0.0, pull_square = 0.0, speed_pull = 0.0, largest_force = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
        if ((i - begin) % chunk == 0) {
            measured_from = list_begin_[i];
            measure_pairs(list_begin_[i], list_begin_[std::min(end, i + chunk)], pushes, pairs);
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

AssemblySums DiscAssembly::compute_forces(const DiscMotion* motion, std::optional<double> moved) {
    if (!moved) moved = move([](std::size_t, std::size_t) {});
    if (list_outdated(*moved)) build_list();
    const std::size_t count = discs.size(), blocks = (count + assembly_block - 1) / assembly_block;
    partial_.resize(blocks);
#pragma omp parallel num_threads(threads) if (count >= assembly_parallel_from)
    {
        std::vector<PairPush> pushes(largest_chunk_ + lane_count - 1);
#pragma omp for schedule(static)
        for (std::size_t block = 0; block < blocks; ++block) {
            partial_[block] = compute_block(block * assembly_block, std::min(count, (block + 1) * assembly_block),
                                            motion, pushes.data());
        }
    }
    AssemblySums total;
    for (const AssemblySums& sums : partial_) {
        total.virial_x += sums.virial_x;
        total.virial_y += sums.virial_y;
        total.platen_overlap += sums.platen_overlap;
        total.platen_contacts += sums.platen_contacts;
        total.overlap += sums.overlap;
        total.contacts += sums.contacts;
        total.largest_force = std::max(total.largest_force, sums.largest_force);
        total.power += sums.power;
        total.speed_square += sums.speed_square;
        total.pull_square += sums.pull_square;
        total.speed_pull += sums.speed_pull;
    }
    total.overlap += total.platen_overlap;
    total.contacts += total.platen_contacts;
    total.largest_force = std::sqrt(total.largest_force);
    return total;
}

}  // namespace crackle
