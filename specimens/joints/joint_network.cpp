// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/joints/joint_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/mesher.hpp"
#include "solver/base/errors.hpp"
#include "specimens/joints/clipping.hpp"
#include "specimens/joints/drawn_sets.hpp"
#include "specimens/joints/faults.hpp"
#include "specimens/joints/trace_files.hpp"
#include "specimens/statistics/spoken.hpp"

namespace crackle {
namespace {

// Largest and smallest snap distance > 0, relative to the shorter side of the box.
constexpr double most_of_a_side = 0.1, least_of_a_side = 1e-9;
constexpr double join_share = 0.5;  // largest distance between ends of rows at one node, relative to the snap distance

/// Point at half the length of a polyline.
Vec2 midpoint_of(const std::vector<Vec2>& points) {
    double left = 0.5 * length_of(points);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const double part = norm(points[k + 1] - points[k]);
        if (left <= part) return points[k] + (left / part) * (points[k + 1] - points[k]);
        left -= part;
    }
    return points.back();
}

bool holds(const Domain& box, Vec2 p) { return p.x >= box.x1 && p.x <= box.x2 && p.y >= box.y1 && p.y <= box.y2; }

struct Measured {
    TracePoints traces;
    TraceRows rows;    // rows of the file at which the traces begin
    std::string file;  // name of the file
};

Measured measured(const JointRequest& joints, std::size_t number) {
    Measured found;
    const auto* file = std::get_if<TraceFile>(&joints.traces[number].from);
    if (file == nullptr) {
        found.traces.push_back(std::get<std::vector<Vec2>>(joints.traces[number].from));
        return found;
    }
    found.file = file->path.filename().string();
    try {
        found.traces = read_traces(file->path, file->layer, &found.rows);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", joints.places.at(CaseKey::trace_file, number), error.what()));
    }
    for (std::vector<Vec2>& points : found.traces)
        for (Vec2& p : points) p = file->scale * p + file->offset;
    return found;
}

/// Adds measured traces. @param join  whether to join rows that are segments of one fault
void take_measured(JointNetwork& network, const JointRequest& joints, std::size_t number, bool join, double snap) {
    const std::size_t source = network.sources.size();
    const Measured read = measured(joints, number);
    network.sources.push_back({joints.traces[number].name, joints.traces[number].mechanics, read.file});
    const std::string& name = network.sources.back().name;
    if (const std::vector<int>& without = read.rows.without_length; !without.empty())
        network.notices.push_back(fmt::format("{}: {} of {} traces {} no length and {} passed over, the first at {}:{}",
                                              name, without.size(), without.size() + read.traces.size(),
                                              without.size() == 1 ? "has" : "have", without.size() == 1 ? "is" : "are",
                                              read.file, without.front()));
    std::vector<Fault> traces;
    if (join) {
        traces = joined_rows(read.traces, join_share * snap);
    } else {
        for (const std::vector<Vec2>& points : read.traces) traces.push_back({points, traces.size(), 1});
    }
    std::size_t joined = 0, ends = 0;
    for (const Fault& fault : traces) {
        if (fault.rows == 1) continue;
        joined += fault.rows;
        ++ends;
    }
    if (ends > 0)
        network.notices.push_back(
            fmt::format("{}: {} rows that share nodes are {} from end to end", name, joined, counted(ends, "trace")));
    std::size_t outside = 0;
    for (const auto& [points, row, rows] : traces) {
        const int line = read.rows.lines.empty() ? 0 : read.rows.lines[row];
        const auto pieces = clipped(points, network.box);
        if (pieces.empty()) ++outside;
        const double whole = length_of(points);
        const bool centred = holds(network.box, midpoint_of(points));
        // A trace cut into pieces has one midpoint, which counts for the longest piece.
        const auto longest = std::max_element(pieces.begin(), pieces.end(),
                                              [](const auto& a, const auto& b) { return length_of(a) < length_of(b); });
        for (auto piece = pieces.begin(); piece != pieces.end(); ++piece)
            network.traces.push_back({*piece, source, whole, centred && piece == longest, line});
    }
    if (outside == traces.size()) {
        throw InputError(fmt::format(
            "{}: found all of its traces outside of the box x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, "
            "expected one inside; "
            "{}",
            joints.places.at(CaseKey::trace, number), network.box.x1, network.box.x2, network.box.y1, network.box.y2,
            read.file.empty() ? "correct its points" : "give the scale and offset of the file"));
    }
    if (outside > 0)
        network.notices.push_back(
            fmt::format("{}: {} of {} traces lie outside of the box", name, outside, traces.size()));
}

/// Removes traces shorter than `shortest`. @param why  explanation of `shortest` for the notice
void leave_out_short(JointNetwork& network, double shortest, const char* why) {
    std::size_t count = 0;
    double length = 0.0;
    for (const JointTrace& trace : network.traces) {
        if (trace.length() >= shortest) continue;
        ++count;
        length += trace.length();
    }
    std::erase_if(network.traces, [&](const JointTrace& trace) { return trace.length() < shortest; });
    if (count > 0)
        network.notices.push_back(fmt::format("{} traces shorter than {:.4g} m ({}) are left out, {:.4g} m in all",
                                              count, shortest, why, length));
}

/// The snap distance, m. @param spacing  mean spacing of the grains, m; 0 if no cells follow the traces
double snap_of(const JointRequest& joints, const Domain& box, double spacing) {
    if (!joints.snap) return snap_share * spacing;
    const double snap = *joints.snap, side = std::min(box.x2 - box.x1, box.y2 - box.y1);
    const double most = spacing > 0.0 ? spacing : most_of_a_side * side, least = least_of_a_side * side;
    if (snap > 0.0 && (snap < least || snap > most))
        throw InputError(
            fmt::format("{}: found {:.4g}, expected 0, or {:.4g} to {:.4g} m, which is {}",
                        joints.places.at(CaseKey::joints_snap), snap, least, most,
                        spacing > 0.0 ? "the mean spacing of the grains" : "a tenth of the shorter side of the box"));
    return snap;
}

/// Cleans the traces by merging nodes that nearly coincide.
void clean(const JointRequest& joints, JointNetwork& network, double snap, double spacing) {
    const bool any = !network.traces.empty();
    try {
        network.cleaning = clean_traces(network.traces, network.box, snap, trace_reach_share * spacing);
    } catch (const MeshError& error) {  // too many crossings for the memory; traces stay as they are
        network.notices.push_back(fmt::format("nodes that nearly coincide are not merged: {}", error.what()));
    }
    if (any && network.traces.empty() && joints.snap)
        throw InputError(
            fmt::format("{}: found no trace left after nodes closer than {:.4g} m were merged, expected at least "
                        "one; lower this value",
                        joints.places.at(CaseKey::joints_snap), 0.5 * snap));
}

}  // namespace

