// SPDX-License-Identifier: GPL-3.0-or-later
// A joint between two blocks: stiffness in series with the face, aperture, dilation and its work.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "solver/linear/elastic.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/joints/two_blocks.hpp"
#include "tests/bench/verify/rows.hpp"

namespace crackle::verification {
namespace {

constexpr double radians = std::numbers::pi / 180.0;
constexpr DofControl still{Drive::velocity, 0.0, 0.0}, free_to_move{};

std::vector<ClaimRow> joint_is_in_series_with_the_face() {
    Rows rows;
    constexpr double face = TwoBlocks::normal_stiffness(), way = 1e-8;
    const auto stiffnesses = [&](const Joint& joint) {
        const TwoBlocks blocks = two_blocks(joint, free_to_move, free_to_move, 0.0);
        const auto force = [&](BodyMotion motion) {
            return solve_elastic(blocks.world, {{blocks.lower, {}}, {blocks.upper, motion}}).reaction[1];
        };
        return Vec2{force({way, 0.0, 0.0}).x / way, force({0.0, way, 0.0}).y / way};
    };
    const auto compare = [&](const std::string& name, const Joint& joint, double normal, double shear) {
        const Vec2 got = stiffnesses(joint);
        rows.relative(name + ": k_n, N/m", got.y, normal, 1e-6, "shares, floats");
        rows.relative(name + ": k_s, N/m", got.x, shear, 1e-6, "shares, floats");
    };
    compare("welded", {}, face, face / TwoBlocks::ratio);
    for (const double stiffness : {1e11, 1e13}) {
        Joint joint;
        joint.normal_stiffness = stiffness;
        compare(fmt::format("K_n = {:g} Pa/m alone", stiffness), joint, TwoBlocks::in_series(face, stiffness),
                face / TwoBlocks::ratio);
        joint.shear_stiffness = 0.1 * stiffness;
        compare(fmt::format("K_n = {:g} Pa/m, K_s a tenth", stiffness), joint, TwoBlocks::in_series(face, stiffness),
                TwoBlocks::in_series(face / TwoBlocks::ratio, 0.1 * stiffness));
        joint.bonded = false;
        compare(fmt::format("K_n = {:g} Pa/m, K_s a tenth, open and pressed", stiffness), joint,
                TwoBlocks::in_series(face, stiffness), TwoBlocks::in_series(face / TwoBlocks::ratio, 0.1 * stiffness));
    }
    Joint stiff;
    stiff.normal_stiffness = stiff.shear_stiffness = 1e24;
    compare("K = 1e24 Pa/m", stiff, face, face / TwoBlocks::ratio);
    return rows.take();
}

std::vector<ClaimRow> open_joint_bears_nothing_until_its_aperture_has_closed() {
    Rows rows;
    constexpr double aperture = 1e-5, stiffness = 2e12, speed = 1e-2;  // m, Pa/m, m/s
    Joint joint;
    joint.bonded = false;
    joint.aperture = aperture;
    joint.normal_stiffness = stiffness;
    TwoBlocks blocks = two_blocks(joint, free_to_move, {Drive::velocity, -speed}, 0.0);
    const double start = blocks.world.bodies.state[blocks.upper].y;
    const auto closure = [&] { return start - blocks.world.bodies.state[blocks.upper].y; };
    const auto force = [&] {
        compute_forces(blocks.world);
        return blocks.world.bodies.force[blocks.upper].fy;
    };
    double largest = 0.0;
    while (closure() < 0.999 * aperture) {
        step(blocks.world);
        largest = std::max(largest, std::abs(force()));
    }
    rows.exactly("largest force up to 0.999 of the aperture, N", largest, 0.0);
    while (closure() < 2.0 * aperture) step(blocks.world);
    rows.relative("force at twice the aperture, N", force(),
                  TwoBlocks::in_series(TwoBlocks::normal_stiffness(), stiffness) * (closure() - aperture), 1e-6,
                  "shares, floats");
    return rows.take();
}

std::vector<ClaimRow> sliding_joint_opens_by_its_dilation_until_its_slip() {
    Rows rows;
    constexpr double pressed = 4e5, dilating_slip = 5e-5, end = 1e-4, friction = 30.0;  // N, m, m, degrees
    for (const Integrator integrator : {Integrator::leapfrog, Integrator::consistent}) {
        for (const double angle : {0.0, 5.0, 12.0}) {
            Joint joint;
            joint.bonded = false;
            joint.friction_angle = friction;
            joint.shear_stiffness = 1e13;
            joint.dilation_angle = angle;
            joint.dilation_slip = dilating_slip;
            TwoBlocks blocks = two_blocks(joint, still, {Drive::force, -pressed}, 0.5, integrator);
            World& world = blocks.world;
            while (world.stepping.steps < 4000) step(world);
            const BodyState pressed_place = world.bodies.state[blocks.upper];
            constexpr double speed = 2e-3;  // m/s
            change_velocity(world, blocks.upper, 0, speed);
            const double yield =
                pressed * std::tan(friction * radians) /
                TwoBlocks::in_series(TwoBlocks::normal_stiffness() / TwoBlocks::ratio, *joint.shear_stiffness);
            const auto slip = [&] { return world.bodies.state[blocks.upper].x - pressed_place.x - yield; };
            const auto rise = [&] { return world.bodies.state[blocks.upper].y - pressed_place.y; };
            const std::string name = fmt::format("{}, {} degrees: ", name_of(integrator), angle);
            const double tangent = std::tan(angle * radians);
            while (slip() < 0.8 * dilating_slip) step(world);
            rows.absolute(name + "opening over slip before", rise() / slip(), tangent, 1e-3, "inertia");
            while (slip() < end) step(world);
            rows.absolute(name + "opening over that slip after", rise() / dilating_slip, tangent, 1e-3, "inertia");
            compute_forces(world);
            const Ledger ledger = measure_ledger(world);
            const double work = std::abs(ledger.displacement_work) + std::abs(ledger.force_work);
            rows.absolute(name + "closing error of energy over work", ledger.closing_error / work, 0.0, 1e-3,
                          "reference");
            rows.relative(name + "friction loss, J", ledger.friction_loss,
                          pressed * (std::tan(friction * radians) * slip() - tangent * dilating_slip), 2e-3, "inertia");
        }
    }
    return rows.take();
}

}  // namespace

std::vector<Claim> joint_face_claims() {
    constexpr const char* group = "Joints";
    return {
        {.name = "joint_is_in_series_with_the_face",
         .group = group,
         .statement =
             "across a joint 1/k = 1/k_face + 1/(K L), in normal and shear direction; infinite K gives the intact face",
         .check = joint_is_in_series_with_the_face},
        {.name = "open_joint_bears_nothing_until_its_aperture_has_closed",
         .group = group,
         .statement = "an open joint has no normal force until its faces have closed by the aperture; then the force "
                      "is k_n times the further closure",
         .check = open_joint_bears_nothing_until_its_aperture_has_closed},
        {.name = "sliding_joint_opens_by_its_dilation_until_its_slip",
         .group = group,
         .statement = "under a constant normal force, a sliding joint opens by tan ψ times its slip up to "
                      "dilation_slip. The friction loss is the work of shear minus the work against the normal force",
         .check = sliding_joint_opens_by_its_dilation_until_its_slip},
    };
}

}  // namespace crackle::verification
