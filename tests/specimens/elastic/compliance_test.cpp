// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the compliance under uniform tractions: for square cells, whose faces form columns, and for joint sets by their
// closed form.

#include "specimens/elastic/compliance.hpp"

#include <cmath>
#include <numbers>

#include "tests/support/claim.hpp"
#include "tests/support/jointed_cells.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

using testing::agrees;

testing::JointedCells grid() {
    testing::JointedCells cells;
    cells.columns = 5, cells.rows = 8;
    return cells;
}
Domain box_of(const testing::JointedCells& cells) {
    return {0.0, cells.columns * cells.size, 0.0, cells.rows * cells.size};
}

TEST(ComplianceOfCells, IsThatOfTheirColumns) {
    const testing::JointedCells cells = grid();
    const Compliance s = compliance_of(jointed_world(cells), box_of(cells), 0.5 * cells.thick);
    // The outer cells are rigid up to the sides, so there is one face less than cells.
    EXPECT_TRUE(agrees("S_xx, 1/Pa", s[0][0], 4.0 / 5.0 / cells.modulus, 1e-6));
    EXPECT_TRUE(agrees("S_yy, 1/Pa", s[1][1], 7.0 / 8.0 / cells.modulus, 1e-6));
    EXPECT_NEAR(s[0][1], 0.0, 1e-6 / cells.modulus);
    EXPECT_NEAR(s[0][2], 0.0, 1e-6 / cells.modulus);
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < a; ++b) EXPECT_NEAR(s[a][b], s[b][a], 1e-9 / cells.modulus) << "symmetric";
}

TEST(ComplianceOfCells, GrowsByThatOfASetExactlyWhereStressIsUniform) {
    testing::JointedCells cells = grid();
    const Compliance rock = compliance_of(jointed_world(cells), box_of(cells), 0.5 * cells.thick);
    cells.joints.resize(1);
    cells.joints[0].normal_stiffness = 1e11;
    cells.joints[0].shear_stiffness = 4e10;
    cells.above_row = {{1, 0}, {3, 0}, {5, 0}};
    const Compliance jointed = compliance_of(jointed_world(cells), box_of(cells), 0.5 * cells.thick);
    const Compliance set = compliance_of_set(0.0, cells.rows * cells.size / 3.0, 1e11, 4e10);
    EXPECT_TRUE(agrees("S_yy, 1/Pa", jointed[1][1], rock[1][1] + set[1][1], 1e-6));
    EXPECT_TRUE(agrees("S_xx, 1/Pa", jointed[0][0], rock[0][0], 1e-6));
    EXPECT_TRUE(agrees("shear, 1/Pa", jointed[2][2], rock[2][2] + set[2][2], 1e-6));
}

TEST(ComplianceOfCells, NeedsEdgesOnEverySide) {
    const testing::JointedCells cells = grid();
    const World world = jointed_world(cells);
    Domain box = box_of(cells);
    box.x2 += cells.size;
    EXPECT_NE(testing::refusal([&] {
                  compliance_of(world, box, 0.5 * cells.thick);
              }).find("found no edges on the right side"),
              std::string::npos);
}

TEST(ComplianceOfASet, AgreesWithItsClosedFormAlongAnyLoad) {
    constexpr double spacing = 0.1, normal = 3e11, shear = 5e10;
    for (const double angle : {0.0, 25.0, 90.0, 140.0}) {
        const Compliance s = compliance_of_set(angle * std::numbers::pi / 180.0, spacing, normal, shear);
        // Load along y. The joint normal is at `angle` to y; c and t are the cosine and sine of this angle.
        const double c = std::cos(angle * std::numbers::pi / 180.0), t = std::sin(angle * std::numbers::pi / 180.0);
        EXPECT_NEAR(s[1][1], c * c * c * c / (normal * spacing) + t * t * c * c / (shear * spacing), 1e-24) << angle;
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < a; ++b) EXPECT_NEAR(s[a][b], s[b][a], 1e-24) << "symmetric";
    }
}

}  // namespace
}  // namespace crackle
