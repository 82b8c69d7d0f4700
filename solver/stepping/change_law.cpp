// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/stepping/change_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "solver/contact/joint_law.hpp"
#include "solver/stepping/time_step.hpp"

namespace crackle {
namespace {

constexpr double right_angle = 90.0;  // degrees

double tangent(double degrees) { return correctly_rounded::tan(degrees * std::numbers::pi / 180.0); }

/// A stiffness with the term of its damping ratio, which goes by its root.
void stiffen(double& stiffness, double& ratio_term, double value) {
    ratio_term = stiffness > 0.0 ? ratio_term * std::sqrt(value / stiffness) : 0.0;
    stiffness = value;
}

/// The law with the number changed; of a pair whose bonds cannot break strengths stay infinite.
void enter(const Settings& settings, ContactLaw& law, const std::string& name, double value, bool held) {
    if (name == "normal_stiffness") stiffen(law.normal_stiffness, law.normal_damping_ratio_term, value);
    if (name == "shear_stiffness") stiffen(law.shear_stiffness, law.shear_damping_ratio_term, value);
    if (held || settings.intact.no_sliding) return;
    const bool coulomb = settings.bond_law == BondLaw::coulomb;
    if (name == "friction_angle") (coulomb ? law.bond_friction : law.friction) = tangent(value);
    if (name == "residual_friction_angle") law.friction = tangent(value);
    if (settings.intact.no_breaking) return;
    if (name == "tensile_strength") law.tensile_strength = value;
    if (name == "cohesion") law.cohesion = value;
}

void check(const Settings& settings, const std::string& name, double value) {
    const auto& keys = law_keys();
    if (std::ranges::none_of(keys, [&](const LawKey& key) { return name == key.name; })) {
        std::string known;
        for (const LawKey& key : keys) known += std::string(known.empty() ? "" : ", ") + key.name;
        throw InputError(fmt::format("property: found '{:.40}', expected one of {}", name, known));
    }
    const bool angle = name.ends_with("angle"), positive = name == "normal_stiffness";
    if (!is_a_size(value) || value < 0.0 || (positive && value == 0.0) || (angle && value >= right_angle)) {
        throw InputError(fmt::format("{}: found {}, expected a number {} 0{}", name, value,
                                     positive ? ">" : ">=", angle ? " and < 90, in degrees" : ""));
    }
    const bool coulomb_only = name == "tensile_strength" || name == "cohesion" || name == "residual_friction_angle";
    if (coulomb_only && settings.bond_law != BondLaw::coulomb) {
        throw InputError(
            fmt::format("{}: found it under back-tension, expected bond.law = \"coulomb\"; a back-tension bond is as "
                        "strong as its stiffness times its overlap",
                        name));
    }
}

}  // namespace

const std::vector<LawKey>& law_keys() {
    static const std::vector<LawKey> all{{"normal_stiffness", "N/m"},   {"shear_stiffness", "N/m"},
                                         {"friction_angle", "degrees"}, {"residual_friction_angle", "degrees"},
                                         {"tensile_strength", "N"},     {"cohesion", "N"}};
    return all;
}

void change_law(World& world, std::size_t a, std::size_t b, const std::string& name, double value) {
    Settings& settings = world.settings;
    check(settings, name, value);
    const std::size_t materials = settings.materials.size();
    if (a >= materials || b >= materials)
        throw InputError(fmt::format("{}: found materials {} and {}, expected 1 to {}", name, a + 1, b + 1, materials));
    const std::size_t pair = pair_number(a, b);
    if (name == "shear_stiffness" && value == 0.0 && settings.laws[pair].shear_damping_ratio_term > 0.0) {
        throw InputError(fmt::format(
            "{}: found 0, expected > 0 where contacts have a damping ratio: nothing would be left to keep it by",
            name));
    }
    ContactLaw changed = settings.laws[pair];
    enter(settings, changed, name, value, false);
    constexpr double rounding = 1e-12;
    if (changed.bond_friction * changed.tensile_strength > changed.cohesion * (1.0 + rounding)) {
        throw InputError(fmt::format(
            "{}: found {}, which puts the tensile strength {:.6g} beyond the apex of the envelope, cohesion over "
            "friction, {:.6g}; give more cohesion first, or less",
            name, value, changed.tensile_strength, changed.cohesion / changed.bond_friction));
    }
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
