// SPDX-License-Identifier: GPL-3.0-or-later
// A program that links the libraries: makes a specimen, pulls it until it breaks, and prints what came out.
#include <algorithm>
#include <cstdio>

#include "solver/base/errors.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"

int main() try {
    const crackle::ResolvedCase pulled = crackle::read_case(crackle::CaseText{"pull", R"(
        [packing]
        count = 60
        radius_min = 0.01333   # m
        radius_max = 0.02667
        mean_overlap = 7.74e-5
        [material]
        density = 2500.0
        normal_stiffness = 1.0e7
        shear_stiffness = 2.5e6
        friction_angle = 27.0
        damping_ratio = 0.2
        [loading]
        kind = "tension"
        platens = "bonded"
        axial_strain_rate = 0.02
        max_axial_strain = 0.002
    )"});
    crackle::VirtualTest test = crackle::prepare_test(pulled);
    crackle::load_specimen(test);
    const auto peak = std::ranges::max_element(test.state.rows, {}, &crackle::CurveRow::axial_stress);
    std::printf("%zu bodies, %ld bonds, %ld broken; at most %.17g N/m at a strain of %.17g\n", test.world.bodies.size(),
                test.world.bonds.initial, test.world.bonds.broken, peak->axial_stress, peak->axial_strain);
} catch (const crackle::InputError& error) {
    std::fprintf(stderr, "pull: %s\n", error.what());
    return 2;
}
