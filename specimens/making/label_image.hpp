// SPDX-License-Identifier: GPL-3.0-or-later
// A PNG image whose colours are labels, laid over a box: its lowest row of pixels along y1, its left column along x1.
// Tested by tests/specimens/making/minerals_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"

namespace crackle {

class LabelImage {
  public:
    /// @param colours 0xrrggbb of each label
    /// @param names of the labels, for errors
    /// @param where begins the text of an error: «file:line: key»
    /// @throws InputError unless every pixel is opaque and of one of the colours
    LabelImage(const std::filesystem::path& file, std::span<const std::uint32_t> colours,
               std::span<const std::string> names, const std::string& where);

    int width() const { return width_; }    ///< pixels
    int height() const { return height_; }  ///< pixels

    /// Label of most of the pixels whose centres lie in the body, of several equal ones the first; of a body between
    /// the centres that of the pixel at its centroid.
    std::size_t label_of(const Scene& scene, const Body& body) const;

  private:
    std::uint16_t at(int column, int row) const;

    int width_ = 0, height_ = 0;
    std::size_t labels_ = 0;
    std::vector<std::uint16_t> pixels_;  ///< label, row by row from the top
};

}  // namespace crackle
