// SPDX-License-Identifier: GPL-3.0-or-later
// Called by libFuzzer: passes each input to the target CRACKLE_FUZZ_TARGET.

#include <cstddef>
#include <cstdint>

#include "solver/base/errors.hpp"
#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        crackle::fuzz::CRACKLE_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
    } catch (const crackle::InputError&) {  // any other exception ends the process and counts as a finding
    }
    return 0;
}
