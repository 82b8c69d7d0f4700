// SPDX-License-Identifier: GPL-3.0-or-later
// A file of measured traces. The first byte selects the format: c for CSV, d for a DXF drawing, l for a layer of a
// drawing, anything else for a table.

#include "specimens/joints/trace_files.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::traces(std::string_view bytes) {
    if (bytes.empty()) return;
    const char form = bytes.front();
    const bool drawing = form == 'd' || form == 'l';
    parse_traces(drawing       ? "traces.dxf"
                 : form == 'c' ? "traces.csv"
                               : "traces.txt",
                 bytes.substr(1), form == 'l' ? "joints" : "");
}
