// SPDX-License-Identifier: GPL-3.0-or-later
// Measures a packing from its scene alone, so that the report describes the result rather than the request.
// Tested by tests/specimens/packing/packing_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/packing/disc_assembly.hpp"
#include "specimens/packing/packing.hpp"

namespace crackle {

namespace {

/// Counts the contacts of all circles in the report. @return forces on the walls at stiffness 1, m; indexed by Wall
std::array<double, 4> count_contacts(const DiscAssembly& assembly, PackingReport& report) {
    std::array<double, 4> wall_force{};
    for (std::size_t i = 0; i < assembly.discs.size(); ++i) {
        const Disc& disc = assembly.discs[i];
        bool touched = false;
        for (const std::uint32_t* j = assembly.neighbours_begin(i); j != assembly.neighbours_end(i); ++j) {
            const Disc& other = assembly.discs[*j];
            const double apart = disc.radius + other.radius;
            const double dx = other.x - disc.x, dy = other.y - disc.y;
            if (dx * dx + dy * dy >= apart * apart) continue;
            touched = true;
            if (*j > i) ++report.circle_contacts;
        }
        const double distance[4] = {disc.x, report.width - disc.x, disc.y, report.height - disc.y};  // indexed by Wall
        for (std::size_t wall = 0; wall < 4; ++wall) {
            if (distance[wall] >= disc.radius) continue;
            touched = true;
            ++report.wall_contacts[wall];
            wall_force[wall] += disc.radius - distance[wall];
        }
        if (!touched) ++report.floating;
    }
    return wall_force;
}

}  // namespace

PackingReport measure_packing(const Scene& scene, const SizeDistribution& sizes) {
    std::vector<Disc> discs;
    std::vector<double> radii;
    for (const Body& body : scene.bodies) {
        if (body.circle_count != 1)
            throw InputError("packing: found a body that is not a single circle, expected circles only");
        const CircleElement& circle = scene.circles[body.first_circle];
        discs.push_back({circle.centre.x - scene.domain.x1, circle.centre.y - scene.domain.y1, circle.radius});
        radii.push_back(circle.radius);
    }
    if (discs.empty()) throw InputError("packing: found no circles, expected at least one");

    PackingReport report;
    report.circles = static_cast<std::int64_t>(discs.size());
    report.width = scene.domain.x2 - scene.domain.x1;
    report.height = scene.domain.y2 - scene.domain.y1;
    report.radius_min = *std::min_element(radii.begin(), radii.end());
    report.radius_max = *std::max_element(radii.begin(), radii.end());
    report.size_distance = kolmogorov_distance(sizes, radii);

    DiscAssembly assembly(report.width, report.height, std::move(discs), scene.threads);
    const AssemblySums sums = assembly.compute_forces();
    report.mean_radius = assembly.mean_radius();
    report.void_ratio = assembly.area() / assembly.disc_area() - 1.0;
    report.mean_overlap = sums.mean_platen_overlap();

    const double stiffness = scene.materials.at(0).normal_stiffness;
    const std::array<double, 4> wall_force = count_contacts(assembly, report);
    const auto count = static_cast<double>(report.circles);
    const auto carrying = static_cast<double>(report.circles - report.floating);
    std::int64_t walls = 0;
    for (const std::int64_t contacts : report.wall_contacts) walls += contacts;
    report.coordination = 2.0 * static_cast<double>(report.circle_contacts) / count;
    report.coordination_of_carrying =
        carrying > 0.0 ? static_cast<double>(2 * report.circle_contacts + walls) / carrying : 0.0;
    report.stress_x = stiffness * 0.5 * (wall_force[0] + wall_force[1]) / report.height;
    report.stress_y = stiffness * 0.5 * (wall_force[2] + wall_force[3]) / report.width;
    const double stress_sum = report.stress_x + report.stress_y;
    report.anisotropy = stress_sum > 0.0 ? std::abs(report.stress_x - report.stress_y) / stress_sum : 0.0;
    report.mean_contact_force = stiffness * sums.mean_overlap();
    report.residual = sums.residual();
    report.isotropic = report.anisotropy <= max_anisotropy;
    return report;
}

std::vector<std::string> packing_notices(const PackingReport& r) {
    std::vector<std::string> notices;
    if (!r.isotropic) {
        notices.push_back(
            fmt::format("the horizontal and vertical stresses in the packing differ: |sx - sy|/(sx + sy) is {:.2g}, "
                        "which is above {}; use more circles, or a box that is more than a few circles wide",
                        r.anisotropy, max_anisotropy));
    }
    if (std::abs(r.aspect_error) > max_aspect_error) {
        notices.push_back(fmt::format(
            "the ratio of height to width of the box differs from the requested one by {:.2g} %; use more circles",
            100.0 * r.aspect_error));
    }
    if (std::abs(r.radius_scale - 1.0) > max_radius_scaling) {
        notices.push_back(fmt::format(
            "radii were multiplied by {:.4f} to fill the box, a change of more than {} of the requested sizes; use "
            "more circles",
            r.radius_scale, max_radius_scaling));
    }
    return notices;
}

}  // namespace crackle
