// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that batches of points give the same bytes as single points, with one law in all lanes and with several laws.
// The latter use the same scene with two equal materials.

#include "solver/contact/batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "solver/contact/pass.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/checkpoint.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "specimens/making/materials.hpp"
#include "tests/support/jointed_circles.hpp"
#include "tests/support/same_bytes.hpp"

namespace crackle {
namespace {

using testing::same_bytes;

Material damped_rock() {
    Material material = undamped_rock(1e7, 27.0);
    material.damping_ratio = 0.2;
    return material;
}

struct Trial {
    Scene scene;
    double thick = 0.0;  // m, thickness for bonding; 0 for no bonds
    double speed = 0.0;  // m/s, random initial velocities of the bodies
    bool slides = true;  // whether some point must slide
};

World made(Trial trial, bool two_materials) {
    std::mt19937_64 random(7);
    const auto any = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
    for (Body& body : trial.scene.bodies) {
        body.velocity = {trial.speed * any(), trial.speed * any()};
        body.spin = 10.0 * trial.speed * any();
    }
    if (two_materials) {
        trial.scene.materials.push_back(trial.scene.materials[0]);
        for (std::size_t b = 0; b < trial.scene.bodies.size(); b += 2) trial.scene.bodies[b].material = 1;
    }
    World world = build_world(trial.scene);
    if (trial.thick > 0.0) bond_all(world, trial.thick);
    return world;
}

/// Flags of all points, without the indices of their laws.
std::vector<std::uint16_t> flags_of(const World& world) {
    std::vector<std::uint16_t> flags;
    for (const PointState& state : world.points.state) flags.push_back(state.flags);
    return flags;
}

/// Compares the values that points store under the consistent integrator; there are none under leapfrog.
void expect_same_memory(const World& a, const World& b) {
    EXPECT_TRUE(same_bytes(a.points.opening, b.points.opening));
    EXPECT_TRUE(same_bytes(a.points.last_overlap, b.points.last_overlap));
    EXPECT_TRUE(same_bytes(a.points.last_normal, b.points.last_normal));
}

void expect_the_same_by(Integrator integrator, Trial trial, int steps, bool breaks) {
    SCOPED_TRACE(name_of(integrator));
    trial.scene.integrator = integrator;
    World together = made(trial, false), two_laws = made(trial, true), apart = made(trial, false);
    apart.workers.one_by_one = true;
    for (World* world : {&together, &two_laws, &apart}) {
        for (int n = 0; n < steps; ++n) step(*world);
        compute_forces(*world);
    }
    for (const World* side_by_side : {&together, &two_laws}) {
        testing::expect_same_run(*side_by_side, apart);
        EXPECT_TRUE(same_bytes(flags_of(*side_by_side), flags_of(apart)));
        expect_same_memory(*side_by_side, apart);
    }
    EXPECT_EQ(together.account.friction_loss > 0.0, trial.slides);
    EXPECT_EQ(together.bonds.broken > 0, breaks);
    EXPECT_LE(together.bonds.broken, together.bonds.initial * 9 / 10) << "some hold";
}

void expect_the_same(const Trial& trial, int steps, bool breaks) {
    expect_the_same_by(Integrator::leapfrog, trial, steps, breaks);
    expect_the_same_by(Integrator::consistent, trial, steps, breaks);
}

TEST(PointBatch, BondedDiscsThatBreak) {
    expect_the_same({triangular_lattice(9, 9, 0.02, 8e-5, damped_rock()), 0.01, 0.3}, 400, true);
}

TEST(PointBatch, BondedPolygonsThatBreak) {
    expect_the_same({honeycomb(7, 7, 0.02, 1e-3, damped_rock()), 1.08e-3, 2.0}, 400, true);
}

TEST(PointBatch, LooseDiscs) {
    expect_the_same({triangular_lattice(9, 9, 0.02, 0.0, damped_rock()), 0.0, 1.0}, 2000, false);
}

TEST(PointBatch, LoosePolygons) {
    expect_the_same({honeycomb(7, 7, 0.02, 1e-3, damped_rock()), 0.0, 1.0}, 2000, false);
}

TEST(PointBatch, WithoutFriction) {
    Material smooth = damped_rock();
    smooth.friction_angle = 0.0;
    expect_the_same({triangular_lattice(9, 9, 0.02, 0.0, smooth), 0.0, 1.0, false}, 2000, false);
    expect_the_same({honeycomb(7, 7, 0.02, 1e-3, smooth), 0.0, 1.0, false}, 2000, false);
    expect_the_same({honeycomb(7, 7, 0.02, 1e-3, smooth), 1.08e-3, 2.0, false}, 400, true);
}

TEST(PointBatch, WithoutShearSprings) {
    Material slippery = undamped_rock(1e7, 27.0, 0.0);
    slippery.damping_ratio = 0.2;
    expect_the_same({triangular_lattice(9, 9, 0.02, 0.0, slippery), 0.0, 1.0, false}, 2000, false);
    expect_the_same({honeycomb(7, 7, 0.02, 1e-3, slippery), 0.0, 1.0, false}, 2000, false);
}

TEST(PointBatch, BondsThatCannotBreak) {
    Trial discs{triangular_lattice(9, 9, 0.02, 8e-5, damped_rock()), 0.01, 0.3, false};
    discs.scene.intact = {true, true, true};
    expect_the_same(discs, 400, false);
    Trial polygons{honeycomb(7, 7, 0.02, 1e-3, damped_rock()), 1.08e-3, 0.3, false};
    polygons.scene.intact = {true, true, true};
    expect_the_same(polygons, 400, false);
}

TEST(PointBatch, DiscsAmongPolygons) {
    // A layer of discs falls onto a honeycomb.
    Scene scene = honeycomb(7, 4, 0.02, 1e-3, damped_rock());
    const Scene discs = triangular_lattice(7, 3, 0.02, 0.0, damped_rock());
    double top = 0.0;
    for (const Vec2 vertex : scene.vertices) top = std::max(top, vertex.y);
    for (Body body : discs.bodies) {
        CircleElement circle = discs.circles[body.first_circle];
        circle.centre.y += top + 0.021;
        body.id += 1000;
        body.first_circle = static_cast<std::uint32_t>(scene.circles.size());
        scene.circles.push_back(circle);
        scene.bodies.push_back(body);
    }
    scene.gravity = {0.0, -2000.0};
    expect_the_same({scene, 0.0, 1.0}, 2000, false);
}

TEST(PointBatch, DiscsOnOneAndTheSameSpot) {
    // With coincident centres the normal is arbitrary; the batch must use the same one as the scalar code.
    Scene scene = triangular_lattice(9, 9, 0.02, 0.0, damped_rock());
    scene.circles[scene.bodies[40].first_circle].centre = scene.circles[scene.bodies[41].first_circle].centre;
    World together = made({scene}, false), apart = made({scene}, false);
    apart.workers.one_by_one = true;
    compute_forces(together);
    compute_forces(apart);
    EXPECT_TRUE(same_bytes(together.bodies.force, apart.bodies.force));
    EXPECT_TRUE(same_bytes(together.points.force, apart.points.force));
}

/// Trials whose points have their own stiffness and strength factors.
Trial with_shares(Trial trial, BondLaw law, StiffnessUnits units) {
    trial.scene.bond_law = law;
    trial.scene.units = units;
    if (law != BondLaw::coulomb) return trial;
    for (Material& material : trial.scene.materials) {
        material.residual_friction_angle = 20.0;
        // N; chosen so that bonds break during the trials. In area units, for a face of a few centimetres.
        material.tensile_strength = units == StiffnessUnits::area ? 1e4 : 400.0;
        material.cohesion = 2.0 * material.tensile_strength;
    }
    return trial;
}

/// All combinations of friction, dashpots, bonds and the consistent integrator, with each bond law and both units.
class EverySetOfFeatures : public ::testing::TestWithParam<std::size_t> {};

TEST_P(EverySetOfFeatures, GivesTheBytesOfPointsOneByOne) {
    const auto bit = [](std::size_t n) { return (GetParam() >> n & 1) != 0; };
    const bool friction = bit(0), dashpots = bit(1), bonds = bit(2), consistent = bit(3);
    const StiffnessUnits units = bit(4) ? StiffnessUnits::area : StiffnessUnits::point;
    const auto law = static_cast<BondLaw>(GetParam() >> 5);
    Material material = damped_rock();
    if (!friction) material.friction_angle = 0.0;
    if (!dashpots) material.damping_ratio = 0.0;
    for (const Scene& scene : {triangular_lattice(9, 9, 0.02, 8e-5, material), honeycomb(7, 7, 0.02, 1e-3, material)}) {
        const bool discs = scene.vertices.empty();
        const double speed = discs ? 0.3 : facts_of(law).strengths_are_given ? 1.0 : 2.0;
        Trial trial = with_shares({scene, bonds ? (discs ? 0.01 : 1.08e-3) : 0.0, speed}, law, units);
        if (!friction)
            for (Material& m : trial.scene.materials) m.residual_friction_angle = 0.0;
        if (consistent) trial.scene.integrator = Integrator::consistent;
        World together = made(trial, false), apart = made(trial, false);
        apart.workers.one_by_one = true;
        const ContactFeatures features = features_of(together);
        const bool rubs = friction || (bonds && facts_of(law).sticks);
        ASSERT_TRUE(features.friction == rubs && features.damping == dashpots && features.bonds == bonds &&
                    features.consistent == consistent && features.own_shares == together.settings.own_shares());
        ASSERT_EQ(features.bond_law, bonds ? law : BondLaw{});
        for (int n = 0; n < 300; ++n) {
            step(together);
            step(apart);
        }
        testing::expect_same_run(together, apart);
        EXPECT_TRUE(same_bytes(flags_of(together), flags_of(apart)));
        expect_same_memory(together, apart);
        EXPECT_EQ(together.account.friction_loss > 0.0, friction);
        EXPECT_EQ(together.account.dashpot_loss > 0.0, dashpots);
        EXPECT_EQ(together.bonds.broken > 0, bonds);
    }
}

INSTANTIATE_TEST_SUITE_P(PointBatch, EverySetOfFeatures, ::testing::Range(std::size_t{0}, 32 * bond_laws));

TEST(PointBatch, OfFacesByTheirArea) {
    const auto area = [](const Trial& trial) {
        return with_shares(trial, BondLaw::back_tension, StiffnessUnits::area);
    };
    expect_the_same(area({triangular_lattice(9, 9, 0.02, 8e-5, damped_rock()), 0.01, 0.3}), 400, true);
    expect_the_same(area({honeycomb(7, 7, 0.02, 1e-3, damped_rock()), 1.08e-3, 2.0}), 400, true);
    expect_the_same(area({triangular_lattice(9, 9, 0.02, 0.0, damped_rock()), 0.0, 1.0}), 2000, false);
}

/// Every second body gets a material that differs by the change `vary`.
void expect_the_same_of_two(Trial trial, const std::function<void(Material&)>& vary) {
    trial.scene.materials.push_back(trial.scene.materials[0]);
    vary(trial.scene.materials[1]);
    for (std::size_t b = 0; b < trial.scene.bodies.size(); b += 2) trial.scene.bodies[b].material = 1;
    for (const Integrator integrator : {Integrator::leapfrog, Integrator::consistent}) {
        SCOPED_TRACE(name_of(integrator));
        trial.scene.integrator = integrator;
        World together = made(trial, false), apart = made(trial, false);
        apart.workers.one_by_one = true;
        for (World* world : {&together, &apart})
            for (int n = 0; n < 400; ++n) step(*world);
        testing::expect_same_run(together, apart);
        EXPECT_TRUE(same_bytes(flags_of(together), flags_of(apart)));
        EXPECT_GT(together.bonds.broken, 0);
    }
}

TEST(PointBatch, OfMaterialsThatDiffer) {
    const std::vector<std::function<void(Material&)>> ways{
        [](Material& m) { m.friction_angle = 22.0; },
        [](Material& m) { m.normal_stiffness *= 1.7; },
        [](Material& m) { m.shear_stiffness *= 0.6; },
        [](Material& m) { m.damping_ratio = 0.1; },
        [](Material& m) { m.tensile_strength *= 0.5, m.cohesion *= 0.7, m.residual_friction_angle = 11.0; },
    };
    const auto all = [&](Material& m) {
        for (const auto& way : ways) way(m);
    };
    for (const BondLaw law : {BondLaw::back_tension, BondLaw::coulomb}) {
        const bool coulomb = law == BondLaw::coulomb;
        const auto with = [&](const Trial& trial) { return with_shares(trial, law, StiffnessUnits::point); };
        const Trial discs = with({triangular_lattice(9, 9, 0.02, 8e-5, damped_rock()), 0.01, 0.3});
        const Trial cells = with({honeycomb(7, 7, 0.02, 1e-3, damped_rock()), 1.08e-3, coulomb ? 1.0 : 2.0});
        for (std::size_t n = 0; n < ways.size() - (coulomb ? 0 : 1); ++n) {
            SCOPED_TRACE(n);
            expect_the_same_of_two(discs, ways[n]);
            expect_the_same_of_two(cells, ways[n]);
        }
        if (!coulomb) continue;
        expect_the_same_of_two(discs, all);
        expect_the_same_of_two(cells, all);
    }
}

TEST(PointBatch, CoulombBondsThatBreak) {
    for (const StiffnessUnits units : {StiffnessUnits::point, StiffnessUnits::area}) {
        const auto coulomb = [&](const Trial& trial) { return with_shares(trial, BondLaw::coulomb, units); };
        expect_the_same(coulomb({triangular_lattice(9, 9, 0.02, 8e-5, damped_rock()), 0.01, 0.3}), 800, true);
        expect_the_same(coulomb({honeycomb(7, 7, 0.02, 1e-3, damped_rock()), 1.08e-3, 1.0}), 800, true);
    }
}

/// Circles whose flat faces slide along two crossing traces, separate, meet others and break, with random velocities
/// and shear.
World faces_in_motion(const std::vector<Joint>& joints, Integrator integrator) {
    testing::JointedCircles circles;
    Scene scene = testing::scene_of(circles);
    scene.integrator = integrator;
    scene.joints = joints;
    scene.trace_joints.assign({0, static_cast<std::int32_t>(joints.size()) - 1});
    scene.trace_pieces.push_back({1, {0.06, -0.02}, {0.18, 0.26}});
    World world = testing::bonded_circles(scene);
    std::mt19937_64 random(5);
    const auto any = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
    for (BodyState& body : world.bodies.state) {
        body.vx += 40.0 * (body.y - 0.1) + 2.0 * any();
        body.vy += -4.0 * (body.y - 0.1) + 2.0 * any();
        body.omega += 100.0 * any();
    }
    velocities_changed(world);
    return world;
}

TEST(PointBatch, FlatFacesThatSlipPartAndBreak) {
    Joint weak, open, stiff;
    weak.strength_factor = 0.05;
    weak.friction_angle = 20.0;
    open.bonded = false;
    open.friction_angle = 25.0;
    open.aperture = 2e-6;
    stiff.strength_factor = 0.1;
    stiff.friction_angle = 30.0;
    stiff.normal_stiffness = 1e11;
    stiff.shear_stiffness = 2e10;
    stiff.dilation_angle = 8.0;
    constexpr auto flat = static_cast<std::size_t>(PointKind::face_face);
    for (const std::vector<Joint>& joints : {std::vector{weak}, {open}, {stiff}, {weak, open}, {stiff, open}}) {
        for (const Integrator integrator : {Integrator::leapfrog, Integrator::consistent}) {
            World together = faces_in_motion(joints, integrator), apart = together;
            apart.workers.one_by_one = true;
            std::size_t parted = 0, slid = 0;
            for (int n = 0; n < 1500; ++n) {
                step(together), step(apart);
                for (PointIndex k = together.points.kind_begin[flat]; k < together.points.kind_begin[flat + 1]; ++k) {
                    const std::uint16_t flags = together.points.state[k].flags;
                    parted += (flags & (point_touching | point_bonded)) == 0 ? 1 : 0;
                    slid += (flags & point_sliding) != 0 ? 1 : 0;
                }
            }
            EXPECT_TRUE(save_world(together) == save_world(apart));
            EXPECT_GT(parted, 100U);
            EXPECT_GT(slid, 100U);
            EXPECT_EQ(together.bonds.broken > 0, joints[0].bonded);
            EXPECT_NE(together.account.law_loss, 0.0) << "laps have changed";
        }
    }
}

}  // namespace
}  // namespace crackle
