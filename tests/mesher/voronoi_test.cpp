// SPDX-License-Identifier: GPL-3.0-or-later
// Tests Voronoi cells: they fill the domain exactly, contain the points nearest to their centre, and are exactly
// `thick` apart.

#include <set>

#include "tests/mesher/centres.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

MeshRequest voronoi(double thick) {
    MeshRequest request;
    request.mesh_gap = thick;
    return request;
}

TEST(Voronoi, CellAreasSumToTheDomains) {
    for (const auto& specimen : testing::specimens()) {
        SCOPED_TRACE(specimen.name);
        const Mesh mesh = make_mesh(specimen.centres, specimen.domain, voronoi(0.0));
        // Far from the origin, the round-off of a position is epsilon times its coordinate; that of an area is this
        // value times the spacing.
        EXPECT_TRUE(
            agrees("area of " + specimen.name, testing::sum_of_areas(mesh), testing::area_of(specimen.domain), 1e-12));
        EXPECT_TRUE(agrees("reported", mesh.report.area_before_inset, testing::area_of(specimen.domain), 1e-12));
    }
}

TEST(Voronoi, NoCellIsLostAndAllAreConvex) {
    for (const auto& specimen : testing::specimens()) {
        SCOPED_TRACE(specimen.name);
        const Mesh mesh = make_mesh(specimen.centres, specimen.domain, voronoi(0.0));
        ASSERT_EQ(mesh.cells.size(), specimen.centres.size());
        for (std::size_t k = 0; k < mesh.cells.size(); ++k) EXPECT_EQ(mesh.cells[k].centre, static_cast<int>(k));
        EXPECT_TRUE(testing::convex_and_counter_clockwise(mesh, testing::scale_of(specimen.domain)));
    }
}

TEST(Voronoi, EveryPointLiesInTheCellOfItsNearestSeed) {
    for (const auto& specimen : testing::specimens()) {
        if (specimen.centres.size() > 1300) continue;
        SCOPED_TRACE(specimen.name);
        const Mesh mesh = make_mesh(specimen.centres, specimen.domain, voronoi(0.0));
        const double slack = 1e-11 * testing::scale_of(specimen.domain);
        for (const Point& p : testing::random_seeds(400, specimen.domain, 77)) {
            std::size_t nearest = 0;
            const auto distance = [&](std::size_t k) {
                return std::hypot(specimen.centres[k].x - p.x, specimen.centres[k].y - p.y);
            };
            for (std::size_t k = 1; k < specimen.centres.size(); ++k)
                nearest = distance(k) < distance(nearest) ? k : nearest;
            const auto corners = mesh.outline(mesh.cells[nearest]);
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const Point a = corners[k], b = corners[(k + 1) % corners.size()];
                EXPECT_GE(testing::cross(a, b, p) / std::hypot(b.x - a.x, b.y - a.y), -slack)
                    << "seed " << nearest << ", edge " << k;
            }
        }
    }
}

