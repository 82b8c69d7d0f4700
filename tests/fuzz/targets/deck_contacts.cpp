// SPDX-License-Identifier: GPL-3.0-or-later
// in_cf.dat or in_cf0.dat for a chain of circles: the first byte selects the file, the others are its contents.

#include "solver/demseg/contact_files.hpp"

#include <filesystem>

#include "solver/demseg/deck_reader.hpp"
#include "solver/demseg/geometry.hpp"
#include "solver/stepping/build_world.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::deck_contacts(std::string_view bytes) {
    static const Scene scene =
        read_geometry(std::filesystem::path(CRACKLE_SOURCE_DIR) / "specimens/demseg/chain_pulled/in_gm.dat");
    static const World fresh = build_world(scene);
    if (bytes.empty()) return;
    World world = fresh;
    DeckReader reader("in_cf.dat", std::string(bytes.substr(1)));
    if (bytes.front() == '0')
        read_back_tensions(reader, scene, world);
    else
        read_contacts(reader, scene, world);
}
