// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the history of contacts in frames, and the positions of drawn cracks.

#include "specimens/observers/contact_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/frames/crack_faces.hpp"
#include "specimens/frames/frame_painter.hpp"
#include "specimens/frames/read_frames.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/observers/curve.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::ScratchFolder;
using testing::SmallCase;
using testing::within;
using testing::write_small_case;

class PastOfRock : public ::testing::Test {
  protected:
    VirtualTest prepared(const SmallCase& wanted) const {
        return prepare_test(read_case(write_small_case(scratch_ / "", wanted)));
    }
    static void note_breaks(VirtualTest& test) {
        ContactHistory& history = test.state.history;
        while (history.cracks.size() < test.world.bonds.events.size())
            note_break(test.setup.bonds, test.world.bonds.events[history.cracks.size()], history);
    }
    static Frame taken(VirtualTest& test) {
        note_breaks(test);
        look_at_contacts(test.world, test.state.history);
        Frame frame;
        take_frame(test.world, test.setup.bonds, test.state.history, observe_row(test.world, test.setup), 0, frame);
        return frame;
    }
    PolyData contacts(const VirtualTest& test, const Frame& frame) const {
        const PlacedFrame placed(test.world, test.setup, frame);
        write([&](std::ostream& out) {
            FramePainter(test.world, test.setup, FramePrecision::single_)
                .write_contacts(out, placed, find_forces(placed), std::span(test.state.history.cracks));
        });
        return read_polydata(scratch_ / "frame.vtp");
    }
    PolyData cracks(const VirtualTest& test, const Frame& frame) const {
        write([&](std::ostream& out) {
            FramePainter(test.world, test.setup, FramePrecision::single_)
                .write_cracks(out, PlacedFrame(test.world, test.setup, frame),
                              std::span(test.state.history.cracks).first(frame.cracks));
        });
        return read_polydata(scratch_ / "frame.vtp");
    }
    template <class Write>
    void write(const Write& write) const {
        std::ofstream out(scratch_ / "frame.vtp", std::ios::binary);
        write(out);
    }
    ScratchFolder scratch_;
};

/// A disc at the side, moved by hand as time passes.
class WanderingDisc {
  public:
    explicit WanderingDisc(VirtualTest& test) : test_(test) {
        for (BodyIndex b = 0; b < test.world.bodies.size(); ++b) {
            const BodyState& body = test.world.bodies.state[b];
            if (test.setup.apparatus.is_platen(b)) continue;
            if (std::abs(body.y - 0.5 * test.setup.specimen.height) <
                    std::abs(at(disc_).y - 0.5 * test.setup.specimen.height) + 1e-9 &&
                body.x < at(disc_).x + 1e-9)
                disc_ = b;
        }
        home_ = {at(disc_).x, at(disc_).y};
    }
    BodyIndex disc() const { return disc_; }
    Vec2 home() const { return home_; }
    void put(Vec2 place, double time) {
        World& world = test_.world;
        world.bodies.state[disc_].x = place.x;
        world.bodies.state[disc_].y = place.y;
        world.stepping.time = time;
        world.stepping.forces_current = world.list.valid = false;
        compute_forces(world);
    }

  private:
    const BodyState& at(BodyIndex b) const { return test_.world.bodies.state[b]; }
    VirtualTest& test_;
    BodyIndex disc_ = 2;
    Vec2 home_;
};

