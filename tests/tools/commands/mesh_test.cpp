// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle mesh` as called by a user: what it writes, and its messages for invalid input.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "solver/demseg/geometry.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/program_call.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::Answer;

class CrackleMesh : public testing::ProgramCall {
  protected:
    CrackleMesh() : ProgramCall("mesh") {}

    /// Circles of radius 0.05 on a jittered lattice, two materials.
    void write_packing() const {
        std::string deck = "1 0 0\n1d-4 0 -9.8\n2\n2500 1e7 2.5e6 0 0 27\n2600 2e7 5e6 0 0 30\n0 1 0 2 0\n50 0 0\n";
        int id = 0;
        for (int j = 0; j < 10; ++j) {
            for (int i = 0; i < 5; ++i) {
                ++id;
                deck += fmt::format("{} {} 1\n0 0 0\n1 0.05\n{} {} 0\n", id, 1 + id % 2,
                                    0.1 + 0.2 * i + 0.01 * (id % 3), 0.1 + 0.2 * j - 0.01 * (id % 4));
            }
        }
        write("in_gm.dat", deck);
    }
};

TEST_F(CrackleMesh, WritesADeckOfPolygonsThatFillsTheDomain) {
    write_packing();
    for (const auto& [kind, file] : {std::pair{"voronoi", "in_gm_volo.dat"}, {"delaunay", "in_gm_tri.dat"}}) {
        const Answer answer = call(fmt::format("in_gm.dat --kind {} --thick 0", kind));
        ASSERT_EQ(answer.code, 0) << answer.err;
        const Scene scene = read_geometry(scratch_ / file);
        double area = 0.0;
        for (const Body& body : scene.bodies) {
            EXPECT_TRUE(body.closed);
            area +=
                mass_properties(scene, body).mass / scene.materials[static_cast<std::size_t>(body.material)].density;
        }
        EXPECT_TRUE(agrees("area of the polygons", area, 2.0, 1e-12));
        EXPECT_EQ(scene.materials.size(), 2U);
        EXPECT_EQ(scene.domain.y2, 2.0);
        if (std::string(kind) == "voronoi") {
            ASSERT_EQ(scene.bodies.size(), 50U);
            for (const Body& body : scene.bodies) EXPECT_EQ(body.material, body.id % 2) << "the circle's material";
        }
        EXPECT_NE(answer.out.find(fmt::format("cells            {} ({})", scene.bodies.size(), kind)),
                  std::string::npos)
            << answer.out;
        for (const char* line : {"segments", "shortest edge", "smallest angle", "cells destroyed  0"}) {
            EXPECT_NE(answer.out.find(line), std::string::npos) << answer.out;
        }
    }
}

TEST_F(CrackleMesh, ThickIsWrittenAndSetsTheGap) {
    write_packing();
    ASSERT_EQ(call("in_gm.dat --kind voronoi --thick 4e-3 -o cells.dat").code, 0);
    const Scene scene = read_geometry(scratch_ / "cells.dat");
    EXPECT_EQ(scene.thick, 4e-3);
    double lowest = 1.0;
    for (const Vec2& corner : scene.vertices) lowest = std::min(lowest, corner.y);
    EXPECT_TRUE(agrees("gap to the domain's face", lowest, 2e-3, 1e-12));
}

TEST_F(CrackleMesh, TakesTheGapOfTheDeckWhereNoneIsGiven) {
    write_packing();
    replace("in_gm.dat", "\n0 1 0 2 0\n", "\n0 1 0 2 4e-3\n");
    const Answer answer = call("in_gm.dat --kind voronoi -o deck.dat");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("gap              0.004 (thick of in_gm.dat)\n"), std::string::npos) << answer.out;
    const Answer given = call("in_gm.dat --kind voronoi --thick 4e-3 -o given.dat");
    EXPECT_NE(given.out.find("gap              0.004\n"), std::string::npos) << given.out;
    EXPECT_EQ(read("deck.dat"), read("given.dat"));
    ASSERT_EQ(call("in_gm.dat --kind voronoi --thick 2e-3 -o other.dat").code, 0);
    EXPECT_EQ(read_geometry(scratch_ / "other.dat").thick, 2e-3) << "the option goes before the deck";
}

