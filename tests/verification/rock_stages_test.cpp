// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the guide's rock (part II) with the script for users: stages by renaming files, three kinds of particle, two
// kinds of loading. The small variant has fewer circles and steps. The complete variant is as shipped, compared with
// the guide's numbers and those in specimens/demseg/rock_packing/README.md.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "solver/demseg/geometry.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using namespace testing;

struct Stages {
    const char *kind, *law;
};

std::string name_of(const ::testing::TestParamInfo<Stages>& info) {
    return std::string(info.param.kind) + "_" + info.param.law;
}

/// Output of `figures` for a folder, by the first words of its lines.
std::map<std::string, std::vector<double>> figures_of(const fs::path& deck, const fs::path& out) {
    const fs::path file = out / "figures.txt";
    EXPECT_EQ(
        std::system(fmt::format("'{}' '{}' > '{}'", (deck / "figures").string(), out.string(), file.string()).c_str()),
        0);
    std::map<std::string, std::vector<double>> figures;
    std::istringstream text(read_file(file));
    for (std::string line; std::getline(text, line);) {
        fmt::print("  {}\n", line);
        std::istringstream words(line);
        std::string first;
        words >> first;
        for (std::string word; words >> word;) {
            char* end = nullptr;
            const double value = std::strtod(word.c_str(), &end);
            if (end != word.c_str()) figures[first].push_back(value);
        }
    }
    return figures;
}

void run_stages(const fs::path& deck, const fs::path& out, const Stages& stages, const std::string& environment = "") {
    const std::string call = fmt::format("{} '{}' '{}' '{}' {} {}", environment, (deck / "run_stages").string(),
                                         CRACKLE_PROGRAM, out.string(), stages.kind, stages.law);
    ASSERT_EQ(std::system(call.c_str()), 0) << call;
}

/// Forces in x on the two plates, one row per output: step, left, right.
Rows forces_on_plates(const fs::path& part) {
    const Rows rows = read_rows(part / "f-d_curve.dat");
    Rows pairs;
    for (std::size_t k = 0; k + 1 < rows.size(); k += 2) {
        EXPECT_EQ(rows[k][0], rows[k + 1][0]);
        pairs.push_back({rows[k][0], rows[k][2], rows[k + 1][2]});
    }
    return pairs;
}

double largest_force(const fs::path& part) {
    double largest = 0.0;
    for (const auto& row : forces_on_plates(part)) largest = std::max({largest, std::abs(row[1]), std::abs(row[2])});
    return largest;
}

/// Checks that apply to a round trip of any size.
void expect_round_trip(const fs::path& out, const Stages& stages) {
    const fs::path specimen = out / "specimen", pulled = out / "pulled", squeezed = out / "squeezed";
    // After bonding the specimen is free of stress: forces on the plates are only round-off compared with later forces.
    const double strength = largest_force(pulled);
    EXPECT_TRUE(within("largest force on a plate before loading, over the largest when pulled",
                       largest_force(specimen) / strength, 0.0, 1e-3));
    EXPECT_GT(largest_force(squeezed), strength) << "rock is stronger in compression";
    // The left plate is held, and the right one moves the full distance.
    for (const auto& [part, sign] : {std::pair{pulled, 1.0}, {squeezed, -1.0}}) {
        const Rows rows = read_rows(part / "f-d_curve.dat");
        ASSERT_GE(rows.size(), 200U);
        EXPECT_EQ(rows.front()[3], rows[rows.size() - 2][3]);
        EXPECT_GT(sign * (rows.back()[3] - rows[1][3]), 0.0);
        // A break may throw the specimen against a plate, so only forces in the direction of loading count.
        double left = 0.0, right = 0.0;
        for (const auto& row : forces_on_plates(part)) {
            left = std::max(left, sign * row[1]);
            right = std::max(right, -sign * row[2]);
        }
        EXPECT_GT(left, 0.5 * right) << "the work of the right plate passes through the specimen";
    }
    // Contacts of circles are identified by two columns, those that involve a segment by four.
    const Scene scene = read_geometry(specimen / "in_gm.dat");
    std::map<int, bool> circle;
    for (const Body& body : scene.bodies) circle[body.id] = body.circle_count == 1;
    std::map<std::size_t, int> lists;
    const Rows bonds = read_rows(specimen / "in_cf0.dat");
    std::size_t left = 0;
    int body = 0;
    for (const auto& row : bonds) {
        if (left == 0) {
            body = static_cast<int>(row[0]);
            left = static_cast<std::size_t>(row[1]);
            continue;
        }
        --left;
        ASSERT_EQ(row.size(), circle[body] && circle[static_cast<int>(row[0])] ? 2U : 4U);
        ASSERT_LT(row[1], 0.0);
        ++lists[row.size()];
    }
    EXPECT_EQ(lists[2] > 0, std::string(stages.kind) == "circles");
    EXPECT_GT(lists[4], 0) << "plates are bonded";
    // The specimen separates in tension.
    const Rows forces = forces_on_plates(pulled);
    EXPECT_LT(std::abs(forces.back()[1]), 0.5 * strength);
}

