// SPDX-License-Identifier: GPL-3.0-or-later
// Tests kernels on the test's own arrays, without a world: circles in a row with one contact point between neighbours.

#include "solver/contact/force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "solver/base/chosen_set.hpp"
#include "solver/contact/kernels.hpp"
#include "tests/support/same_bytes.hpp"

namespace crackle::force_test {
namespace {

using testing::same_bytes;

constexpr double radius = 0.5, k_n = 1e6, k_s = 4e5, mu = 0.5;
constexpr double bond_overlap = 1e-3;                                 // m
constexpr double tensile = 400.0, cohesion = 600.0, residual = 0.25;  // N, N and -

ContactLaw rock() {
    ContactLaw law{};
    law.normal_stiffness = k_n, law.shear_stiffness = k_s;
    law.friction = mu, law.bond_friction = mu;
    law.tensile_strength = tensile, law.cohesion = cohesion;
    return law;
}

/// Circles in a row; all arrays belong to this struct.
struct Row {
    std::vector<BodyState> bodies;
    std::vector<BodyInertia> inertia;
    std::vector<BodyForce> force;
    std::vector<PushBound> push_bound;
    std::vector<BodyPair> pairs;
    std::vector<PointState> state;
    std::vector<double> root_mass, shear_force, bond_overlap, last_normal;
    std::vector<float> stiffness_share, strength_share, shear_root;
    std::vector<float> normal_dashpot, shear_dashpot, strong_normal, strong_shear;
    std::vector<OpeningMemory> opening;
    std::vector<LastOverlap> last_overlap;
    std::vector<ContactLaw> laws{rock()};
    ContactFeatures features;
    double drift = 1e-5;  // s
    std::vector<PointForce> forces;
    LossBlock losses;

    /// @param overlaps overlap of each circle with the next, m
    explicit Row(const std::vector<double>& overlaps) {
        const std::size_t points = overlaps.size();
        double x = 0.0;
        for (std::size_t b = 0; b <= points; ++b) {
            bodies.push_back({x, 0.0, 0.0, 0.0, 0.0, {radius, 0.0}, 0.0});
            if (b < points) x += 2.0 * radius - overlaps[b];
        }
        inertia.assign(points + 1, {1.0, 1.0, 8.0, 1.0});
        force.resize(points + 1);
        push_bound.assign(points + 1, {1.0, 2.0, radius});
        for (BodyIndex b = 0; b < points; ++b) pairs.push_back({b, b + 1});
        state.assign(points, {0, point_touching});
        root_mass.assign(points, 0.7);
        shear_force.assign(points, 0.0);
        bond_overlap.assign(points, 0.0);
        last_normal.assign(points, 0.0);
        for (auto* ones : {&stiffness_share, &strength_share, &shear_root}) ones->assign(points, 1.0F);
        for (auto* zeros : {&normal_dashpot, &shear_dashpot, &strong_normal, &strong_shear})
            zeros->assign(points, 0.0F);
        opening.resize(points);
        last_overlap.resize(points);
        forces.resize(points);
    }

    /// Bonds a point. @param at overlap at bonding, m
    void bond(PointIndex k, double at) {
        state[k].flags |= point_bonded | point_counted;
        bond_overlap[k] = at;
    }

    /// One force pass. @param one_by_one whether points are computed without batches
    void pass(bool one_by_one = false) {
        PassView view;
        view.features = features;
        view.bodies.state = bodies.data();
        view.force = view.last_force = force.data();
        view.inertia = inertia.data();
        view.push_bound = push_bound.data();
        view.points = view.circle_points = static_cast<PointIndex>(pairs.size());
        view.pairs = pairs.data();
        view.root_mass = root_mass.data();
        view.state = state.data();
        view.shear_force = shear_force.data(), view.bond_overlap = bond_overlap.data();
        view.stiffness_share = stiffness_share.data(), view.strength_share = strength_share.data();
        view.shear_root = shear_root.data();
        view.normal_dashpot = normal_dashpot.data(), view.shear_dashpot = shear_dashpot.data();
        view.opening = opening.data(), view.last_overlap = last_overlap.data();
        view.last_normal = last_normal.data();
        view.strong_normal = strong_normal.data(), view.strong_shear = strong_shear.data();
        view.laws = laws.data(), view.law_count = laws.size();
        view.drift = view.time_step = view.kick = drift;
        view.one_by_one = one_by_one;
        view.losses = &losses;
        const auto kernel_of = of_chosen_set([]<InstructionSet S>() { return &force_kernel_of<S>; });
        const ForceKernel kernel = kernel_of(features, static_cast<std::size_t>(PointKind::circle_circle));
        for (PointIndex begin = 0; begin < view.points; begin += block) {
            kernel(view, {begin, std::min(begin + block, view.points), 0, forces.data() + begin});
            total.dashpot += losses.dashpot, total.friction += losses.friction;
            total.broken += losses.broken, total.gained += losses.gained;
        }
    }
    static constexpr PointIndex block = 256;
    LossBlock total;

