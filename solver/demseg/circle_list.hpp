// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/commands/centre_list_test.cpp.
#pragma once

#include <string_view>

namespace crackle {

/// If a text is not a deck but lists circles or spheres, one per line, returns the format of the lines: "x y", "x y r"
/// or "x y z r" (radii > 0). Empty for any other text.
std::string_view circle_list_form(std::string_view text);

}  // namespace crackle
