// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a frame shows the state at its time: positions, forces and losses of the world. It must not depend on the
// list of points or on frames written earlier.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <span>
#include <sstream>
#include <utility>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/point_order.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/frames/frame_painter.hpp"
#include "specimens/frames/read_frames.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/observers/curve.hpp"
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
    /// A specimen loaded until failure, so that bodies have rotated, bonds are broken, and lists were rebuilt.
    VirtualTest broken_test(const std::string& mesh, const std::string& law = "rounded") const {
        SmallCase wanted;
        wanted.mesh = mesh;
        wanted.rate = 0.05;
        wanted.numerics = "contact_law = \"" + law + "\"";
        VirtualTest test = prepare_test(read_case(write_small_case(scratch_ / "", wanted)));
        load_specimen(test);
        test.world.list.valid = false;
        compute_forces(test.world);
        EXPECT_GT(test.world.bonds.broken, 0);
        return test;
    }
    enum class Picture { particles, contacts, cracks };
    static Frame taken(VirtualTest& test) {
        ContactHistory& history = test.state.history;
        while (history.cracks.size() < test.world.bonds.events.size())
            note_break(test.setup.bonds, test.world.bonds.events[history.cracks.size()], history);
        look_at_contacts(test.world, history);
        Frame frame;
        take_frame(test.world, test.setup.bonds, history, observe_row(test.world, test.setup), 7, frame);
        return frame;
    }
    static void write(std::ostream& out, const VirtualTest& test, const FramePainter& painter, const Frame& frame,
                      Picture picture) {
        const PlacedFrame placed(test.world, test.setup, frame);
        const auto cracks = std::span(test.state.history.cracks).first(frame.cracks);
        switch (picture) {
            case Picture::particles:
                painter.write_particles(out, placed, find_forces(placed));
                break;
            case Picture::contacts:
                painter.write_contacts(out, placed, find_forces(placed), cracks);
                break;
            case Picture::cracks:
                painter.write_cracks(out, placed, cracks);
        }
    }
    PolyData read(const VirtualTest& test, const Frame& frame, Picture picture) const {
        std::ofstream out(scratch_ / "frame.vtp", std::ios::binary);
        write(out, test, FramePainter(test.world, test.setup, FramePrecision::single_), frame, picture);
        out.close();
        return read_polydata(scratch_ / "frame.vtp");
    }
    static std::string all_pictures(const VirtualTest& test, const FramePainter& painter, const Frame& frame) {
        std::ostringstream text;
        for (const Picture picture : {Picture::particles, Picture::contacts, Picture::cracks})
            write(text, test, painter, frame, picture);
        return std::move(text).str();
    }

    ScratchFolder scratch_;
};

