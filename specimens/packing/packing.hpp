// SPDX-License-Identifier: GPL-3.0-or-later
// Random circle packings, compressed between four smooth walls to a mean overlap or a void ratio, in mechanical
// equilibrium.
//
// Circles touch each other and the walls through frictionless linear springs, f = k_n δ. They start at random places,
// are quenched in a box that is slightly too small, and the box is then opened to the pressure at which the target is
// met: positions and box minimise the enthalpy U + p·W·H. Every contact carries the same k_n, so the equilibrium holds
// for any k_n, and with friction as well.
//
// Mean overlap: over all circle-circle contacts and those with the bottom and top walls, which become platen bonds; the
// side walls are gone when a specimen is bonded, and do not count.
//
// Box. Its shape is kept while the pressure acts; circles of nearly equal size then trade places until the stress is
// isotropic (isotropy.hpp), so radii stay as drawn. With a count, that is all. With a width and a height, the count is
// chosen so that one factor on all lengths, at most max_radius_scaling from 1 (report: radius_scale), meets the box
// exactly. Packings that miss one of these are drawn again, with the next stream of random numbers (report: attempts);
// the one that came nearest is taken, and its report states what it missed (isotropic, box_met). Where circles are all
// alike there is nothing to trade: with a count the box may then leave its shape by max_aspect_error.
// Circles do not depend on the material: it gives the report its stresses, and the deck its time step.
//
// Reachable void ratios end where frictionless circles jam: looser arrangements cannot carry load at rest.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/packing/size_distribution.hpp"

namespace crackle {

struct PackingRequest {
    // Either a box ...
    std::optional<double> width, height;  ///< m
    // ... or a count.
    std::optional<std::int64_t> count;
    std::optional<double> height_to_width;  ///< shape of the box, with a count; 2 if not given

    SizeDistribution sizes;

    // One target.
    std::optional<double> mean_overlap;  ///< m
    std::optional<double> void_ratio;    ///< (area of the box - area of the circles) / area of the circles

    std::uint64_t seed = 1;
    Material material;  ///< of the scene; k_n also gives the stresses of the report and the time step
    int threads = 1;    ///< any number gives the same bytes
};

struct PackingReport {
    std::int64_t circles = 0;
    double width = 0.0, height = 0.0;           ///< m
    double radius_min = 0.0, radius_max = 0.0;  ///< m, of the circles made
    double mean_radius = 0.0;                   ///< m
    double radius_scale = 1.0;                  ///< radii made / radii drawn; 1 with a count
    double size_distance = 0.0;                 ///< Kolmogorov-Smirnov distance of the radii from the distribution
    double void_ratio = 0.0;
    double mean_overlap = 0.0;                     ///< m, circle-circle, bottom and top walls
    std::int64_t circle_contacts = 0;              ///< pairs of circles with overlap > 0
    std::int64_t wall_contacts[4] = {0, 0, 0, 0};  ///< by Wall
    double coordination = 0.0;                     ///< 2·circle_contacts / circles
    double coordination_of_carrying = 0.0;  ///< (2·circle_contacts + wall contacts) / circles that are not floating
    std::int64_t floating = 0;              ///< circles without any contact
    double stress_x = 0.0, stress_y = 0.0;  ///< N/m, mean of the two opposite walls, compression positive
    double anisotropy = 0.0;                ///< |σx - σy| / (σx + σy)
    double mean_contact_force = 0.0;        ///< N, all contacts
    double residual = 0.0;                  ///< largest unbalanced force on a circle / mean contact force
    double aspect_error = 0.0;              ///< height / width / asked aspect - 1
    int attempts = 1;                       ///< packings drawn
    bool isotropic = true;                  ///< anisotropy within max_anisotropy
    bool box_met = true;                    ///< aspect and radius scaling within their limits
};

struct Packing {
    Scene scene;  ///< circles 1..N, numbered along the box's height, at rest; all four walls; time step set
    PackingReport report;
};

inline constexpr double max_aspect_error = 1e-3;
inline constexpr double max_anisotropy = 0.01;
inline constexpr double max_radius_scaling = 0.005;
inline constexpr std::int64_t min_packing_circles = 10, max_packing_circles = 20'000'000;

/// What make_packing() is doing: a stage in words, and how far the equilibrium is (largest unbalanced / mean contact
/// force).
struct PackingProgress {
    std::string stage;
    int attempt = 1;
    double residual = 0.0;
};
using PackingCallback = std::function<void(const PackingProgress&)>;

/// Cost: about 0.3 s for 300 circles, growing slightly faster than their number.
/// @param progress called now and then; may be empty, may throw to stop.
/// @throws InputError for a request that is incomplete or contradictory, and for a target out of reach, with the
/// reachable range.
Packing make_packing(const PackingRequest& request, const PackingCallback& progress = {});

/// Measures a scene of single circles between four walls again, from nothing but the scene.
PackingReport measure_packing(const Scene& scene, const SizeDistribution& sizes);

/// What the packing misses of what was asked, in words; nothing where all was met.
std::vector<std::string> packing_notices(const PackingReport& report);

/// Circles 1, 2, … in a box between four walls, at rest, with the time step of the deck.
Scene scene_of_circles(const std::vector<CircleElement>& circles, double width, double height, const Material& material,
                       int threads);

/// Time step written into the deck: a tenth of the lightest circle's 2·sqrt(m/k_n) [s]. Its contacts number at most
/// about six and carry dashpots, so that the bound of the bonded specimen is a few times larger.
double deck_time_step(const Scene& scene);

}  // namespace crackle
