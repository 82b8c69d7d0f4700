// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the joints of a case on the faces of its mesh.

#include "specimens/joints/joint_faces.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "solver/geometry/across_joint.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "specimens/making/make_specimen.hpp"
#include "tests/specimens/joints/cases.hpp"
#include "tests/support/refusal.hpp"

namespace crackle::joint_faces_test {
namespace {

using testing::area_rock;
using testing::case_of;

std::string meshed(const char* kind) {
    return std::string(area_rock) + "[mesh]\nkind = \"" + kind + "\"\nthick = 5e-4\n";
}

TEST(JointFaces, EveryFaceOnATraceHasOneBodyOnEitherSide) {
    for (const char* kind : {"voronoi", "delaunay"}) {
        const ResolvedCase test = case_of(meshed(kind) +
                                          "[[trace]]\npoints = [0.0, 0.1, 0.15, 0.2, 0.3, 0.42]\n"
                                          "friction_angle = 20.0\n"
                                          "[[trace]]\npoints = [0.2, 0.0, 0.1, 0.5]\n");
        const Specimen specimen = make_specimen(test, {});
        const Scene& scene = specimen.scene;
        ASSERT_EQ(scene.edge_sides.size(), scene.vertices.size());
        ASSERT_EQ(scene.joints.size(), 1u) << "the second trace has the rock's properties";
        EXPECT_EQ(scene.trace_joints, (std::vector<std::int32_t>{0, -1}));
        const std::vector<Vec2> bent{{0.0, 0.1}, {0.15, 0.2}, {0.3, 0.42}};
        std::map<TraceSide, double> length;
        for (const Body& body : scene.bodies) {
            const Vec2 centre = mass_properties(scene, body).centroid;
            for (std::uint32_t v = 0; v < body.vertex_count; ++v) {
                const TraceSide side = scene.edge_sides[body.first_vertex + v];
                if (side == no_side) continue;
                const Vec2 from = scene.vertices[body.first_vertex + v],
                           to = scene.vertices[body.first_vertex + (v + 1) % body.vertex_count];
                length[side] += norm(to - from);
                if (trace_of(side) != 0) continue;
                const Vec2 middle = 0.5 * (from + to);
                const std::size_t part = middle.x < 0.15 ? 0 : 1;
                const bool left = cross(bent[part + 1] - bent[part], centre - bent[part]) > 0.0;
                EXPECT_EQ(side, left ? 0 : 1) << kind << " body " << body.id;
            }
        }
        const double whole[] = {norm(bent[1] - bent[0]) + norm(bent[2] - bent[1]), std::hypot(0.1, 0.5)};
        for (const auto& [side, sum] : length) {
            fmt::print("  {}: side {}: expected {:.4f} m, got {:.4f} less the insets\n", kind, side,
                       whole[trace_of(side)], sum);
            EXPECT_LT(sum, whole[trace_of(side)]);
            EXPECT_GT(sum, 0.9 * whole[trace_of(side)]);
        }
        EXPECT_EQ(length.size(), 4u);
    }
}

/// Counts points of pairs with and without bonds across the joint: no bond may bypass an open joint.
TEST(JointFaces, AnOpenTraceThroughTheSpecimenLeavesNoBondAcrossIt) {
    for (const char* kind : {"voronoi", "delaunay"}) {
        const ResolvedCase test =
            case_of(meshed(kind) + "[[trace]]\npoints = [0.0, 0.15, 0.3, 0.35]\nbonded = false\n");
        const Specimen specimen = make_specimen(test, {});
        Scene scene = specimen.scene;
        scene.thick = specimen.mesh_gap;
        scene.bond_law = BondLaw::coulomb;
        scene.units = StiffnessUnits::area;
        scene.time_step = 0.0;
        scene.domain.wall_present = {false, false, false, false};
        Bonding bonding;
        bonding.thick = scene.thick;
        bonding.gap = 0.05 * scene.thick;
        World world = build_world(scene);
        bond_all(world, bonding);
        const auto above = [&](BodyIndex b) {
            const BodyState& body = world.bodies.state[b];
            return cross({0.3, 0.2}, Vec2{body.x, body.y - 0.15}) > 0.0;
        };
        int left = 0, across_bonds = 0;
        for (PointIndex k = 0; k < world.points.size(); ++k) {
            const ContactPoint point = world.points.contact[k];
            if (above(point.body_i) == above(point.body_j)) continue;
            across_bonds += (world.points.state[k].flags & point_bonded) != 0 ? 1 : 0;
            left += (world.points.state[k].flags & point_closed) != 0 ? 1 : 0;
        }
        fmt::print("  {}: {} points left open, {} bonds across\n", kind, left, across_bonds);
        EXPECT_EQ(across_bonds, 0);
        EXPECT_GT(left, 10);
    }
}

TEST(JointFaces, KeysComeToAJoint) {
    const ResolvedCase test =
        case_of(meshed("voronoi") +
                "[[trace]]\npoints = [0.0, 0.1, 0.3, 0.2]\nbonded = false\nfriction_angle = 20.0\n"
                "normal_stiffness = 1e11\nshear_stiffness = 2e10\ndilation_angle = 5.0\n"
                "dilation_slip = 1e-3\naperture = 1e-4\n"
                "[[joint_set]]\nname = \"a\"\nangle = 0.0\nspacing = 0.1\nstrength_factor = 0.5\n"
                "tensile_strength = 0.0\nresidual_friction_angle = 30.0\n");
    const Joint set = test.joints.sets[0].mechanics.value(), trace = test.joints.traces[0].mechanics.value();
    EXPECT_TRUE(set.bonded);
    EXPECT_EQ(set.strength_factor, 0.5);
    EXPECT_EQ(set.tensile_strength, 0.0);
    EXPECT_FALSE(set.cohesion);
    EXPECT_EQ(set.residual_friction_angle, 30.0);
    EXPECT_FALSE(trace.bonded);
    EXPECT_EQ(trace.friction_angle, 20.0);
    EXPECT_EQ(trace.normal_stiffness, 1e11);
    EXPECT_EQ(trace.shear_stiffness, 2e10);
    EXPECT_EQ(trace.dilation_angle, 5.0);
    EXPECT_EQ(trace.dilation_slip, 1e-3);
    EXPECT_EQ(trace.aperture, 1e-4);
}

TEST(JointFaces, OfCirclesLieOnTheTracesThatHaveMechanics) {
    const std::string joints =
        "[[trace]]\npoints = [0.0, 0.1, 0.15, 0.2, 0.3, 0.42]\nfriction_angle = 20.0\n"
        "[[trace]]\nname = \"idle\"\npoints = [0.2, 0.0, 0.1, 0.5]\n";
    const Specimen specimen = make_specimen(case_of(area_rock + joints), {});
    EXPECT_EQ(specimen.kind, SpecimenKind::circles);
    ASSERT_EQ(specimen.scene.joints.size(), 1u);
    EXPECT_EQ(specimen.scene.trace_joints, (std::vector<std::int32_t>{0, -1}));
    EXPECT_EQ(specimen.scene.trace_pieces.size(), 3u);
    ASSERT_EQ(specimen.traces.size(), 2u);
    EXPECT_NE(specimen.notices.back().find("joints without mechanical properties (idle) have no effect among circles"),
              std::string::npos);
    Scene scene = specimen.scene;
    scene.bond_law = BondLaw::coulomb;
    scene.units = StiffnessUnits::area;
    scene.time_step = 0.0;  // derived for the packing's stiffness; an automatic step is used instead
    const World world = build_world(scene);
    for (std::uint32_t part = 0; part < 2; ++part) {
        const TracePiece& piece = scene.trace_pieces[part];
        const double length = norm(piece.to - piece.from);
        for (const int right : {0, 1}) {
            std::vector<std::pair<double, double>> faces;  // extents of faces along the part
            std::vector<std::pair<double, double>> feet;   // of these circles: position along the part, and power, m2
            double least_radius = 1.0;
            for (const FlatFace& face : world.bodies.flat_faces) {
                ASSERT_EQ(trace_of(face.side), 0) << "the other has none";
                const BodyState& body = world.bodies.state[face.body];
                const Vec2 from_begin = Vec2{body.x, body.y} - piece.from, along{face.along_x, face.along_y};
                const double above = cross(along, from_begin);  // negative for circles assigned to the other side
                if (face.piece != part || (face.side & 1) != right || face.height != (right == 1 ? -above : above))
                    continue;
                faces.emplace_back(dot(along, from_begin) + face.from, dot(along, from_begin) + face.to);
                least_radius = std::min(least_radius, body.shape[0]);
                if (face.from < face.to)
                    feet.emplace_back(dot(along, from_begin), above * above - body.shape[0] * body.shape[0]);
            }
            std::sort(faces.begin(), faces.end());
            double covered = 0.0;  // end of the part covered without a gap
            for (const auto& [begin, end] : faces)
                if (begin <= covered + 1e-12) covered = std::max(covered, end);
            fmt::print("  faces of part {}, side {}: {} from its begin to {} m of {}\n", part, right, faces.size(),
                       covered, length);
            if (part == 0 || right == 0) {
                EXPECT_GE(covered, length - 1e-12);
            }
            // In the wedge between the second part and the wall to its right there are few circles, whose faces reach
            // up to three radii r. At an uncovered position, the nearest circle has a power of at least 9 r² - r², and
            // all others have a larger one.
            for (double p = 0.0; p < length; p += 1e-4) {
                if (std::ranges::any_of(faces,
                                        [&](const auto& f) { return f.first <= p + 1e-12 && p <= f.second + 1e-12; }))
                    continue;
                for (const auto& [foot, power] : feet)
                    ASSERT_GE((p - foot) * (p - foot) + power, 8.0 * least_radius * least_radius) << "at " << p;
            }
        }
    }
}

TEST(JointFaces, OfCirclesHaveAnAperturesLimit) {
    const std::string said = testing::refusal([&] {
        make_specimen(case_of(area_rock + "[[trace]]\npoints = [0.0, 0.2, 0.3, 0.2]\nbonded = false\naperture = 0.1\n"),
                      {});
    });
    EXPECT_NE(said.find("trace[1].aperture: found 0.1 m, expected at most the radius of the smallest circle"),
              std::string::npos)
        << said;
}

}  // namespace
}  // namespace crackle::joint_faces_test
