// SPDX-License-Identifier: GPL-3.0-or-later
// in_gm.dat of either mode; the result is written and read again.

#include "solver/demseg/geometry.hpp"

#include <sstream>

#include "solver/demseg/deck_reader.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::deck_geometry(std::string_view bytes) {
    DeckReader mode("in_gm.dat", std::string(bytes)), reader = mode;
    if (mode.integer("mode", 0, 1) == 0) {
        read_random_geometry(reader);
        return;
    }
    const DeckGeometry geometry = read_deck_geometry(reader);
    std::ostringstream out;
    write_geometry(out, geometry.scene, geometry.large_segments);
    DeckReader again("written", std::move(out).str());
    read_deck_geometry(again);
}
