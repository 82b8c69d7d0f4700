// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that an interrupt ends meshing at any stage.

#include <functional>
#include <optional>

#include "mesher/partition.hpp"
#include "tests/mesher/jointed.hpp"

namespace crackle {
namespace {

struct Request {
    const char* name;
    MeshRequest request;
    // Least number of calls of `interrupted`: 5000 centres are inserted, and their triangles and cells are processed,
    // with one call per thousand units of work.
    int questions;
};

/// One request for each kind of mesh.
std::vector<Request> all_ways() {
    MeshRequest triangles, outlined;
    triangles.kind = outlined.kind = MeshKind::delaunay;
    outlined.outline = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}, {0.0, 2.0}};
    const testing::Lines lines{{{0.1, 0.2}, {0.9, 1.7}}, {{0.2, 1.5}, {0.8, 0.4}}};
    return {{"Voronoi", {}, 24},
            {"Delaunay", triangles, 34},
            {"Delaunay in an outline", outlined, 35},
            {"Voronoi along traces", testing::with_traces(MeshKind::voronoi, lines), 21},
            {"Delaunay along traces", testing::with_traces(MeshKind::delaunay, lines), 36}};
}

/// The mesh, if it is completed before call number `last`, and the number of calls.
std::pair<std::optional<Mesh>, int> meshed(MeshRequest request, int last) {
    int asked = 0;
    request.interrupted = [&] { return ++asked >= last; };
    try {
        return {make_mesh(testing::packing_like(3, 50), testing::jointed_box, request), asked};
    } catch (const MeshInterrupted&) {
        return {std::nullopt, asked};
    }
}

TEST(MeshInterrupt, IsHeardThroughoutAndChangesNothingWhereItDoesNotCome) {
    constexpr int never = 1'000'000;
    for (const Request& way : all_ways()) {
        SCOPED_TRACE(way.name);
        const auto [mesh, questions] = meshed(way.request, never);
        ASSERT_TRUE(mesh.has_value());
        const Mesh unasked = make_mesh(testing::packing_like(3, 50), testing::jointed_box, way.request);
        EXPECT_EQ(mesh->corners, unasked.corners);
        EXPECT_GE(questions, way.questions);
        for (const int last : {1, questions / 2, questions}) {
            const auto [none, asked] = meshed(way.request, last);
            EXPECT_FALSE(none.has_value()) << "of question " << last;
            EXPECT_EQ(asked, last) << "after the first positive answer, no further question is asked";
        }
    }
}

TEST(MeshInterrupt, OnePieceInAThousandAsks) {
    int asked = 0;
    const std::function<bool()> count = [&] { return ++asked > 1'000'000; }, none;
    Patience patience(count), deaf(none);
    for (int k = 0; k < 102'400; ++k) {
        patience.piece();
        deaf.piece();
    }
    EXPECT_EQ(asked, 100);
}

}  // namespace
}  // namespace crackle