TEST(Voronoi, EdgesHalveAndAreOrthogonalToTheirDelaunayDuals) {
    for (const auto& specimen : testing::specimens()) {
        SCOPED_TRACE(specimen.name);
        const Mesh mesh = make_mesh(specimen.centres, specimen.domain, voronoi(0.0));
        const testing::EdgeTable table(mesh);
        double slant = 0.0, off_middle = 0.0;
        int interfaces = 0, unmatched = 0;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            const auto corners = mesh.outline(mesh.cells[c]);
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const Point a = corners[k], b = corners[(k + 1) % corners.size()];
                const int other = table.beyond(a, b);
                if (other < 0) {
                    unmatched += testing::on_one_side(a, b, specimen.domain) ? 0 : 1;
                    continue;
                }
                ++interfaces;
                const CellCentre s = specimen.centres[c], t = specimen.centres[static_cast<std::size_t>(other)];
                const double apart = std::hypot(t.x - s.x, t.y - s.y);
                slant = std::max(slant, std::abs((b.x - a.x) * (t.x - s.x) + (b.y - a.y) * (t.y - s.y)) / apart);
                for (const Point& p : {a, b}) {
                    off_middle = std::max(off_middle, std::abs((p.x - 0.5 * (s.x + t.x)) * (t.x - s.x) +
                                                               (p.y - 0.5 * (s.y + t.y)) * (t.y - s.y)) /
                                                          apart);
                }
            }
        }
        // The tolerance is for lengths across the bisector, because in a badly shaped triangle the round-off of the
        // circumcentre is multiplied.
        const double tolerance = 1e-11 * testing::scale_of(specimen.domain);
        EXPECT_TRUE(within("slant of Voronoi edges of " + specimen.name, slant, 0.0, tolerance));
        EXPECT_TRUE(within("their distance from the middle", off_middle, 0.0, tolerance));
        const bool on_walls = std::any_of(specimen.centres.begin(), specimen.centres.end(), [&](CellCentre s) {
            return s.x == specimen.domain.x1 || s.x == specimen.domain.x2 || s.y == specimen.domain.y1 ||
                   s.y == specimen.domain.y2;
        });
        if (!on_walls) {
            EXPECT_EQ(unmatched, 0) << "edges that are neither shared nor on a wall";
        }
        if (specimen.centres.size() > 1 && !on_walls) {
            EXPECT_GT(interfaces, 0);
        }
    }
}

TEST(Voronoi, FacingGapsEqualThick) {
    const Rectangle domain{-0.3, 0.4, 0.1, 1.5};
    for (const double thick : {1e-3, 4e-3}) {
        const auto centres = testing::lattice(14, 28, domain, 0.7, 3);
        const Mesh whole = make_mesh(centres, domain, voronoi(0.0));
        const Mesh apart = make_mesh(centres, domain, voronoi(thick));
        ASSERT_EQ(apart.cells.size(), centres.size());
        EXPECT_TRUE(testing::convex_and_counter_clockwise(apart, 1.5));
        const testing::GapCheck check = testing::check_gaps(whole, apart, domain, thick);
        EXPECT_GT(check.interfaces, 1500);
        EXPECT_GT(check.faces, 70);
        EXPECT_TRUE(within(fmt::format("worst departure from the gap {} over {} interfaces", thick, check.interfaces),
                           check.worst, 0.0, 1e-14));
    }
}

TEST(Voronoi, InsetOverridesThick) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    const auto centres = testing::lattice(10, 10, domain, 0.5);
    MeshRequest request = voronoi(1e-3);
    request.inset = 2e-3;
    const Mesh mesh = make_mesh(centres, domain, request);
    EXPECT_EQ(mesh.corners, make_mesh(centres, domain, voronoi(4e-3)).corners);
    EXPECT_NE(mesh.corners, make_mesh(centres, domain, voronoi(1e-3)).corners);
}

TEST(Voronoi, SquareLatticeHasFourCorneredCells) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    for (const double jitter : {0.0, 1e-13}) {
        const Mesh mesh = make_mesh(testing::lattice(30, 30, domain, jitter), domain, voronoi(1e-3));
        EXPECT_EQ(mesh.report.segments, 4 * 900) << "jitter " << jitter;
        EXPECT_TRUE(agrees("shortest edge", mesh.report.shortest_edge, 1.0 / 30 - 1e-3, 1e-9));
        EXPECT_TRUE(agrees("smallest angle", mesh.report.smallest_angle, 90.0, 1e-9));
        EXPECT_TRUE(agrees("area after the inset", mesh.report.area_after_inset,
                           900 * (1.0 / 30 - 1e-3) * (1.0 / 30 - 1e-3), 1e-9));
    }
}

