// SPDX-License-Identifier: GPL-3.0-or-later
// Directions of the cracks in a specimen. Each broken bonded point contributes the part of the face that belongs to it
// (frames/crack_faces.hpp). The direction of this part is perpendicular to the contact normal at breakage; its weight
// is its length.
// Tested by tests/specimens/measures/crack_rose_test.cpp.
#pragma once

#include <cstddef>

#include "specimens/observers/contact_history.hpp"
#include "specimens/setup/setup.hpp"
#include "specimens/statistics/directions.hpp"

namespace crackle {

/// Rose diagrams by failure mode, up to the peak and after it; lengths in m, angles in degrees from the horizontal.
struct CrackRoses {
    Rose tension_to_peak, shear_to_peak, tension_after, shear_after;
};

/// Determines the rose diagrams of all broken bonds except bonds to platens.
/// @param time_of_peak  s; if NaN, all cracks count as formed up to the peak
CrackRoses find_crack_roses(const World& world, const TestSetup& setup, const ContactHistory& history,
                            double time_of_peak);

}  // namespace crackle
