// SPDX-License-Identifier: GPL-3.0-or-later
// In which directions a specimen cracked: of each broken bonded point the direction of its share of the face (square to
// the contact normal when it broke) with the length of that share (frames/crack_faces.hpp).
// Tested by tests/specimens/measures/crack_rose_test.cpp.
#pragma once

#include <cstddef>

#include "specimens/observers/contact_history.hpp"
#include "specimens/setup/setup.hpp"
#include "specimens/statistics/directions.hpp"

namespace crackle {

/// By the kind of break, up to the peak and after; lengths in m, degrees from the horizontal.
struct CrackRoses {
    Rose tension_to_peak, shear_to_peak, tension_after, shear_after;
};

/// @param time_of_peak s; not a number: all are counted as up to it. Cracks of a platen's bonds are left out.
CrackRoses find_crack_roses(const World& world, const TestSetup& setup, const ContactHistory& history,
                            double time_of_peak);

}  // namespace crackle
