// SPDX-License-Identifier: GPL-3.0-or-later
// A frame shows the moment it was taken in: places, forces and losses of the world itself, whatever the list of points
// does and however many frames the painter has written before.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <utility>

#include "solver/point_order.hpp"
#include "specimens/observers/curve.hpp"
#include "specimens/observers/frame_painter.hpp"
#include "specimens/observers/read_frames.hpp"
#include "specimens/virtual_test.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"
#include "tests/support/vtp_data.hpp"

namespace crackle {
namespace {

using testing::ScratchFolder;
using testing::SmallCase;
using testing::write_small_case;

class Frames : public ::testing::Test {
  protected:
    /// Loaded until it has failed: turned bodies, broken bonds, a list built anew.
    VirtualTest broken_test(const std::string& mesh, const std::string& law = "rounded") const {
        SmallCase wanted;
        wanted.mesh = mesh;
        wanted.rate = 0.05;
        wanted.numerics = "contact_law = \"" + law + "\"";
        VirtualTest test = prepare_test(read_case(write_small_case(scratch_ / "", wanted)));
        load_specimen(test);
        test.world.list_valid = false;
        compute_forces(test.world);
        EXPECT_GT(test.world.bonds_broken, 0);
        return test;
    }
    static Frame taken(const VirtualTest& test) {
        Frame frame;
        take_frame(test.world, test.setup, observe_row(test.world, test.setup), 7, frame);
        return frame;
    }
    PolyData read(const FramePainter& painter, const Frame& frame, bool bonds) const {
        std::ofstream out(scratch_ / "frame.vtp", std::ios::binary);
        bonds ? painter.write_bonds(out, frame) : painter.write_particles(out, frame);
        out.close();
        return read_polydata(scratch_ / "frame.vtp");
    }

