// SPDX-License-Identifier: GPL-3.0-or-later
// A rock of 100 circles with known keys, whose tests take a few hundredths of a second, and files for its calibration.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "tests/support/small_plan.hpp"

namespace crackle::testing {

/// Writes compression.toml and tension.toml with coulomb bonds. @param ratio cohesion over tensile strength; if it is
/// high and there are few circles, all breaks are in tension and strengths do not depend on it
inline void write_circles_rock(const std::filesystem::path& folder, double modulus = 20e9, double stiffness_ratio = 2.5,
                               double tensile = 10e6, double ratio = 2.0, int circles = 100) {
    for (const auto& [kind, strain] : {std::pair("compression", 0.03), std::pair("tension", 0.008)})
        write_text(folder / (std::string(kind) + ".toml"),
                   fmt::format("[packing]\ncount = {}\nradius_min = 1.0e-3\nradius_max = 1.66e-3\n"
                               "mean_overlap = 2.0e-6\n[material]\ndensity = 2600.0\nunits = \"area\"\n"
                               "contact_modulus = {}\nstiffness_ratio = {}\nfriction_angle = 30.0\n"
                               "residual_friction_angle = 20.0\ntensile_strength = {}\ncohesion = {}\n"
                               "damping_ratio = 0.2\n[bond]\nlaw = \"coulomb\"\nrange = 0.1\n"
                               "strength_distribution = \"weibull\"\nstrength_cv = 0.3\nstrength_seed = 1\n"
                               "[loading]\nkind = \"{}\"\nmax_axial_strain = {}\n",
                               circles, modulus, stiffness_ratio, tensile, ratio * tensile, kind, strain));
}

inline std::string target_text(const std::string& test, const std::string& figure, double value,
                               const std::string& more = "") {
    return fmt::format("[[target]]\ntest = \"{}\"\nfigure = \"{}\"\nvalue = {:.10g}\n{}\n", test, figure, value, more);
}

inline const char* const circles_tests = "[[test]]\ncase = \"compression.toml\"\n[[test]]\ncase = \"tension.toml\"\n";
/// TOML for the compression test under two further pressures.
inline const char* const pressed_tests =
    "[[test]]\nname = \"pressed\"\ncase = \"compression.toml\"\n"
    "set = {\"loading.kind\" = \"biaxial\", \"confinement.pressure\" = 1e6}\n"
    "[[test]]\nname = \"squeezed\"\ncase = \"compression.toml\"\n"
    "set = {\"loading.kind\" = \"biaxial\", \"confinement.pressure\" = 3e6}\n";
/// TOML for a target of a law fitted to these tests and the compression.
inline std::string law_target_text(const std::string& figure, double value,
                                   const std::string& tests = "[\"compression\", \"pressed\", \"squeezed\"]") {
    return fmt::format("[[target]]\ntests = {}\nfigure = \"{}\"\nvalue = {:.10g}\n", tests, figure, value);
}

inline const char* const elastic_keys =
    "[[free]]\nkey = \"material.contact_modulus\"\nfrom = 2e9\nto = 200e9\n"
    "[[free]]\nkey = \"material.stiffness_ratio\"\nfrom = 1\nto = 10\n";
inline const char* const strength_keys =
    "[[free]]\nkey = \"material.tensile_strength\"\nfrom = 1e6\nto = 100e6\n"
    "[[free]]\nkey = \"material.cohesion\"\nof = \"material.tensile_strength\"\nfrom = 0.6\nto = 6\n";

}  // namespace crackle::testing
