// SPDX-License-Identifier: GPL-3.0-or-later
// The outputs of a deck run and its in_gm.dat, which are shown and then truncated for the next part.

#include "solver/demseg/outputs.hpp"

#include "solver/base/errors.hpp"
#include "specimens/recordings/recording.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::deck_outputs(std::string_view bytes) {
    const auto [output, forces, details, geometry, energy, bodies, velocities, events] = files_of<8>(bytes);
    std::filesystem::create_directories(scratch() / "outputs");
    write_file("outputs/output.dat", output);
    write_file("outputs/cont.dat", forces);
    write_file("outputs/cont2.dat", details);
    write_file("outputs/in_gm.dat", geometry);
    write_file("outputs/events.csv", events);
    write_file("outputs/energy.dat", energy);
    write_file("outputs/f-d_curve.dat", bodies);
    write_file("outputs/velocity_y.dat", velocities);
    const std::filesystem::path folder = scratch() / "outputs";
    try {
        const Recording recording = read_deck_recording(folder, 3);
        for (std::size_t k = 0; k < recording.frames.size(); ++k) recording.frame(k);
    } catch (const InputError&) {  // drop_rows_after() is tried even if showing failed
    }
    drop_rows_after(folder, 5);
}
