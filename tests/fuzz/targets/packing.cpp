// SPDX-License-Identifier: GPL-3.0-or-later
// A packing kept by a campaign. The hash in its first line is corrected.

#include <fmt/format.h>
#include <xxhash.h>

#include "specimens/packing/packing_text.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::packing(std::string_view bytes) {
    Material material;
    material.density = 2500.0;
    material.normal_stiffness = 1e7;
    material.shear_stiffness = 2.5e6;
    material.friction_angle = 27.0;
    packing_of_text(fmt::format("crackle packing {:016x}\n{}", XXH3_64bits(bytes.data(), bytes.size()), bytes),
                    material, 1);
}
