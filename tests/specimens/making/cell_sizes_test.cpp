// SPDX-License-Identifier: GPL-3.0-or-later
// Tests cells of requested sizes: mean and spread of their equivalent diameters, computed again from the polygons'
// areas.

#include "specimens/making/cell_sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/scene/scene.hpp"
#include "specimens/making/make_specimen.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

ResolvedCase cells_case(MeshKind kind, double diameter, double spread, RadiusLaw sizes = RadiusLaw::uniform) {
    ResolvedCase test;
    test.source = parts::Packing{parts::CircleCount{300, 2.0}, parts::MeanOverlap{0.002 * diameter},
                                 parts::CellDiameters{sizes, diameter, spread}, 1};
    test.mesh = parts::Mesh{{}, kind, parts::DerivedGap{}};
    test.material.density = 2500.0;
    test.material.normal_stiffness = 1e7;
    test.material.shear_stiffness = 2.5e6;
    test.material.friction_angle = 27.0;
    test.material.tensile_strength = 1e3;
    test.material.cohesion = 2e3;
    test.bond.law = BondLaw::coulomb;
    return test;
}

/// From the areas of the scene's bodies, which have very small gaps.
CellSizes recounted(const Scene& scene) {
    double sum = 0.0, squares = 0.0;
    for (const Body& body : scene.bodies) {
        const double diameter = std::sqrt(4.0 * mass_properties(scene, body).mass / 2500.0 / std::numbers::pi);
        sum += diameter;
        squares += diameter * diameter;
    }
    const auto n = static_cast<double>(scene.bodies.size());
    return {sum / n, std::sqrt(squares / n - sum * sum / n / n) / (sum / n)};
}

TEST(CellSizes, OfASquareGridAreThoseOfItsSquares) {
    std::vector<CellCentre> centres;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 3; ++j) centres.push_back({0.5 + i, 0.5 + j});
    MeshRequest request;
    request.mesh_gap = 0.1;
    const CellSizes squares = measure_cells(make_mesh(centres, {0.0, 4.0, 0.0, 3.0}, request));
    EXPECT_TRUE(agrees("equivalent diameter of a unit square", squares.mean, 2.0 / std::sqrt(std::numbers::pi), 1e-12));
    EXPECT_TRUE(within("spread", squares.spread, 0.0, 1e-7));
}

TEST(CellSizes, AskedForAreReached) {
    struct Asked {
        MeshKind kind;
        RadiusLaw sizes;
        double spread;
    };
    for (const Asked& asked :
         {Asked{MeshKind::voronoi, RadiusLaw::uniform, 0.12}, Asked{MeshKind::voronoi, RadiusLaw::lognormal, 0.24},
          Asked{MeshKind::voronoi, RadiusLaw::lognormal, 0.35}, Asked{MeshKind::delaunay, RadiusLaw::uniform, 0.2},
          Asked{MeshKind::delaunay, RadiusLaw::lognormal, 0.5}}) {
        ResolvedCase test = cells_case(asked.kind, 0.004, asked.spread, asked.sizes);
        test.mesh->gap = parts::MeshGap{4e-9, {}};
        test.mesh->merge_destroyed = true;
        const Specimen specimen = make_specimen(test, {});
        const CellSizes made = recounted(specimen.scene);
        const std::string what = std::string(name_of(asked.kind)) + ", " + name_of(asked.sizes);
        EXPECT_TRUE(agrees(what + ": mean diameter", made.mean, 0.004, 0.003));
        EXPECT_TRUE(within(what + ": spread", made.spread, asked.spread, 0.02));
        double stated[2] = {};
        for (const auto& [name, value] : specimen.packing) {
            if (name == "cell_diameter") stated[0] = value;
            if (name == "cell_spread") stated[1] = value;
        }
        EXPECT_TRUE(agrees(what + ": mean as stated", stated[0], made.mean, 1e-5));
        EXPECT_TRUE(within(what + ": spread as stated", stated[1], made.spread, 1e-5));
    }
}

TEST(CellSizes, InABoxTakeAsManyCirclesAsFillIt) {
    ResolvedCase test = cells_case(MeshKind::voronoi, 0.004, 0.15);
    test.packing()->box = parts::Box{0.06, 0.1};
    const Specimen specimen = make_specimen(test, {});
    EXPECT_TRUE(agrees("width", specimen.width, 0.06, 1e-12));
    const double number = 4.0 * 0.06 * 0.1 / (std::numbers::pi * 0.004 * 0.004 * (1.0 + 0.15 * 0.15));
    EXPECT_TRUE(agrees("cells", static_cast<double>(specimen.scene.bodies.size()), number, 0.01));
}

TEST(CellSizes, OutOfReachAreRefusedWithTheirKey) {
    const auto refusal = [](double spread, RadiusLaw sizes) -> std::string {
        ResolvedCase test = cells_case(MeshKind::voronoi, 0.004, spread, sizes);
        try {
            make_specimen(test, {});
        } catch (const InputError& error) {
            return error.what();
        }
        return "made without complaint";
    };
    EXPECT_NE(refusal(0.02, RadiusLaw::uniform).find("packing.cell_spread: found 0.02, expected 0.037 to 0.211"),
              std::string::npos)
        << refusal(0.02, RadiusLaw::uniform);
    EXPECT_NE(refusal(0.3, RadiusLaw::uniform)
                  .find("expected 0.037 to 0.211 for Voronoi cells made from circles of uniform sizes; "
                        "sizes = \"lognormal\" reaches 0.536"),
              std::string::npos)
        << refusal(0.3, RadiusLaw::uniform);
    for (const RadiusLaw sizes : {RadiusLaw::uniform, RadiusLaw::lognormal})
        EXPECT_NE(refusal(0.6, sizes).find("; 0.536 is the most that packed circles reach"), std::string::npos)
            << refusal(0.6, sizes);
}

TEST(DerivedGap, IsAFiftiethOfTheMeanCellSize) {
    ResolvedCase test = cells_case(MeshKind::voronoi, 0.004, 0.15);
    const Specimen specimen = make_specimen(test, {});
    const double size = std::sqrt(specimen.width * specimen.height / static_cast<double>(specimen.scene.bodies.size()));
    EXPECT_TRUE(agrees("mesh.thick", specimen.mesh_thick, 0.02 * size, 1e-12));
    EXPECT_EQ(specimen.mesh_gap, specimen.mesh_thick);
    test.mesh->gap = parts::MeshGap{4e-5, 2e-5};
    EXPECT_EQ(make_specimen(test, {}).mesh_gap, 4e-5) << "twice the inset, where that is given";
}

}  // namespace
}  // namespace crackle
