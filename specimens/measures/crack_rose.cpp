// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/crack_rose.hpp"

#include <numbers>

#include "specimens/frames/crack_faces.hpp"

namespace crackle {

CrackRoses find_crack_roses(const World& world, const TestSetup& setup, const ContactHistory& history,
                            double time_of_peak) {
    CrackRoses roses;
    for (const Crack& crack : history.cracks) {
        const ContactPoint point = setup.bonds.points[crack.bond];
        if (setup.apparatus.is_platen(point.body_i) || setup.apparatus.is_platen(point.body_j)) continue;
        const bool after = crack.time > time_of_peak;
        Rose& rose = crack.shear_mode ? (after ? roses.shear_after : roses.shear_to_peak)
                                      : (after ? roses.tension_after : roses.tension_to_peak);
        rose.add(crack.orientation + 0.5 * std::numbers::pi, length_of_face(world, setup, crack.bond));
    }
    return roses;
}

}  // namespace crackle
