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
        text +=
            fmt::format("{}trace {} is of {}{}, from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g})", text.empty() ? " (" : ", ",
                        number, source.name, trace.row > 0 ? fmt::format(" ({}:{})", source.file, trace.row) : "",
                        from.x, from.y, to.x, to.y);
    }
    return text.empty() ? text : text + ")";
}

namespace {

/// The shape of cells, beside that of the same centres' without traces where these have a mesh.
std::string shape_text(const Mesh& with, const std::vector<CellCentre>& centres, const Domain& domain,
                       const MeshRequest& without_traces) {
    const MeshQuality shape = quality_of(with);
    try {
        const MeshQuality plain =
            quality_of(make_mesh(centres, {domain.x1, domain.x2, domain.y1, domain.y2}, without_traces));
        return fmt::format(
            "cells beside those without joints: least angle {:.3g} ({:.3g}) degrees, smallest over mean area "
            "{:.2g} ({:.2g}), shortest over mean edge {:.2g} ({:.2g})",
            shape.smallest_angle, plain.smallest_angle, shape.smallest_area, plain.smallest_area, shape.shortest_edge,
            plain.shortest_edge);
    } catch (const MeshError&) {  // centres that made way for traces are in it
        return fmt::format(
            "cells: least angle {:.3g} degrees, smallest over mean area {:.2g}, shortest over mean edge {:.2g}; the "
            "same centres have no mesh without joints to compare",
            shape.smallest_angle, shape.smallest_area, shape.shortest_edge);
    }
}

}  // namespace

std::vector<std::string> jointed_mesh_text(const Mesh& with, const std::vector<CellCentre>& centres,
                                           const Domain& domain, MeshRequest request) {
    const MeshReport& report = with.report;
    request.traces.clear();
    std::vector<std::string> lines{
        fmt::format("joints: {:.6g} m of traces are {} edges of cells; {} centres made way, {} points were added",
                    report.trace_length, report.trace_edges, report.centres_left, report.points_added),
        shape_text(with, centres, domain, request)};
    if (report.cells_cut > 0)
        lines.push_back(
            fmt::format("joints: {} cells were cut by traces too close for cells of their own; {} pieces "
                        "smaller than {} of the mean cell joined a neighbour",
                        report.cells_cut, report.pieces_joined, smallest_piece_share));
    if (report.ends_moved > 0)
        lines.push_back(
            fmt::format("joints: {} ends that lay within {} of the mean spacing of another trace, a wall or, where "
                        "they cut cells, the outline of one meet it now, by at most {:.3g} m",
                        report.ends_moved, trace_reach_share, report.largest_move));
    if (report.coincident > 0.0)
        lines.push_back(fmt::format("joints: {:.3g} m of traces lie on others, whose edges are the first one's",
                                    report.coincident));
    return lines;
}

}  // namespace crackle
