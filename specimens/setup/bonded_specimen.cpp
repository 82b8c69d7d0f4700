// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/bonded_specimen.hpp"

#include <fmt/format.h>

#include <utility>

#include "solver/base/errors.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/stepping/time_step.hpp"

namespace crackle {
namespace {

// Circles bond at the overlaps they have whatever the thickness; this one keeps platens thin beside the particles.
constexpr double circle_thick_share = 0.1;  // of the mean radius

/// The case's step, known to be stable only now that there are bonds.
void apply_given_step(World& world, const TestCase& test) {
    if (!test.numerics.time_step) return;
    try {
        set_time_step(world, *test.numerics.time_step);
    } catch (const UnstableRun&) {
        throw InputError(fmt::format(
            "{}: found {} s, expected at most the exact stable step of this specimen, {:.6g} s; give a smaller one, "
            "leave it out to have it derived, or run with --allow-unstable to see the limit",
            test.at("numerics.time_step"), *test.numerics.time_step, world.stepping.exact_step));
    }
}

}  // namespace

BondedSpecimen bond_specimen(const Specimen& specimen, const TestCase& test, const TestCase::Loading& loading) {
    Scene scene = specimen.scene;
    scene.thick = test.bond.thick ? *test.bond.thick : circle_thick_share * specimen.mean_radius;
    scene.segment_law = segment_law_named("numerics.contact_law", test.numerics.contact_law);
    scene.integrator = integrator_named("numerics.integrator", test.numerics.integrator);
    scene.time_step = 0.0;  // a particle file's own is of its packing
    scene.safety_factor = test.numerics.safety_factor;
    scene.step_scale = test.step_scale;
    scene.allow_unstable = test.numerics.allow_unstable;
    scene.first_kick = FirstKick::half;
    scene.threads = static_cast<int>(test.numerics.threads);
    scene.intact = {test.numerics.intact, test.numerics.intact, test.numerics.intact};
    BondedSpecimen bonded;
    bonded.platens = add_platens(scene, specimen, loading, scene.thick);
    const double thick = scene.thick;
    bonded.world = build_world(std::move(scene));
    forget_point_forces(bonded.world);  // platens give the stress, the curve's rows the energy of springs
    bond_all(bonded.world, thick);
    apply_given_step(bonded.world, test);
    place_platens(bonded.world, bonded.platens);
    compute_forces(bonded.world);
    return bonded;
}

}  // namespace crackle
