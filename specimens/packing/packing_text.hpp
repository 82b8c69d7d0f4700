// SPDX-License-Identifier: GPL-3.0-or-later
// A packing as one text, and back from it to the same bits: tests that start from the same circles pack them once.
// Tested by tests/specimens/packing/packing_text_test.cpp.
#pragma once

#include <optional>
#include <string>

#include "specimens/packing/packing.hpp"

namespace crackle {

/// What follows neither from the circles nor from the material, and the circles.
std::string packing_text(const Packing& packing);

/// @param material, threads  of the scene; the report's stresses follow from them
/// @return nothing if the text is not, byte for byte, one that packing_text() made
std::optional<Packing> packing_of_text(const std::string& text, const Material& material, int threads);

}  // namespace crackle
