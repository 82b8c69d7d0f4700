// SPDX-License-Identifier: GPL-3.0-or-later
// Which grain of a specimen is of which mineral: drawn by area, by size, from a file of labels or from an image.
// Tested by tests/specimens/making/minerals_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/case/test_case.hpp"

namespace crackle {

/// What was asked for of one mineral, and what its grains come to.
struct MineralShare {
    std::string name;
    std::optional<double> asked;  ///< of the area of all grains; none of labels or an image where the case is silent
    double reached = 0.0;         ///< of the area of all grains
    std::int64_t grains = 0;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("name", s.name);
        visit("asked", s.asked);
        visit("reached", s.reached);
        visit("grains", s.grains);
    }
};

/// Gives each body the material of its mineral: the index of the mineral in the case. All bodies are grains.
/// @param notices appended to: what may surprise
/// @return in the case's order
/// @throws InputError for labels or an image that do not fit, naming file and line or pixel
std::vector<MineralShare> assign_minerals(Scene& scene, const TestCase& test, std::vector<std::string>& notices);

/// One line for people: name, share reached and asked, grains.
std::string mineral_shares_text(const std::vector<MineralShare>& shares);

}  // namespace crackle