TEST_F(CrackleMesh, WritesBothFilesWhereNoKindIsGiven) {
    write_packing();
    const Answer answer = call("in_gm.dat --thick 4e-3 --boundary centres");
    ASSERT_EQ(answer.code, 0) << answer.err;
    ASSERT_EQ(call("in_gm.dat --thick 4e-3 --kind delaunay --boundary centres -o tri.dat").code, 0);
    ASSERT_EQ(call("in_gm.dat --thick 4e-3 --kind voronoi -o volo.dat").code, 0);
    EXPECT_EQ(read("in_gm_tri.dat"), read("tri.dat"));
    EXPECT_EQ(read("in_gm_volo.dat"), read("volo.dat"));
    for (const char* line : {"(delaunay)", "written          in_gm_tri.dat", "written          in_gm_volo.dat"})
        EXPECT_NE(answer.out.find(line), std::string::npos) << answer.out;
    // There are 2n - 2 - h triangles, for h centres along the outer chain.
    const std::size_t triangles = read_geometry(scratch_ / "in_gm_tri.dat").bodies.size();
    EXPECT_GT(triangles, 50U);
    EXPECT_LT(triangles, 98U);

    expect_refused("in_gm.dat --thick 4e-3", "--force");
    ASSERT_TRUE(std::filesystem::remove(scratch_ / "in_gm_tri.dat"));
    expect_refused("in_gm.dat --thick 4e-3", "in_gm_volo.dat");
    std::filesystem::create_directory(scratch_ / "meshes");
    ASSERT_EQ(call("in_gm.dat --thick 4e-3 --boundary centres -o meshes").code, 0);
    EXPECT_EQ(read("meshes/in_gm_tri.dat"), read("tri.dat"));
    EXPECT_EQ(read("meshes/in_gm_volo.dat"), read("volo.dat"));
    expect_refused("in_gm.dat --thick 1 --force -o meshes", "destroyed by the inset");
}

TEST_F(CrackleMesh, ReadsAPlainListOfSeeds) {
    write("seeds.txt", "# x y\n-0.5 0.25\n\n 0.5  2.5d-1\r\n-0.5 0.75 # comment\n0.5 0.75\n");
    const Answer answer = call("seeds.txt --kind voronoi --thick 1e-3 --domain -1 1 0 1");
    ASSERT_EQ(answer.code, 0) << answer.err;
    const Scene scene = read_geometry(scratch_ / "in_gm_volo.dat");
    EXPECT_EQ(scene.bodies.size(), 4U);
    EXPECT_EQ(scene.vertices.size(), 16U);
    EXPECT_EQ(scene.domain.x1, -1.0);
    ASSERT_EQ(call("seeds.txt --kind delaunay --thick 1e-3 --bounding-box").code, 0);
    EXPECT_EQ(read_geometry(scratch_ / "in_gm_tri.dat").bodies.size(), 2U);
}

TEST_F(CrackleMesh, MergesWhatTheInsetDestroysOnRequest) {
    write("seeds.txt", "0.2 0.5\n0.5 0.5\n0.50001 0.5\n0.50002 0.5\n0.8 0.5\n");
    expect_refused("seeds.txt --kind voronoi --thick 1e-3 --domain 0 1 0 1", "centre 2 is seeds.txt:3");
    const Answer answer = call("seeds.txt --kind voronoi --thick 1e-3 --domain 0 1 0 1 --merge");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("cells            4"), std::string::npos) << answer.out;
    EXPECT_NE(answer.out.find("cells destroyed  1 (merged)"), std::string::npos) << answer.out;
}

