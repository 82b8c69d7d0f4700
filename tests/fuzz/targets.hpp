// SPDX-License-Identifier: GPL-3.0-or-later
// What is fuzzed: a function for each reader of files, which gives it any bytes. A reader returns or throws InputError;
// any other exception, a crash, a hang and memory that a small input does not need are finds.
#pragma once

#include <string_view>

namespace crackle::fuzz {

/// Each in a file of its name in targets/, which says what the bytes are.
#define CRACKLE_FUZZ_TARGETS(USE) \
    USE(deck_geometry)            \
    USE(deck_boundary)            \
    USE(deck_contacts)            \
    USE(deck_state)               \
    USE(deck_outputs)             \
    USE(case_file)                \
    USE(plan)                     \
    USE(rock)                     \
    USE(ledger)                   \
    USE(packing)                  \
    USE(checkpoint)               \
    USE(frame)                    \
    USE(recording)                \
    USE(results)                  \
    USE(centres)                  \
    USE(sieve)                    \
    USE(labels)                   \
    USE(image)                    \
    USE(traces)                   \
    USE(journal)

#define CRACKLE_FUZZ_DECLARE(name) void name(std::string_view bytes);
CRACKLE_FUZZ_TARGETS(CRACKLE_FUZZ_DECLARE)
#undef CRACKLE_FUZZ_DECLARE

}  // namespace crackle::fuzz
