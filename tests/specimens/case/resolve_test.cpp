// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the resolved form of a case: each alternative has its own type, and defaults are filled in.

#include "specimens/case/resolve.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/case/case_file.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

const std::string rock = R"([material]
density = 2500.0
units = "area"
contact_modulus = 50e9
stiffness_ratio = 2.5
friction_angle = 40.0
tensile_strength = 5e6
cohesion = 15e6
[bond]
law = "coulomb"
[loading]
kind = "compression"
max_axial_strain = 0.01
)";

const std::string packing = R"([packing]
width = 0.3
height = 0.5
radius_min = 0.01
radius_max = 0.02
mean_overlap = 1e-5
)";

ResolvedCase case_with(const std::string& more = "") { return read_case(CaseText{"mine", packing + rock + more}); }

TEST(Resolve, EachAlternativeIsAType) {
    const ResolvedCase test = case_with();
    ASSERT_NE(test.packing(), nullptr);
    EXPECT_EQ(test.packing()->box, (std::variant<parts::Box, parts::CircleCount>(parts::Box{0.3, 0.5})));
    EXPECT_TRUE(std::holds_alternative<parts::MeanOverlap>(test.packing()->target));
    EXPECT_TRUE(std::holds_alternative<UniformRadii>(test.packing()->sizes));
    EXPECT_FALSE(test.mesh || test.confinement || test.bond.random);
    EXPECT_EQ(*test.loading.rate_tolerance(), 0.01);
    EXPECT_EQ(test.loading.axial_strain_rate(), nullptr);

    const ResolvedCase sieved = read_case(
        CaseText{"mine", "[packing]\ncount = 50\nsizes = \"sieve\"\nsieve = \"curve.csv\"\nvoid_ratio = 0.2\n" + rock +
                             "[mesh]\nkind = \"voronoi\"\n"});
    EXPECT_EQ(std::get<parts::CircleCount>(sieved.packing()->box), (parts::CircleCount{50, 2.0}));
    EXPECT_EQ(std::get<parts::VoidRatio>(sieved.packing()->target).value, 0.2);
    EXPECT_EQ(sieved.data_files, std::vector<std::filesystem::path>{"curve.csv"});
    EXPECT_TRUE(std::holds_alternative<parts::DerivedGap>(sieved.mesh->gap));
}

TEST(Resolve, DerivesStiffnessesDampingAndGap) {
    const ResolvedCase test = case_with("[mesh]\nkind = \"voronoi\"\ninset = 2e-4\n");
    EXPECT_EQ(test.material.normal_stiffness, 50e9);
    EXPECT_EQ(test.material.shear_stiffness, 50e9 / 2.5);
    EXPECT_EQ(test.material.damping_ratio, default_damping_ratio);
    EXPECT_TRUE(test.material.damping_by_default);
    EXPECT_EQ(std::get<parts::MeshGap>(test.mesh->gap), (parts::MeshGap{4e-4, 2e-4}));
}

TEST(Resolve, SharesOfMineralsAddUp) {
    const ResolvedCase test = case_with(
        "[[mineral]]\nname = \"a\"\narea_share = 0.3\n[[mineral]]\nname = \"b\"\ncontact_modulus = 90e9\n"
        "[[mineral_pair]]\nbetween = [\"b\", \"a\"]\nfriction_angle = 20\n");
    ASSERT_EQ(test.minerals.list.size(), 2U);
    EXPECT_EQ(test.minerals.list[1].share, 1.0 - 0.3);
    EXPECT_FALSE(test.minerals.list[1].asked);
    EXPECT_EQ(test.minerals.list[1].material.shear_stiffness, 90e9 / 2.5) << "with the ratio of [material]";
    ASSERT_EQ(test.minerals.pairs.size(), 1U);
    EXPECT_EQ(test.minerals.pairs[0].a, 1);
    EXPECT_EQ(test.minerals.pairs[0].b, 0);
}

TEST(Resolve, OnlyUnchangedPartsAreWrittenAsACase) {
    std::ostringstream text;
    const auto refusal_of = [&](auto&& change) {
        ResolvedCase test = case_with();
        change(test);
        return testing::refusal([&] { write_resolved_case(text, test, "."); });
    };
    EXPECT_NE(refusal_of([](ResolvedCase& t) { t.loading.max_axial_strain = 0.02; }).find("changed after its case"),
              std::string::npos);
    EXPECT_NE(refusal_of([](ResolvedCase& t) { t.material.cohesion = 1e6; }).find("changed after its case"),
              std::string::npos);
    EXPECT_NE(refusal_of([](ResolvedCase& t) { t = {}; }).find("not read from a case"), std::string::npos);
    ResolvedCase test = case_with();
    test.numerics.threads = 3;
    test.numerics.allow_unstable = true;
    write_resolved_case(text, test, ".");
    EXPECT_NE(text.str().find("threads = 3"), std::string::npos);
    EXPECT_NE(text.str().find("allow_unstable = true"), std::string::npos);
}

TEST(Resolve, SettingsChangeACaseBeforeItIsResolved) {
    const CaseFiles files(CaseText{"mine", packing + rock});
    const ResolvedCase slow =
        files.with(std::vector<CaseSetting>{{"loading.rate_tolerance", 0.1, "here:1"}}, {.rate = 0.5});
    EXPECT_EQ(*slow.loading.rate_tolerance(), 0.1 * 0.5 * 0.5);
    std::ostringstream text;
    write_resolved_case(text, slow, ".");
    EXPECT_NE(text.str().find("rate_tolerance = 0.025"), std::string::npos) << text.str();
}

TEST(Resolve, AnApertureThatTheGapCannotHoldIsRefused) {
    EXPECT_NE(testing::refusal([] {
                  case_with(
                      "[mesh]\nkind = \"voronoi\"\nthick = 1e-4\n"
                      "[[trace]]\npoints = [0.0, 0.1, 0.3, 0.2]\nbonded = false\naperture = 2e-4\n");
              }).find("trace[1].aperture: found 0.0002 m, expected at most the gap of the mesh, 0.0001 m"),
              std::string::npos);
    EXPECT_NE(testing::refusal([] {
                  case_with(
                      "[mesh]\nkind = \"voronoi\"\nthick = 3e-4\ninset = 5e-5\n"
                      "[[trace]]\npoints = [0.0, 0.1, 0.3, 0.2]\nbonded = false\naperture = 2e-4\n");
              }).find("trace[1].aperture: found 0.0002 m, expected at most the gap of the mesh, 0.0001 m"),
              std::string::npos)
        << "the inset, not thick, determines the distance between faces";
}

}  // namespace
}  // namespace crackle
