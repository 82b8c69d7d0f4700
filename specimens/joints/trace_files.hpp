// SPDX-License-Identifier: GPL-3.0-or-later
// Files of measured traces:
//     a table       with a heading: trace,x,y, a line a point, points of one trace one after another; or x1,y1,x2,y2
//                   and so on, a line a trace; other columns are passed over. Every .csv is one
//     DXF R12       LINE, POLYLINE with its VERTEX entities, and LWPOLYLINE; straight parts alone
//     a list        a trace a line: x1 y1 x2 y2 ..., blanks, tabs or commas between (FracPaQ's list of nodes); # begins
//                   a remark
// GeoJSON, SVG and other kinds of file are refused by name, and so are lists of x y z.
// Tested by tests/specimens/joints/trace_files_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// Points of the traces in the file's units, in its order.
using TracePoints = std::vector<std::vector<Vec2>>;

/// Where in a file its traces begin.
struct TraceRows {
    std::vector<int> lines;           ///< by trace
    std::vector<int> without_length;  ///< of rows whose points are all one place: these are passed over
};

/// @param layer of a DXF file; empty: all  @param rows filled where given
/// @throws InputError «file:line: found X, expected Y», also for a file without a trace
TracePoints read_traces(const std::filesystem::path& path, const std::string& layer, TraceRows* rows = nullptr);

/// The same of a text. @param name of the file: its ending says what it is
TracePoints parse_traces(const std::string& name, std::string_view text, const std::string& layer,
                         TraceRows* rows = nullptr);

/// A trace a line, x1 y1 x2 y2 ..., as read_traces() takes it, to the last digit.
std::string traces_text(const TracePoints& traces);

}  // namespace crackle
