// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/commands/centre_list_test.cpp.
#pragma once

#include <string_view>

namespace crackle {

/// What a text is that lists circles or spheres, one a line, and is no deck: "x y", "x y r" or "x y z r", with radii
/// above 0. Empty for any other text.
std::string_view circle_list_form(std::string_view text);

}  // namespace crackle
