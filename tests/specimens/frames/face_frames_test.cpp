// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that frames show the stresses, moments, openings and slips of faces as the force pass found them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <span>
#include <vector>

#include "solver/faces/face_pass.hpp"
#include "solver/faces/face_traction.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/frames/frame_forces.hpp"
#include "specimens/frames/frame_painter.hpp"
#include "specimens/frames/read_frames.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/observers/curve.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

using testing::within;

/// Resultant of a stress that is linear between the ends of a line, without its tension if it is broken.
struct Resultant {
    double force = 0.0, moment = 0.0;  // N, N m
};
Resultant resultant_of(double length, double begin, double end, bool broken) {
    constexpr int steps = 200'000;
    Resultant sum;
    for (int k = 0; k < steps; ++k) {
        const double share = (k + 0.5) / steps, linear = begin + share * (end - begin);
        const double stress = broken ? std::max(0.0, linear) : linear;
        sum.force += stress * length / steps;
        sum.moment += stress * (share - 0.5) * length * length / steps;
    }
    return sum;
}

class FaceFrames : public ::testing::Test {
  protected:
    void SetUp() override {
        std::ofstream(scratch_ / "case.toml")
            << "[packing]\nwidth = 0.018\nheight = 0.036\nradius_min = 0.9e-3\nradius_max = 1.4e-3\nmean_overlap = "
               "1e-6\n"
               "[mesh]\nkind = \"voronoi\"\nmerge_destroyed = true\n[material]\ndensity = 2600\nunits = \"area\"\n"
               "youngs_modulus = 70e9\npoissons_ratio = 0.25\nstiffness_ratio = 1.6\ntensile_strength = 10e6\n"
               "cohesion = 40e6\nfriction_angle = 40\nmoment_share = 0.6\ndamping_ratio = 0.1\n[bond]\nlaw = \"face\"\n"
               "strength_distribution = \"weibull\"\nstrength_cv = 0.2\nstrength_seed = 1\n[loading]\n"
               "kind = \"compression\"\nrate_tolerance = 0.02\nmax_axial_strain = 0.006\n";
        test_ = prepare_test(read_case(scratch_ / "case.toml"), {});
        load_specimen(test_, {}, nullptr);
        compute_forces(test_.world);
        ContactHistory& history = test_.state.history;
        while (history.cracks.size() < test_.world.bonds.events.size())
            note_break(test_.setup.bonds, test_.world.bonds.events[history.cracks.size()], history);
        look_at_contacts(test_.world, history);
        take_frame(test_.world, test_.setup.bonds, history, observe_row(test_.world, test_.setup), 7, frame_);
        first_ = test_.setup.bonds.kind_begin[static_cast<std::size_t>(PointKind::bonded_face)];
    }
    PolyData written(const auto& write) const {
        const FramePainter painter(test_.world, test_.setup, FramePrecision::double_);
        const PlacedFrame placed(test_.world, test_.setup, frame_);
        std::ofstream out(scratch_ / "frame.vtp", std::ios::binary);
        write(painter, out, placed);
        out.close();
        return read_polydata(scratch_ / "frame.vtp");
    }
    std::span<const Crack> cracks() const { return std::span(test_.state.history.cracks).first(frame_.cracks); }

    testing::ScratchFolder scratch_;
    VirtualTest test_;
    Frame frame_;
    PointIndex first_ = 0;
};

