// SPDX-License-Identifier: GPL-3.0-or-later
// Tests Delaunay triangles: empty circumcircles, the guide's number of triangles, flat faces on request, and gaps of
// exactly `thick`.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <set>
#include <tuple>
#include <vector>

#include "mesher/partition.hpp"
#include "tests/mesher/centres.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

MeshRequest delaunay(Boundary boundary, double thick) {
    MeshRequest request;
    request.kind = MeshKind::delaunay;
    request.boundary = boundary;
    request.mesh_gap = thick;
    return request;
}

/// Number of centres along the outer chain, counting repetitions where it touches itself. It equals the number of
/// Voronoi edges that end on the boundary.
int chain_length(const std::vector<CellCentre>& centres, const Rectangle& domain) {
    const Mesh cells = make_mesh(centres, domain, MeshRequest{});
    std::set<std::pair<double, double>> ends;
    for (const Point& p : cells.corners) {
        const bool x = p.x == domain.x1 || p.x == domain.x2, y = p.y == domain.y1 || p.y == domain.y2;
        if (x != y) ends.insert({p.x, p.y});
    }
    return static_cast<int>(ends.size());
}

TEST(DelaunayOfSeeds, CountIsTwoNMinusTwoMinusH) {
    for (const int count : {10, 304, 2000}) {
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const Rectangle domain{0.0, 0.7, 0.0, 1.4};
            const auto centres = testing::random_seeds(count, domain, seed);
            const Mesh mesh = make_mesh(centres, domain, delaunay(Boundary::centres, 0.0));
            const int h = chain_length(centres, domain);
            EXPECT_EQ(mesh.report.cells, 2 * count - 2 - h) << count << " centres, " << h << " on the chain";
            EXPECT_EQ(mesh.report.segments, 3 * mesh.report.cells);
        }
    }
}

TEST(DelaunayOfSeeds, TheGuidesSpecimenHasAboutItsTriangles) {
    // 304 centres distributed as in a packing give 537 triangles, so 69 centres are on the chain.
    const Rectangle domain{0.0, 0.63, 0.0, 1.26};
    const auto centres = testing::lattice(12, 25, domain, 0.5, 2);
    const Mesh mesh = make_mesh(centres, domain, delaunay(Boundary::centres, 0.0));
    EXPECT_TRUE(agrees("triangles of 300 centres against the guide's share", static_cast<double>(mesh.report.cells),
                       300 * 537.0 / 304, 0.02));
}

/// Coordinates and centre of each point, sorted.
std::vector<std::tuple<double, double, int>> numbered_points(const Triangles& triangles) {
    std::vector<std::tuple<double, double, int>> all;
    for (std::size_t k = 0; k < triangles.points.size(); ++k)
        all.emplace_back(triangles.points[k].x, triangles.points[k].y, triangles.centre_of.at(k));
    std::ranges::sort(all);
    return all;
}

TEST(DelaunayOfSeeds, PointsAloneAreThoseOfTheTriangles) {
    const std::function<bool()> never;
    Patience patience(never);
    for (const auto& specimen : testing::specimens()) {
        const Triangles whole = delaunay_triangles(specimen.centres, specimen.domain, Boundary::domain, patience);
        const Triangles alone = delaunay_points(specimen.centres, specimen.domain, patience);
        SCOPED_TRACE(specimen.name);
        EXPECT_EQ(numbered_points(alone), numbered_points(whole));
    }
}

