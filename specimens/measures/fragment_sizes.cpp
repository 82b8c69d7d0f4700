// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/fragment_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "specimens/frames/fragments.hpp"
#include "specimens/frames/frame_forces.hpp"

namespace crackle {
namespace {

constexpr double least_particles = 2.0;  // smallest area of a fragment included in the fit, in mean particle areas

double diameter(double area) { return std::sqrt(4.0 * area / std::numbers::pi); }

}  // namespace

FragmentSizes measure_fragments(const World& world, const TestSetup& setup, const Frame& frame) {
    std::vector<double> areas;  // area of each fragment, m²
    const std::vector<std::int32_t> number = find_fragments(world, setup, frame);
    for (BodyIndex b = 0; b < number.size(); ++b) {
        if (number[b] < 0) continue;
        const auto fragment = static_cast<std::size_t>(number[b]);
        if (fragment >= areas.size()) areas.resize(fragment + 1, 0.0);
        areas[fragment] += area_of(world, b);
    }
    FragmentSizes figures;
    figures.count = static_cast<std::int64_t>(areas.size());
    const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
    figures.largest_share = areas.front() / all;
    std::vector<double> sizes(areas.size());
    std::ranges::transform(areas, sizes.begin(), diameter);
    figures.median_size = median_size(sizes, areas);
    const double particle = all / static_cast<double>(setup.specimen.particles);
    figures.law = fit_rosin_rammler(sizes, areas, diameter(least_particles * particle));
    return figures;
}

}  // namespace crackle