TEST_F(PastOfRock, AContactHasStateAndAgeThroughBreakAndTouchingAgain) {
    VirtualTest test = prepared({});
    WanderingDisc disc(test);
    std::vector<std::size_t> own;  // indices of the disc's bonds
    for (std::size_t k = 0; k < test.setup.bonds.points.size(); ++k) {
        const ContactPoint point = test.setup.bonds.points[k];
        if (point.body_i == disc.disc() || point.body_j == disc.disc()) own.push_back(k);
    }
    ASSERT_GE(own.size(), 2U);
    const auto look = [&] { return contacts(test, taken(test)).cell_data; };
    const auto expect = [&](const char* when, const auto& data, double state, double age) {
        for (std::size_t k = 0; k < test.setup.bonds.points.size(); ++k) {
            const bool its = std::find(own.begin(), own.end(), k) != own.end();
            EXPECT_EQ(data.at("state")[k], its ? state : 0.0) << when << ", bond " << k;
            EXPECT_EQ(data.at("age")[k], its ? age : test.world.stepping.time) << when << ", bond " << k;
        }
        fmt::print("  {}: state {}, age {} s of {} contacts\n", when, data.at("state")[own[0]], data.at("age")[own[0]],
                   data.at("age").size());
    };
    disc.put(disc.home(), 0.5);
    expect("intact", look(), 0.0, 0.5);
    const Vec2 away = disc.home() - Vec2{3.0 * testing::rock_radius, 0.0};
    disc.put(away, 1.0);
    EXPECT_EQ(test.world.bonds.broken, static_cast<std::int64_t>(own.size()));
    expect("at the break", look(), 2.0, 0.0);
    disc.put(away, 1.25);
    expect("later", look(), 2.0, 0.25);
    disc.put(disc.home(), 2.0);
    const auto again = look();
    expect("touching again", again, 3.0, 1.0);
    EXPECT_EQ(again.at("state").size(), test.setup.bonds.points.size()) << "not listed again as a contact";
    for (const std::size_t k : own) {
        EXPECT_TRUE(agrees("its force, of the whole overlap, N", again.at("normal_force")[k],
                           1e7 * test.setup.bonds.overlaps[k], 1e-6));
    }
    disc.put(away, 2.5);
    expect("and off", look(), 2.0, 1.5);
}

TEST_F(PastOfRock, AContactWithoutABondIsAsOldAsTheLookThatSawItFirst) {
    VirtualTest test = prepared({});
    WanderingDisc disc(test);
    // Another disc at the left side, two rows up; touched from the left, it touches only the moved disc.
    BodyIndex other = no_body;
    for (BodyIndex b = 0; b < test.world.bodies.size(); ++b) {
        const BodyState& body = test.world.bodies.state[b];
        const double up = body.y - disc.home().y;
        if (!test.setup.apparatus.is_platen(b) && up > 2.5 * testing::rock_radius && up < 4.5 * testing::rock_radius &&
            std::abs(body.x - disc.home().x) < 0.5 * testing::rock_radius)
            other = b;
    }
    ASSERT_NE(other, no_body);
    const BodyState& partner = test.world.bodies.state[other];
    const double overlap = 1e-5;
    const Vec2 beside{partner.x - 2.0 * testing::rock_radius + overlap, partner.y};
    const std::size_t bonds = test.setup.bonds.points.size();
    const auto expect_age = [&](double age) {
        const PolyData data = contacts(test, taken(test));
        ASSERT_EQ(data.cells.size(), bonds + 1);
        EXPECT_EQ(data.cell_data.at("state")[bonds], 4.0);
        EXPECT_EQ(data.cell_data.at("age")[bonds], age);
        const std::pair ids(data.cell_data.at("body_i")[bonds], data.cell_data.at("body_j")[bonds]);
        EXPECT_EQ(std::minmax(ids.first, ids.second),
                  std::minmax<double>(test.world.bodies.info(other).id, test.world.bodies.info(disc.disc()).id));
        EXPECT_TRUE(agrees("its force, N", data.cell_data.at("normal_force")[bonds], 1e7 * overlap, 1e-6));
    };
    disc.put(beside, 1.0);
    expect_age(0.0);
    disc.put(beside, 1.5);
    expect_age(0.5);
    disc.put(beside - Vec2{1e-3, 0.0}, 2.0);
    EXPECT_EQ(contacts(test, taken(test)).cells.size(), bonds) << "gone";
    disc.put(beside, 3.0);
    expect_age(0.0);
}

