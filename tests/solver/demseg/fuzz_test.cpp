// SPDX-License-Identifier: GPL-3.0-or-later
// Tests damaged decks: for any bytes, a reader returns or throws InputError. Sanitizers check for other errors.

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "solver/base/errors.hpp"
#include "solver/demseg/boundary.hpp"
#include "solver/demseg/contact_files.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/demseg/geometry.hpp"
#include "solver/files/read_file.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

using namespace testing;

#ifdef __SANITIZE_ADDRESS__
constexpr int rounds = 1000;  // with sanitizers, each takes several times as long
#else
constexpr int rounds = 3000;
#endif

std::string damaged(std::string text, std::mt19937_64& random) {
    static const std::string letters = " \n\t0123456789.-+eEdDxn,/*\x1a\x81\x40\xe3\xff";
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    for (std::size_t k = 1 + below(4); k > 0 && !text.empty(); --k) {
        const std::size_t at = below(text.size());
        switch (below(4)) {
            case 0:
                text[at] = letters[below(letters.size())];
                break;
            case 1:
                text.insert(at, 1, letters[below(letters.size())]);
                break;
            case 2:
                text.erase(at, 1 + below(8));
                break;
            default:
                text.resize(at);
                break;
        }
    }
    return text;
}

/// Reads damaged versions of a text. @return fraction of them that were refused
double refused(const std::string& text, const std::function<void(DeckReader&)>& read) {
    std::mt19937_64 random(text.size());
    int count = 0;
    for (int n = 0; n < rounds; ++n) {
        DeckReader reader("damaged", damaged(text, random));
        try {
            read(reader);
        } catch (const InputError& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("damaged")) << error.what();
            ++count;
        }
    }
    return static_cast<double>(count) / rounds;
}

TEST(DamagedDecks, AreReadOrRefusedWithFileAndLine) {
    for (const char* name : {"circle", "clump", "triangle", "controlled_segment_force", "slope_k1", "embankment"}) {
        const std::string text = read_file(shipped_deck(name) / "in_gm.dat");
        EXPECT_GT(refused(text, [](DeckReader& reader) { read_deck_geometry(reader); }), 0.3) << name;
    }
    EXPECT_GT(refused(read_file(shipped_deck("repose") / "in_gm.dat"),
                      [](DeckReader& reader) { read_random_geometry(reader); }),
              0.3);
    EXPECT_GT(
        refused(read_file(shipped_deck("wave_chain") / "in_bc.dat"), [](DeckReader& reader) { read_boundary(reader); }),
        0.3);
    EXPECT_GT(refused(read_file(shipped_deck("controlled_segment_force") / "in_bc.dat"),
                      [](DeckReader& reader) { read_boundary(reader); }),
              0.3);
}

TEST(DamagedContactFiles, AreReadOrRefusedWithFileAndLine) {
    const Scene scene = read_geometry(shipped_deck("chain_pulled") / "in_gm.dat");
    const World fresh = build_world(scene);
    EXPECT_GT(refused(read_file(shipped_deck("chain_pulled") / "in_cf0.dat"),
                      [&](DeckReader& reader) {
                          World world = fresh;
                          read_back_tensions(reader, scene, world);
                      }),
              0.3);
    World bonded = fresh;
    bond_all(bonded, 0.0);
    std::ostringstream contacts;
    write_contacts(contacts, scene, bonded);
    EXPECT_GT(refused(contacts.str(),
                      [&](DeckReader& reader) {
                          World world = fresh;
                          read_contacts(reader, scene, world);
                      }),
              0.3);
}

}  // namespace
}  // namespace crackle
