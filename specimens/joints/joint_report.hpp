// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of the traces in a specimen: requested and actual amounts, lengths, directions, and the blocks that the
// traces would cut out if all were open.
//       P10  crossings per length of scan line, 1/m: mean over all parallel lines, Σ l |sin(θ - scan)|/area
//       P20  midpoints per area, 1/m2, of traces whose midpoint before clipping lies in the box
//       P21  length per area, m/m2 (Dershowitz & Herda 1992)
// Tested by tests/specimens/joints/joint_report_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "specimens/joints/joint_network.hpp"
#include "specimens/statistics/directions.hpp"

namespace crackle {

/// Statistics of one source, or of all traces together. Undefined values are NaN.
struct SourceReport {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    /// An amount requested for a set, and the amount reached, in the unit of the key.
    struct Asked {
        std::string key;  ///< "number", "p10", "p20" or "p21"
        double value = 0.0, reached = 0.0;
    };

    std::string name;
    std::size_t traces = 0;
    double p10 = none, p20 = none, p21 = 0.0;
    /// Direction of the scan line for p10, degrees; by default perpendicular to the mean direction.
    double scan_line = none;
    std::optional<Asked> amount;  ///< amount requested for a set; empty if none
    double mean_length = none;    ///< mean length before clipping of the traces whose midpoint lies in the box, m
    /// Requested mean length (m), direction (degrees from 0 to 180) and concentration (dimensionless).
    double mean_length_asked = none, direction_asked = none, kappa_asked = none;
    /// Length of the longest trace in the box, m.
    double longest = 0.0;
    double direction = none;  ///< mean direction weighted by length, degrees from 0 to 180
    /// Concentration of an axial von Mises distribution fitted to the directions of the traces; each trace counts
    /// once.
    double kappa = none;
    Rose rose;  ///< rose of the straight segments, weighted by length; the first bin is centred on 0
};

/// Statistics of a network of joints.
struct JointReport {
    std::vector<SourceReport> sources;
    SourceReport all;
    /// Number of blocks into which traces divide the box; empty if there are too many crossings to count blocks.
    std::optional<std::size_t> blocks;
    double largest_block = SourceReport::none;  ///< area of the largest block, relative to the box
    double median_block = SourceReport::none;   ///< area of the median block, relative to the box
    std::vector<std::string> notices;
};

/// For counting blocks, an end closer than this to another trace, relative to the box's diagonal, is taken to lie on
/// that trace, because surveys have few digits.
inline constexpr double block_reach_share = 1e-4;

/// Statistics of all sources, and of the blocks between the traces.
JointReport report_joints(const JointRequest& joints, const JointNetwork& network);

}  // namespace crackle
