// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/unlikely_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace crackle {
namespace {

// Rocks fail at strains near 1e-3, the softest soils at 0.1. Values far outside this range are probably in another
// unit.
constexpr double least_strength_over_modulus = 1e-6, least_modulus = 1e5;  // Pa
// Grains as stiff as rock are rarely larger than this; the blocks of a rock mass are, but they are separated by joints.
constexpr double stiff_as_rock = 1e9, largest_grain = 0.1;  // Pa, m
// The smallest density is that of aerogel. For bonds in rock, the cohesion is 1 to 10 times the tensile strength.
constexpr double least_density = 100.0, largest_cohesion_over_tension = 15.0;  // kg/m2, -
constexpr double degrees_a_radian = 180.0 / std::numbers::pi;

class Look {
  public:
    Look(const ResolvedCase& test, std::vector<std::string>& notices) : test_(test), notices_(notices) {}

    void at(const std::string& name, const parts::MaterialValues& m) const {
        const auto notice = [&](const char* key, double value, const char* unit, const std::string& why) {
            const std::string found = fmt::format(".{} = {:g}{} {}", key, value, unit, why);
            // A value that a mineral does not set itself comes from [material] and is reported there.
            if (std::ranges::find(notices_, "material" + found) == notices_.end()) notices_.push_back(name + found);
        };
        if (const std::optional<double> modulus = m.normal_stiffness; modulus && test_.area_units()) {
            if (*modulus < least_modulus)
                notice("contact_modulus", *modulus, " Pa",
                       "is softer than any rock or soil: is it meant in GPa? Values must be in Pa");
            else if (m.tensile_strength && *m.tensile_strength < least_strength_over_modulus * *modulus)
                notice("tensile_strength", *m.tensile_strength, " Pa",
                       fmt::format("is only {:.1g} of the contact modulus: is it meant in MPa? Values must be in Pa",
                                   *m.tensile_strength / *modulus));
        }
        if (m.friction_angle && *m.friction_angle == 0.0)
            notice(
                "friction_angle", 0.0, " degrees",
                "lets broken faces slide freely, and pressure does not strengthen bonds; rocks have 20 to 45 degrees");
        for (const auto& [key, angle] : {std::pair("friction_angle", m.friction_angle),
                                         std::pair("residual_friction_angle", m.residual_friction_angle)})
            if (angle && *angle > 0.0 && *angle <= std::numbers::pi / 2.0)
                notice(key, *angle, " degrees",
                       fmt::format("is almost zero: is it meant in radians? That would be {:.3g} degrees",
                                   *angle * degrees_a_radian));
        if (m.density && *m.density < least_density)
            notice("density", *m.density, " kg/m2",
                   fmt::format("is lighter than any rock: is it meant in g/cm3? That would be {:g} kg/m2",
                               1e3 * *m.density));
        if (m.cohesion && m.tensile_strength && *m.cohesion > largest_cohesion_over_tension * *m.tensile_strength)
            notice("cohesion", *m.cohesion, test_.area_units() ? " Pa" : " N",
                   fmt::format("is {:.3g} times the tensile strength, while 1 to 10 is usual for rocks; is one of them "
                               "in another unit?",
                               *m.cohesion / *m.tensile_strength));
    }

    void at_size(const TestedSpecimen& specimen) const {
        const double grain = std::sqrt(specimen.area / static_cast<double>(specimen.particles));
        const double stiffness = test_.material.normal_stiffness.value_or(0.0);
        if (!test_.area_units() || !test_.joints.empty() || stiffness < stiff_as_rock || grain < largest_grain) return;
        notices_.push_back(
            fmt::format("the specimen is {:.3g} m by {:.3g} m, with grains of {:.2g} m that are as stiff as rock: are "
                        "its lengths given in mm? Values must be in m",
                        specimen.width, specimen.height, grain));
    }

  private:
    const ResolvedCase& test_;
    std::vector<std::string>& notices_;
};

}  // namespace

std::vector<std::string> unlikely_numbers(const ResolvedCase& test, const TestedSpecimen& specimen) {
    std::vector<std::string> notices;
    const Look look(test, notices);
    look.at("material", test.material);
    for (std::size_t k = 0; k < test.minerals.list.size(); ++k)
        look.at(fmt::format("mineral[{}]", k + 1), test.minerals.list[k].material);
    look.at_size(specimen);
    return notices;
}

}  // namespace crackle
