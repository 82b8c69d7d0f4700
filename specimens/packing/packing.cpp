// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a packing: checks the request, chooses the number of circles for a box, and draws packings until one is
// accepted.

#include "specimens/packing/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "solver/base/errors.hpp"
#include "specimens/packing/compression.hpp"
#include "specimens/packing/isotropy.hpp"

namespace crackle {
namespace {

constexpr int max_attempts = 12;
// Initial estimate of the fraction of a box that circles fill, from packings of 304 and 5,000 circles with radii from r
// to 2r. Walls reduce it in proportion to their length. The first packing then gives the actual value for the requested
// sizes.
constexpr double fill_without_walls = 0.849, fill_lost_beside_walls = 0.2;
constexpr int size_samples = 20'000;

struct SizeMoments {
    double mean = 0.0, mean_square = 0.0;  // mean radius, m, and mean square, m2
    double largest = 0.0;
};

SizeMoments moments(const SizeDistribution& sizes) {
    SizeMoments result;
    for (int k = 0; k < size_samples; ++k) {
        const double radius = radius_at(sizes, (k + 0.5) / size_samples);
        result.mean += radius / size_samples;
        result.mean_square += radius * radius / size_samples;
        result.largest = std::max(result.largest, radius);
    }
    return result;
}

void require_positive(const char* key, const std::optional<double>& value, const char* unit) {
    if (value && (!(*value > 0.0) || !std::isfinite(*value))) {
        throw InputError(fmt::format("{}: found {}, expected a finite number > 0{}", key, *value, unit));
    }
}

void check(const PackingRequest& request) {
    validate(request.sizes);
    require_positive("width", request.width, " in m");
    require_positive("height", request.height, " in m");
    require_positive("height_to_width", request.height_to_width, "");
    require_positive("mean_overlap", request.mean_overlap, " in m");
    require_positive("void_ratio", request.void_ratio, "");
    if (request.count ? request.width || request.height : !(request.width && request.height)) {
        throw InputError(fmt::format("size of the packing: found {}, expected either width and height or a count",
                                     request.count ? "a count and a width or height" : "neither"));
    }
    if (!request.count && request.height_to_width) {
        throw InputError(
            "height_to_width: found this key together with width and height, but it has an effect only with a count; "
            "remove it");
    }
    if (request.mean_overlap.has_value() == request.void_ratio.has_value()) {
        throw InputError(fmt::format("target of the packing: found {}, expected either mean_overlap or void_ratio",
                                     request.mean_overlap ? "both" : "neither"));
    }
    if (request.count && (*request.count < min_packing_circles || *request.count > max_packing_circles)) {
        throw PackingError(PackingInput::count, "count",
                           fmt::format(": found {}, expected {} to {} circles", *request.count, min_packing_circles,
                                       max_packing_circles));
    }
    if (request.threads < 1) throw InputError(fmt::format("threads: found {}, expected at least 1", request.threads));
    const SizeMoments size = moments(request.sizes);
    if (request.mean_overlap) {
        const double smallest = smallest_overlap_share * size.mean, largest = largest_overlap_share * size.mean;
        if (*request.mean_overlap < smallest || *request.mean_overlap > largest) {
            throw PackingError(PackingInput::mean_overlap, "mean_overlap",
                               fmt::format(": found {} m, expected {:.3g} to {:.3g} m (the mean radius is {:.3g} m)",
                                           *request.mean_overlap, smallest, largest, size.mean));
        }
    }
    if (!request.count) {
        const double shorter = std::min(*request.width, *request.height);
        if (shorter < 4.0 * size.largest) {
            throw PackingError(
                PackingInput::box, "width",
                fmt::format(", height: found {} x {} m, expected room for at least two of the largest circles (radius "
                            "{:.3g} m) in each direction; make the box larger or the circles smaller",
                            *request.width, *request.height, size.largest));
        }
    }
}

std::mt19937_64 stream(std::uint64_t seed, int attempt) {
    std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                           static_cast<std::uint32_t>(attempt)};
    return std::mt19937_64(sequence);
}

/// Number of circles that fill a given fraction of the box.
/// @throws InputError if the number is outside the limits for a packing
std::size_t count_for_box(const PackingRequest& request, double mean_square, double fill) {
    const double count = std::round(fill * *request.width * *request.height / (std::numbers::pi * mean_square));
    if (count < static_cast<double>(min_packing_circles) || count > static_cast<double>(max_packing_circles)) {
        throw PackingError(
            PackingInput::box, "width",
            fmt::format(
                ", height: found {} x {} m, which needs about {:.0f} circles of these sizes, expected {} to {} circles",
                *request.width, *request.height, count, min_packing_circles, max_packing_circles));
    }
    return static_cast<std::size_t>(count);
}

/// Deviation of an attempt from the request, divided by the allowed deviation; at most 1 if accepted.
double shortfall(const Compression& draw, double radius_scale) {
    return std::max({std::abs(stress_anisotropy(draw.sums)) / max_anisotropy,
                     std::abs(draw.aspect_error) / max_aspect_error,
                     std::abs(radius_scale - 1.0) / max_radius_scaling});
}

}  // namespace

