// SPDX-License-Identifier: GPL-3.0-or-later
// A plain list of centres: one `x y` a line, blanks between, `#` begins a comment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle::tools {

struct CentreList {
    std::vector<Vec2> places;  ///< m
    std::vector<int> lines;    ///< on which each stands, from 1
};

/// True if the first line that holds anything holds two words; a deck begins with three.
bool looks_like_centre_list(std::string_view text);

/// @param name of the file, for messages. @throws InputError with file, line, what was found and expected.
CentreList parse_centre_list(const std::string& name, std::string_view text);

/// A whole word as a finite number; a Fortran exponent (d) is understood. @return false if it is none.
bool parse_number(std::string_view word, double& value);

}  // namespace crackle::tools
