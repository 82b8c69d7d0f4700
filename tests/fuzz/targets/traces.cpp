// SPDX-License-Identifier: GPL-3.0-or-later
// A file of measured traces: of the first byte c a CSV, d a DXF drawing, l one of which a layer is read, any other a
// table.

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
