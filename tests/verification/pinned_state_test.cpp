// SPDX-License-Identifier: GPL-3.0-or-later
// Compares six small scenes with recorded states. After some steps the hash of each field must equal the recorded one,
// in every build (release, sanitizers, any number of lanes and threads). No sparse solve is involved. A mismatch is
// reported with scene, step, field and, for the bodies' state, the first body that differs.
//
// If a change is meant to alter results, the states are recorded again, and the commit says so:
//     CRACKLE_RECORD_STATES=tests/verification/pinned_states.csv build/release/tests/verification/verification_tests
//         --gtest_filter='PinnedState*'

#include <gtest/gtest.h>

#include <xxhash.h>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/state_hash.hpp"
#include "specimens/making/lattices.hpp"
#include "specimens/making/materials.hpp"

namespace crackle {
namespace {

constexpr std::int64_t looks[] = {1, 10, 100, 300};

Material damped_rock() {
    Material material = undamped_rock(1e7, 27.0);
    material.damping_ratio = 0.1;
    return material;
}

/// Gives the bodies different velocities and spins.
Scene stirred(Scene scene, double speed) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const auto k = static_cast<double>(b % 7), l = static_cast<double>(b % 5);
        scene.bodies[b].velocity = {speed * (k - 3.0), speed * (l - 2.0)};
        scene.bodies[b].spin = 10.0 * speed * (l - 2.0);
    }
    scene.time_step = 2e-5;
    return scene;
}

Scene discs_in_collision() { return stirred(triangular_lattice(5, 5, 0.02, 0.0, damped_rock()), 0.3); }

Scene polygons_in_collision() { return stirred(honeycomb(4, 4, 0.02, 1e-3, damped_rock()), 0.3); }

Scene guide_law() {
    Scene scene = polygons_in_collision();
    scene.segment_law = SegmentLaw::demseg;
    return scene;
}

Scene consistent_discs() {
    Scene scene = discs_in_collision();
    scene.integrator = Integrator::consistent;
    return scene;
}

Scene rolling_disc() {
    Scene scene;
    scene.materials = {damped_rock()};
    scene.domain = {0.0, 1.0, 0.0, 1.0, {true, true, true, true}};
    scene.gravity = {1.0, -9.81};
    scene.add_circle_body(1, 0, {{0.5, 0.0201}, 0.02, 0.0});
    scene.time_step = 2e-5;
    return scene;
}

Scene clump_on_the_floor() {
    Scene scene = rolling_disc();
    scene.circles.push_back({{0.53, 0.025}, 0.02, 0.0});
    scene.bodies[0].circle_count = 2;
    return scene;
}

using Hashes = std::map<std::string, std::uint64_t>;  // "scene,step,what"

std::uint64_t hash_of_body(const BodyState& body) {
    const double members[] = {body.x, body.y, body.vx, body.vy, body.omega, body.shape[0], body.shape[1], body.angle};
    return XXH3_64bits(members, sizeof members);
}

Hashes hashes_of(const std::string& name, const Scene& scene, int threads) {
    Scene own = scene;
    own.threads = threads;
    World world = build_world(own);
    Hashes hashes;
    for (const std::int64_t look : looks) {
        while (world.stepping.steps < look) step(world);
        const std::string at = name + ',' + std::to_string(look) + ',';
        for (const FieldHash& field : hash_fields(world)) {
            for (const char* pinned : {"bodies.state", "points.contact", "points.shear_force", "points.normal_dashpot",
                                       "account.dashpot_loss", "account.friction_loss"})
                if (field.name == pinned) hashes[at + field.name] = field.hash;
        }
        for (std::size_t b = 0; b < world.bodies.size(); ++b)
            hashes[at + "body " + std::to_string(world.bodies.info(b).id)] = hash_of_body(world.bodies.state[b]);
    }
    return hashes;
}

const std::string& record_path() {
    static const std::string path = CRACKLE_SOURCE_DIR "/tests/verification/pinned_states.csv";
    return path;
}

Hashes recorded() {
    Hashes hashes;
    std::ifstream in(record_path());
    for (std::string line; std::getline(in, line);) {
        const std::size_t comma = line.rfind(',');
        if (line.starts_with("scene,") || comma == std::string::npos) continue;
        hashes[line.substr(0, comma)] = std::stoull(line.substr(comma + 1), nullptr, 16);
    }
    return hashes;
}

void write_record(const char* path, const Hashes& hashes) {
    std::ofstream out(path, std::ios::app);
    for (const auto& [where, hash] : hashes) out << where << ',' << std::hex << hash << '\n';
}

class PinnedState : public ::testing::TestWithParam<std::pair<const char*, Scene (*)()>> {};

TEST_P(PinnedState, IsTheRecordedOneOnAnyNumberOfThreads) {
    const auto name = GetParam().first;
    const auto scene = GetParam().second;
    const Hashes expected = recorded();
    if (const char* path = std::getenv("CRACKLE_RECORD_STATES")) write_record(path, hashes_of(name, scene(), 1));
    for (const int threads : {1, 2, 3}) {
        const Hashes got = hashes_of(name, scene(), threads);
        for (const std::int64_t look : looks) {  // the first step that differs shows where the runs diverge
            const std::string at = std::string(name) + ',' + std::to_string(look) + ',';
            std::string differing;
            for (auto entry = got.lower_bound(at); entry != got.end() && entry->first.starts_with(at); ++entry) {
                const auto pinned = expected.find(entry->first);
                if (pinned == expected.end() || pinned->second != entry->second)
                    differing += "  " + entry->first.substr(at.size()) + '\n';
            }
            ASSERT_EQ(differing, "") << name << ", step " << look << ", " << threads
                                     << " threads: these fields and bodies are not the recorded ones";
        }
        EXPECT_EQ(got.size(),
                  static_cast<std::size_t>(std::count_if(expected.begin(), expected.end(), [&](auto& entry) {
                      return entry.first.starts_with(std::string(name) + ',');
                  })));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, PinnedState,
    ::testing::Values(std::pair("discs", &discs_in_collision), std::pair("polygons", &polygons_in_collision),
                      std::pair("guide_law", &guide_law), std::pair("consistent", &consistent_discs),
                      std::pair("rolling_disc", &rolling_disc), std::pair("clump", &clump_on_the_floor)),
    [](const auto& test) { return std::string(test.param.first); });

}  // namespace
}  // namespace crackle
