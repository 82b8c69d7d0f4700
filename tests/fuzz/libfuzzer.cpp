// SPDX-License-Identifier: GPL-3.0-or-later
// What libFuzzer calls: CRACKLE_FUZZ_TARGET with each input.

#include <cstddef>
#include <cstdint>

#include "solver/base/errors.hpp"
#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        crackle::fuzz::CRACKLE_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
    } catch (const crackle::InputError&) {  // anything else ends the process: a find
    }
    return 0;
}
