// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solver/base/errors.hpp"

namespace crackle {

void refuse_name(const std::string& where, const std::string& found, const std::vector<std::string>& expected) {
    throw InputError(fmt::format("{}: found \"{}\", expected \"{}\" or \"{}\"", where, found,
                                 fmt::join(expected.begin(), expected.end() - 1, "\", \""), expected.back()));
}

}  // namespace crackle
