// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a packing to text and back without loss, so that tests with the same circles can share one packing.
// Tested by tests/specimens/packing/packing_text_test.cpp.
#pragma once

#include <optional>
#include <string>

#include "specimens/packing/packing.hpp"

namespace crackle {

/// Text with the circles, and with the parts of the report that follow neither from the circles nor from the
/// material.
std::string packing_text(const Packing& packing);

/// Restores a packing.
/// @param material, threads  as in PackingRequest; the stresses in the report follow from the material
/// @return empty if the text is not, byte for byte, an output of packing_text()
std::optional<Packing> packing_of_text(const std::string& text, const Material& material, int threads);

}  // namespace crackle
