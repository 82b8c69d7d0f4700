// SPDX-License-Identifier: GPL-3.0-or-later
// One attempt at making a packing. Circles at random positions are quenched in a box that is slightly too small. The
// box is then expanded at constant shape until the target is met, and the stress is made isotropic.
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "specimens/packing/disc_assembly.hpp"

namespace crackle {

/// Target of a compression; exactly one of the two values is set.
struct CompressionTarget {
    std::optional<double> mean_overlap;  ///< mean overlap of all contacts except contacts with side walls, m
    std::optional<double> void_ratio;
    /// Width to which the finished packing will be scaled, m; mean_overlap refers to the scaled packing. 0: no scaling.
    double final_width = 0.0;
};

/// Limits of the mean overlap, relative to the mean radius. Below the lower limit, round-off errors of positions exceed
/// the overlaps. Above the upper limit, discs interpenetrate rather than touch.
inline constexpr double smallest_overlap_share = 1e-5, largest_overlap_share = 0.1;

/// Called with the current stage and imbalance.
using CompressionCallback = std::function<void(const std::string& stage, double imbalance)>;

/// A packing in equilibrium, with its deviations from the request.
struct Compression {
    DiscAssembly assembly;
    AssemblySums sums;
    double aspect_error = 0.0;  ///< height / width / requested aspect - 1; nonzero only if exchanging radii could not
                                ///< make the stress isotropic
    bool converged = false;     ///< whether equilibrium and target were reached; if not, the attempt is discarded
};

/// Makes one attempt. @param free_box  whether the shape may change if the stress cannot be made isotropic otherwise
/// @throws InputError if the void ratio cannot be reached; the message gives the reachable range
Compression compress(const std::vector<double>& radii, double height_to_width, const CompressionTarget& target,
                     bool free_box, int threads, std::mt19937_64& generator, const CompressionCallback& progress);

}  // namespace crackle