TEST_F(CrackleMesh, LeavesAnExistingFileAlone) {
    write("seeds.txt", "0.2 0.5\n0.5 0.5\n");
    write("mine.dat", "precious\n");
    const std::string words = "seeds.txt --kind voronoi --thick 1e-3 --domain 0 1 0 1 -o mine.dat";
    expect_refused(words, "--force");
    expect_refused("seeds.txt --kind voronoi --thick 1e-3 --domain 0 1 0 1 --force -o seeds.txt",
                   "found an input of the same command");
    expect_refused("seeds.txt --kind voronoi --thick 1e-3 --domain 0 1 0 0 --force -o mine.dat", "y1 < y2");
    EXPECT_EQ(read("mine.dat"), "precious\n");
    EXPECT_EQ(call(words + " --force").code, 0);
    EXPECT_EQ(read_geometry(scratch_ / "mine.dat").bodies.size(), 2U);
}

TEST_F(CrackleMesh, FollowsTheTracesOfAFileOfJoints) {
    write_packing();
    write("joints.toml", "[[trace]]\nname = \"fault\"\npoints = [0.0, 0.73, 1.0, 1.21]\n");
    for (const char* kind : {"delaunay", "voronoi"}) {
        const Answer answer =
            call(fmt::format("in_gm.dat --kind {} --thick 0 --joints joints.toml -o cells.dat", kind));
        ASSERT_EQ(answer.code, 0) << answer.err;
        EXPECT_NE(answer.out.find("joints: 1.10923 m of traces are "), std::string::npos) << answer.out;
        const Scene scene = read_geometry(scratch_ / "cells.dat");
        const auto above = [](Vec2 p) { return p.y - 0.73 - 0.48 * p.x; };
        double on_trace = 0.0;
        for (const Body& body : scene.bodies) {
            bool over = false, under = false;
            for (std::size_t k = body.first_vertex; k < body.first_vertex + body.vertex_count; ++k) {
                const double side = above(scene.vertices[k]);
                over = over || side > 1e-9;
                under = under || side < -1e-9;
                on_trace += std::abs(side) <= 1e-9 ? 1.0 : 0.0;
            }
            EXPECT_FALSE(over && under) << "body " << body.id << " lies on both sides of the trace";
        }
        EXPECT_GT(on_trace, 10.0);
        ASSERT_TRUE(std::filesystem::remove(scratch_ / "cells.dat"));
    }
}

TEST_F(CrackleMesh, DestroysNoFileThatItsJointsAreReadFrom) {
    write_packing();
    write("survey.txt", "0 0.73 1 1.21\n");
    write("joints.toml", "[[trace]]\nfile = \"survey.txt\"\n");
    const std::string words = "in_gm.dat --kind delaunay --thick 0 --joints joints.toml --force -o ";
    for (const char* input : {"survey.txt", "joints.toml", "in_gm.dat"})
        expect_refused(words + input, "found an input of the same command");
    write("empty.toml", "");
    expect_refused("in_gm.dat --kind delaunay --thick 0 --joints empty.toml", "empty.toml: found no [[joint_set]]");
    expect_refused("in_gm.dat --kind delaunay --thick 0 --joints absent.toml", "absent.toml");
}

// Centres near a trace are omitted, so cells may survive that are destroyed in the mesh without traces.
TEST_F(CrackleMesh, MeshesAlongJointsWhatHasNoMeshWithout) {
    std::string seeds = "0.5 0.5\n0.5 0.50001\n";
    for (int k = 0; k < 100; ++k)
        if (k != 44 && k != 45 && k != 54 && k != 55)
            seeds += fmt::format("{} {}\n", 0.05 + 0.1 * (k % 10), 0.05 + 0.1 * (k / 10) + 0.01 * (k % 3));
    write("seeds.txt", seeds);
    write("joints.toml", "[[trace]]\npoints = [0.0, 0.5, 1.0, 0.5]\n");
    const std::string words = "seeds.txt --kind delaunay --thick 1e-3 --domain 0 1 0 1 -o ";
    expect_refused(words + "without.dat", "seeds.txt:");
    const Answer answer = call(words + "with.dat --joints joints.toml");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("; a comparison is missing, because the same centres cannot be meshed without joints"),
              std::string::npos)
        << answer.out;
}

