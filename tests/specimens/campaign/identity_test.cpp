// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that two tests have the same identity if and only if all their results must be equal.

#include "specimens/campaign/identity.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "solver/base/version.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/results/sha256.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_plan.hpp"

namespace crackle {
namespace {

ResolvedCase with(const CaseFiles& files, const std::string& key, const CaseValue& value) {
    return files.with(std::vector<CaseSetting>{{key, value, "here:1"}});
}

TEST(Identity, ChangesWithEveryKeyButThoseThatNoFigureDependsOn) {
    const testing::ScratchFolder scratch;
    const CaseFiles files(testing::write_packed_case(scratch / "case.toml"));
    FileHashes hashes;
    const std::string asked = identity_of(files.with({}), hashes);
    EXPECT_EQ(asked.size(), 32U);
    std::set<std::string> seen{asked};
    for (const auto& [key, value] :
         std::vector<std::pair<std::string, CaseValue>>{{"packing.seed", std::int64_t{2}},
                                                        {"packing.count", std::int64_t{61}},
                                                        {"material.friction_angle", 27.000000001},
                                                        {"loading.kind", std::string("compression")},
                                                        {"loading.strength_drop", 0.2},
                                                        {"numerics.safety_factor", 0.5},
                                                        {"output.curve_rows", std::int64_t{201}},
                                                        {"output.out_of_plane_thickness", 0.1},
                                                        {"output.emission", true},
                                                        {"bond.thick", 1e-5}})
        EXPECT_TRUE(seen.insert(identity_of(with(files, key, value), hashes)).second) << key;
    for (const auto& [key, value] :
         std::vector<std::pair<std::string, CaseValue>>{{"title", std::string("Another")},
                                                        {"numerics.threads", std::int64_t{2}},
                                                        {"output.frames", std::int64_t{7}},
                                                        {"output.slips", true},
                                                        {"output.frame_precision", std::string("double")},
                                                        {"output.checkpoint_interval", 5.0}})
        EXPECT_EQ(identity_of(with(files, key, value), hashes), asked) << key;
    EXPECT_TRUE(seen.insert(identity_of(files.with({}, {.step = 0.5}), hashes)).second);
    EXPECT_TRUE(seen.insert(identity_of(files.with({}, {.rate = 0.5}), hashes)).second);
}

TEST(Identity, LooksIntoFilesAndNotAtTheirNames) {
    const testing::ScratchFolder scratch;
    std::filesystem::create_directory(scratch / "a");
    std::filesystem::create_directory(scratch / "b");
    const auto identity = [&](const char* folder, const char* contents) {
        const std::string text =
            "[particles]\nfile = \"rock.dat\"\n[loading]\nkind = \"tension\"\nmax_axial_strain = 1e-3\n";
        testing::write_text(scratch / folder / "case.toml", text);
        testing::write_text(scratch / folder / "rock.dat", contents);
        FileHashes hashes;
        return identity_of(read_case(scratch / folder / "case.toml"), hashes);
    };
    EXPECT_EQ(identity("a", "1 2 3"), identity("b", "1 2 3"));
    EXPECT_NE(identity("a", "1 2 3"), identity("b", "1 2 4"));
}

TEST(KeysOfRock, LeaveOutSeedsLoadingAndWhatIsWritten) {
    const testing::ScratchFolder scratch;
    const CaseFiles files(testing::write_packed_case(scratch / "case.toml"));
    FileHashes hashes;
    const auto asked = keys_of_rock(files.with({}), hashes);
    EXPECT_EQ(asked.at("material.friction_angle"), "27");
    for (const auto& [key, value] :
         std::vector<std::pair<std::string, CaseValue>>{{"title", std::string("Another")},
                                                        {"packing.seed", std::int64_t{2}},
                                                        {"loading.kind", std::string("compression")},
                                                        {"loading.max_axial_strain", 0.5},
                                                        {"numerics.threads", std::int64_t{2}},
                                                        {"output.curve_rows", std::int64_t{201}}})
        EXPECT_EQ(keys_of_rock(with(files, key, value), hashes), asked) << key;
    for (const auto& [key, value] :
         std::vector<std::pair<std::string, CaseValue>>{{"packing.count", std::int64_t{61}},
                                                        {"material.friction_angle", 27.000000001},
                                                        {"numerics.integrator", std::string("consistent")},
                                                        {"bond.thick", 1e-5}})
        EXPECT_NE(keys_of_rock(with(files, key, value), hashes), asked) << key;
}

/// A particle file defines the material unless the case states it.
TEST(KeysOfRock, OfParticleFilesCountThemUnlessTheCaseStatesTheMaterial) {
    const testing::ScratchFolder scratch;
    const auto keys = [&](const char* contents, const char* material) {
        testing::write_text(scratch / "rock.dat", contents);
        testing::write_text(
            scratch / "case.toml",
            fmt::format("[particles]\nfile = \"rock.dat\"\n[material]\n{}[loading]\nkind = \"tension\"\n"
                        "max_axial_strain = 1e-3\n",
                        material));
        FileHashes hashes;
        return keys_of_rock(read_case(scratch / "case.toml"), hashes);
    };
    const char* stated =
        "density = 2500.0\nnormal_stiffness = 1e7\nshear_stiffness = 2.5e6\nfriction_angle = 27.0\ndamping_ratio = "
        "0.2\n";
    EXPECT_EQ(keys("1 2 3", stated), keys("1 2 4", stated));
    EXPECT_NE(keys("1 2 3", "density = 2500.0\n"), keys("1 2 4", "density = 2500.0\n"));
    EXPECT_EQ(keys("1 2 3", "density = 2500.0\n"), keys("1 2 3", "density = 2500.0\n"));
}

TEST(Identity, OfThePackingAloneLeavesTheRestOut) {
    const testing::ScratchFolder scratch;
    const CaseFiles files(testing::write_packed_case(scratch / "case.toml"));
    FileHashes hashes;
    const std::string asked = packing_identity(files.with({}), hashes);
    EXPECT_EQ(packing_identity(with(files, "material.normal_stiffness", 2e7), hashes), asked);
    EXPECT_EQ(packing_identity(with(files, "loading.kind", std::string("compression")), hashes), asked);
    EXPECT_NE(packing_identity(with(files, "packing.seed", std::int64_t{2}), hashes), asked);
    EXPECT_NE(packing_identity(with(files, "packing.mean_overlap", 8e-5), hashes), asked);
}

// The results version covers curves, events and summaries of the small scenes. If they changed without a new version, a
// campaign would mix old and new results.
TEST(Identity, ResultsVersionGoesUpWhenResultsChange) {
    std::string curves;
    const std::string pinned =
        read_file(std::filesystem::path(CRACKLE_SOURCE_DIR) / "tests/same_bytes/pinned_small.csv");
    for (std::size_t at = 0; at < pinned.size();) {
        const std::size_t end = std::min(pinned.find('\n', at), pinned.size());
        const std::string line = pinned.substr(at, end - at);
        at = end + 1;
        if (line.starts_with("deck_")) continue;  // decks are not tests of a rock
        if (line.find("curve.csv") != std::string::npos || line.find("events.csv") != std::string::npos ||
            line.find("summary.json") != std::string::npos)
            curves += line + '\n';
    }
    ASSERT_FALSE(curves.empty());
    fmt::print("  results version {}: {}\n", results_version, sha256(curves));
    EXPECT_EQ(sha256(curves), "b602db81ff025c960053e9c15953afb434534e2d6c5b8919d0dbdd9b20cad287")
        << "results have changed: raise results_version (unless it was a shipped case that changed), and give this "
           "test "
           "the new hash";
    EXPECT_EQ(results_version, 13);
}

}  // namespace
}  // namespace crackle
