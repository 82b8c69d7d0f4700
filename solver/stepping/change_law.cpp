// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/stepping/change_law.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/contact/joint_law.hpp"
#include "solver/stepping/time_step.hpp"

namespace crackle {
namespace {

constexpr double right_angle = 90.0;  // degrees

/// Sets a stiffness and scales the corresponding damping ratio term with its square root.
void stiffen(double& stiffness, double& ratio_term, double value) {
    ratio_term = stiffness > 0.0 ? ratio_term * std::sqrt(value / stiffness) : 0.0;
    stiffness = value;
}

/// Sets a property in one law. @param held whether the law's bonds are unbreakable; their strengths then stay infinite
void enter(const Settings& settings, ContactLaw& law, const std::string& name, double value, bool held) {
    if (name == "normal_stiffness") stiffen(law.normal_stiffness, law.normal_damping_ratio_term, value);
    if (name == "shear_stiffness") stiffen(law.shear_stiffness, law.shear_damping_ratio_term, value);
    if (held || settings.intact.no_sliding) return;
    const BondLawFacts& bonds = facts_of(settings.bond_law);
    if (name == "friction_angle") law.*bonds.friction = friction_coefficient(value);
    const BondConstant* constant = bonds.constant(name);
    if (constant == nullptr || (settings.intact.no_breaking && !constant->is_angle)) return;
    law.*constant->of_law = constant->in_law(value);
}

void check(const Settings& settings, const std::string& name, double value) {
    std::vector<std::string> known{"normal_stiffness", "shear_stiffness", "friction_angle"};
    for (const BondConstant& constant : all_bond_constants()) {
        known.emplace_back(constant.key);
        if (name == constant.key && facts_of(settings.bond_law).constant(name) == nullptr)
            throw InputError(fmt::format("{}: found it with bond.law = \"{}\", expected bond.law = {}", name,
                                         name_of(settings.bond_law), laws_with(&BondLawFacts::strengths_are_given)));
    }
    if (std::ranges::count(known, name) == 0)
        throw InputError(fmt::format("property: found '{:.40}', expected one of {}", name, fmt::join(known, ", ")));
    const bool angle = name.ends_with("angle"), positive = name == "normal_stiffness";
    if (!is_a_size(value) || value < 0.0 || (positive && value == 0.0) || (angle && value >= right_angle)) {
        throw InputError(fmt::format("{}: found {}, expected a number {} 0{}", name, value,
                                     positive ? ">" : ">=", angle ? " and < 90, in degrees" : ""));
    }
}

}  // namespace

void change_law(World& world, std::size_t a, std::size_t b, const std::string& name, double value) {
    Settings& settings = world.settings;
    check(settings, name, value);
    const std::size_t materials = settings.materials.size();
    if (a >= materials || b >= materials)
        throw InputError(fmt::format("{}: found materials {} and {}, expected 1 to {}", name, a + 1, b + 1, materials));
    const std::size_t pair = pair_number(a, b);
    if (name == "shear_stiffness" && value == 0.0 && settings.laws[pair].shear_damping_ratio_term > 0.0) {
        throw InputError(fmt::format(
            "{}: found 0, expected a number > 0, since the damping ratio of the contacts is undefined for 0", name));
    }
    ContactLaw changed = settings.laws[pair];
    enter(settings, changed, name, value, false);
    check_strengths(changed, name);
    settings.laws[pair] = changed;
    enter(settings, settings.laws[settings.pair_count() + pair], name, value, true);
    if (a == b) enter(settings, settings.laws[2 * settings.pair_count() + a], name, value, false);
    derive_joint_laws(settings);
    restart_account(world);
    velocities_changed(world);
    if (name.ends_with("stiffness")) {
        if (world.bonds.made) find_exact_step(world);
        evaluate_step_bound(world);
    }
}

}  // namespace crackle