TEST_F(PastOfRock, CracksAreTheEvents) {
    for (const auto& [mesh, law] : {std::pair("", "rounded"), {"delaunay", "rounded"}, {"voronoi", "demseg"}}) {
        SmallCase wanted;
        wanted.mesh = mesh;
        wanted.rate = 0.05;
        wanted.numerics = fmt::format("contact_law = \"{}\"", law);
        VirtualTest test = prepared(wanted);
        EXPECT_EQ(cracks(test, taken(test)).cells.size(), 0U) << "before the first";
        load_specimen(test);
        const Frame frame = taken(test);
        const PolyData data = cracks(test, frame);
        const auto& events = test.world.bonds.events;
        ASSERT_GT(events.size(), 0U);
        ASSERT_EQ(data.cells.size(), events.size());
        double farthest = 0.0, widest = -1.0;
        for (std::size_t k = 0; k < events.size(); ++k) {
            const auto value = [&](const char* name) { return data.cell_data.at(name)[k]; };
            EXPECT_EQ(value("time"), events[k].time);
            EXPECT_EQ(value("energy"), events[k].energy);
            EXPECT_EQ(value("orientation"), events[k].orientation);
            EXPECT_EQ(value("strength"), events[k].strength);
            EXPECT_EQ(value("mode"), events[k].shear_mode ? 1.0 : 0.0);
            EXPECT_EQ(value("body_i"), events[k].body_i);
            EXPECT_EQ(value("body_j"), events[k].body_j);
            const Vec2 middle = 0.5 * (data.points[data.cells[k].points[0]] + data.points[data.cells[k].points[1]]);
            farthest = std::max(farthest, norm(middle - events[k].position));
            widest = std::max(widest, value("opening"));
        }
        fmt::print("  {} {}: {} cracks, up to {:.2g} m from where they broke, open up to {:.2g} m\n", mesh, law,
                   events.size(), farthest, widest);
        // Under the guide's law, a point without overlap has no position, so its events may be elsewhere on the cell.
        EXPECT_LT(farthest, (law == std::string("demseg") ? 2.0 : 1.0) * testing::rock_radius)
            << "a point's share of a face may lie next to it";
        EXPECT_GT(widest, 0.0);
        EXPECT_LT(widest, testing::rock_radius);
    }
}

/// Normal of a bond whose points have not moved, from i to j.
Vec2 normal_at_start(const VirtualTest& test, PointIndex bond) {
    for (PointIndex k = 0; k < test.world.points.size(); ++k) {
        const ContactPoint point = test.world.points.contact[k], wanted = test.setup.bonds.points[bond];
        if (point.body_i == wanted.body_i && point.body_j == wanted.body_j && point.element_i == wanted.element_i)
            return view_point(test.world, k).normal;
    }
    ADD_FAILURE() << "bond " << bond << " is not listed";
    return {};
}

