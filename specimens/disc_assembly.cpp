// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbour list and force sum of the packer's discs. See the header.

#include "specimens/disc_assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace crackle {
namespace {

/// Uniform grid over the box; cell (column, row) holds the discs whose centres lie in it.
struct Grid {
    std::size_t columns, rows;
    double per_width, per_height;  // cells / m
    std::vector<std::uint32_t> begin, members;

    Grid(double width, double height, double cell, const std::vector<Disc>& discs)
        : columns(std::max<std::size_t>(1, static_cast<std::size_t>(width / cell))),
          rows(std::max<std::size_t>(1, static_cast<std::size_t>(height / cell))),
          per_width(static_cast<double>(columns) / width),
          per_height(static_cast<double>(rows) / height) {
        std::vector<std::uint32_t> cell_of(discs.size());
        begin.assign(columns * rows + 1, 0);
        for (std::size_t i = 0; i < discs.size(); ++i) {
            cell_of[i] = static_cast<std::uint32_t>(row(discs[i].y) * columns + column(discs[i].x));
            ++begin[cell_of[i] + 1];
        }
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        members.resize(discs.size());
        std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
        for (std::size_t i = 0; i < discs.size(); ++i) members[next[cell_of[i]]++] = static_cast<std::uint32_t>(i);
    }

    std::size_t column(double x) const { return index(x * per_width, columns); }
    std::size_t row(double y) const { return index(y * per_height, rows); }

  private:
    // A disc pressed beyond a wall belongs to the cell at the wall.
    static std::size_t index(double place, std::size_t count) {
        if (!(place > 0.0)) return 0;
        return std::min(static_cast<std::size_t>(place), count - 1);
    }
};

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
    const Grid grid(width, height, 2.0 * mean_radius_, discs);
    std::vector<Disc> sorted;
    sorted.reserve(discs.size());
    for (const std::uint32_t i : grid.members) sorted.push_back(discs[i]);
    discs = std::move(sorted);
    listed_at_.clear();
}

bool DiscAssembly::list_outdated() const {
    if (listed_at_.size() != discs.size()) return true;
    // In shares of the box a uniform strain moves nothing; what it does to a pair is bounded by their listed distance.
    const std::size_t count = discs.size();
    const bool many = count >= assembly_parallel_from;
    double largest_square = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : largest_square) if (many)
    for (std::size_t i = 0; i < count; ++i) {
        const double dx = discs[i].x - listed_at_[i].x * width, dy = discs[i].y - listed_at_[i].y * height;
        largest_square = std::max(largest_square, dx * dx + dy * dy);
    }
    const double squeeze = std::max({0.0, 1.0 - width / listed_width_, 1.0 - height / listed_height_});
    const double reach = 2.0 * largest_radius_ + skin;
    return 2.0 * std::sqrt(largest_square) + squeeze * reach >= skin;
}

void DiscAssembly::build_list() {
    const Grid grid(width, height, 2.0 * largest_radius_ + skin, discs);
    listed_at_.resize(discs.size());
    listed_width_ = width;
    listed_height_ = height;
    list_begin_.assign(discs.size() + 1, 0);
    neighbours_.clear();
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const Disc& disc = discs[i];
        listed_at_[i] = {disc.x / width, disc.y / height};
        const std::size_t column = grid.column(disc.x), row = grid.row(disc.y);
        for (std::size_t r = row == 0 ? 0 : row - 1; r <= std::min(row + 1, grid.rows - 1); ++r) {
            const std::size_t first = r * grid.columns + (column == 0 ? 0 : column - 1);
            const std::size_t last = r * grid.columns + std::min(column + 1, grid.columns - 1);
            for (std::uint32_t k = grid.begin[first]; k < grid.begin[last + 1]; ++k) {
                const std::uint32_t j = grid.members[k];
                const double dx = discs[j].x - disc.x, dy = discs[j].y - disc.y;
                const double reach = disc.radius + discs[j].radius + skin;
                if (j != i && dx * dx + dy * dy < reach * reach) neighbours_.push_back(j);
            }
        }
        list_begin_[i + 1] = static_cast<std::uint32_t>(neighbours_.size());
    }
}

AssemblySums DiscAssembly::compute_block(std::size_t begin, std::size_t end, const DiscMotion* motion) {
    AssemblySums sums;
    double pair_energy = 0.0, pair_virial_x = 0.0, pair_virial_y = 0.0,
           pair_overlap = 0.0;  // each pair from both sides
    std::size_t pair_contacts = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const Disc disc = discs[i];
        Vec2 force;
        const std::uint32_t* const last = neighbours_end(i);
        for (const std::uint32_t* j = neighbours_begin(i); j != last; ++j) {
            const Disc& other = discs[*j];
            const double dx = other.x - disc.x, dy = other.y - disc.y, reach = disc.radius + other.radius;
            const double square = dx * dx + dy * dy;
            if (square >= reach * reach) continue;
            const double distance = std::sqrt(square), overlap = reach - distance;
            // Coincident centres have no direction: no force, the neighbours part them.
            const double pull = distance > 0.0 ? overlap / distance : 0.0;
            const double pull_x = pull * dx, pull_y = pull * dy;
            force.x -= pull_x;
            force.y -= pull_y;
            pair_energy += overlap * overlap;
            pair_virial_x += pull_x * dx;
            pair_virial_y += pull_y * dy;
            pair_overlap += overlap;
            ++pair_contacts;
        }
        const auto touch_wall = [&](double distance, double& component, double sign, double& virial, bool platen) {
            const double overlap = disc.radius - distance;
            if (overlap <= 0.0) return;
            component += sign * overlap;
            sums.energy += 0.5 * overlap * overlap;
            virial += overlap * distance;
            (platen ? sums.platen_overlap : sums.overlap) += overlap;
            (platen ? sums.platen_contacts : sums.contacts) += 1.0;
        };
        touch_wall(disc.x, force.x, 1.0, sums.virial_x, false);
        touch_wall(width - disc.x, force.x, -1.0, sums.virial_x, false);
        touch_wall(disc.y, force.y, 1.0, sums.virial_y, true);
        touch_wall(height - disc.y, force.y, -1.0, sums.virial_y, true);
        forces[i] = force;
        sums.largest_force = std::max(sums.largest_force, dot(force, force));
        if (motion == nullptr) continue;
        const Vec2 velocity = motion->velocity[i], pull = motion->inverse_mass[i] * force;
        sums.power += dot(force, velocity);
        sums.speed_square += dot(velocity, velocity);
        sums.pull_square += dot(pull, pull);
        sums.speed_pull += dot(velocity, pull);
    }
    sums.energy += 0.25 * pair_energy;
    sums.virial_x += 0.5 * pair_virial_x;
    sums.virial_y += 0.5 * pair_virial_y;
    sums.platen_overlap += 0.5 * pair_overlap;
    sums.platen_contacts += 0.5 * static_cast<double>(pair_contacts);
    return sums;
}

AssemblySums DiscAssembly::compute_forces(const DiscMotion* motion) {
    if (list_outdated()) build_list();
    const std::size_t count = discs.size(), blocks = (count + assembly_block - 1) / assembly_block;
    partial_.resize(blocks);
#pragma omp parallel for schedule(static) num_threads(threads) if (count >= assembly_parallel_from)
    for (std::size_t block = 0; block < blocks; ++block) {
        partial_[block] = compute_block(block * assembly_block, std::min(count, (block + 1) * assembly_block), motion);
    }
    AssemblySums total;
    for (const AssemblySums& sums : partial_) {
        total.energy += sums.energy;
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
