// SPDX-License-Identifier: GPL-3.0-or-later
// What the traces of a specimen come to: amounts asked for and reached, lengths, directions, and the blocks that they
// would cut out if all of them were open.
//     P10  crossings per length of scan line, 1/m: the mean over all parallel lines in the box, Σ l |sin(θ -
//     scan)|/area P20  midpoints per area, 1/m2: of traces whose midpoint, before the box cut them, lies in the box P21
//     length per area, m/m2 (Dershowitz & Herda 1992)
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

/// Of one source, or of all traces together. What is not defined is not a number.
struct SourceReport {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    struct Asked {
        std::string key;  ///< "number", "p10", "p20" or "p21"
        double value = 0.0, reached = 0.0;
    };

    std::string name;
    std::size_t traces = 0;
    double p10 = none, p20 = none, p21 = 0.0;
    double scan_line = none;      ///< degrees, of p10: square to the mean direction where nobody gave one
    std::optional<Asked> amount;  ///< of a set
    double mean_length = none;    ///< m, of traces with their midpoint in the box, before that cut them
    double mean_length_asked = none, direction_asked = none, kappa_asked = none;  ///< m, degrees 0 to 180, -
    double longest = 0.0;                                                         ///< m, in the box
    double direction = none;                                                      ///< degrees 0 to 180, mean by length
    double kappa = none;  ///< of an axial von Mises law fitted to the traces' directions, each counted once
    Rose rose;            ///< straight parts, by length; the first bin is centred on 0
};

struct JointReport {
    std::vector<SourceReport> sources;
    SourceReport all;
    /// Parts of the box that traces part from each other; none where traces meet too often to count them.
    std::optional<std::size_t> blocks;
    double largest_block = SourceReport::none;  ///< share of the box's area
    double median_block = SourceReport::none;   ///< share; of blocks by number
    std::vector<std::string> notices;
};

/// Ends within this share of the box's diagonal of another trace are taken to lie on it where blocks are counted:
/// digits of a survey.
inline constexpr double block_reach_share = 1e-4;

JointReport report_joints(const TestCase& test, const JointNetwork& network);

}  // namespace crackle
