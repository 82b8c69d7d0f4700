// SPDX-License-Identifier: GPL-3.0-or-later
// Reads lists of centres: `x y` on each line, separated by blanks or commas, with comments after `#`; or a table whose
// heading has columns x and y. Lists of circles (x y r, or x y z r) are read as well; their radii are ignored. A DEMseg
// deck is not such a list.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle::tools {

struct CentreList {
    std::vector<Vec2> places;  ///< m
    std::vector<int> lines;    ///< line number of each centre, starting at 1
    std::string form;          ///< "x y", "x y r", "x y z r"
};

/// Whether a text looks like a list of centres, even with errors. A deck is recognised by the three numbers at its
/// beginning, and because its number of values per line varies.
bool looks_like_centre_list(std::string_view text);

/// @param name name of the file, for messages @throws InputError with file and line, and what was found and expected;
/// also if spheres do not lie in one plane
CentreList parse_centre_list(const std::string& name, std::string_view text);

}  // namespace crackle::tools
