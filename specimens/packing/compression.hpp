// SPDX-License-Identifier: GPL-3.0-or-later
// One draw of a packing: circles at random places, quenched in a box slightly too small, and the box then opened to the
// pressure at which the target is met, with its shape kept and the stress made isotropic.
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "specimens/packing/disc_assembly.hpp"

namespace crackle {

/// One of the two.
struct CompressionTarget {
    std::optional<double> mean_overlap;  ///< m, without the side walls
    std::optional<double> void_ratio;
    /// m: the finished packing will be scaled as a whole to this width, and mean_overlap is meant after that. 0: it
    /// will not.
    double final_width = 0.0;
};

/// Mean overlaps as shares of the mean radius between which packings are made. Below, the equilibrium would drown in
/// the round-off of the positions; above, discs are no longer bodies that touch.
inline constexpr double smallest_overlap_share = 1e-5, largest_overlap_share = 0.1;

/// Reports what is being done, and the imbalance reached.
using CompressionCallback = std::function<void(const std::string& stage, double imbalance)>;

struct Compression {
    DiscAssembly assembly;
    AssemblySums sums;
    double aspect_error =
        0.0;  ///< height / width / asked - 1; not 0 only where exchanging radii could not make it isotropic
    bool converged = false;  ///< equilibrium and target; else the draw is of no use
};

/// @param free_box the shape may change where the stress cannot be made isotropic otherwise.
/// @throws InputError for a void ratio out of reach, naming the reachable range.
Compression compress(const std::vector<double>& radii, double height_to_width, const CompressionTarget& target,
                     bool free_box, int threads, std::mt19937_64& generator, const CompressionCallback& progress);

}  // namespace crackle
