// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/joints/mesh_traces.hpp"

#include <fmt/format.h>

namespace crackle {

std::vector<std::vector<Point>> mesh_traces(const JointNetwork& network) {
    std::vector<std::vector<Point>> lines;
    lines.reserve(network.traces.size());
    for (const JointTrace& trace : network.traces) {
        std::vector<Point>& line = lines.emplace_back();
        for (const Vec2 p : trace.points) line.push_back({p.x, p.y});
    }
    return lines;
}

std::string traces_named(const JointNetwork& network, std::span<const int> traces) {
    std::string text;
    for (const int number : traces) {
        const JointTrace& trace = network.traces[static_cast<std::size_t>(number)];
        const JointSource& source = network.sources[trace.source];
        const Vec2 from = trace.points.front(), to = trace.points.back();
        text += fmt::format("{}trace {} belongs to {}{}, from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g})",
                            text.empty() ? " (" : ", ", number, source.name,
                            trace.row > 0 ? fmt::format(" ({}:{})", source.file, trace.row) : "", from.x, from.y, to.x,
                            to.y);
    }
    return text.empty() ? text : text + ")";
}

namespace {

/// Describes the shape of the cells and, if possible, compares it with a mesh of the same centres without traces.
std::string shape_text(const Mesh& with, const std::vector<CellCentre>& centres, const Domain& domain,
                       const MeshRequest& without_traces) {
    const MeshQuality shape = quality_of(with);
    try {
        const MeshQuality plain =
            quality_of(make_mesh(centres, {domain.x1, domain.x2, domain.y1, domain.y2}, without_traces));
        return fmt::format(
            "cells (in brackets: cells without joints): smallest angle {:.3g} ({:.3g}) degrees, ratio of smallest to "
            "mean area {:.2g} ({:.2g}), ratio of shortest to mean edge {:.2g} ({:.2g})",
            shape.smallest_angle, plain.smallest_angle, shape.smallest_area, plain.smallest_area, shape.shortest_edge,
            plain.shortest_edge);
        // Meshing without traces may fail, because the centres include some that were removed for traces.
    } catch (const MeshError&) {
        return fmt::format(
            "cells: smallest angle {:.3g} degrees, ratio of smallest to mean area {:.2g}, ratio of shortest to mean "
            "edge {:.2g}; a comparison is missing, because the same centres cannot be meshed without joints",
            shape.smallest_angle, shape.smallest_area, shape.shortest_edge);
    }
}

}  // namespace

std::vector<std::string> jointed_mesh_text(const Mesh& with, const std::vector<CellCentre>& centres,
                                           const Domain& domain, MeshRequest request) {
    const MeshReport& report = with.report;
    request.traces.clear();
    std::vector<std::string> lines{
        fmt::format(
            "joints: {:.6g} m of traces are {} edges of cells; {} centres were removed and {} points were added",
            report.trace_length, report.trace_edges, report.centres_left, report.points_added),
        shape_text(with, centres, domain, request)};
    if (report.cells_cut > 0)
        lines.push_back(
            fmt::format("joints: {} cells were cut by traces that are too close together for separate cells; {} pieces "
                        "smaller than {} of the mean cell area were joined to a neighbour",
                        report.cells_cut, report.pieces_joined, smallest_piece_share));
    if (report.ends_moved > 0)
        lines.push_back(
            fmt::format("joints: {} ends of traces were less than {} times the mean spacing away from another trace, a "
                        "wall or the outline of a cut cell. They were extended to it, by at most {:.3g} m",
                        report.ends_moved, trace_reach_share, report.largest_move));
    if (report.coincident > 0.0)
        lines.push_back(fmt::format(
            "joints: {:.3g} m of traces lie on earlier traces; the edges there are assigned to the earlier traces",
            report.coincident));
    return lines;
}

}  // namespace crackle
