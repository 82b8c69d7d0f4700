// SPDX-License-Identifier: GPL-3.0-or-later
// Files of measured traces:
//     .csv          with a heading: trace,x,y, a line a point, points of one trace one after another; or x1,y1,x2,y2, a
//                   line a straight trace; other columns are passed over
//     .dxf          R12: LINE, POLYLINE with its VERTEX entities, and LWPOLYLINE; straight parts alone
//     any other     a trace a line: x1 y1 x2 y2 ..., blanks or tabs between (FracPaQ's list of nodes); # begins a
//     remark
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
