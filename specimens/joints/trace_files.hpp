// SPDX-License-Identifier: GPL-3.0-or-later
// Files of measured traces:
//       a table       with a header: trace,x,y, one line per point, points of a trace in sequence; or x1,y1,x2,y2,
//                     and so on, one line per trace; other columns are ignored. Every .csv file is a table
//       DXF R12       LINE, POLYLINE with its VERTEX entities, and LWPOLYLINE; straight parts only
//       a list        one line per trace: x1 y1 x2 y2 ..., separated by spaces, tabs or commas (FracPaQ's node list);
//                     # begins a comment
// GeoJSON, SVG and some other file types are recognised and rejected, as are lists of x y z.
// Tested by tests/specimens/joints/trace_files_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// Points of the traces, in the units and order of the file.
using TracePoints = std::vector<std::vector<Vec2>>;

/// Line numbers in a file of traces.
struct TraceRows {
    std::vector<int> lines;           ///< line where each trace begins
    std::vector<int> without_length;  ///< lines of rows that are skipped because all their points coincide
};

/// Reads traces from a file.
/// @param layer  layer of a DXF file; if empty, all layers are read
/// @param rows  filled if not nullptr
/// @throws InputError «file:line: found X, expected Y», also if the file contains no trace
TracePoints read_traces(const std::filesystem::path& path, const std::string& layer, TraceRows* rows = nullptr);

/// Reads traces from text. @param name  name of the file; its extension determines the type
TracePoints parse_traces(const std::string& name, std::string_view text, const std::string& layer,
                         TraceRows* rows = nullptr);

/// Text with one line per trace, x1 y1 x2 y2 ..., in the format that read_traces() reads, at full precision.
std::string traces_text(const TracePoints& traces);

}  // namespace crackle
