// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers formatted for sentences: "1 packing", "17.9 GPa".
// Tested by tests/specimens/statistics/spoken_test.cpp.
#pragma once

#include <cstdint>
#include <string>

namespace crackle {

/// A count with its noun: "1 packing", "2 packings". @param noun  singular of a noun whose plural ends in s
std::string counted(std::int64_t count, const char* noun);
/// A count with its noun, for a count that is the size of a container.
std::string counted(std::size_t count, const char* noun);

/// A value below a bound, with three digits, or more if they are needed to show that it is below the bound: "19.97" for
/// 20.
std::string spoken_below(double value, double bound);

/// A unit and its size in SI units.
struct SpokenUnit {
    double factor;
    std::string name;
};

/// Pa with the SI prefix that suits a value: {1e9, "GPa"}; any other unit without a prefix. @param digits that are
/// printed
SpokenUnit spoken_unit(double value, const std::string& unit, int digits = 4);

/// A stress in Pa with an SI prefix, "17.9 GPa"; in any other unit without a prefix, "5.1e+06 N/m".
std::string spoken_stress(double value, const std::string& unit, int digits = 4);

}  // namespace crackle
