// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz targets: one function per file reader, which receives arbitrary bytes. A reader must return or throw InputError.
// Any other exception, a crash, a hang, or more memory than a small input needs is a finding.
#pragma once

#include <string_view>

namespace crackle::fuzz {

/// Each target is in a file of its name in targets/, which describes the meaning of the bytes.
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
