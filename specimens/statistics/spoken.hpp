// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as sentences have them: "1 packing", "17.9 GPa".
// Tested by tests/specimens/statistics/spoken_test.cpp.
#pragma once

#include <cstdint>
#include <string>

namespace crackle {

/// "1 packing", "2 packings". @param noun whose plural ends in s
std::string counted(std::int64_t count, const char* noun);
std::string counted(std::size_t count, const char* noun);

/// A value below a bound, with as many digits, three or more, as it takes to see that: "19.97" below 20.
std::string spoken_below(double value, double bound);

/// Pa by its prefix, "17.9 GPa"; any other unit as it is, "5.1e+06 N/m".
std::string spoken_stress(double value, const std::string& unit, int digits = 4);

}  // namespace crackle