TEST_F(CrackleMesh, NumbersThatNoReadOfTheDeckTakesAreANotice) {
    write_packing();
    write("noted.dat", read("in_gm.dat") + "7 circles more\n");
    const Answer answer = call("noted.dat --kind voronoi --thick 1e-3");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.err.find("noted.dat: numbers after the last value of a READ"), std::string::npos) << answer.err;
    EXPECT_NE(answer.err.find("'7' in line 208"), std::string::npos) << answer.err;
}

TEST_F(CrackleMesh, RefusesBadInputInOneMessage) {
    write_packing();
    const std::string cells = " --kind voronoi --thick 1e-3";
    expect_refused("absent.dat" + cells, "absent.dat");
    expect_refused(cells, "expected an in_gm.dat or a list of centres");
    expect_refused("in_gm.dat --thick 1e-3 -o cells.dat",
                   "cells.dat, which is not a folder, expected a folder for in_gm_tri");
    expect_refused("in_gm.dat --kind hexagons --thick 1e-3", "--kind: found hexagons");
    expect_refused("in_gm.dat --kind voronoi --thick 1e-3 --boundary centres", "found centres with --kind voronoi");
    expect_refused("in_gm.dat --kind voronoi --thick -1", "thick: found -1");
    expect_refused("in_gm.dat --kind voronoi --thick nan", "thick");
    expect_refused("in_gm.dat --kind voronoi --thick thin", "thin");
    expect_refused("in_gm.dat --kind voronoi --thick 1", "destroyed by the inset of 0.5");
    expect_refused("in_gm.dat --kind voronoi --thick 1e-3 --boundary seeds", "--boundary: found seeds");
    expect_refused("in_gm.dat --domain 0 1 0 1" + cells, "--domain");
    expect_refused("in_gm.dat --colour red" + cells, "--colour");
    expect_refused("in_gm.dat -o nowhere/at/all.dat" + cells, "nowhere/at");
    expect_refused("in_gm.dat -o " + std::string(300, 'x') + cells, "xxx");

    write("empty.txt", "");
    expect_refused("empty.txt" + cells, "empty.txt");
    write("seeds.txt", "0.2 0.5\n0.3\n");
    expect_refused("seeds.txt --domain 0 1 0 1" + cells, "seeds.txt:2: found 1 value");
    write("seeds.txt", "0.2 0.5\n0.3 nan\n");
    expect_refused("seeds.txt --domain 0 1 0 1" + cells, "seeds.txt:2: found 'nan', expected a finite number for y");
    write("seeds.txt", "0.2 0.5\n0.3 0.5\n0.2 0.5\n");
    expect_refused("seeds.txt --domain 0 1 0 1" + cells, "centre 0 is seeds.txt:1, centre 2 is seeds.txt:3");
    expect_refused("seeds.txt" + cells, "found neither");
    expect_refused("seeds.txt --domain 0 1 0 1 --kind voronoi", "--thick: found nothing");
    expect_refused("seeds.txt --bounding-box --domain 0 1 0 1" + cells, "found both");
    expect_refused("seeds.txt --domain 0 1 0" + cells, "expected four numbers");
    expect_refused("seeds.txt --bounding-box" + cells, "y1 < y2");

    const std::string deck = read("in_gm.dat");
    write("cut.dat", deck.substr(0, deck.size() / 2));
    expect_refused("cut.dat" + cells, "cut.dat:");
    write("outside.dat", std::string(deck).replace(deck.find("0 1 0 2 0\n"), 9, "0 0.3 0 2 0"));
    expect_refused("outside.dat" + cells, "inside the domain");
}

}  // namespace
}  // namespace crackle
