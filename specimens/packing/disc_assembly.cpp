// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbour list and force sums for the packer's discs; see disc_assembly.hpp.

#include "specimens/packing/disc_assembly.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "solver/base/chosen_set.hpp"
#include "solver/neighbours/cell_grid.hpp"

namespace crackle {
namespace {

/// Cell grid over the box; a disc beyond a wall belongs to the cell at that wall. @param cell  smallest cell width, m
CellGrid grid_of(double width, double height, double cell, const std::vector<Disc>& discs) {
    CellLayout layout;
    layout.columns = std::max<std::size_t>(1, static_cast<std::size_t>(width / cell));
    layout.rows = std::max<std::size_t>(1, static_cast<std::size_t>(height / cell));
    layout.per_width = static_cast<double>(layout.columns) / width;
    layout.per_height = static_cast<double>(layout.rows) / height;
    return {layout, discs.size(), [&](std::size_t i) { return Vec2{discs[i].x, discs[i].y}; }};
}

}  // namespace

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
    // A uniform strain does not change relative positions in the box. It changes a pair's distance by at most the
    // strain times the largest listed distance.
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
    // Each block of discs finds its own neighbours; the lists are then concatenated.
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
    // Entries are read as whole SIMD vectors, so the arrays are padded.
    neighbours_.resize(block_begin.back() + most_lanes - 1);
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
    for (std::size_t i = 0; i < count; i += assembly_chunk)
        largest_chunk_ =
            std::max<std::size_t>(largest_chunk_, list_begin_[std::min(count, i + assembly_chunk)] - list_begin_[i]);
}

AssemblySums DiscAssembly::compute_forces(const DiscMotion* motion, std::optional<double> moved) {
    if (!moved) moved = move([](std::size_t, std::size_t) {});
    if (list_outdated(*moved)) build_list();
    const std::size_t count = discs.size(), blocks = (count + assembly_block - 1) / assembly_block;
    partial_.resize(blocks);
#pragma omp parallel num_threads(threads) if (count >= assembly_parallel_from)
    {
        std::vector<PairPush> pushes(largest_chunk_ + most_lanes - 1);
#pragma omp for schedule(static)
        for (std::size_t block = 0; block < blocks; ++block) {
            const std::size_t begin = block * assembly_block, end = std::min(count, begin + assembly_block);
            partial_[block] =
                of_chosen_set([&]<InstructionSet S>() { return compute_block<S>(begin, end, motion, pushes.data()); });
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
