// SPDX-License-Identifier: GPL-3.0-or-later
// Random circle packings, compressed between four smooth walls to a mean overlap or a void ratio, in mechanical
// equilibrium.
//
// Circles touch each other and the walls through frictionless linear springs, f = k_n δ. They start at random positions
// and are quenched in a box that is slightly too small. The box is then expanded until its pressure gives the target;
// at each pressure p, positions and box minimise the enthalpy U + p·W·H. Every contact has the same k_n, so the
// equilibrium holds for any k_n. It also holds with friction.
//
// The mean overlap covers contacts between circles, and contacts with the bottom and top walls, which platen bonds will
// replace. The side walls are removed before a specimen is bonded, so contacts with them do not count.
//
// The box keeps its shape while the pressure acts. Circles of nearly equal size then swap places until the stress is
// isotropic (isotropy.hpp), so the set of radii stays as drawn. If the request gives a count, nothing else is needed.
// If the request gives width and height, the count is chosen so that scaling all lengths by one factor gives exactly
// this box. The factor must be within max_radius_scaling of 1 (report: radius_scale). If a packing violates a limit,
// another packing is drawn from the next stream of random numbers (report: attempts). The best packing is used, and its
// report states whether the limits are met (isotropic, box_met).
//
// Equal circles cannot be swapped. With a given count, the aspect ratio of the box may then change by up to
// max_aspect_error. The circles do not depend on the material, which only determines the stresses in the report and the
// time step in the particle file.
//
// The largest reachable void ratio is the ratio at which frictionless circles jam: looser arrangements cannot carry
// load in equilibrium.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/packing/size_distribution.hpp"

namespace crackle {

/// Request for a packing.
struct PackingRequest {
    // The box is given either by width and height, or by the number of circles.
    std::optional<double> width, height;  ///< m
    std::optional<std::int64_t> count;
    std::optional<double> height_to_width;  ///< shape of the box if a count is given; default 2

    SizeDistribution sizes;

    // Exactly one of these targets is given.
    std::optional<double> mean_overlap;  ///< m
    std::optional<double> void_ratio;    ///< (area of the box - area of the circles)/(area of the circles)

    std::uint64_t seed = 1;
    Material material;  ///< material of the scene; its k_n also determines the stresses in the report and the time step
    int threads = 1;    ///< results are bit-identical for any number of threads
};

/// Measured properties of a packing.
struct PackingReport {
    std::int64_t circles = 0;
    double width = 0.0, height = 0.0;           ///< m
    double radius_min = 0.0, radius_max = 0.0;  ///< smallest and largest radius of the final circles, m
    double mean_radius = 0.0;                   ///< m
    double radius_scale = 1.0;                  ///< final radius divided by drawn radius; 1 if a count is given
    double size_distance = 0.0;                 ///< Kolmogorov-Smirnov distance of the radii from the distribution
    double void_ratio = 0.0;
    double mean_overlap = 0.0;         ///< mean overlap of all contacts except the contacts with side walls, m
    std::int64_t circle_contacts = 0;  ///< pairs of circles with overlap > 0
    std::int64_t wall_contacts[4] = {0, 0, 0, 0};  ///< indexed by Wall
    double coordination = 0.0;                     ///< 2·circle_contacts/circles
    double coordination_of_carrying = 0.0;  ///< (2·circle_contacts + wall contacts)/(circles that are not floating)
    std::int64_t floating = 0;              ///< circles without any contact
    double stress_x = 0.0, stress_y = 0.0;  ///< N/m, mean over the two opposite walls, compression positive
    double anisotropy = 0.0;                ///< |σx - σy| / (σx + σy)
    double mean_contact_force = 0.0;        ///< mean over all contacts, N
    double residual = 0.0;                  ///< largest unbalanced force on a circle divided by the mean contact force
    double aspect_error = 0.0;              ///< (height/width)/(requested height/width) - 1
    int attempts = 1;                       ///< number of packings drawn
    bool isotropic = true;                  ///< whether anisotropy is within max_anisotropy
    bool box_met = true;                    ///< whether aspect_error and the radius scaling are within their limits
};

/// A packing of circles.
struct Packing {
    Scene scene;  ///< circles 1..N, numbered along the box's height, at rest, with all four walls and a time step
    PackingReport report;
};

inline constexpr double max_aspect_error = 1e-3;
inline constexpr double max_anisotropy = 0.01;
inline constexpr double max_radius_scaling = 0.005;
inline constexpr std::int64_t min_packing_circles = 10, max_packing_circles = 20'000'000;

/// Progress of make_packing(): the current stage, and the distance from equilibrium (largest unbalanced force divided
/// by mean contact force).
struct PackingProgress {
    std::string stage;
    int attempt = 1;
    double residual = 0.0;
};
using PackingCallback = std::function<void(const PackingProgress&)>;

/// Makes a packing. This takes about 0.3 s for 300 circles; the time grows slightly faster than their number.
/// @param progress  called occasionally; may be empty; may throw to stop
/// @throws InputError if a request is incomplete or contradictory, or if the target is out of reach; the message then
/// gives the reachable range
Packing make_packing(const PackingRequest& request, const PackingCallback& progress = {});

/// Report for a scene of single circles between four walls, computed from the scene alone.
PackingReport measure_packing(const Scene& scene, const SizeDistribution& sizes);

/// Returns a sentence for each limit that the packing violates.
std::vector<std::string> packing_notices(const PackingReport& report);

/// Scene with circles 1, 2, … in a box between four walls, at rest, with deck_time_step().
Scene scene_of_circles(const std::vector<CircleElement>& circles, double width, double height, const Material& material,
                       int threads);

/// Time step for an input file (deck) with these circles, s: a tenth of 2·sqrt(m/k_n) for the lightest circle. A circle
/// has at most about six contacts, with dashpots, so the stability limit of the bonded specimen is a few times larger.
double deck_time_step(const Scene& scene);

}  // namespace crackle
