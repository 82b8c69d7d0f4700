// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a mesh of a million centres: all cells exist, and areas add up.

#include "tests/mesher/centres.hpp"

namespace crackle {
namespace {

using testing::agrees;

TEST(MillionSeeds, FillTheDomain) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    for (const bool random : {true, false}) {
        const auto centres =
            random ? testing::random_seeds(1'000'000, domain, 1) : testing::lattice(1000, 1000, domain, 0.0);
        for (const MeshKind kind : {MeshKind::voronoi, MeshKind::delaunay}) {
            MeshRequest request;
            request.kind = kind;
            const Mesh mesh = make_mesh(centres, domain, request);
            if (kind == MeshKind::voronoi) {
                EXPECT_EQ(mesh.cells.size(), centres.size());
            }
            EXPECT_TRUE(agrees("area", testing::sum_of_areas(mesh), 1.0, 1e-12));
            EXPECT_TRUE(agrees("reported", mesh.report.area_before_inset, 1.0, 1e-12));
            EXPECT_TRUE(testing::convex_and_counter_clockwise(mesh, 1.0));
        }
    }
}

}  // namespace
}  // namespace crackle
