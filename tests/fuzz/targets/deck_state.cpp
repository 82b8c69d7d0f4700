// SPDX-License-Identifier: GPL-3.0-or-later
// new_state.bin of a continued deck. Its hashes are corrected, so that the code behind them is reached.

#include "solver/demseg/deck_state.hpp"

#include <xxhash.h>

#include "solver/demseg/deck_run.hpp"
#include "solver/files/read_file.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

namespace crackle::fuzz {
namespace {

namespace fs = std::filesystem;

/// A deck run after one step.
fs::path make_deck() {
    const fs::path folder = scratch() / "deck", shipped = fs::path(CRACKLE_SOURCE_DIR) / "specimens/demseg/triangle";
    fs::create_directories(folder);
    for (const char* name : {"in_gm.dat", "in_bc.dat"}) fs::copy_file(shipped / name, folder / name);
    DeckOptions options;
    options.folder = folder;
    options.steps = 1;
    DeckRun(options).run();
    return folder;
}

constexpr std::size_t hashes_at = 16;  // after magic number and version

}  // namespace

void deck_state(std::string_view bytes) {
    static const fs::path folder = make_deck();
    std::string state(bytes);
    for (std::size_t k = 0; k < deck_text_names.size() && state.size() >= hashes_at + 8 * (k + 1); ++k) {
        const std::string text = read_file(folder / (std::string("new_") + deck_text_names[k]));
        const XXH64_hash_t hash = XXH3_64bits(text.data(), text.size());
        std::memcpy(state.data() + hashes_at + 8 * k, &hash, sizeof hash);
    }
    mend_world(state, state.size());
    write_file("deck/new_state.bin", state);
    DeckOptions options;
    options.folder = folder;
    options.goes_on = true;
    const DeckRun run(options);
}

}  // namespace crackle::fuzz
