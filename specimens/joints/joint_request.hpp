// SPDX-License-Identifier: GPL-3.0-or-later
// The joints that a test requests: sets with their distributions, measured traces, and the mechanical properties of
// each. make_joints() places them in a box.
// Tested by tests/specimens/joints/joint_network_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "solver/base/names.hpp"
#include "solver/base/vec2.hpp"
#include "solver/scene/joint.hpp"
#include "specimens/joints/length_law.hpp"
#include "specimens/joints/orientation_law.hpp"
#include "specimens/places/places.hpp"

namespace crackle {

/// Traces that cross the whole box.
struct PersistentTraces {
    bool operator==(const PersistentTraces&) const = default;
};

/// Joints and rock bridges that alternate along lines.
struct TracesWithGaps {
    LengthLaw joint, gap;

    bool operator==(const TracesWithGaps&) const = default;
};

/// The quantity that states how many traces a set has.
enum class AmountKind : std::uint8_t { number, p10, p20, p21, spacing };
constexpr auto list_names(AmountKind) { return in_order("number", "p10", "p20", "p21", "spacing"); }

/// The amount of a set. A spacing has a distribution; its value is the mean.
struct TraceAmount {
    AmountKind kind = AmountKind::number;
    double value = 0.0;                         ///< -, 1/m, 1/m2, m/m2, or m
    LengthLaw spacing = LengthLaw::fixed(0.0);  ///< distances between the lines, for AmountKind::spacing
    std::optional<Vec2> through = {};           ///< m, a point on one of the lines at a spacing; empty: at random

    bool operator==(const TraceAmount&) const = default;
};

/// A joint set drawn from distributions.
struct JointSet {
    std::string name;
    OrientationLaw directions;
    std::variant<PersistentTraces, TracesWithGaps, LengthLaw> length;  ///< LengthLaw: traces of finite length
    TraceAmount amount;
    std::optional<double> scan_line;  ///< degrees from +x, scan line of P10; empty: perpendicular to the mean direction
    std::optional<Joint> mechanics;   ///< empty: the joint has the properties of the rock

    bool operator==(const JointSet&) const = default;
};

/// A file of measured traces.
struct TraceFile {
    std::filesystem::path path;
    std::string layer;   ///< the only layer of a DXF file that is read; empty: all layers
    double scale = 1.0;  ///< m per unit of the file
    Vec2 offset;         ///< m, added after scaling

    bool operator==(const TraceFile&) const = default;
};

/// Measured traces: the points of one trace, or a file with any number of traces.
struct MeasuredTraces {
    std::string name;
    std::variant<std::vector<Vec2>, TraceFile> from;
    std::optional<Joint> mechanics;  ///< empty: the joints have the properties of the rock

    bool operator==(const MeasuredTraces&) const = default;
};

/// Values that apply to all joints and are used as stated in the case.
struct JointValues {
    /// Shortest trace that is kept, m; empty: the mean spacing of the cells, if cells follow the traces.
    std::optional<double> shortest;
    /// Distance within which nodes are merged, m; empty: a fraction of the mean spacing of the cells.
    std::optional<double> snap;

    bool operator==(const JointValues&) const = default;
};

/// All joints of a test.
struct JointRequest : JointValues {
    std::uint64_t seed = 1;
    std::vector<JointSet> sets;
    std::vector<MeasuredTraces> traces;
    Places places;

    /// Whether there are no joints.
    bool empty() const { return sets.empty() && traces.empty(); }

    bool operator==(const JointRequest&) const = default;
};

/// The joints of a file, and the box of its packing, if the file states the size.
struct JointCase {
    JointRequest joints;
    std::optional<double> width, height;       // m
    std::vector<std::filesystem::path> files;  ///< all files from which the joints were read
};

}  // namespace crackle
