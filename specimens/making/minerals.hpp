// SPDX-License-Identifier: GPL-3.0-or-later
// Assigns minerals to the grains of a specimen: at random by area, by size, from a label file or from an image.
// Tested by tests/specimens/making/minerals_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/scene/scene.hpp"
#include "specimens/parts/rock.hpp"
#include "specimens/places/places.hpp"

namespace crackle {

/// Requested and actual area fraction of one mineral.
struct MineralShare {
    std::string name;
    /// Requested fraction of the total grain area; empty if the case states no fraction, as with labels or an image.
    std::optional<double> asked;
    double reached = 0.0;  ///< actual fraction of the total grain area
    std::int64_t grains = 0;

    CRACKLE_FIELDS(name, asked, reached, grains);
};

/// Assigns a mineral to each body: the body's material becomes the mineral's index. All bodies are grains.
/// @param notices  list to which remarks on unexpected results are appended
/// @return area fractions of the minerals, in the order of the list
/// @throws InputError if labels or an image do not fit; the message names file and line or pixel
std::vector<MineralShare> assign_minerals(Scene& scene, const parts::Minerals& asked, const Places& places,
                                          std::vector<std::string>& notices);

/// One-line summary: name, actual and requested area fraction, number of grains.
std::string mineral_shares_text(const std::vector<MineralShare>& shares);

}  // namespace crackle
