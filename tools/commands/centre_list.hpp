// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of centres: `x y` a line, with blanks or commas between and `#` before a remark, or under a heading with x and
// y; and lists of circles, x y r or x y z r, whose radii are not used. A deck is none of these.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle::tools {

struct CentreList {
    std::vector<Vec2> places;  ///< m
    std::vector<int> lines;    ///< on which each stands, from 1
    std::string form;          ///< "x y", "x y r", "x y z r"
};

/// Whether a text is such a list, be it a wrong one; a deck begins with three numbers, and its lines differ in number.
bool looks_like_centre_list(std::string_view text);

/// @param name of the file, for messages. @throws InputError with file, line, what was found and expected; for spheres
/// that do not lie in one plane
CentreList parse_centre_list(const std::string& name, std::string_view text);

}  // namespace crackle::tools
