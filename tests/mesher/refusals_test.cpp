// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that input from which no mesh can be made is refused with a message that names the cause.

#include <limits>

#include "tests/mesher/centres.hpp"

namespace crackle {
namespace {

const Rectangle unit{0.0, 1.0, 0.0, 1.0};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

MeshError refusal(const std::vector<CellCentre>& centres, const Rectangle& domain, const MeshRequest& request) {
    try {
        make_mesh(centres, domain, request);
    } catch (const MeshError& error) {
        fmt::print("  {}\n", error.what());
        return error;
    }
    return MeshError("no refusal");
}

void expect_text(const MeshError& error, const std::string& text) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
}

TEST(MeshRefusal, NamesBothCoincidentSeeds) {
    auto centres = testing::random_seeds(100, unit, 2);
    centres[70] = centres[13];
    for (const MeshKind kind : {MeshKind::delaunay, MeshKind::voronoi}) {
        MeshRequest request;
        request.kind = kind;
        const MeshError error = refusal(centres, unit, request);
        expect_text(error, "centres 13 and 70 at the same place");
        EXPECT_EQ(error.centres, (std::vector<int>{13, 70}));
    }
    centres[70].x += 1e-14;  // distinct, but no bisector can be computed
    expect_text(refusal(centres, unit, {}), "centres 13 and 70 at the same place");
}

TEST(MeshRefusal, NamesSeedsThatAreNowhereOrOutside) {
    auto centres = testing::random_seeds(5, unit, 2);
    centres[3].y = nan;
    expect_text(refusal(centres, unit, {}), "centre 3 at (");
    centres[3].y = std::numeric_limits<double>::infinity();
    expect_text(refusal(centres, unit, {}), "finite coordinates");
    centres[3].y = 1.0000001;
    const MeshError error = refusal(centres, unit, {});
    expect_text(error, "inside the domain");
    EXPECT_EQ(error.centres, std::vector<int>{3});
}

TEST(MeshRefusal, NoSeedsNoMesh) { expect_text(refusal({}, unit, {}), "no centres"); }

TEST(MeshRefusal, TooFewOrCollinearSeedsHaveNoTriangles) {
    MeshRequest request;
    request.kind = MeshKind::delaunay;
    request.boundary = Boundary::centres;
    expect_text(refusal({{0.5, 0.5}}, unit, request), "1 centre that form");
    expect_text(refusal({{0.5, 0.5}, {0.2, 0.1}}, unit, request), "no triangle");
    expect_text(refusal(testing::lattice(25, 1, unit, 0.0), unit, request), "no triangle");
}

TEST(MeshRefusal, DomainAndLengthsMustMakeSense) {
    const std::vector<CellCentre> centres{{0.5, 0.5}};
    expect_text(refusal(centres, {1.0, 0.0, 0.0, 1.0}, {}), "x1 < x2");
    expect_text(refusal(centres, {0.0, 0.0, 0.0, 1.0}, {}), "x1 < x2");
    expect_text(refusal(centres, {0.0, nan, 0.0, 1.0}, {}), "finite");
    expect_text(refusal(centres, {-1e200, 1e200, -1e200, 1e200}, {}), "choose another unit");
    MeshRequest request;
    request.mesh_gap = -1.0;
    expect_text(refusal(centres, unit, request), "thick: found -1");
    request.mesh_gap = nan;
    expect_text(refusal(centres, unit, request), "thick: found nan");
    request.mesh_gap = 1e-3;
    request.inset = -1e-3;
    expect_text(refusal(centres, unit, request), "inset: found -0.001");
}

TEST(MeshRefusal, SeedsHardlyOffTheWallLeaveNoRoomForATriangle) {
    MeshRequest request;
    request.kind = MeshKind::delaunay;
    expect_text(refusal({{1e-300, 0.4}, {0.5, 0.5}}, unit, request), "destroyed by the inset of 0");
}

TEST(MeshRefusal, NamesTheCellThatTheInsetDestroys) {
    auto centres = testing::lattice(10, 10, unit, 0.2);
    MeshRequest request;
    request.mesh_gap = 0.3;
    const MeshError all = refusal(centres, unit, request);
    expect_text(all, "the cell of centre");
    expect_text(all, "destroyed by the inset of 0.15 (100 cells in all)");
    ASSERT_EQ(all.centres.size(), 1U);
    request.merge_destroyed = true;  // with merging, one cell may grow to the whole domain and survive
    EXPECT_EQ(make_mesh(centres, unit, request).report.cells + make_mesh(centres, unit, request).report.cells_destroyed,
              100);
    request.mesh_gap = 1.2;  // the inset destroys even the whole domain
    expect_text(refusal(centres, unit, request), "destroyed by the inset of 0.6");
}

/// The number that follows some words in a text.
double number_behind(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    return at == std::string::npos ? nan : std::stod(text.substr(at + words.size()));
}

TEST(MeshRefusal, WhatIsAdvisedWorks) {
    const auto centres = testing::random_seeds(100, unit, 2);
    int thinner = 0, merged = 0, other_kind = 0;
    for (const MeshKind kind : {MeshKind::delaunay, MeshKind::voronoi}) {
        for (const bool traced : {false, true}) {
            for (const double depth : {0.02, -0.02, 0.04, -0.04}) {  // requested as an inset, or as half the gap
                const bool by_inset = depth < 0.0;
                MeshRequest request;
                request.kind = kind;
                (by_inset ? request.inset.emplace() : request.mesh_gap) = by_inset ? -depth : 2.0 * depth;
                if (traced) request.traces = {{{0.0, 0.31}, {1.0, 0.62}}, {{0.0, 0.62}, {1.0, 0.4}}};
                const std::string text = refusal(centres, unit, request).what();
                if (text == "no refusal") continue;
                const double most = number_behind(text, by_inset ? "use an inset of " : "set thick to ");
                EXPECT_GT(most, 0.0) << text;
                MeshRequest advised = request;
                (by_inset ? *advised.inset : advised.mesh_gap) = most;
                EXPECT_NO_THROW(make_mesh(centres, unit, advised));
                ++thinner;
                if (text.find("merge the destroyed cells") != std::string::npos) {
                    advised = request;
                    advised.merge_destroyed = true;
                    EXPECT_NO_THROW(make_mesh(centres, unit, advised));
                    ++merged;
                }
                EXPECT_FALSE(traced && kind == MeshKind::voronoi && text.find("merge") != std::string::npos) << text;
                if (text.find("take ") != std::string::npos) {
                    advised = request;
                    advised.kind = kind == MeshKind::voronoi ? MeshKind::delaunay : MeshKind::voronoi;
                    EXPECT_NO_THROW(make_mesh(centres, unit, advised));
                    ++other_kind;
                }
            }
        }
    }
    EXPECT_GE(thinner, 4);
    EXPECT_GE(merged, 2);
    fmt::print("  advised: {} thinner, {} merged, {} of the other kind\n", thinner, merged, other_kind);
}

}  // namespace
}  // namespace crackle