TEST(DelaunayOfSeeds, CircumcirclesAreEmptyAndCentredInTheDomain) {
    for (const auto& specimen : testing::specimens()) {
        if (specimen.centres.size() < 50 || specimen.centres.size() > 1300 ||
            specimen.name.find("line") != std::string::npos)
            continue;
        SCOPED_TRACE(specimen.name);
        const Mesh mesh = make_mesh(specimen.centres, specimen.domain, delaunay(Boundary::centres, 0.0));
        ASSERT_FALSE(mesh.cells.empty());
        const double scale = testing::scale_of(specimen.domain);
        for (const Cell& cell : mesh.cells) {
            const Point a = specimen.centres[static_cast<std::size_t>(cell.centres[0])];
            const Point b = specimen.centres[static_cast<std::size_t>(cell.centres[1])];
            const Point c = specimen.centres[static_cast<std::size_t>(cell.centres[2])];
            const double d = 2.0 * testing::cross(a, b, c);
            ASSERT_GT(d, 0.0);
            const double b2 = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y),
                         c2 = (c.x - a.x) * (c.x - a.x) + (c.y - a.y) * (c.y - a.y);
            const Point o{a.x + ((c.y - a.y) * b2 - (b.y - a.y) * c2) / d,
                          a.y + ((b.x - a.x) * c2 - (c.x - a.x) * b2) / d};
            const double radius = std::hypot(o.x - a.x, o.y - a.y), slack = 1e-9 * scale;
            EXPECT_TRUE(o.x > specimen.domain.x1 - slack && o.x < specimen.domain.x2 + slack &&
                        o.y > specimen.domain.y1 - slack && o.y < specimen.domain.y2 + slack);
            for (const CellCentre& s : specimen.centres) EXPECT_GT(std::hypot(s.x - o.x, s.y - o.y), radius - slack);
        }
    }
}

TEST(DelaunayOfTheDomain, AreasSumToTheDomainsAndTrianglesAreConvex) {
    for (const auto& specimen : testing::specimens()) {
        if (specimen.name == "hardly off the wall") continue;  // no triangle is possible, see MeshRefusal
        SCOPED_TRACE(specimen.name);
        const Mesh mesh = make_mesh(specimen.centres, specimen.domain, delaunay(Boundary::domain, 0.0));
        EXPECT_TRUE(
            agrees("area of " + specimen.name, testing::sum_of_areas(mesh), testing::area_of(specimen.domain), 1e-12));
        EXPECT_TRUE(agrees("reported", mesh.report.area_before_inset, testing::area_of(specimen.domain), 1e-12));
        EXPECT_TRUE(testing::convex_and_counter_clockwise(mesh, testing::scale_of(specimen.domain)));
    }
}

TEST(DelaunayOfTheDomain, EverySeedIsACornerAndFacesAreFlat) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    const auto centres = testing::random_seeds(400, domain, 12);
    const Mesh mesh = make_mesh(centres, domain, delaunay(Boundary::domain, 0.0));
    std::set<int> used;
    std::set<std::pair<double, double>> added;
    double face = 0.0;
    for (const Cell& cell : mesh.cells) {
        const auto corners = mesh.outline(cell);
        for (std::size_t k = 0; k < 3; ++k) {
            used.insert(cell.centres[k]);
            const Point a = corners[k], b = corners[(k + 1) % 3];
            if (cell.centres[k] < 0) added.insert({a.x, a.y});
            if (testing::on_one_side(a, b, domain)) face += std::hypot(b.x - a.x, b.y - a.y);
        }
    }
    EXPECT_EQ(used.size(), centres.size() + 1);  // includes -1
    EXPECT_TRUE(agrees("length of the faces", face, 4.0, 1e-12));
    // Each centre whose Voronoi cell has an edge on a wall is projected onto it; the four corners are added.
    const Mesh cells = make_mesh(centres, domain, MeshRequest{});
    std::set<std::pair<double, double>> feet{{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    for (const Cell& cell : cells.cells) {
        const CellCentre s = centres[static_cast<std::size_t>(cell.centre)];
        if (cell.on_left()) feet.insert({0.0, s.y});
        if (cell.on_right()) feet.insert({1.0, s.y});
        if (cell.on_bottom()) feet.insert({s.x, 0.0});
        if (cell.on_top()) feet.insert({s.x, 1.0});
    }
    EXPECT_EQ(added, feet);
    const auto n = static_cast<std::int64_t>(centres.size() + added.size()),
               h = static_cast<std::int64_t>(added.size());
    EXPECT_EQ(mesh.report.cells, 2 * n - 2 - h);
}

TEST(DelaunayOfTheDomain, FacingGapsEqualThick) {
    const Rectangle domain{-0.3, 0.4, 0.1, 1.5};
    const auto centres = testing::lattice(14, 28, domain, 0.5, 3);
    for (const Boundary boundary : {Boundary::domain, Boundary::centres}) {
        const double thick = 1e-3;
        const Mesh whole = make_mesh(centres, domain, delaunay(boundary, 0.0)),
                   apart = make_mesh(centres, domain, delaunay(boundary, thick));
        ASSERT_EQ(whole.cells.size(), apart.cells.size());
        EXPECT_TRUE(testing::convex_and_counter_clockwise(apart, 1.5));
        const testing::GapCheck check = testing::check_gaps(whole, apart, domain, thick);
        EXPECT_GT(check.interfaces, 1900);
        if (boundary == Boundary::domain) {
            EXPECT_GT(check.faces, 80);
        }
        EXPECT_TRUE(within(fmt::format("worst departure from the gap over {} interfaces", check.interfaces),
                           check.worst, 0.0, 1e-13));
    }
}

TEST(DelaunayOfTheDomain, OneSeedGivesEightTriangles) {
    const Mesh mesh =
        make_mesh(std::vector<CellCentre>{{0.3, 0.6}}, {0.0, 1.0, 0.0, 1.0}, delaunay(Boundary::domain, 1e-3));
    EXPECT_EQ(mesh.report.cells, 8);
}

TEST(DelaunayOfTheDomain, SquareLatticeTrianglesAreRight) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    const Mesh mesh = make_mesh(testing::lattice(20, 20, domain, 0.0), domain, delaunay(Boundary::centres, 1e-4));
    EXPECT_EQ(mesh.report.cells, 2 * 19 * 19);
    EXPECT_TRUE(agrees("smallest angle", mesh.report.smallest_angle, 45.0, 1e-9));
}

