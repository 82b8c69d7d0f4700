// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the feature study: the least step gives the same results as the engine's step, and rows are labelled
// accordingly.

#include "tests/bench/throughput/feature_costs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/throughput/least_step.hpp"
#include "tests/bench/throughput/timed_test.hpp"

namespace crackle::throughput {
namespace {

/// Unbonded discs with random velocities.
World loose_discs() {
    Scene scene = triangular_lattice(12, 12, 0.02, 8e-5, timed_rock());
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const auto k = static_cast<double>(b);
        scene.bodies[b].velocity = {0.01 * std::sin(1.7 * k), 0.01 * std::cos(2.3 * k)};
    }
    World world = build_world(scene);
    step(world);
    return world;
}

bool same_bodies(const World& a, const World& b) {
    return std::memcmp(a.bodies.state.data(), b.bodies.state.data(), a.bodies.size() * sizeof(BodyState)) == 0;
}

TEST(LeastStep, GivesTheBytesOfTheEnginesStep) {
    World by_engine = loose_discs(), least = by_engine;
    const ContactFeatures features = features_of(by_engine);
    ASSERT_TRUE(features.friction && features.damping && !features.bonds && !features.consistent);
    for (int k = 0; k < 50; ++k) {
        step(by_engine);
        least_step(least, features);
    }
    EXPECT_TRUE(same_bodies(by_engine, least));
    EXPECT_EQ(by_engine.list.travelled, least.list.travelled);
    ContactFeatures frictionless = features;
    frictionless.friction = false;
    least_step(least, frictionless);
    step(by_engine);
    EXPECT_FALSE(same_bodies(by_engine, least)) << "unused features must not change results";
}

TEST(LeastStep, KernelsWithFeaturesThatAreNotThereChangeNothing) {
    World plain = loose_discs(), roomy = plain;
    const ContactFeatures features = features_of(plain), all{true, true, true, false};
    make_room_for(roomy, all);
    for (int k = 0; k < 50; ++k) {
        least_step(plain, features);
        least_step(roomy, all);
    }
    EXPECT_TRUE(same_bodies(plain, roomy));
}

TEST(FeatureCosts, EveryRowHasItsNumbersInOrder) {
    const std::filesystem::path scratch = std::filesystem::path(::testing::TempDir()) / "feature_costs";
    std::map<std::string, int> kinds;
    std::map<std::string, FeatureRow> discs;
    measure_feature_costs({150, fewest_for_interval, 0.001, scratch}, [&](const FeatureRow& row) {
        ++kinds[name_of(row.kind)];
        if (row.kind == FeatureRowKind::added && row.bodies == "discs") discs[row.feature] = row;
        EXPECT_GT(row.contact_seconds, 0.0) << row.feature;
        EXPECT_GT(row.contacts, row.particles) << row.bodies << ' ' << row.feature;
        // The difference and the ratio are computed from the same pairs of runs.
        EXPECT_EQ(row.difference.low > 0.0, row.ratio.low > 1.0) << row.feature;
    });
    std::filesystem::remove_all(scratch);
    EXPECT_EQ(kinds["added"], 11 + 10 + 2 + 2);
    EXPECT_EQ(kinds["dispatched"], 4 + 4 + 2);
    EXPECT_EQ(kinds["forced"], 4 + 4 + 1);
    // No contact opens during the runs, so all rows of unbonded discs have the same number of contacts. Clumps make
    // fewer bodies.
    EXPECT_EQ(discs.at("normal springs").contacts, discs.at("friction").contacts);
    EXPECT_EQ(discs.at("bonds").contacts, discs.at("two materials").contacts);
    EXPECT_EQ(discs.at("driven platens").particles, discs.at("bonds").particles + 2);
    EXPECT_LT(discs.at("clumps of two").particles, 2 * discs.at("bonds").particles / 3);
}

}  // namespace
}  // namespace crackle::throughput