Scene scene_of_circles(const std::vector<CircleElement>& circles, double width, double height, const Material& material,
                       int threads) {
    Scene scene;
    scene.materials.push_back(material);
    scene.domain.x1 = scene.domain.y1 = 0.0;
    scene.domain.x2 = width;
    scene.domain.y2 = height;
    scene.threads = threads;
    int id = 0;
    for (const CircleElement& circle : circles) scene.add_circle_body(++id, 0, circle);
    validate(scene);
    scene.time_step = deck_time_step(scene);
    return scene;
}

double deck_time_step(const Scene& scene) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Body& body : scene.bodies) {
        const double stiffness = scene.materials[static_cast<std::size_t>(body.material)].normal_stiffness;
        shortest = std::min(shortest, 0.1 * 2.0 * std::sqrt(mass_properties(scene, body).mass / stiffness));
    }
    return shortest;
}

Packing make_packing(const PackingRequest& request, const PackingCallback& progress) {
    check(request);
    const SizeMoments size = moments(request.sizes);
    const bool box_asked = !request.count;
    const double height_to_width = box_asked ? *request.height / *request.width : request.height_to_width.value_or(2.0);
    CompressionTarget target{request.mean_overlap, request.void_ratio, box_asked ? *request.width : 0.0};

    double fill = fill_without_walls;
    if (box_asked) fill -= fill_lost_beside_walls * size.mean * 2.0 * (1.0 / *request.width + 1.0 / *request.height);
    if (request.void_ratio) fill = 1.0 / (1.0 + *request.void_ratio);
    std::optional<Compression> best;
    double best_shortfall = 0.0, best_scale = 1.0;
    int attempts = 0;
    while (attempts < max_attempts && !(best && best_shortfall <= 1.0)) {
        ++attempts;
        std::mt19937_64 generator = stream(request.seed, attempts);
        const std::size_t count =
            box_asked ? count_for_box(request, size.mean_square, fill) : static_cast<std::size_t>(*request.count);
        const std::vector<double> radii = sample_radii(request.sizes, count, generator);
        Compression draw = compress(radii, height_to_width, target, !box_asked, request.threads, generator,
                                    [&](const std::string& stage, double imbalance_reached) {
                                        if (progress) progress({stage, attempts, imbalance_reached});
                                    });
        if (!draw.converged) continue;
        const double scale = box_asked ? *request.width / draw.assembly.width : 1.0;
        if (!request.void_ratio) fill = draw.assembly.disc_area() / draw.assembly.area();
        const double missing = shortfall(draw, scale);
        if (!best || missing < best_shortfall) {
            best = std::move(draw);
            best_shortfall = missing;
            best_scale = scale;
        }
    }
    if (!best) {
        throw PackingError(PackingInput::whole, "packing",
                           fmt::format(": found no equilibrium in {} attempts; try more circles, another seed, or a "
                                       "larger mean overlap",
                                       attempts));
    }

    const double width = box_asked ? *request.width : best->assembly.width;
    const double height = box_asked ? *request.height : best->assembly.height;
    Packing packing;
    std::vector<CircleElement> circles;
    for (const Disc& disc : best->assembly.discs) {
        circles.push_back(
            {.centre = {best_scale * disc.x, best_scale * disc.y}, .radius = best_scale * disc.radius, .angle = 0.0});
    }
    packing.scene = scene_of_circles(circles, width, height, request.material, request.threads);
    packing.report = measure_packing(packing.scene, request.sizes);
    packing.report.radius_scale = best_scale;
    packing.report.aspect_error = best->aspect_error;
    packing.report.attempts = attempts;
    packing.report.isotropic = packing.report.anisotropy <= max_anisotropy;
    packing.report.box_met =
        std::abs(best->aspect_error) <= max_aspect_error && std::abs(best_scale - 1.0) <= max_radius_scaling;
    return packing;
}

}  // namespace crackle
