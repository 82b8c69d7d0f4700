// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/packed_circles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "solver/base/errors.hpp"
#include "specimens/making/cell_sizes.hpp"
#include "specimens/making/meshed_cells.hpp"

namespace crackle {
namespace {

/// Adds file and line to an error of a packing.
InputError located(const Places& places, const PackingError& error) {
    using enum CaseKey;
    constexpr std::array keys{packing_width,        packing_count,         packing_radius_min,
                              packing_radius_max,   packing_radius_median, packing_radius_log_deviation,
                              packing_mean_overlap, packing_void_ratio};
    const auto input = static_cast<std::size_t>(error.input);
    if (input < keys.size() && places.gives(keys[input])) return InputError(places.at(keys[input]) + error.text);
    return InputError(fmt::format("{}: {}", places.at(packing), error.what()));
}

// Number of packings tried for cells of a given size, and accepted errors. In a box of a few hundred circles, one
// circle more or less changes the mean size by about the accepted error. Another arrangement changes the spread by half
// of its accepted error.
constexpr int cell_packings = 4;
constexpr double met_diameter_share = 0.002, met_spread = 0.02;

Packing packed(const PackingRequest& request, const Places& places, const PackingCallback& progress) {
    try {
        return make_packing(request, progress);
    } catch (const PackingError& error) {
        throw located(places, error);
    }
}

/// Packs circles whose cells have the requested diameters, or come as close as possible.
Packing pack_for_cells(const parts::CellDiameters& cells, const parts::Mesh& mesh, PackingRequest request,
                       const Places& places, const PackingCallback& progress) {
    const CellSizes asked{cells.mean, cells.spread};
    std::optional<Packing> best;
    double best_miss = 0.0, scale = 1.0, correction = 0.0;
    for (int k = 0; k < cell_packings && !(best && best_miss <= 1.0); ++k) {
        try {
            request.sizes = scaled(radii_for_cells(mesh.kind, cells.radii, asked, correction), scale);
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", places.at(CaseKey::packing_cell_spread), error.what()));
        }
        Packing packing = packed(request, places, progress);
        const CellSizes reached = measure_cells(bare_cells(packing.scene, mesh, places));
        const double miss = std::max(std::abs(reached.mean / asked.mean - 1.0) / met_diameter_share,
                                     std::abs(reached.spread - asked.spread) / met_spread);
        if (!best || miss < best_miss) {
            best = std::move(packing);
            best_miss = miss;
        }
        scale *= asked.mean / reached.mean;
        // The spread is corrected only once: the remaining error is random, and each change of the spread also changes
        // the mean.
        if (k == 0 && std::abs(reached.spread - asked.spread) > met_spread) correction = asked.spread - reached.spread;
    }
    return std::move(*best);
}

Packing pack(const parts::Particles& particles, PackingRequest request, const Places& places,
             const PackingCallback& progress) {
    const auto& sizes = particles.packing()->sizes;
    if (const auto* cells = std::get_if<parts::CellDiameters>(&sizes))
        return pack_for_cells(*cells, *particles.mesh, std::move(request), places, progress);
    if (const auto* radii = std::get_if<UniformRadii>(&sizes)) request.sizes = *radii;
    if (const auto* radii = std::get_if<LognormalRadii>(&sizes)) request.sizes = *radii;
    if (const auto* file = std::get_if<parts::SieveFile>(&sizes)) request.sizes = read_sieve_curve(file->path);
    return packed(request, places, progress);
}

}  // namespace

Packing packing_of(const parts::Particles& particles, int threads, const Places& places, const TestHooks& hooks) {
    const parts::Packing& asked = *particles.packing();
    PackingRequest request;
    if (const auto* box = std::get_if<parts::Box>(&asked.box)) {
        request.width = box->width;
        request.height = box->height;
    } else {
        request.count = std::get<parts::CircleCount>(asked.box).count;
        request.height_to_width = std::get<parts::CircleCount>(asked.box).height_to_width;
    }
    if (const auto* target = std::get_if<parts::MeanOverlap>(&asked.target))
        request.mean_overlap = target->value;
    else
        request.void_ratio = std::get<parts::VoidRatio>(asked.target).value;
    request.seed = static_cast<std::uint64_t>(asked.seed);
    request.threads = threads;
    particles.material.apply_to(request.material);
    request.material.tensile_strength = request.material.cohesion = 0.0;  // nothing is bonded yet
    const auto make = [&] {
        return pack(particles, request, places, [&](const PackingProgress& p) {
            hooks.report_work(fmt::format("{} (draw {}): unbalanced by {:.1e} of the mean contact force", p.stage,
                                          p.attempt, p.residual));
        });
    };
    return hooks.keep_packing ? hooks.keep_packing(request, make) : make();
}

}  // namespace crackle