TEST_F(Frames, ContactsHaveTheForcesAndStatesOfTheirPoints) {
    for (const auto& [mesh, law] : {std::pair("", "rounded"), {"voronoi", "rounded"}, {"voronoi", "demseg"}}) {
        VirtualTest test = broken_test(mesh, law);
        const PolyData data = read(test, taken(test), Picture::contacts);
        const auto& bonds = test.setup.bonds.points;
        std::map<std::pair<PointKind, PointKey>, PointView> touching;
        std::size_t bonded = 0;
        for (PointIndex k = 0; k < test.world.points.size(); ++k) {
            const PointView view = view_point(test.world, k);
            if (view.touching) touching[{view.kind, key_of(view.kind, test.world.points.contact[k])}] = view;
            bonded += view.bonded;
        }
        EXPECT_LT(bonded, bonds.size());
        // Round-off of positions, about 1e-15 of the specimen's height, times a stiffness of 1e7 N/m.
        const double rounding = 1e7 * 1e-15 * test.setup.specimen.height;
        double largest = 0.0;
        std::array<int, 5> counts{};
        const auto expect_forces = [&](std::size_t cell, const PointView& view) {
            EXPECT_NEAR(data.cell_data.at("normal_force")[cell], view.normal_force, rounding);
            EXPECT_EQ(data.cell_data.at("shear_force")[cell], view.shear_force);
            largest = std::max(largest, std::abs(view.shear_force));
            ++counts.at(static_cast<std::size_t>(data.cell_data.at("state")[cell]));
        };
        for (std::size_t k = 0; k < bonds.size(); ++k) {
            int kind = 0;
            while (k >= test.setup.bonds.kind_begin[static_cast<std::size_t>(kind) + 1]) ++kind;
            const ContactPoint point = bonds[k];
            const auto held = touching.find({PointKind(kind), key_of(PointKind(kind), point)});
            const bool touches = held != touching.end();
            const PointView view = touches ? held->second : PointView{};
            const double state = view.bonded ? (view.slid ? 1.0 : 0.0) : touches ? 3.0 : 2.0;
            EXPECT_EQ(data.cell_data.at("state")[k], state);
            expect_forces(k, view);
            EXPECT_EQ(data.cell_data.at("body_i")[k], test.world.bodies.info(point.body_i).id);
            EXPECT_EQ(data.cell_data.at("body_j")[k], test.world.bodies.info(point.body_j).id);
            if (touches) touching.erase(held);
        }
        ASSERT_EQ(data.cells.size(), bonds.size() + touching.size()) << "the remaining points were never bonded";
        std::size_t cell = bonds.size();
        for (const auto& [name, view] : touching) {  // sorted by kind and key, in the order of writing
            EXPECT_EQ(data.cell_data.at("state")[cell], 4.0);
            EXPECT_EQ(data.cell_data.at("body_i")[cell], test.world.bodies.info(view.body_i).id);
            EXPECT_EQ(data.cell_data.at("body_j")[cell], test.world.bodies.info(view.body_j).id);
            Vec2 middle;  // mean of the line's inner points, or of its only point
            const auto& line = data.cells[cell].points;
            for (const std::size_t point : line)
                middle = middle + (1.0 / static_cast<double>(line.size())) * data.points[point];
            if (!test.setup.specimen.polygons && line.size() == 3) middle = data.points[line[1]];
            if (!test.setup.specimen.polygons && line.size() == 2) middle = data.points[line[1]];
            EXPECT_LT(norm(middle - view.position), 1e-7 * test.setup.specimen.height);
            expect_forces(cell++, view);
        }
        fmt::print("  {} {}: intact, slid, broken, touching again, loose: {}, {}, {}, {}, {}; shear up to {:.3g} N\n",
                   *mesh == '\0' ? "circles" : mesh, law, counts[0], counts[1], counts[2], counts[3], counts[4],
                   largest);
        EXPECT_GT(largest, 0.0);
    }
}

