// SPDX-License-Identifier: GPL-3.0-or-later
// SHA-256 (FIPS 180-4): names the inputs of a test so that `sha256sum` can check them, and guards checkpoints.
#pragma once

#include <string>
#include <string_view>

namespace crackle {

/// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace crackle