    bool bonded(PointIndex k) const { return (state[k].flags & point_bonded) != 0; }
    double normal(PointIndex k) const { return -forces[k].fx; }
    double shear(PointIndex k) const { return forces[k].fy; }
};

/// A row whose bonds are of one law.
Row row_of(BondLaw law, const std::vector<double>& overlaps) {
    Row row(overlaps);
    row.features = {.friction = true, .bonds = true, .own_shares = facts_of(law).own_shares, .bond_law = law};
    return row;
}

constexpr double exact = 1e-6;  // N, round-off of k_n times positions of about 1 m

TEST(Force, OfEachLawIsZeroAtItsBondAndThenThatOfItsSprings) {
    for (std::size_t n = 0; n < bond_laws; ++n) {
        const auto law = static_cast<BondLaw>(n);
        SCOPED_TRACE(name_of(law));
        Row row = row_of(law, {bond_overlap, bond_overlap, bond_overlap});
        for (PointIndex k = 0; k < 3; ++k) row.bond(k, bond_overlap);
        row.pass();
        for (PointIndex k = 0; k < 3; ++k) EXPECT_NEAR(row.normal(k), 0.0, exact);
        row.bodies[3].x -= 1e-4;
        row.bodies[3].vy = 2.0;
        row.pass();
        EXPECT_NEAR(row.normal(2), 1e-4 * k_n, exact);
        EXPECT_NEAR(row.shear(2), 2.0 * row.drift * k_s, 1e-3) << "the rotation of the normal is neglected";
        EXPECT_EQ(row.total.broken, 0U);
    }
}

TEST(Force, OfBackTensionBreaksWhereTheOverlapEndsAndSlidesAtTheFrictionOfTheOverlap) {
    Row row = row_of(BondLaw::back_tension, {bond_overlap, -1e-6, 0.5 * bond_overlap});
    for (PointIndex k = 0; k < 3; ++k) row.bond(k, bond_overlap);
    row.shear_force = {1e4, 0.0, -100.0};
    row.pass();
    EXPECT_TRUE(row.bonded(0));
    EXPECT_NEAR(row.shear(0), mu * k_n * bond_overlap, exact);
    EXPECT_NE(row.state[0].flags & point_slid, 0);
    EXPECT_EQ(row.state[1].flags & (point_bonded | point_just_broken), point_just_broken);
    EXPECT_EQ(row.forces[1].fx, 0.0);
    EXPECT_EQ(row.forces[1].fy, 0.0);
    EXPECT_TRUE(row.bonded(2));
    EXPECT_NEAR(row.normal(2), -0.5 * k_n * bond_overlap, exact) << "pulls";
    EXPECT_NEAR(row.shear(2), -100.0, exact) << "sticks";
    EXPECT_NEAR(row.strong_normal[2], -500.0, 1e-3) << "half its strength";
    EXPECT_EQ(row.total.broken, 1U);
}

TEST(Force, OfCoulombBreaksInTensionAndInShearAndStillPushesAfterwards) {
    const double weak = bond_overlap - 1.01 * tensile / k_n, strong = bond_overlap - 0.99 * tensile / k_n;
    Row row = row_of(BondLaw::coulomb, {weak, strong, 2.0 * bond_overlap});
    row.laws[0].friction = residual;
    for (PointIndex k = 0; k < 3; ++k) row.bond(k, bond_overlap);
    row.shear_force[2] = 1.01 * (cohesion + mu * k_n * bond_overlap);
    row.pass();
    EXPECT_EQ(row.state[0].flags & (point_bonded | point_just_broken), point_just_broken);
    EXPECT_EQ(row.normal(0), 0.0);
    EXPECT_TRUE(row.bonded(1));
    EXPECT_NEAR(row.normal(1), -0.99 * tensile, exact);
    EXPECT_EQ(row.state[2].flags & (point_bonded | point_just_broken), point_just_broken);
    EXPECT_NEAR(row.normal(2), k_n * bond_overlap, exact) << "from its rest overlap";
    EXPECT_NEAR(row.shear(2), residual * k_n * bond_overlap, exact);
    EXPECT_EQ(row.total.broken, 2U);
}

TEST(Force, OfCoulombGrowsWithTheStrengthOfItsPoint) {
    Row row = row_of(BondLaw::coulomb, {bond_overlap - 1.5 * tensile / k_n, bond_overlap - 1.5 * tensile / k_n});
    for (PointIndex k = 0; k < 2; ++k) row.bond(k, bond_overlap);
    row.strength_share[1] = 2.0F;
    row.pass();
    EXPECT_FALSE(row.bonded(0));
    EXPECT_TRUE(row.bonded(1));
}

/// Several hundred points in all states that can occur in a pass.
Row any_row(const ContactFeatures& features, bool two_laws) {
    std::mt19937_64 random(11);
    const auto any = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    std::vector<double> overlaps(640);
    // Sequences of points in contact and of separate points, so that all kinds of batches occur.
    for (std::size_t k = 0; k < overlaps.size(); ++k)
        overlaps[k] = k % 64 < 40 ? any(0.02, 2.0) * bond_overlap : any(-1.0, k % 64 < 56 ? 0.0 : 1.0) * bond_overlap;
    Row row(overlaps);
    row.features = features;
    ContactLaw& law = row.laws[0];
    if (!features.friction) law.friction = 0.0;
    if (features.damping) law.normal_damping = 30.0, law.shear_damping = 20.0, law.normal_damping_ratio_term = 5.0;
    law.tensile_strength = 700.0, law.cohesion = 900.0;
    if (two_laws) {
        row.laws.push_back(law);
        row.laws[1].normal_stiffness *= 1.5, row.laws[1].friction *= 0.7, row.laws[1].cohesion *= 0.9;
    }
    for (BodyState& body : row.bodies) body.vx = any(-3.0, 3.0), body.vy = any(-3.0, 3.0), body.omega = any(-3.0, 3.0);
    for (PointIndex k = 0; k < row.state.size(); ++k) {
        row.state[k] = {static_cast<std::uint16_t>(two_laws && random() % 16 == 0 ? 1 : 0), point_counted};
        if (overlaps[k] > 0.0) {
            row.state[k].flags |= point_touching;
            if (features.bonds && random() % 32 != 0) row.bond(k, bond_overlap);
            row.shear_force[k] = any(-600.0, 600.0);
            row.last_normal[k] = any(0.0, 1000.0);
            row.normal_dashpot[k] = row.shear_dashpot[k] = 3.0F;
        }
        row.last_overlap[k].value = overlaps[k] + any(-1e-4, 1e-4);
        if (features.own_shares) {
            row.stiffness_share[k] = static_cast<float>(any(0.5, 1.5));
            row.strength_share[k] = static_cast<float>(any(0.9, 1.5));
        }
        if (features.own_shear) row.shear_root[k] = static_cast<float>(any(0.5, 1.0));
    }
    return row;
}

void expect_same(const Row& a, const Row& b) {
    EXPECT_TRUE(same_bytes(a.forces, b.forces));
    EXPECT_TRUE(same_bytes(a.state, b.state));
    EXPECT_TRUE(same_bytes(a.shear_force, b.shear_force));
    EXPECT_TRUE(same_bytes(a.normal_dashpot, b.normal_dashpot));
    EXPECT_TRUE(same_bytes(a.shear_dashpot, b.shear_dashpot));
    EXPECT_TRUE(same_bytes(a.strong_normal, b.strong_normal));
    EXPECT_TRUE(same_bytes(a.strong_shear, b.strong_shear));
    EXPECT_TRUE(same_bytes(a.opening, b.opening));
    EXPECT_TRUE(same_bytes(a.last_overlap, b.last_overlap));
    EXPECT_TRUE(same_bytes(a.last_normal, b.last_normal));
    EXPECT_EQ(a.total.dashpot, b.total.dashpot);
    EXPECT_EQ(a.total.friction, b.total.friction);
    EXPECT_EQ(a.total.broken, b.total.broken);
    EXPECT_EQ(a.total.gained, b.total.gained);
}

TEST(Force, OfABatchHasTheBytesOfPointsOneByOneForAllLawsAndFeatures) {
    for (std::size_t set = 0; set < 64 * bond_laws; ++set) {
        const auto law = static_cast<BondLaw>(set / 64);
        const auto bit = [&](std::size_t n) { return (set >> n & 1) != 0; };
        const ContactFeatures features{bit(0), bit(1), bit(2), bit(3), bit(4), bit(5), bit(2) ? law : BondLaw{}};
        if (features.bonds && facts_of(law).own_shares && !features.own_shares) continue;  // no such scene
        for (const bool two_laws : {false, true}) {
            SCOPED_TRACE(::testing::Message() << "set " << set << (two_laws ? " of two laws" : ""));
            Row batches = any_row(features, two_laws), single = batches;
            for (int n = 0; n < 3; ++n) {
                batches.pass();
                single.pass(true);
                for (Row* row : {&batches, &single})
                    for (BodyState& body : row->bodies) body.x += row->drift * body.vx, body.y += row->drift * body.vy;
            }
            expect_same(batches, single);
            EXPECT_EQ(batches.total.broken > 0, features.bonds);
            EXPECT_EQ(batches.total.dashpot != 0.0, features.damping);
        }
    }
}

}  // namespace
}  // namespace crackle::force_test