TEST(Voronoi, SidesAreThoseOfTheDomain) {
    const Rectangle domain{0.0, 2.0, 0.0, 1.0};
    const Mesh mesh = make_mesh(testing::lattice(6, 3, domain, 0.3), domain, voronoi(1e-3));
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 6; ++i) {
            const Cell& cell = mesh.cells[static_cast<std::size_t>(6 * j + i)];
            EXPECT_EQ(cell.on_left(), i == 0);
            EXPECT_EQ(cell.on_right(), i == 5);
            EXPECT_EQ(cell.on_bottom(), j == 0);
            EXPECT_EQ(cell.on_top(), j == 2);
        }
    }
}

TEST(Voronoi, SameSeedsSameBytes) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    const auto centres = testing::random_seeds(2000, domain, 4);
    const Mesh once = make_mesh(centres, domain, voronoi(1e-6)), again = make_mesh(centres, domain, voronoi(1e-6));
    EXPECT_EQ(once.corners, again.corners);
    for (std::size_t k = 0; k < once.cells.size(); ++k)
        EXPECT_EQ(once.cells[k].first_corner, again.cells[k].first_corner);
}

TEST(Voronoi, OrderOfSeedsChangesTheirNumbersOnly) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    const auto centres = testing::random_seeds(300, domain, 4);
    const std::vector<CellCentre> reversed(centres.rbegin(), centres.rend());
    const Mesh one = make_mesh(centres, domain, voronoi(1e-5)), other = make_mesh(reversed, domain, voronoi(1e-5));
    double worst = 0.0;
    for (std::size_t k = 0; k < centres.size(); ++k) {
        const auto a = one.outline(one.cells[k]), b = other.outline(other.cells[centres.size() - 1 - k]);
        ASSERT_EQ(a.size(), b.size());
        worst = std::max(worst, std::abs(testing::area_of(a) - testing::area_of(b)));
    }
    EXPECT_TRUE(within("largest change of a cell's area", worst, 0.0, 1e-15));
}

TEST(Voronoi, MirroredSeedsGiveMirroredCells) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    const auto centres = testing::random_seeds(300, domain, 8);
    std::vector<CellCentre> mirrored;
    for (const CellCentre& s : centres) mirrored.push_back({1.0 - s.x, s.y});
    const Mesh one = make_mesh(centres, domain, voronoi(1e-5)), other = make_mesh(mirrored, domain, voronoi(1e-5));
    double worst = 0.0;
    for (std::size_t k = 0; k < centres.size(); ++k) {
        EXPECT_EQ(one.cells[k].on_left(), other.cells[k].on_right());
        worst = std::max(worst, std::abs(testing::area_of(one.outline(one.cells[k])) -
                                         testing::area_of(other.outline(other.cells[k]))));
    }
    EXPECT_TRUE(within("largest change of a cell's area", worst, 0.0, 1e-14));
}

TEST(Voronoi, MergingLeavesNeighboursInPlaceOfADestroyedCell) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    auto centres = testing::lattice(10, 10, domain, 0.3);
    centres.push_back({centres[44].x + 1e-4, centres[44].y});  // the cells of both are 5e-2 long and half as wide
    centres.push_back({centres[44].x - 1e-4, centres[44].y});  // leaves 44 a cell 1e-4 wide
    MeshRequest request = voronoi(1e-3);
    EXPECT_THROW(make_mesh(centres, domain, request), MeshError);
    request.merge_destroyed = true;
    const Mesh mesh = make_mesh(centres, domain, request);
    EXPECT_EQ(mesh.cells.size(), centres.size() - 1);
    EXPECT_EQ(mesh.report.cells_destroyed, 1);
    EXPECT_TRUE(agrees("area", mesh.report.area_before_inset, 1.0, 1e-12));
    std::set<int> left;
    for (const Cell& cell : mesh.cells) left.insert(cell.centre);
    EXPECT_FALSE(left.contains(44));
    EXPECT_TRUE(left.contains(101));
    EXPECT_TRUE(testing::convex_and_counter_clockwise(mesh, 1.0));
}

}  // namespace
}  // namespace crackle