TEST_F(Frames, OutlinesAndBondsLieWhereTheBodiesAre) {
    for (const std::string mesh : {"", "voronoi"}) {
        VirtualTest test = broken_test(mesh);
        const Frame frame = taken(test);
        const PolyData particles = read(test, frame, Picture::particles), bonds = read(test, frame, Picture::contacts);
        ASSERT_EQ(particles.cells.size(), test.world.bodies.size());
        EXPECT_TRUE(particles.cells[0].line && particles.cells[1].line && !particles.cells[2].line);
        const double rounding = 1e-7 * test.setup.specimen.height;
        double farthest = 0.0, turned = 0.0;
        for (std::size_t c = 0; c < particles.cells.size(); ++c) {
            const BodyIndex b = body_of_id(test.world, static_cast<int>(particles.cell_data.at("id")[c]));
            std::vector<Vec2> places = element_positions(test.world, b);
            if (test.setup.apparatus.is_platen(b)) places.resize(2);
            const bool circle = test.world.bodies.info(b).piece_count == 0;
            ASSERT_EQ(particles.cells[c].points.size(), circle ? 24U : places.size());
            Vec2 mean;
            for (std::size_t k = 0; k < particles.cells[c].points.size(); ++k) {
                const Vec2 corner = particles.points[particles.cells[c].points[k]];
                mean = mean + (1.0 / 24.0) * corner;
                if (!circle) farthest = std::max(farthest, norm(corner - places[k]));
            }
            if (circle) farthest = std::max(farthest, norm(mean - places[0]));
            EXPECT_EQ(particles.cell_data.at("radius")[c], circle ? test.world.bodies.state[b].shape[0] : 0.0);
            EXPECT_EQ(particles.cell_data.at("displacement")[3 * c + 1],
                      test.world.bodies.state[b].y - test.setup.bonds.start[b].y);
            EXPECT_EQ(particles.cell_data.at("velocity")[3 * c], test.world.bodies.state[b].vx);
            EXPECT_EQ(particles.cell_data.at("rotation_rate")[c], test.world.bodies.state[b].omega);
            turned = std::max(turned, std::abs(particles.cell_data.at("angle")[c]));
        }
        // An intact bond is drawn from body to body without a gap.
        double longest = 0.0;
        for (std::size_t k = 0; k < bonds.cells.size(); ++k) {
            const auto& line = bonds.cells[k].points;
            if (bonds.cell_data.at("state")[k] > 1.0) continue;
            for (std::size_t p = 1; p < line.size(); ++p)
                longest = std::max(longest, norm(bonds.points[line[p]] - bonds.points[line[p - 1]]));
        }
        fmt::print("  {}: off by at most {:.2g} m, turned up to {:.2g}, bonds up to {:.3g} m long\n",
                   mesh.empty() ? "circles" : mesh, farthest, turned, longest);
        EXPECT_LT(farthest, rounding);
        EXPECT_GT(turned, 1e-4);
        EXPECT_LT(longest, mesh.empty() ? 1.01 * testing::rock_radius : 1.2e-3)
            << "largest distance: a radius, or the gap of the mesh";
    }
}

TEST_F(Frames, DoNotDependOnThoseWrittenBefore) {
    for (const std::string mesh : {"", "voronoi"}) {
        VirtualTest test = broken_test(mesh);
        const FramePainter used(test.world, test.setup, FramePrecision::single_);
        const std::string before = all_pictures(test, used, taken(test));
        for (int k = 0; k < 50; ++k) step(test.world);
        compute_forces(test.world);
        const Frame second = taken(test);
        const std::string one = all_pictures(test, used, second);
        EXPECT_TRUE(one == all_pictures(test, FramePainter(test.world, test.setup, FramePrecision::single_), second))
            << mesh;
        EXPECT_FALSE(one == before) << mesh;
    }
}

TEST_F(Frames, HaveTheTypesThatAreWrittenDown) {
    VirtualTest test = broken_test("");
    const std::string text =
        all_pictures(test, FramePainter(test.world, test.setup, FramePrecision::single_), taken(test));
    for (const char* array :
         {"Float32\" Name=\"points",    "Int32\" Name=\"connectivity",   "Int32\" Name=\"offsets",
          "Int32\" Name=\"id",          "Float64\" Name=\"radius",       "Float64\" Name=\"displacement",
          "Float64\" Name=\"velocity",  "Float64\" Name=\"angle",        "Float64\" Name=\"rotation_rate",
          "Float64\" Name=\"stress_xx", "Float64\" Name=\"stress_yy",    "Float64\" Name=\"stress_xy",
          "Int32\" Name=\"fragment",    "Float64\" Name=\"normal_force", "Float64\" Name=\"shear_force",
          "UInt8\" Name=\"state",       "Float64\" Name=\"age",          "Float64\" Name=\"time",
          "UInt8\" Name=\"mode",        "Float64\" Name=\"energy",       "Float64\" Name=\"orientation",
          "Float64\" Name=\"strength",  "Float64\" Name=\"opening",      "Int32\" Name=\"body_j"})
        EXPECT_NE(text.find(array), std::string::npos) << array;
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
        // Parts of the circle beyond the sides: circular segments of half-angle a.
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

/// Noise, zeros and repeated values, with sizes around the block size in which arrays are compressed, and sizes large
/// enough to be written block by block.
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