TEST(Delaunay, SameSeedsSameBytes) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    const auto centres = testing::random_seeds(2000, domain, 4);
    for (const Boundary boundary : {Boundary::domain, Boundary::centres}) {
        const Mesh once = make_mesh(centres, domain, delaunay(boundary, 0.0)),
                   again = make_mesh(centres, domain, delaunay(boundary, 0.0));
        EXPECT_EQ(once.corners, again.corners);
    }
}

TEST(Delaunay, MergingASliverMakesAConvexQuadrangle) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    // Three centres 3 degrees apart on an empty circle form a triangle 6e-4 high, surrounded by well-shaped ones.
    std::vector<CellCentre> centres;
    for (const auto& [radius, degrees] :
         {std::pair{0.45, 87.0}, {0.45, 90.0}, {0.45, 93.0}, {0.47, 200.0}, {0.48, 340.0}, {0.46, 270.0}}) {
        centres.push_back({0.5 + radius * std::cos(degrees * 0.017453292519943295),
                           0.5 + radius * std::sin(degrees * 0.017453292519943295)});
    }
    MeshRequest request = delaunay(Boundary::centres, 0.0);
    const Mesh whole = make_mesh(centres, domain, request);
    request.mesh_gap = 2e-3;
    std::string text;
    try {
        make_mesh(centres, domain, request);
    } catch (const MeshError& error) {
        text = error.what();
        EXPECT_EQ(std::set<int>(error.centres.begin(), error.centres.end()), (std::set<int>{0, 1, 2}));
    }
    EXPECT_NE(text.find("destroyed by the inset of 0.001 (1 cell in all)"), std::string::npos) << text;
    request.merge_destroyed = true;
    const Mesh merged = make_mesh(centres, domain, request);
    EXPECT_EQ(merged.report.cells, whole.report.cells - 1);
    EXPECT_EQ(merged.report.cells_destroyed, 1);
    EXPECT_TRUE(agrees("area", merged.report.area_before_inset, whole.report.area_before_inset, 1e-14));
    EXPECT_TRUE(testing::convex_and_counter_clockwise(merged, 1.0));
    EXPECT_TRUE(
        std::any_of(merged.cells.begin(), merged.cells.end(), [](const Cell& c) { return c.corner_count == 4; }));
}

TEST(Delaunay, MergingRandomSliversKeepsTheArea) {
    const Rectangle domain{0.0, 1.0, 0.0, 1.0};
    const auto centres = testing::random_seeds(1000, domain, 21);
    MeshRequest request = delaunay(Boundary::centres, 6e-4);
    request.merge_destroyed = true;
    const Mesh merged = make_mesh(centres, domain, request);
    const Mesh whole = make_mesh(centres, domain, delaunay(Boundary::centres, 0.0));
    EXPECT_GT(merged.report.cells_destroyed, 0);
    EXPECT_TRUE(agrees("area", merged.report.area_before_inset, whole.report.area_before_inset, 1e-13));
    EXPECT_TRUE(testing::convex_and_counter_clockwise(merged, 1.0));
}

}  // namespace
}  // namespace crackle
