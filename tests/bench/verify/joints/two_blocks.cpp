// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/joints/two_blocks.hpp"

#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"

namespace crackle::verification {
namespace {

/// A rectangle inset by half the thickness, counter-clockwise from its lower left corner.
std::uint32_t add_block(Scene& scene, int id, Vec2 low, Vec2 high) {
    const double h = 0.5 * scene.thick;
    return scene.add_chain_body(
        id, 0, {{low.x + h, low.y + h}, {high.x - h, low.y + h}, {high.x - h, high.y - h}, {low.x + h, high.y - h}},
        true);
}

}  // namespace

TwoBlocks two_blocks(const Joint& joint, const DofControl& x, const DofControl& y, double damping_ratio,
                     Integrator integrator) {
    constexpr double width = TwoBlocks::width, height = TwoBlocks::height;
    Scene scene;
    Material rock;
    rock.density = TwoBlocks::density;
    rock.normal_stiffness = TwoBlocks::modulus;
    rock.shear_stiffness = TwoBlocks::modulus / TwoBlocks::ratio;
    rock.friction_angle = rock.residual_friction_angle = 40.0;
    rock.tensile_strength = 5e6;
    rock.cohesion = 2e7;
    rock.damping_ratio = damping_ratio;
    scene.materials = {rock};
    scene.domain.wall_present = {false, false, false, false};
    scene.thick = TwoBlocks::thick;
    scene.bond_law = BondLaw::coulomb;
    scene.units = StiffnessUnits::area;
    scene.integrator = integrator;
    const auto lower = static_cast<int>(add_block(scene, 1, {-width, -height}, {2.0 * width, 0.0}));
    const auto upper = static_cast<int>(add_block(scene, 2, {0.0, 0.0}, {width, height}));
    // The trace runs along +x, so the upper block is on its left.
    scene.edge_sides = {no_side, no_side, 1, no_side, 0, no_side, no_side, no_side};
    scene.joints = {joint};
    scene.trace_joints = {0};
    const DofControl at_rest{Drive::velocity, 0.0};
    scene.controls = {{lower, at_rest, at_rest, at_rest, 0}};
    if (x.drive != Drive::free || y.drive != Drive::free) scene.controls.push_back({upper, x, y, at_rest, 0});
    Bonding bonding;
    bonding.thick = scene.thick;
    bonding.gap = 0.05 * scene.thick;
    TwoBlocks blocks;
    blocks.world = build_world(std::move(scene));
    bond_all(blocks.world, bonding);
    blocks.lower = body_of_id(blocks.world, 1);
    blocks.upper = body_of_id(blocks.world, 2);
    return blocks;
}

}  // namespace crackle::verification