JointNetwork make_joints(const JointRequest& joints, const Domain& box, std::size_t centres) {
    JointNetwork network;
    network.box = box;
    const double spacing = centres > 0 ? std::sqrt(network.area() / static_cast<double>(centres)) : 0.0;
    const double snap = snap_of(joints, box, spacing);
    for (std::size_t set = 0; set < joints.sets.size(); ++set) {
        network.sources.push_back({joints.sets[set].name, joints.sets[set].mechanics});
        const std::vector<JointTrace> traces = draw_set(joints, set, box);
        if (traces.empty()) network.notices.push_back(fmt::format("{}: no trace meets the box", joints.sets[set].name));
        network.traces.insert(network.traces.end(), traces.begin(), traces.end());
    }
    const bool join = snap > 0.0 || joints.shortest || centres > 0;
    for (std::size_t number = 0; number < joints.traces.size(); ++number)
        take_measured(network, joints, number, join, snap);
    if (joints.shortest)
        leave_out_short(network, *joints.shortest, "joints.shortest");
    else if (centres > 0)
        leave_out_short(network, spacing, "the mean spacing of the cells; joints.shortest sets another limit");
    clean(joints, network, snap, spacing);
    network.cleaning.derived = !joints.snap;
    return network;
}

void check_apertures(const JointRequest& joints, double gap, bool meshed) {
    const auto check = [&](const auto& list, CaseKey key) {
        for (std::size_t k = 0; k < list.size(); ++k) {
            if (!list[k].mechanics || list[k].mechanics->aperture <= gap) continue;
            throw InputError(fmt::format(
                "{}: found {} m, expected at most {}, {:.6g} m; {}", joints.places.at(key, k),
                list[k].mechanics->aperture, meshed ? "the gap of the mesh" : "the radius of the smallest circle", gap,
                meshed ? "the faces are this far apart, so lower the aperture or raise mesh.thick" : "lower it"));
        }
    };
    check(joints.sets, CaseKey::joint_set_aperture);
    check(joints.traces, CaseKey::trace_aperture);
}

}  // namespace crackle