void replace(const fs::path& file, const std::string& old_text, const std::string& new_text) {
    std::string text = read_file(file);
    const std::size_t at = text.find(old_text);
    ASSERT_NE(at, std::string::npos) << file << ": " << old_text;
    std::ofstream(file) << text.replace(at, old_text.size(), new_text);
}

/// A smaller box with the same void ratio. With so few circles the pressure is higher, and which of them jam is random.
void copy_small_deck(const fs::path& deck) {
    fs::copy(shipped_deck("rock_packing"), deck);
    replace(deck / "in_gm.dat", "\n0.0d0 96.89d0 0.0d0 48.44d0 0.1d0\n", "\n0.0d0 40.0d0 0.0d0 20.0d0 0.1d0\n");
}

class SmallRock : public ::testing::TestWithParam<Stages> {};

TEST_P(SmallRock, GoesRoundByRenaming) {
    const ScratchFolder scratch;
    const fs::path deck = scratch / "deck", out = scratch / "out";
    copy_small_deck(deck);
    run_stages(deck, out, GetParam(), "STEPS=10000");
    figures_of(deck, out);
    expect_round_trip(out, GetParam());
}

// The test with plates that consist of one segment, the inner side of the box: a corner passes through, and the error
// message is correct.
TEST(GuideRock, APlateOfOneSegmentLetsACornerThrough) {
    const ScratchFolder scratch;
    const fs::path deck = scratch / "deck", out = scratch / "out", err = scratch / "err.txt";
    copy_small_deck(deck);
    replace(deck / "run_stages", "echo \"$1 1 4\"", "echo \"$1 1 1\"");
    replace(deck / "run_stages",
            R"sh(1 "$2" "$4" "$3" "$4"  2 "$3" "$4" "$3" "$5"  3 "$3" "$5" "$2" "$5"  4 "$2" "$5" "$2" "$4")sh",
            R"sh(1 "$x" "$4" "$x" "$5")sh");
    replace(deck / "run_stages", "plate() {\n", "plate() {\n  if [ \"$1\" = \"$left\" ]; then x=$3; else x=$2; fi\n");
    const int ended =
        std::system(fmt::format("STEPS=10000 '{}' '{}' '{}' voronoi 2> '{}'", (deck / "run_stages").string(),
                                CRACKLE_PROGRAM, out.string(), err.string())
                        .c_str());
    EXPECT_EQ(WEXITSTATUS(ended), 3);
    const std::string printed = read_file(err);
    fmt::print("  {}", printed);
    EXPECT_NE(printed.find("it went through segment 1 of body"), std::string::npos);
    EXPECT_NE(printed.find("four segments that form a closed box"), std::string::npos);
}

constexpr Stages kinds[] = {{"circles", "rounded"}, {"delaunay", "rounded"}, {"voronoi", "rounded"}};
INSTANTIATE_TEST_SUITE_P(GuideRock, SmallRock, ::testing::ValuesIn(kinds), name_of);

TEST(GuideRock, ItsPackingMakesTheGuides537Triangles) {
    const ScratchFolder scratch;
    const fs::path out = scratch / "out";
    ASSERT_EQ(
        std::system(
            fmt::format("'{0}' run -q '{1}' -o '{2}' && '{0}' mesh -q '{2}/new_in_gm.dat' --boundary centres -o '{2}'",
                        CRACKLE_PROGRAM, shipped_deck("rock_packing").string(), out.string())
                .c_str()),
        0);
    const Scene triangles = read_geometry(out / "in_gm_tri.dat"), cells = read_geometry(out / "in_gm_volo.dat");
    EXPECT_EQ(triangles.bodies.size(), 537U);
    EXPECT_EQ(triangles.vertices.size(), 1611U);
    EXPECT_EQ(triangles.thick, 0.1) << "of the deck";
    EXPECT_EQ(cells.bodies.size(), 304U);
}

class WholeRock : public ::testing::TestWithParam<Stages> {};

TEST_P(WholeRock, ComesToTheFiguresOfItsPage) {
    const ScratchFolder scratch;
    const fs::path deck = shipped_deck("rock_packing"), out = scratch / "out";
    run_stages(deck, out, GetParam());
    const auto figures = figures_of(deck, out);
    expect_round_trip(out, GetParam());
    const std::string printed = read_file(out / "figures.txt");
    EXPECT_NE(read_file(deck / "README.md").find(printed), std::string::npos) << printed;
    // The guide's mean back-tensions are 0.774 kN (circles) and 0.753 kN (triangles). Packings of this size have a
    // larger scatter.
    EXPECT_TRUE(agrees("mean back-tension, kN", figures.at("mean").at(0), 0.77, 0.06));
}

INSTANTIATE_TEST_SUITE_P(Whole, WholeRock, ::testing::ValuesIn(kinds), name_of);

}  // namespace
}  // namespace crackle
