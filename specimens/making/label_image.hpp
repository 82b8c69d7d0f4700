// SPDX-License-Identifier: GPL-3.0-or-later
// A PNG image whose colours are labels. It covers the domain: the bottom row of pixels is at y1, the left column at x1.
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
    /// Reads an image. @param colours  0xrrggbb of each label
    /// @param names  names of the labels, for error messages
    /// @param where  start of the error message: «file:line: key»
    /// @throws InputError unless every pixel is opaque and has one of the colours
    LabelImage(const std::filesystem::path& file, std::span<const std::uint32_t> colours,
               std::span<const std::string> names, const std::string& where);

    int width() const { return width_; }    ///< number of pixels
    int height() const { return height_; }  ///< number of pixels

    /// Most frequent label among the pixels whose centres lie in a body; in a tie, the label that comes first. A body
    /// without pixel centres has the label of the pixel at its centroid.
    std::size_t label_of(const Scene& scene, const Body& body) const;

  private:
    std::uint16_t at(int column, int row) const;

    int width_ = 0, height_ = 0;
    std::size_t labels_ = 0;
    std::vector<std::uint16_t> pixels_;  ///< labels, row by row from the top
};

}  // namespace crackle
