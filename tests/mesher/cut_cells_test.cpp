// SPDX-License-Identifier: GPL-3.0-or-later
// Tests Voronoi cells cut by traces that are too close together for rows of cells. Edges must lie on both sides of
// every trace, pieces must be complete and not too small, and trace ends must be where they were requested or reported.

#include "mesher/cut_cells.hpp"

#include "tests/mesher/jointed.hpp"

namespace crackle::cut_cells_test {
namespace {

using testing::agrees;
using testing::check;
using testing::jointed_box;
using testing::length_of;
using testing::Lines;
using testing::packing_like;
using testing::TraceCheck;
using testing::within;

constexpr double spacing = 0.05;  // m, as in packing_like()

MeshRequest cells_with(const Lines& traces, double gap = 0.0) {
    return testing::with_traces(MeshKind::voronoi, traces, gap);
}
/// Two parallel diagonal traces at the given distance.
Lines two_apart(double apart) {
    return {{{0.303, 0.6}, {0.703, 0.9}},
            {{0.303 - 0.6 * apart, 0.6 + 0.8 * apart}, {0.703 - 0.6 * apart, 0.9 + 0.8 * apart}}};
}

TEST(CutCells, HaveEdgesOnBothSidesOfTracesASeventhOfACellApart) {
    int cut = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Lines traces = two_apart(0.15 * spacing);
        const Mesh mesh = make_mesh(packing_like(seed), jointed_box, cells_with(traces));
        if (mesh.report.cells_cut == 0) continue;  // there was space for rows of cells
        ++cut;
        const TraceCheck found = check(mesh, traces);
        EXPECT_TRUE(within("distance of the edges from the traces", found.off_line, 0.0, 2e-12));
        EXPECT_TRUE(within("one side's length less the other's", found.between_sides, 0.0, 1e-9));
        EXPECT_TRUE(agrees("areas", testing::sum_of_areas(mesh), 2.0, 1e-12));
        EXPECT_TRUE(testing::convex_and_counter_clockwise(mesh, 2.0));
    }
    EXPECT_GE(cut, 5);
}

TEST(CutCells, OfCrowdedTracesAreCountedAndNotTooSmall) {
    int cut = 0, fair = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        // A third trace crosses both at a small angle.
        Lines traces = two_apart(0.2 * spacing);
        traces.push_back({{0.3, 0.55}, {0.7, 1.0}});
        try {
            const Mesh mesh = make_mesh(packing_like(seed), jointed_box, cells_with(traces));
            if (mesh.report.cells_cut == 0) continue;
            ++cut;
            double least = 1e300;
            for (const Cell& cell : mesh.cells) least = std::min(least, cell.area);
            EXPECT_GT(least, 0.002 * spacing * spacing) << "if no other way gives a mesh, small pieces remain";
            if (least > 0.02 * spacing * spacing) ++fair;  // rows of cells are at least a fifth of a spacing wide
            double asked = 0.0;
            for (const auto& trace : traces) asked += length_of(trace);
            EXPECT_TRUE(within("length on traces", mesh.report.trace_length, asked,
                               1e-9 + static_cast<double>(mesh.report.ends_moved) * mesh.report.largest_move));
        } catch (const MeshError& error) {
            EXPECT_FALSE(error.traces.empty()) << error.what();
        }
    }
    EXPECT_GE(cut, 3);
    EXPECT_GE(fair, 3);
}

TEST(CutCells, LetMostNetworksOfShortTracesBeMeshed) {
    int meshed = 0, cut = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        std::mt19937_64 generator(seed);
        const auto number = [&] { return static_cast<double>(generator() >> 11) * 0x1.0p-53; };
        Lines traces;
        while (traces.size() < 20) {  // traces are four cells long; about ten fit into the area
            const Point middle{0.1 + 0.8 * number(), 0.1 + 1.8 * number()};
            const double turn = 3.14159 * number(), x = 2.0 * spacing * std::cos(turn),
                         y = 2.0 * spacing * std::sin(turn);
            traces.push_back({{middle.x - x, middle.y - y}, {middle.x + x, middle.y + y}});
        }
        try {
            const Mesh mesh = make_mesh(packing_like(seed), jointed_box, cells_with(traces, 0.02 * spacing));
            ++meshed;
            if (mesh.report.cells_cut > 0) ++cut;
        } catch (const MeshError& error) {
            EXPECT_FALSE(error.traces.empty()) << error.what();
        }
    }
    fmt::print("  {} of 50 meshed, {} of them with cells cut\n", meshed, cut);
    EXPECT_GE(meshed, 30);
    EXPECT_GE(cut, 5);
}

TEST(CutCells, AreRefusedByNameWhereTracesAreAMillionthOfACellApart) {
    try {
        make_mesh(packing_like(1), jointed_box, cells_with(two_apart(1e-6 * spacing)));
        ADD_FAILURE() << "meshed";
    } catch (const MeshError& error) {
        EXPECT_EQ(error.traces, (std::vector<int>{0, 1})) << error.what();
        EXPECT_NE(std::string(error.what()).find("cut off a sliver with only 9.9e-06 of the mean cell"),
                  std::string::npos)
            << error.what();
    }
}

TEST(CutCells, AreTheSameBytesForTheSameInput) {
    int cut = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const auto centres = packing_like(seed);
        const Mesh once = make_mesh(centres, jointed_box, cells_with(two_apart(0.15 * spacing))),
                   again = make_mesh(centres, jointed_box, cells_with(two_apart(0.15 * spacing)));
        EXPECT_EQ(once.corners, again.corners);
        EXPECT_EQ(once.edge_traces, again.edge_traces);
        if (once.report.cells_cut > 0) ++cut;
    }
    EXPECT_GE(cut, 3);
}

}  // namespace
}  // namespace crackle::cut_cells_test
