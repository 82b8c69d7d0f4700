// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/joints/joint_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/trace_graph.hpp"
#include "solver/base/correctly_rounded.hpp"
#include "specimens/joints/drawn_sets.hpp"
#include "specimens/joints/mesh_traces.hpp"

namespace crackle {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

double angle_of(Vec2 direction) { return correctly_rounded::atan2(direction.y, direction.x); }

/// Sums over the traces of one source.
class Sums {
  public:
    // Edges of bins lie between multiples of 10 degrees. Users often state such multiples, and rounding must not spread
    // parallel traces over two bins.
    Sums() { by_length_.begins = -0.5 * rose_bin_width; }

    void add(const JointTrace& trace) {
        traces_.push_back(&trace);
        for (std::size_t k = 0; k + 1 < trace.points.size(); ++k) {
            const Vec2 part = trace.points[k + 1] - trace.points[k];
            by_length_.add(angle_of(part), norm(part));
        }
        const Vec2 chord = trace.points.back() - trace.points.front();
        if (norm(chord) > 0.0) once_each_.add(angle_of(chord), 1.0);
        if (!trace.centred) return;
        ++centred_;
        whole_lengths_ += trace.whole_length;
    }

    /// Statistics of the traces. @param scan_line  direction, rad; if NaN, perpendicular to the mean direction
    SourceReport report(const std::string& name, double scan_line, double area) const {
        SourceReport r;
        r.name = name;
        r.traces = traces_.size();
        double length = 0.0;
        bool endless = false;
        for (const JointTrace* trace : traces_) {
            length += trace->length();
            r.longest = std::max(r.longest, trace->length());
            endless = endless || !std::isfinite(trace->whole_length);
        }
        r.p21 = length / area;
        r.rose = by_length_;
        r.direction = by_length_.mean_direction();
        r.kappa = fitted_kappa(once_each_.resultant(), once_each_.count);
        if (!endless) r.p20 = static_cast<double>(centred_) / area;
        if (centred_ > 0) r.mean_length = whole_lengths_ / static_cast<double>(centred_);
        if (std::isnan(scan_line)) scan_line = r.direction / degrees + 0.5 * std::numbers::pi;
        if (std::isnan(scan_line)) return r;
        r.scan_line = line_direction(scan_line * degrees);
        r.p10 = 0.0;
        for (const JointTrace* trace : traces_) r.p10 += length_across(*trace, scan_line) / area;
        return r;
    }

  private:
    std::vector<const JointTrace*> traces_;
    Rose by_length_, once_each_;
    std::size_t centred_ = 0;
    double whole_lengths_ = 0.0;
};

void add_what_was_asked(SourceReport& r, const JointSet& set) {
    r.direction_asked = line_direction(set.directions.mean() * degrees);
    r.kappa_asked = set.directions.kappa();
    double persistence = 1.0;
    if (const auto* gaps = std::get_if<TracesWithGaps>(&set.length)) {
        r.mean_length_asked = gaps->joint.mean();
        persistence = gaps->joint.mean() / (gaps->joint.mean() + gaps->gap.mean());
    } else if (const auto* law = std::get_if<LengthLaw>(&set.length)) {
        r.mean_length_asked = law->mean();
    }
    const auto [kind, value] = std::pair(set.amount.kind, set.amount.value);
    if (kind == AmountKind::spacing)
        r.amount = {name_of(AmountKind::p10), persistence / value, r.p10};
    else
        r.amount = {name_of(kind), value,
                    kind == AmountKind::number ? static_cast<double>(r.traces)
                    : kind == AmountKind::p10  ? r.p10
                    : kind == AmountKind::p20  ? r.p20
                                               : r.p21};
}

void count_blocks(JointReport& report, const JointNetwork& network) {
    const std::vector<std::vector<Point>> lines = mesh_traces(network);
    const Domain& box = network.box;
    const double reach = block_reach_share * norm({box.x2 - box.x1, box.y2 - box.y1});
    std::vector<double> areas;
    try {
        areas = parted_areas(trace_graph({box.x1, box.x2, box.y1, box.y2}, lines, reach));
    } catch (const MeshError& error) {
        report.notices.push_back(fmt::format("blocks are not counted: {}", error.what()));
        return;
    }
    std::sort(areas.begin(), areas.end());
    report.blocks = areas.size();
    report.largest_block = areas.back() / network.area();
    report.median_block = areas[(areas.size() - 1) / 2] / network.area();
}

}  // namespace

JointReport report_joints(const JointRequest& joints, const JointNetwork& network) {
    JointReport report;
    report.notices = network.notices;
    std::vector<Sums> sums(network.sources.size());
    Sums all;
    for (const JointTrace& trace : network.traces) {
        sums[trace.source].add(trace);
        all.add(trace);
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
        const JointSource& source = network.sources[k];
        if (k >= joints.sets.size()) {  // measured
            report.sources.push_back(sums[k].report(source.name, SourceReport::none, network.area()));
            continue;
        }
        const JointSet& set = joints.sets[k];
        const double scan_line =
            set.scan_line ? *set.scan_line / degrees : set.directions.mean() + 0.5 * std::numbers::pi;
        report.sources.push_back(sums[k].report(source.name, scan_line, network.area()));
        add_what_was_asked(report.sources.back(), set);
    }
    report.all = all.report("all", SourceReport::none, network.area());
    count_blocks(report, network);
    return report;
}

}  // namespace crackle
