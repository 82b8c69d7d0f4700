// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/bonded_specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/time_step.hpp"
#include "specimens/setup/face_bonds.hpp"

namespace crackle {
namespace {

// Circles bond at their overlaps, whatever the segment thickness, which here affects only platens.
constexpr double circle_thick_share = 0.1;  // thickness relative to the mean radius

/// Applies the case's time step. Its stability can be checked only once there are bonds.
void apply_given_step(World& world, const parts::Procedure& test) {
    if (!test.numerics.time_step) return;
    try {
        set_time_step(world, *test.numerics.time_step);
    } catch (const UnstableRun&) {
        throw InputError(fmt::format(
            "{}: found {} s, expected at most the exact stable step of this specimen, {:.6g} s; give a smaller "
            "time step, omit it for an automatic step, or run with --allow-unstable to find the limit",
            test.at(CaseKey::numerics_time_step), *test.numerics.time_step, world.stepping.exact_step));
    }
}

/// Allowance for the overhang of mesh corners after the inset, relative to the thickness. The overhang is about 0.01,
/// and rarely exceeds the allowance.
constexpr double overhang_share = 0.05;

Bonding bonding_of(const Specimen& specimen, const parts::Bonds& bonds, double thick) {
    Bonding bonding;
    bonding.thick = thick;
    if (!bonds.facts().bonds_across_gaps) return bonding;
    if (specimen.polygons) bonding.gap = bonds.gap.value_or(overhang_share * thick);
    // Pairs of circles use `range`; this gap applies between circles and the parts that hold them.
    if (!specimen.polygons && !specimen.shape.outline.empty()) bonding.gap = cut_circles_offset * specimen.particle;
    bonding.range = bonds.range;
    bonding.tensile_factor = bonds.tensile_factor;
    bonding.cohesion_factor = bonds.cohesion_factor;
    if (const auto& random = bonds.random)
        bonding.factors = StrengthFactors(random->distribution, random->cv, random->seed);
    return bonding;
}

/// Returns a predicate that is true for pairs of bodies on opposite sides of the notch, which are not bonded.
std::function<bool(BodyIndex, BodyIndex)> parted_by(const World& world, const Notch& notch) {
    return [&world, notch](BodyIndex i, BodyIndex j) {
        const BodyState &a = world.bodies.state[i], &b = world.bodies.state[j];
        return notch.parts({a.x, a.y}, {b.x, b.y});
    };
}

/// Returns a predicate that is true for bonds to a glued platen and for bonds in a grip, which never break.
/// @param grip  depth of the layer held at either end, relative to the height of the specimen
std::function<bool(Vec2, BodyIndex, BodyIndex)> grips_of(const World& world, const Specimen& specimen,
                                                         const Platens& platens, double grip) {
    const Domain& domain = specimen.scene.domain;
    const double depth = grip * specimen.height;
    return [=, &world](Vec2 position, BodyIndex i, BodyIndex j) {
        const auto is_platen = [&](BodyIndex b) {
            const int id = world.bodies.info(b).id;
            return id >= platens.bottom_id && id <= platens.top_id;
        };
        return is_platen(i) || is_platen(j) || position.y < domain.y1 + depth || position.y > domain.y2 - depth;
    };
}

/// Checks that bond.thick is large enough for the gap stated in a particle file with polygons.
void check_thick(const Specimen& specimen, const parts::Bonds& bonds, const Places& places) {
    if (!specimen.polygons || specimen.centres > 0) return;
    const bool across_gaps = bonds.facts().bonds_across_gaps;
    if (across_gaps ? bonds.thick && *bonds.thick < specimen.mesh_gap
                    : !bonds.thick || *bonds.thick <= specimen.mesh_gap) {
        throw InputError(
            fmt::format("{}: found {}, expected {} the particle file's thick = {} m; the excess is the "
                        "overlap that bonds the polygons",
                        places.at(CaseKey::bond_thick), bonds.thick ? fmt::format("{} m", *bonds.thick) : "nothing",
                        across_gaps ? "at least" : "more than", specimen.mesh_gap));
    }
}

/// The scene that will be bonded, without platens.
Scene scene_of(const Specimen& specimen, const parts::Bonds& bonds, const parts::Procedure& test) {
    check_thick(specimen, bonds, test.places);
    Scene scene = specimen.scene;
    scene.thick = bonds.thick         ? *bonds.thick
                  : specimen.polygons ? specimen.mesh_gap
                                      : circle_thick_share * specimen.mean_radius;
    scene.bond_law = bonds.law;
    scene.segment_law = test.numerics.contact_law;
    scene.integrator = test.numerics.integrator;
    scene.time_step = 0.0;  // the time step in a particle file was chosen for packing
    scene.safety_factor = test.numerics.safety_factor;
    scene.step_scale = test.step_scale;
    scene.allow_unstable = test.numerics.allow_unstable;
    scene.first_kick = FirstKick::half;
    scene.threads = test.numerics.threads;
    scene.intact = {test.numerics.intact, test.numerics.intact, test.numerics.intact};
    return scene;
}

void bond(World& world, const Places& places, const Bonding& bonding) {
    try {
        bond_all(world, bonding);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", places.at(CaseKey::bond_law), error.what()));
    }
}

void bond_faces_of(World& world, const Places& places, const FaceBonding& faces) {
    try {
        bond_by_faces(world, faces);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", places.at(CaseKey::bond_law), error.what()));
    }
}

}  // namespace

BondedSpecimen bond_specimen(const Specimen& specimen, const parts::Bonds& bonds, const parts::Procedure& test,
                             std::function<void()> while_solving) {
    Scene scene = scene_of(specimen, bonds, test);
    BondedSpecimen bonded;
    bonded.platens = add_platens(scene, specimen, test, scene.thick);
    const double thick = scene.thick;
    bonded.world = build_world(std::move(scene));
    bonded.world.workers.while_solving = std::move(while_solving);
    forget_point_forces(bonded.world);  // not needed: stress comes from platens, and curve rows compute spring energy
    Bonding bonding = bonding_of(specimen, bonds, thick);
    const TestKind& kind = test_kind(test.loading.kind);
    bonding.pressed = kind.compression || kind.shear_box;
    if (test.loading.platens == PlatenKind::glued)
        bonding.holds = grips_of(bonded.world, specimen, bonded.platens, test.loading.grip);
    if (specimen.shape.notch && specimen.polygons) bonding.leaves = parted_by(bonded.world, *specimen.shape.notch);
    if (bonds.facts().by_faces) {
        FaceBonding faces = face_bonding_of(bonded.world, specimen, bonds, test.loading.platens, thick);
        faces.holds = bonding.holds;
        if (test.numerics.intact) faces.holds = [](Vec2, BodyIndex, BodyIndex) { return true; };
        faces.leaves = bonding.leaves;
        faces.pressed = bonding.pressed;
        bond_faces_of(bonded.world, test.places, faces);
    } else {
        bond(bonded.world, test.places, bonding);
    }
    apply_given_step(bonded.world, test);
    place_platens(bonded.world, bonded.platens);
    return bonded;
}

World bond_alone(const Specimen& specimen, const parts::Bonds& bonds, const parts::Procedure& test, Traces traces) {
    Scene scene = scene_of(specimen, bonds, test);
    scene.domain.wall_present = {false, false, false, false};
    if (traces == Traces::as_rock) std::ranges::fill(scene.trace_joints, -1);
    if (traces == Traces::welded) std::ranges::fill(scene.joints, Joint{});
    const double thick = scene.thick;
    World world = build_world(std::move(scene));
    if (bonds.facts().by_faces)
        bond_faces_of(world, test.places, face_bonding_of(world, specimen, bonds, PlatenKind::bonded, thick));
    else
        bond(world, test.places, bonding_of(specimen, bonds, thick));
    return world;
}

}  // namespace crackle
