// SPDX-License-Identifier: GPL-3.0-or-later
// One .vtp file, unchanged.

#include "solver/base/errors.hpp"
#include "specimens/frames/read_frames.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::frame(std::string_view bytes) {
    const std::filesystem::path file = write_file("frame.vtp", bytes);
    try {
        read_field_values(file);
    } catch (const InputError&) {  // read_polydata() is tried even if this failed
    }
    const PolyData data = read_polydata(file);
    cell_values(file, data, "id");
}