TEST_F(PastOfRock, OpeningIsTheMotionApartLessTheOverlapThatBonded) {
    for (const char* mesh : {"", "voronoi"}) {
        SmallCase wanted;
        wanted.mesh = mesh;
        VirtualTest test = prepared(wanted);
        const Frame start = taken(test);
        double worst = 0.0, turned_off = 0.0;
        for (PointIndex bond = 0; bond < test.setup.bonds.points.size(); ++bond) {
            const ContactPoint point = test.setup.bonds.points[bond];
            const CrackFace closed = find_crack_face(PlacedFrame(test.world, test.setup, start), bond);
            worst = std::max(worst, std::abs(closed.opening + test.setup.bonds.overlaps[bond]));
            const Vec2 normal = normal_at_start(test, bond);
            Frame frame = start;
            const double way = 1e-3;
            frame.bodies[point.body_j].x += way * normal.x;
            frame.bodies[point.body_j].y += way * normal.y;
            const CrackFace open = find_crack_face(PlacedFrame(test.world, test.setup, frame), bond);
            worst = std::max(worst, std::abs(open.opening - closed.opening - way));
            worst = std::max(worst, norm(open.begin - closed.begin - 0.5 * way * normal));
            // A specimen that rotates as a whole opens nowhere.
            const double angle = 0.3;
            const Vec2 turn{std::cos(angle), std::sin(angle)};
            for (Frame::Body& body : frame.bodies) {
                const Vec2 place = rotated(turn, {body.x, body.y});
                body = {place.x, place.y, body.angle + angle, 0.0, 0.0, 0.0};
            }
            const CrackFace turned = find_crack_face(PlacedFrame(test.world, test.setup, frame), bond);
            turned_off = std::max(
                {turned_off, std::abs(turned.opening - open.opening), norm(turned.end - rotated(turn, open.end))});
        }
        EXPECT_TRUE(within(fmt::format("{}: largest deviation, m", mesh), worst, 0.0, 1e-12));
        EXPECT_TRUE(within(fmt::format("{}: after a turn, m", mesh), turned_off, 0.0, 1e-12));
    }
}

TEST_F(PastOfRock, SharesOfAFaceMakeUpTheFaceAndCirclesHaveTheirDiameter) {
    VirtualTest discs = prepared({});
    const Frame of_discs = taken(discs);
    for (PointIndex bond = 0; bond < discs.setup.bonds.points.size(); ++bond) {
        const CrackFace face = find_crack_face(PlacedFrame(discs.world, discs.setup, of_discs), bond);
        EXPECT_NEAR(norm(face.end - face.begin), 2.0 * testing::rock_radius, 1e-12);
    }
    for (const char* law : {"rounded", "demseg"}) {
        SmallCase wanted;
        wanted.mesh = "voronoi";
        wanted.numerics = fmt::format("contact_law = \"{}\"", law);
        VirtualTest test = prepared(wanted);
        const Frame frame = taken(test);
        const PlacedFrame placed(test.world, test.setup, frame);
        std::map<std::pair<BodyIndex, BodyIndex>, double> faces;  // m, length of faces between two bodies
        for (PointIndex bond = 0; bond < test.setup.bonds.points.size(); ++bond) {
            const ContactPoint point = test.setup.bonds.points[bond];
            const CrackFace face = find_crack_face(placed, bond);
            faces[std::minmax(point.body_i, point.body_j)] += norm(face.end - face.begin);
        }
        // Edges of cells that face another cell, one per pair, if they are at least a fifth of a disc long.
        double worst = 0.0;
        int compared = 0;
        for (const auto& [pair, length] : faces) {
            if (test.setup.apparatus.is_platen(pair.first) || test.setup.apparatus.is_platen(pair.second)) continue;
            const Vec2 to{test.setup.bonds.start[pair.second].x, test.setup.bonds.start[pair.second].y};
            const std::vector<Vec2> corners = element_positions(test.world, pair.first);
            double facing = 0.0, nearest = 1e9;
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const Vec2 side = corners[(k + 1) % corners.size()] - corners[k];
                const Vec2 outward = (1.0 / norm(side)) * Vec2{side.y, -side.x};
                const double off = norm(to - (corners[k] + 0.5 * side)) - std::abs(dot(to - corners[k], outward));
                if (dot(to - corners[k], outward) > 0.0 && off < nearest) {
                    nearest = off;
                    facing = norm(side);
                }
            }
            if (facing < 0.2 * testing::rock_radius || nearest > 0.1 * testing::rock_radius) continue;
            ++compared;
            worst = std::max(worst, std::abs(length / facing - 1.0));
        }
        fmt::print("  {}: {} of {} interfaces compared\n", law, compared, faces.size());
        EXPECT_GE(compared, 100);
        EXPECT_TRUE(within("largest deviation from the facing edge", worst, 0.0, 0.02));
    }
}

}  // namespace
}  // namespace crackle
