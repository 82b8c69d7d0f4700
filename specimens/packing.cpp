// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "solver/errors.hpp"
#include "specimens/random_numbers.hpp"
#include "specimens/relaxation.hpp"

namespace crackle {
namespace {

// Area share of the circles in the box they are quenched in: above jamming (0.83 to 0.85), so that the quench ends jammed.
constexpr double quench_density = 0.88;
constexpr double quench_tolerance = 0.1;
constexpr double equilibrium_tolerance = 1e-6;  // a tenth of what is promised
constexpr double target_tolerance = 3e-4;       // of the target; 1e-3 is promised
constexpr int max_target_steps = 40;
constexpr int max_attempts = 3;
constexpr int max_quench_passes = 20000;
constexpr int max_shape_steps = 8;
constexpr double shape_overshoot = 1.2;  // part of a shear is elastic and comes back
// Range of mean overlaps over the mean radius that a packing may have: looser is hardly jammed, tighter not rigid discs any more.
constexpr double loosest_overlap = 1e-5;
constexpr double tightest_overlap = 0.05;

struct Target {
    double overlap;     // m, mean over the bonds to be
    double void_ratio;  // where > 0, aimed at instead
};

double void_ratio_of(const DiscAssembly& a) { return a.area() / a.disc_area() - 1.0; }

/// Equilibrium at a pressure. @return whether it was reached
bool settle(DiscAssembly& assembly, double pressure, AssemblySums& sums, const RelaxationCallback& progress) {
    const RelaxationResult result = relax(assembly, {BoxFreedom::free, pressure}, equilibrium_tolerance, progress);
    sums = result.sums;
    return result.converged && sums.platen_contacts > 0.0;
}

/// Pressure by which the mean overlap meets its target: overlaps grow in proportion to the pressure, nearly.
bool settle_at_overlap(DiscAssembly& assembly, double overlap, double& pressure, AssemblySums& sums, const RelaxationCallback& progress) {
    for (int k = 0; k < max_target_steps; ++k) {
        if (!settle(assembly, pressure, sums, progress)) return false;
        const double ratio = overlap / sums.mean_platen_overlap();
        if (std::abs(ratio - 1.0) <= target_tolerance) return true;
        pressure *= ratio;
    }
    return false;
}

[[noreturn]] void refuse_void_ratio(double asked, double densest, double loosest) {
    throw InputError(fmt::format(
        "void ratio: found {}, expected {:.4f} to {:.4f}, what these circles reach at rest; a looser arrangement cannot carry load, "
        "a tighter one would overlap by more than {} of the mean radius",
        asked, densest, loosest, tightest_overlap));
}

/// Void ratio falls nearly linearly with the overlap: secant on the overlap, between the loosest and the tightest.
bool settle_at_void_ratio(DiscAssembly& assembly, double asked, double& pressure, AssemblySums& sums, const RelaxationCallback& progress) {
    double low = loosest_overlap * assembly.mean_radius(), high = tightest_overlap * assembly.mean_radius();
    DiscAssembly tight = assembly;
    double tight_pressure = pressure * high / std::max(low, 1e-300);
    AssemblySums tight_sums;
    if (!settle_at_overlap(assembly, low, pressure, sums, progress)) return false;
    const double loosest = void_ratio_of(assembly);
    tight_pressure = pressure * high / low;
    if (!settle_at_overlap(tight, high, tight_pressure, tight_sums, progress)) return false;
    const double densest = void_ratio_of(tight);
    if (asked > loosest * (1.0 + 1e-3) || asked < densest) refuse_void_ratio(asked, densest, loosest);
    double e_low = loosest, e_high = densest;
    for (int k = 0; k < max_target_steps; ++k) {
        if (std::abs(void_ratio_of(assembly) / asked - 1.0) <= target_tolerance) return true;
        const double share = std::clamp((e_low - asked) / (e_low - e_high), 0.02, 0.98);
        const double overlap = low + share * (high - low);
        pressure *= overlap / std::max(sums.mean_platen_overlap(), 1e-300);
        if (!settle_at_overlap(assembly, overlap, pressure, sums, progress)) return false;
        const double e = void_ratio_of(assembly);
        (e > asked ? low : high) = overlap;
        (e > asked ? e_low : e_high) = e;
    }
    return false;
}

/// Random places in a box of the quench's density and the given height over width.
DiscAssembly scattered(const std::vector<double>& radii, double aspect, int threads, std::mt19937_64& random) {
    double area = 0.0;
    for (const double r : radii) area += std::numbers::pi * r * r;
    const double width = std::sqrt(area / quench_density / aspect), height = aspect * width;
    std::vector<Disc> discs;
    discs.reserve(radii.size());
    for (const double r : radii) {
        const double x = r + uniform_number(random) * (width - 2.0 * r);
        const double y = r + uniform_number(random) * (height - 2.0 * r);
        discs.push_back({x, y, r});
    }
    return {width, height, std::move(discs), threads};
}

struct Attempt {
    DiscAssembly assembly;
    AssemblySums sums;
    double aspect_error;
};

/// One packing from one stream of random numbers.
std::optional<Attempt> attempt(const PackingRequest& request, const std::vector<double>& radii, const Target& target, double aspect,
                               std::mt19937_64& random, const RelaxationCallback& progress) {
    DiscAssembly assembly = scattered(radii, aspect, request.threads, random);
    assembly.sort_spatially();
    const RelaxationResult quench = relax_fire(assembly, {}, quench_tolerance, max_quench_passes, progress);
    if (quench.loose || quench.sums.contacts == 0.0) return std::nullopt;
    const double start = target.void_ratio > 0.0 ? loosest_overlap * assembly.mean_radius() : target.overlap;
    double pressure = 0.5 * (quench.sums.virial_x + quench.sums.virial_y) / assembly.area() * start / quench.sums.mean_overlap();
    assembly.sort_spatially();
    assembly.skin = 0.1 * assembly.mean_radius();
    AssemblySums sums;
    double error = 0.0;
    for (int k = 0; k < max_shape_steps; ++k) {
        if (!settle(assembly, pressure, sums, progress)) return std::nullopt;
        error = assembly.height / assembly.width / aspect - 1.0;
        if (std::abs(error) <= 0.5 * max_aspect_error) break;
        // Sheared back to the asked shape, the packing yields, and keeps the shape but for its elastic strain.
        const double factor = std::sqrt(1.0 + shape_overshoot * error);
        assembly.strain(factor, 1.0 / factor);
    }
    const bool met = target.void_ratio > 0.0 ? settle_at_void_ratio(assembly, target.void_ratio, pressure, sums, progress)
                                             : settle_at_overlap(assembly, target.overlap, pressure, sums, progress);
    if (!met) return std::nullopt;
    error = assembly.height / assembly.width / aspect - 1.0;
    return Attempt{std::move(assembly), sums, error};
}

/// Draws until the box has the asked shape, or takes the one that came nearest.
Attempt best_attempt(const PackingRequest& request, const std::vector<double>& radii, const Target& target, double aspect, int& attempts,
                     const PackingCallback& progress) {
    std::optional<Attempt> best;
    for (attempts = 1; attempts <= max_attempts; ++attempts) {
        const RelaxationCallback report = [&](double residual) {
            if (progress) progress({"packing", attempts, residual});
        };
        std::mt19937_64 random(request.seed * 2654435761ULL + static_cast<std::uint64_t>(attempts));
        std::optional<Attempt> made = attempt(request, radii, target, aspect, random, report);
        if (made && (!best || std::abs(made->aspect_error) < std::abs(best->aspect_error))) best = std::move(made);
        if (best && std::abs(best->aspect_error) <= max_aspect_error) break;
    }
    attempts = std::min(attempts, max_attempts);
    if (!best) {
        throw InputError(fmt::format("packing: found no arrangement of these {} circles at rest at the target, expected one in {} attempts; ask for more "
                                     "circles or a larger overlap",
                                     radii.size(), max_attempts));
    }
    return std::move(*best);
}

/// Lengths by one factor: equilibrium and void ratio stay, overlaps scale along.
void scale(DiscAssembly& assembly, double factor) {
    assembly.width *= factor;
    assembly.height *= factor;
    for (Disc& disc : assembly.discs) disc = {disc.x * factor, disc.y * factor, disc.radius * factor};
}

void require(bool good, const std::string& message) {
    if (!good) throw InputError(message);
}

void judge(const PackingRequest& r) {
    validate(r.sizes);
    require(r.count.has_value() != (r.width.has_value() || r.height.has_value()),
            "packing: found both or neither of a count and a box, expected a count, or a width and a height");
    require(r.width.has_value() == r.height.has_value(), "packing: found one of width and height, expected both or a count");
    require(r.mean_overlap.has_value() != r.void_ratio.has_value(), "packing: found both or neither of mean overlap and void ratio, expected one target");
    const auto positive = [](const char* name, const std::optional<double>& v, const char* unit) {
        require(!v || (std::isfinite(*v) && *v > 0.0), fmt::format("packing: {}: found {}, expected a number > 0{}", name, v.value_or(0.0), unit));
    };
    positive("width", r.width, " in m");
    positive("height", r.height, " in m");
    positive("height to width", r.height_to_width, "");
    positive("mean overlap", r.mean_overlap, " in m");
    positive("void ratio", r.void_ratio, "");
    require(!r.count || (*r.count >= min_packing_circles && *r.count <= 10'000'000),
            fmt::format("packing: count: found {}, expected {} to 10000000", r.count.value_or(0), min_packing_circles));
    const double mean = radius_at(r.sizes, 0.5);
    require(!r.mean_overlap || (*r.mean_overlap <= tightest_overlap * mean && *r.mean_overlap >= 1e-8 * mean),
            fmt::format("packing: mean overlap: found {} m, expected {:.3g} to {:.3g} m for circles of median radius {:.3g} m", r.mean_overlap.value_or(0.0),
                        1e-8 * mean, tightest_overlap * mean, mean));
}

struct Made {
    Attempt attempt;
    double radius_scale = 1.0;
    int attempts = 1;
};

Made pack_count(const PackingRequest& request, std::int64_t count, const Target& target, double aspect, const PackingCallback& progress) {
    std::mt19937_64 random(request.seed);
    const std::vector<double> radii = sample_radii(request.sizes, static_cast<std::size_t>(count), random);
    int attempts = 1;
    Attempt best = best_attempt(request, radii, target, aspect, attempts, progress);
    return {std::move(best), 1.0, attempts};
}

/// The count whose packing fills the box nearest, then all lengths by one factor so that the width is met exactly.
Made pack_box(const PackingRequest& request, const Target& target, const PackingCallback& progress) {
    const double asked = *request.width * *request.height;
    double mean_square = 0.0;
    constexpr int quantiles = 1000;
    for (int k = 0; k < quantiles; ++k) mean_square += std::pow(radius_at(request.sizes, (k + 0.5) / quantiles), 2) / quantiles;
    const double estimate = asked * 0.83 / (std::numbers::pi * mean_square);
    require(estimate >= static_cast<double>(min_packing_circles),
            fmt::format("packing: found a box of {} by {} m, which holds about {:.1f} of these circles, expected at least {}", *request.width, *request.height,
                        estimate, min_packing_circles));
    auto count = static_cast<std::int64_t>(std::lround(estimate));
    Made made = pack_count(request, count, target, *request.height / *request.width, progress);
    for (int k = 0; k < 4; ++k) {
        const double filled = made.attempt.assembly.area() / asked;
        const auto better = std::max(min_packing_circles, static_cast<std::int64_t>(std::lround(static_cast<double>(count) / filled)));
        // Overlaps scale with the radii: aim beside the target by as much.
        Target aimed = target;
        aimed.overlap *= std::sqrt(filled * static_cast<double>(better) / static_cast<double>(count));
        const double factor = std::sqrt(asked / (made.attempt.assembly.area()));
        if (better == count && std::abs(made.attempt.sums.mean_platen_overlap() * factor / target.overlap - 1.0) <= 9e-4) break;
        if (better == count && target.void_ratio > 0.0) break;
        count = better;
        made = pack_count(request, count, aimed, *request.height / *request.width, progress);
    }
    made.radius_scale = *request.width / made.attempt.assembly.width;
    scale(made.attempt.assembly, made.radius_scale);
    made.attempt.assembly.width = *request.width;
    return made;
}

Scene scene_of(const DiscAssembly& assembly, const Material& material) {
    Scene scene;
    scene.materials = {material};
    scene.domain = {0.0, assembly.width, 0.0, assembly.height, {true, true, true, true}};
    int id = 0;
    for (const Disc& disc : assembly.discs) scene.add_circle_body(++id, 0, {{disc.x, disc.y}, disc.radius, 0.0});
    scene.time_step = deck_time_step(scene);
    return scene;
}

}  // namespace

double deck_time_step(const Scene& scene) {
    double lightest = std::numeric_limits<double>::infinity();
    for (const Body& body : scene.bodies) lightest = std::min(lightest, mass_properties(scene, body).mass);
    return 0.2 * std::sqrt(lightest / scene.materials.front().normal_stiffness);
}

PackingReport measure_packing(const Scene& scene, const SizeDistribution& sizes) {
    PackingReport report;
    const Domain& box = scene.domain;
    std::vector<Disc> discs;
    std::vector<double> radii;
    for (const CircleElement& circle : scene.circles) {
        discs.push_back({circle.centre.x - box.x1, circle.centre.y - box.y1, circle.radius});
        radii.push_back(circle.radius);
    }
    DiscAssembly assembly(box.x2 - box.x1, box.y2 - box.y1, discs, 1);
    const AssemblySums sums = assembly.compute_forces();
    const double stiffness = scene.materials.front().normal_stiffness;
    report.circles = static_cast<std::int64_t>(discs.size());
    report.width = assembly.width;
    report.height = assembly.height;
    report.radius_min = *std::min_element(radii.begin(), radii.end());
    report.radius_max = *std::max_element(radii.begin(), radii.end());
    report.mean_radius = assembly.mean_radius();
    report.size_distance = kolmogorov_distance(sizes, radii);
    report.void_ratio = void_ratio_of(assembly);
    report.mean_overlap = sums.mean_platen_overlap();
    report.mean_contact_force = stiffness * sums.mean_overlap();
    report.residual = sums.residual();
    std::array<double, 4> push{};
    std::int64_t carried = 0;
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const Disc& d = discs[i];
        std::int64_t touching = 0;
        for (const std::uint32_t* j = assembly.neighbours_begin(i); j != assembly.neighbours_end(i); ++j) {
            const Disc& other = discs[*j];
            if (d.radius + other.radius > std::hypot(other.x - d.x, other.y - d.y)) ++touching;
        }
        report.circle_contacts += touching;  // every pair is seen from both sides; halved below
        const std::array<double, 4> overlap{d.radius - d.x, d.radius - (assembly.width - d.x), d.radius - d.y, d.radius - (assembly.height - d.y)};
        for (std::size_t w = 0; w < 4; ++w) {
            if (overlap[w] <= 0.0) continue;
            ++report.wall_contacts[w];
            ++touching;
            push[w] += stiffness * overlap[w];
        }
        if (touching == 0) ++report.floating;
        carried += touching;
    }
    report.circle_contacts /= 2;
    const auto n = static_cast<double>(discs.size());
    report.coordination = 2.0 * static_cast<double>(report.circle_contacts) / n;
    report.coordination_of_carrying = report.floating < report.circles ? static_cast<double>(carried) / static_cast<double>(report.circles - report.floating) : 0.0;
    report.stress_x = 0.5 * (push[0] + push[1]) / assembly.height;
    report.stress_y = 0.5 * (push[2] + push[3]) / assembly.width;
    const double total = report.stress_x + report.stress_y;
    report.anisotropy = total > 0.0 ? std::abs(report.stress_x - report.stress_y) / total : 0.0;
    report.isotropic = report.anisotropy <= max_anisotropy;
    return report;
}

Packing make_packing(const PackingRequest& request, const PackingCallback& progress) {
    judge(request);
    const Target target{request.mean_overlap.value_or(loosest_overlap * radius_at(request.sizes, 0.5)), request.void_ratio.value_or(0.0)};
    const double aspect = request.width ? *request.height / *request.width : request.height_to_width.value_or(2.0);
    Made made = request.count ? pack_count(request, *request.count, target, aspect, progress) : pack_box(request, target, progress);
    Packing packing;
    packing.scene = scene_of(made.attempt.assembly, request.material);
    packing.report = measure_packing(packing.scene, request.sizes);
    packing.report.radius_scale = made.radius_scale;
    packing.report.attempts = made.attempts;
    packing.report.aspect_error = packing.report.height / packing.report.width / aspect - 1.0;
    packing.report.box_met =
        std::abs(packing.report.aspect_error) <= max_aspect_error && std::abs(made.radius_scale - 1.0) <= max_radius_scaling;
    return packing;
}

}  // namespace crackle