    ScratchFolder scratch_;
};

TEST_F(Frames, BondsHaveTheForcesOfTheirPoints) {
    for (const auto& [mesh, law] : {std::pair("", "rounded"), {"voronoi", "rounded"}, {"voronoi", "demseg"}}) {
        const VirtualTest test = broken_test(mesh, law);
        const PolyData data = read(FramePainter(test.world, test.setup), taken(test), true);
        const auto& bonds = test.setup.bonds;
        ASSERT_EQ(data.cells.size(), bonds.size());
        std::map<std::pair<PointKind, PointKey>, PointView> bonded;
        for (PointIndex k = 0; k < test.world.points.size(); ++k) {
            const PointView view = view_point(test.world, k);
            if (view.bonded) bonded[{view.kind, key_of(view.kind, test.world.points[k])}] = view;
        }
        EXPECT_LT(bonded.size(), bonds.size());
        // Places are known to a rounding of the specimen's size, turns to one of a whole turn.
        const double rounding = 1e7 * 1e-15 * test.setup.height;
        double largest = 0.0;
        for (std::size_t k = 0; k < bonds.size(); ++k) {
            int kind = 0;
            while (k >= test.setup.bond_kind_begin[static_cast<std::size_t>(kind) + 1]) ++kind;
            const ContactPoint& point = bonds[k].point;
            const auto held = bonded.find({PointKind(kind), key_of(PointKind(kind), point)});
            const bool broken = held == bonded.end();
            EXPECT_EQ(data.cell_data.at("broken")[k], broken ? 1.0 : 0.0);
            EXPECT_NEAR(data.cell_data.at("normal_force")[k], broken ? 0.0 : held->second.normal_force, rounding);
            EXPECT_EQ(data.cell_data.at("shear_force")[k], broken ? 0.0 : held->second.shear_force);
            EXPECT_EQ(data.cell_data.at("body_i")[k], test.world.info[point.body_i].id);
            EXPECT_EQ(data.cell_data.at("body_j")[k], test.world.info[point.body_j].id);
            largest = std::max(largest, std::abs(data.cell_data.at("shear_force")[k]));
        }
        fmt::print("  {} {}: {} of {} bonds hold, shear up to {:.3g} N\n", *mesh == '\0' ? "circles" : mesh, law,
                   bonded.size(), bonds.size(), largest);
        EXPECT_GT(largest, 0.0);
    }
}

TEST_F(Frames, OutlinesAndBondsLieWhereTheBodiesAre) {
    for (const std::string mesh : {"", "voronoi"}) {
        const VirtualTest test = broken_test(mesh);
        const Frame frame = taken(test);
        const FramePainter painter(test.world, test.setup);
        const PolyData particles = read(painter, frame, false), bonds = read(painter, frame, true);
        ASSERT_EQ(particles.cells.size(), test.world.bodies.size());
        EXPECT_TRUE(particles.cells[0].line && particles.cells[1].line && !particles.cells[2].line);
        const double rounding = 1e-7 * test.setup.height;
        double farthest = 0.0, turned = 0.0;
        for (std::size_t c = 0; c < particles.cells.size(); ++c) {
            const BodyIndex b = body_of_id(test.world, static_cast<int>(particles.cell_data.at("id")[c]));
            std::vector<Vec2> places = element_positions(test.world, b);
            if (test.setup.is_platen(b)) places.resize(2);
            const bool circle = test.world.info[b].piece_count == 0;
            ASSERT_EQ(particles.cells[c].points.size(), circle ? 24U : places.size());
            Vec2 mean;
            for (std::size_t k = 0; k < particles.cells[c].points.size(); ++k) {
                const Vec2 corner = particles.points[particles.cells[c].points[k]];
                mean = mean + (1.0 / 24.0) * corner;
                if (!circle) farthest = std::max(farthest, norm(corner - places[k]));
            }
            if (circle) farthest = std::max(farthest, norm(mean - places[0]));
            EXPECT_EQ(particles.cell_data.at("radius")[c], circle ? test.world.bodies[b].shape[0] : 0.0);
            EXPECT_EQ(particles.cell_data.at("displacement")[3 * c + 1],
                      test.world.bodies[b].y - test.setup.start[b].y);
            EXPECT_EQ(particles.cell_data.at("velocity")[3 * c], test.world.bodies[b].vx);
            turned = std::max(turned, std::abs(particles.cell_data.at("angle")[c]));
        }
        // A bond that holds runs from body to body without a leap.
        double longest = 0.0;
        for (std::size_t k = 0; k < bonds.cells.size(); ++k) {
            const auto& line = bonds.cells[k].points;
            if (bonds.cell_data.at("broken")[k] == 1.0) continue;
            for (std::size_t p = 1; p < line.size(); ++p)
                longest = std::max(longest, norm(bonds.points[line[p]] - bonds.points[line[p - 1]]));
        }
        fmt::print("  {}: off by at most {:.2g} m, turned up to {:.2g}, bonds up to {:.3g} m long\n",
                   mesh.empty() ? "circles" : mesh, farthest, turned, longest);
        EXPECT_LT(farthest, rounding);
        EXPECT_GT(turned, 1e-4);
        EXPECT_LT(longest, mesh.empty() ? 1.01 * testing::rock_radius : 1.2e-3) << "a radius; the gap";
    }
}

TEST_F(Frames, DoNotDependOnThoseWrittenBefore) {
    for (const std::string mesh : {"", "voronoi"}) {
        VirtualTest test = broken_test(mesh);
        const FramePainter used(test.world, test.setup);
        const Frame first = taken(test);
        std::ostringstream before;
        used.write_particles(before, first);
        used.write_bonds(before, first);
        for (int k = 0; k < 50; ++k) step(test.world);
        compute_forces(test.world);
        const Frame second = taken(test);
        std::ostringstream one, other;
        used.write_particles(one, second);
        used.write_bonds(one, second);
        const FramePainter fresh(test.world, test.setup);
        fresh.write_particles(other, second);
        fresh.write_bonds(other, second);
        EXPECT_TRUE(one.str() == other.str()) << mesh;
        EXPECT_FALSE(one.str() == before.str()) << mesh;
    }
}

TEST_F(Frames, HaveTheTypesThatAreWrittenDown) {
    const VirtualTest test = broken_test("");
    const FramePainter painter(test.world, test.setup);
    std::ostringstream text;
    painter.write_particles(text, taken(test));
    painter.write_bonds(text, taken(test));
    for (const char* array : {"Float32\" Name=\"points", "Int32\" Name=\"connectivity", "Int32\" Name=\"offsets",
                              "Int32\" Name=\"id", "Float64\" Name=\"radius", "Float64\" Name=\"displacement",
                              "Float64\" Name=\"velocity", "Float64\" Name=\"angle", "Float64\" Name=\"normal_force",
                              "Float64\" Name=\"shear_force", "UInt8\" Name=\"broken"})
        EXPECT_NE(text.str().find(array), std::string::npos) << array;
}

TEST(CircleOutline, CoversTheCircleAndNothingElse) {
    EXPECT_EQ(circle_corners(2000), 24);
    EXPECT_EQ(circle_corners(2001), 12);
    for (const std::int64_t particles : {100, 1000000}) {
        const std::vector<Vec2> outline = unit_circle_outline(circle_corners(particles));
        const auto n = static_cast<double>(outline.size());
        double area = 0.0;
        for (std::size_t k = 0; k < outline.size(); ++k)
            area += 0.5 * cross(outline[k], outline[(k + 1) % outline.size()]);
        // What of the circle lies beyond the sides: segments of half-angle a.
        const double a = std::acos(norm(0.5 * (outline[0] + outline[1])));
        const double beyond = n * (a - std::sin(a) * std::cos(a)), pi = std::numbers::pi;
        const double overlap = (pi - beyond) / (area + beyond);
        fmt::print("  {} corners: intersection over union {:.4f}\n", outline.size(), overlap);
        EXPECT_NEAR(area, pi, 1e-14 * pi * n);
        EXPECT_GT(overlap, 0.98);
    }
}

TEST(DefaultFrames, FallWithTheNumberOfBodies) {
    EXPECT_EQ(default_frames(77, 2000), 100);
    EXPECT_EQ(default_frames(2000, 2000), 100);
    EXPECT_EQ(default_frames(5000, 2000), 40);
    EXPECT_EQ(default_frames(10000, 2000), 20);
    EXPECT_EQ(default_frames(1000000, 2000), 20);
    EXPECT_EQ(default_frames(77, 10), 10) << "frames are taken at rows";
}

/// Noise, zeros and repeats, of sizes about the blocks in which arrays are packed, and so large that they are written
/// block by block.
TEST(PackedArrays, ComeBackWhateverTheirSize) {
    const ScratchFolder folder;
    std::mt19937_64 generator(1);
    for (const std::size_t count : {1U, 2U, 4095U, 4096U, 4097U, 12'288U, 40'000U, 200'000U}) {
        for (const int kind : {0, 1, 2}) {
            testing::VtpData data;
            std::vector<Vec2> places;
            for (std::size_t k = 0; k < count; ++k) {
                const double noise = static_cast<double>(static_cast<float>(generator()));
                places.push_back(kind == 0   ? Vec2{noise, -noise}
                                 : kind == 1 ? Vec2{}
                                             : Vec2{static_cast<double>(k % 7), 1.0});
            }
            data.lines = {places};
            const std::string text = testing::vtp_text(data);
            EXPECT_TRUE(text == testing::vtp_text(data)) << "depends on what was packed before";
            const auto file = folder / "array.vtp";
            std::ofstream(file, std::ios::binary) << text;
            const PolyData back = read_polydata(file);
            ASSERT_EQ(back.points.size(), count);
            EXPECT_TRUE(std::equal(places.begin(), places.end(), back.points.begin())) << count << ", kind " << kind;
            ASSERT_EQ(back.cells.size(), 1U);
            EXPECT_EQ(back.cells[0].points.size(), count);
        }
    }
}

}  // namespace
}  // namespace crackle