TEST_F(FaceFrames, StressesHaveTheForceAndTheMomentOfTheFace) {
    const PolyData data = written([&](const FramePainter& painter, std::ostream& out, const PlacedFrame& placed) {
        painter.write_contacts(out, placed, find_forces(placed), cracks());
    });
    const auto& values = data.cell_data;
    const Faces& faces = test_.world.faces;
    double forces = 0.0, moments = 0.0, lengths = 0.0, pressing_forces = 0.0, pressing_moments = 0.0, largest = 0.0;
    int intact = 0, pressing = 0, partly = 0;
    for (PointIndex bond = first_; bond < test_.setup.bonds.points.size(); ++bond) {
        const FaceIndex k = test_.setup.bonds.points[bond].element_i;
        const FaceForces force = forces_of_face(faces, k);
        const bool holds = faces.broken_at[k] == no_face;
        const double length = norm(data.points[2 * bond + 1] - data.points[2 * bond]);
        const double begin = values.at("stress_begin")[bond], end = values.at("stress_end")[bond];
        const Resultant sum = resultant_of(length, begin, end, !holds);
        const double scale = faces.springs[k].length * 1e7;  // N, at a stress of 10 MPa
        largest = std::max(largest, std::abs(force.normal) / scale);
        const double off = std::abs(sum.force + force.normal) / scale;
        const double turned =
            std::max(std::abs(sum.moment - force.moment), std::abs(values.at("moment")[bond] - force.moment)) /
            (scale * faces.springs[k].length);
        if (holds) {
            ++intact;
            forces = std::max(forces, off);
            moments = std::max(moments, turned);
            lengths = std::max(lengths, std::abs(length / faces.springs[k].length - 1.0));
        } else if (force.normal != 0.0) {
            ++pressing;
            partly += begin < 0.0 || end < 0.0;
            pressing_forces = std::max(pressing_forces, off);
            pressing_moments = std::max(pressing_moments, turned);
        } else {
            EXPECT_EQ(begin, 0.0);
            EXPECT_EQ(end, 0.0);
        }
    }
    fmt::print("  {} intact faces, {} broken ones that press, {} of them partly\n", intact, pressing, partly);
    ASSERT_GT(intact, 100);
    ASSERT_GT(partly, 3);
    ASSERT_LT(partly, pressing);
    EXPECT_GT(largest, 1.0);
    // The sum over 2e5 steps errs by 1e-10 of a stress, and by 1e-5 in the step where the pressure ends.
    EXPECT_TRUE(within("force of intact faces, of 10 MPa", forces, 0.0, 1e-9));
    EXPECT_TRUE(within("moment of intact faces, of 10 MPa", moments, 0.0, 1e-9));
    EXPECT_TRUE(within("length of intact faces", lengths, 0.0, 1e-9));
    EXPECT_TRUE(within("force of broken faces, of 10 MPa", pressing_forces, 0.0, 1e-7));
    EXPECT_TRUE(within("moment of broken faces, of 10 MPa", pressing_moments, 0.0, 1e-7));
}

TEST_F(FaceFrames, CracksHaveTheOpeningAndTheSlipOfTheFace) {
    const PolyData data = written([&](const FramePainter& painter, std::ostream& out, const PlacedFrame& placed) {
        painter.write_cracks(out, placed, cracks());
    });
    ASSERT_GT(cracks().size(), 20U);
    const double rounding = 1e-12 * test_.setup.specimen.height;
    for (std::size_t k = 0; k < cracks().size(); ++k) {
        const FaceIndex face = test_.setup.bonds.points[cracks()[k].bond].element_i;
        const BondFaceMotion motion = test_.world.faces.motion[face];
        EXPECT_NEAR(data.cell_data.at("opening")[k], motion.opening, rounding);
        EXPECT_NEAR(data.cell_data.at("slip")[k], motion.sliding, rounding);
        EXPECT_EQ(data.cell_data.at("mode")[k], test_.world.faces.broken[test_.world.faces.broken_at[face]].in_shear);
    }
}

