// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/cell_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"

namespace crackle {
namespace {

/// Coefficients of variation of circle radii, and of the equivalent diameters of the resulting cells.
struct SpreadPair {
    double circles, voronoi, delaunay;
};

// Means of three to six packings of 300 to 2,000 circles at mean overlaps of 0.004 and 0.03 radii, measured by
// measure_cell_spreads in this folder. Values of a packing of 600 circles differ from them by at most 0.005 (Voronoi)
// and 0.01 (Delaunay). For the widest spreads, the scatter is six times as large, because a few large circles dominate.
// Triangles beside the faces are smaller: in packings of 300 circles, this raises the smallest spread by 0.02.
// tests/specimens/making/cell_sizes_test.cpp checks some of the values.
constexpr std::array<SpreadPair, 7> uniform_spreads{{{0.0, 0.037, 0.110},
                                                     {0.1, 0.054, 0.124},
                                                     {0.2, 0.096, 0.158},
                                                     {0.3, 0.140, 0.207},
                                                     {0.4, 0.171, 0.250},
                                                     {0.5, 0.197, 0.289},
                                                     {0.55, 0.211, 0.305}}};
constexpr std::array<SpreadPair, 14> lognormal_spreads{{{0.0, 0.037, 0.110},
                                                        {0.1, 0.056, 0.122},
                                                        {0.2, 0.099, 0.162},
                                                        {0.3, 0.144, 0.210},
                                                        {0.4, 0.184, 0.258},
                                                        {0.5, 0.224, 0.305},
                                                        {0.6, 0.263, 0.363},
                                                        {0.7, 0.301, 0.418},
                                                        {0.8, 0.342, 0.470},
                                                        {0.9, 0.387, 0.532},
                                                        {1.0, 0.411, 0.570},
                                                        {1.1, 0.452, 0.621},
                                                        {1.2, 0.480, 0.664},
                                                        {1.3, 0.536, 0.738}}};

/// Spread of circle radii that gives a requested spread of cells, interpolated linearly between measurements.
double circle_spread(std::span<const SpreadPair> measured, double SpreadPair::*cells, double asked) {
    std::size_t k = 1;
    while (k + 1 < measured.size() && measured[k].*cells < asked) ++k;
    const SpreadPair &low = measured[k - 1], &high = measured[k];
    return std::lerp(low.circles, high.circles, (asked - low.*cells) / (high.*cells - low.*cells));
}

// Square of the ratio of circle diameter to cell diameter; random packings fill about this fraction of their box.
constexpr double filled_share = 0.835;

}  // namespace

double derived_gap(double area, double cells) { return derived_gap_share * std::sqrt(area / cells); }

CellSizes measure_cells(const Mesh& mesh) {
    double sum = 0.0, squares = 0.0;
    for (const Cell& cell : mesh.cells) {
        sum += std::sqrt(4.0 * cell.area / std::numbers::pi);
        squares += 4.0 * cell.area / std::numbers::pi;
    }
    const auto count = static_cast<double>(mesh.cells.size());
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean};
}

std::string small_cell_text(const Mesh& mesh) {
    constexpr double noticed_steps = 10.0;
    const auto smallest = std::ranges::min_element(mesh.cells, {}, &Cell::area);
    const double mean = mesh.report.area_before_inset / static_cast<double>(mesh.cells.size());
    const double times = std::sqrt(mean / smallest->area);
    if (!(times > noticed_steps)) return "";
    const Point at = mesh.outline(*smallest).front();
    return fmt::format(
        "the smallest cell, at ({:.6g}, {:.6g}), has {:.2g} of the mean cell area, which makes the time step about "
        "{:.2g} times smaller and a test correspondingly longer",
        at.x, at.y, smallest->area / mean, times);
}

SizeDistribution radii_for_cells(MeshKind kind, RadiusLaw sizes, const CellSizes& asked, double correction) {
    const bool lognormal = sizes == RadiusLaw::lognormal;
    const std::span<const SpreadPair> widest = lognormal_spreads, measured = lognormal ? widest : uniform_spreads;
    const auto cells = kind == MeshKind::voronoi ? &SpreadPair::voronoi : &SpreadPair::delaunay;
    const double least = measured.front().*cells, most = measured.back().*cells;
    if (asked.spread < least || asked.spread > most) {
        const double reached = widest.back().*cells;
        throw InputError(
            fmt::format("found {}, expected {} to {} for {} cells made from circles of {} sizes; {}", asked.spread,
                        least, most, kind == MeshKind::voronoi ? "Voronoi" : "Delaunay", name_of(sizes),
                        asked.spread < least      ? "cells made from equal circles already vary more than this"
                        : asked.spread <= reached ? fmt::format("sizes = \"lognormal\" reaches {}", reached)
                                                  : fmt::format("{} is the most that packed circles reach", reached)));
    }
    const double spread = circle_spread(measured, cells, std::clamp(asked.spread + correction, least, most));
    // A mesh has one Voronoi cell, or about two triangles, per circle.
    const double per_cell = kind == MeshKind::voronoi ? 1.0 : 2.0;
    const double mean =
        0.5 * asked.mean *
        std::sqrt(per_cell * filled_share * (1.0 + asked.spread * asked.spread) / (1.0 + spread * spread));
    if (!lognormal) return UniformRadii{mean * (1.0 - std::sqrt(3.0) * spread), mean * (1.0 + std::sqrt(3.0) * spread)};
    const double deviation = std::sqrt(correctly_rounded::log1p(spread * spread));
    if (deviation == 0.0) return UniformRadii{mean, mean};
    return LognormalRadii{mean / std::sqrt(1.0 + spread * spread), deviation, 0.0, 0.0};
}

SizeDistribution scaled(SizeDistribution sizes, double by) {
    if (auto* uniform = std::get_if<UniformRadii>(&sizes)) {
        uniform->radius_min *= by;
        uniform->radius_max *= by;
    } else if (auto* lognormal = std::get_if<LognormalRadii>(&sizes)) {
        for (double* length : {&lognormal->median, &lognormal->radius_min, &lognormal->radius_max}) *length *= by;
    } else {
        for (SievePoint& point : std::get<SieveCurve>(sizes).points) point.size *= by;
    }
    return sizes;
}

}  // namespace crackle
