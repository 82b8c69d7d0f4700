// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the start of a search from targets, against the keys of rocks that were calibrated to them.

#include "specimens/calibration/starting_guess.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "specimens/calibration/rock.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_circles_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::target_text;

class StartingGuess : public ::testing::Test {
  protected:
    /// The tests of a shipped rock, and its compression at 10 MPa.
    static std::string tests_of(const std::string& rock) {
        const std::string folder = std::string(CRACKLE_SOURCE_DIR) + "/specimens/rocks/" + rock;
        return fmt::format(
            "[[test]]\nname = \"compression\"\ncase = \"{0}_compression.toml\"\n"
            "[[test]]\nname = \"tension\"\ncase = \"{0}_tension.toml\"\n"
            "[[test]]\nname = \"confined\"\ncase = \"{0}_compression.toml\"\n"
            "set = {{\"loading.kind\" = \"biaxial\", \"confinement.pressure\" = 10e6}}\n",
            folder);
    }
    static std::string free_text(const std::string& key, double from, double to, const std::string& more = "") {
        return fmt::format("[[free]]\nkey = \"material.{}\"\nfrom = {}\nto = {}\n{}", key, from, to, more);
    }
    Rock rock_of(const std::string& text) const {
        testing::write_text(folder_ / "rock.toml", text);
        return read_rock(folder_ / "rock.toml");
    }

    testing::ScratchFolder scratch_;
    std::filesystem::path folder_ = scratch_ / "";
    const std::string ratio_ = "of = \"material.tensile_strength\"\n";
};

// A search takes steps of a third, so a guess within a factor of 1.5 is one or two rounds away.
TEST_F(StartingGuess, OfStrengthsIsNearTheKeysOfTheShippedRocks) {
    for (const auto& [name, compression, tension] : {std::tuple{"granite", 200e6, 9.3e6},
                                                     {"sandstone", 60e6, 4.0e6},
                                                     {"marble", 85e6, 6.5e6},
                                                     {"faces/granite", 200e6, 9.3e6},
                                                     {"faces/sandstone", 60e6, 4.0e6},
                                                     {"faces/marble", 85e6, 6.5e6}}) {
        const Rock rock = rock_of(tests_of(name) + target_text("compression", "peak_stress", compression) +
                                  target_text("tension", "peak_stress", tension) +
                                  free_text("tensile_strength", 1e5, 1e9) + free_text("cohesion", 1.2, 120, ratio_));
        const std::vector<double> starts = starting_values(rock);
        const parts::Material& calibrated = rock.tests[0].files.with({}).material;
        const double tensile = calibrated.tensile_strength.value(), cohesion = calibrated.cohesion.value();
        EXPECT_TRUE(agrees(std::string(name) + ", tensile strength, Pa", starts[0], tensile, 0.15));
        const double factor = starts[0] * starts[1] / cohesion;
        EXPECT_TRUE(agrees(std::string(name) + ", cohesion, logarithm of the factor less 1",
                           1.0 + std::abs(std::log(factor)), 1.0, std::log(1.5)));
    }
}

TEST_F(StartingGuess, OfFrictionFollowsFromTheStrengthUnderPressure) {
    const std::string keys = free_text("friction_angle", 33, 45);
    // σ1 = p + sqrt(m UCS p + UCS²) with m = 36
    const double strength = 10e6 + std::sqrt(36.0 * 60e6 * 10e6 + 60e6 * 60e6);
    const Rock rock = rock_of(tests_of("sandstone") + target_text("compression", "peak_stress", 60e6) +
                              target_text("confined", "largest_stress", strength) + keys);
    EXPECT_TRUE(agrees("friction angle, degrees", starting_values(rock)[0], 1.1 * 36.0, 1e-8))
        << "the file states the strength with ten digits";
    const Rock weak = rock_of(tests_of("sandstone") + target_text("compression", "peak_stress", 60e6) +
                              target_text("confined", "largest_stress", 90e6) + keys);
    EXPECT_EQ(starting_values(weak)[0], 33.0) << "not below its bound";
}

TEST_F(StartingGuess, OfTheFrictionOfFacesIsNearThatOfTheShippedRocks) {
    for (const auto& [name, ucs, m] :
         {std::tuple{"granite", 200e6, 30.0}, {"sandstone", 60e6, 17.0}, {"marble", 85e6, 9.0}}) {
        const double strength = 10e6 + std::sqrt(m * ucs * 10e6 + ucs * ucs);
        const Rock rock =
            rock_of(tests_of(std::string("faces/") + name) + target_text("compression", "peak_stress", ucs) +
                    target_text("confined", "largest_stress", strength) + free_text("friction_angle", 20, 60));
        const double calibrated = rock.tests[0].files.with({}).material.friction_angle.value();
        EXPECT_TRUE(agrees(std::string(name) + ", friction angle, degrees", starting_values(rock)[0], calibrated, 0.1));
    }
}

TEST_F(StartingGuess, LeavesWhatIsGivenAndWhatIsNotKnown) {
    const std::string targets =
        target_text("compression", "peak_stress", 60e6) + target_text("tension", "peak_stress", 4e6);
    const Rock given =
        rock_of(tests_of("sandstone") + targets + free_text("tensile_strength", 1e6, 1e8, "start = 3e6\n") +
                free_text("cohesion", 0.9, 9, ratio_ + "start = 2\n"));
    EXPECT_EQ(starting_values(given)[0], 3e6);
    EXPECT_EQ(starting_values(given)[1], 2.0);
    const Rock untold = rock_of(tests_of("sandstone") + target_text("compression", "youngs_modulus", 15e9) +
                                free_text("tensile_strength", 1e6, 2e7));
    EXPECT_TRUE(agrees("middle of the bounds, Pa", starting_values(untold)[0], std::sqrt(2e13), 1e-12));
    testing::write_circles_rock(folder_);
    const Rock circles =
        rock_of(testing::circles_tests + target_text("tension", "peak_stress", 4e6) + testing::strength_keys);
    EXPECT_TRUE(agrees("circles start at the middle of the bounds, Pa", starting_values(circles)[0], 1e7, 1e-12));
}

}  // namespace
}  // namespace crackle