// At rest no dashpot acts, so the forces in the frame are all that act on a grain. Points take over where broken faces
// slide apart or turn; their stiffness is a share of the whole.
TEST_F(FaceFrames, ForcesOfAFrameSumToTheForceOnEachBodyBesideBrokenFacesToo) {
    World& world = test_.world;
    for (BodyState& body : world.bodies.state) body.vx = body.vy = body.omega = 0.0;
    world.stepping.forces_current = false;
    compute_forces(world);
    look_at_contacts(world, test_.state.history);
    take_frame(world, test_.setup.bonds, test_.state.history, observe_row(world, test_.setup), 7, frame_);
    const PlacedFrame placed(world, test_.setup, frame_);
    const FrameForces forces = find_forces(placed);
    std::vector<Vec2> sum(world.bodies.size());
    std::vector<double> pressed(world.bodies.size(), 0.0);  // N, sum of the magnitudes
    const auto add = [&](const ContactPoint& point, const ContactGeometry& g, double normal, double shear) {
        const Vec2 on_i = shear * Vec2{-g.ny, g.nx} - normal * Vec2{g.nx, g.ny};
        sum[point.body_i] = sum[point.body_i] + on_i;
        sum[point.body_j] = sum[point.body_j] - on_i;
        pressed[point.body_i] += norm(on_i);
        pressed[point.body_j] += norm(on_i);
    };
    const auto geometry = [&]<PointKind K>(const ContactPoint& point) {
        std::uint32_t feature = point.feature_j;
        return contact_geometry<K>(BodyView(world), point, placed.body(point.body_i), placed.body(point.body_j),
                                   feature);
    };
    visit_kinds(test_.setup.bonds.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            const ContactPoint point = test_.setup.bonds.points.at<K>(k);
            add(point, geometry.template operator()<K>(point), forces.normal[k], frame_.shear_force[k]);
        }
    });
    const std::size_t bonds = test_.setup.bonds.points.size();
    int loose = 0, sharing = 0;
    visit_kinds(frame_.loose.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            const LooseContact& contact = frame_.loose.contacts[k];
            add(contact.point, geometry.template operator()<K>(contact.point), forces.normal[bonds + k],
                contact.shear_force);
            ++loose;
        }
    });
    for (const BrokenFace& face : world.faces.broken) sharing += face.taken > 0.0 && face.taken < 1.0;
    fmt::print("  {} points press, {} broken faces share with points\n", loose, sharing);
    ASSERT_GT(loose, 10);
    double off = 0.0;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        if (world.bodies.inertia[b].inverse_mass_y == 0.0 || pressed[b] == 0.0) continue;
        off = std::max(off, norm(sum[b] - Vec2{world.bodies.force[b].fx, world.bodies.force[b].fy}) / pressed[b]);
    }
    EXPECT_TRUE(within("force on a grain, of the forces that press it", off, 0.0, 1e-9));
}

// Springs of 1 GPa/m and a face of 2 m: a turn of 1e-3 makes 1 MPa/m.
TEST(FaceTraction, IsLinearAndEndsWhereABrokenFaceOpens) {
    const FaceSprings springs{2e9, 1e9, 2.0, 0.5, 0.5, 0.0, 0.0};
    const BondFaceMotion turned{{1.0, 0.0}, 0.0, 0.0, 1e-3};
    const FaceTraction intact = traction_of_intact(springs, turned, 1e6);
    EXPECT_DOUBLE_EQ(intact.at_begin, 0.5e6 - 1e6);
    EXPECT_DOUBLE_EQ(intact.at_end, 0.5e6 + 1e6);
    const FaceTraction full = traction_of_broken(springs, turned, 0.01, 4e6);
    EXPECT_DOUBLE_EQ(full.at_begin, 1e6);
    EXPECT_DOUBLE_EQ(full.at_end, 3e6);
    const FaceTraction half = traction_of_broken(springs, turned, 0.01, 0.5e6);
    EXPECT_DOUBLE_EQ(half.at_begin, -1e6);
    EXPECT_DOUBLE_EQ(half.at_end, 1e6);
    EXPECT_DOUBLE_EQ(half.moment, 0.5e6 * (1.0 - 1.0 / 3.0));
    EXPECT_EQ(traction_of_broken(springs, turned, 0.01, 0.0).at_end, 0.0);
}

}  // namespace
}  // namespace crackle
