// SPDX-License-Identifier: GPL-3.0-or-later
// Tests values that frames derive from the forces and bonds at one time: the mean stress of each particle, and the
// fragments.

#include "specimens/frames/frame_forces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/frames/fragments.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/measures/fragment_sizes.hpp"
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

Frame taken(VirtualTest& test) {
    compute_forces(test.world);
    look_at_contacts(test.world, test.state.history);
    Frame frame;
    take_frame(test.world, test.setup.bonds, test.state.history, observe_row(test.world, test.setup), 0, frame);
    return frame;
}

/// Calls visit(bond, view) for each bonded point.
template <class Visit>
void each_bond(const VirtualTest& test, Visit visit) {
    for (PointIndex k = 0; k < test.world.points.size(); ++k) {
        const PointView view = view_point(test.world, k);
        if (!view.bonded) continue;
        const PointIndex bond = bond_of(test.setup.bonds, view.kind, test.world.points.contact[k]);
        ASSERT_LT(bond, test.setup.bonds.points.size());
        visit(bond, view);
    }
}

class FrameForcesOfRock : public ::testing::Test {
  protected:
    VirtualTest prepared(const std::string& mesh = {}) const {
        SmallCase wanted;
        wanted.mesh = mesh;
        wanted.rate = 0.05;
        return prepare_test(read_case(write_small_case(scratch_ / "", wanted)));
    }
    ScratchFolder scratch_;
};

/// Σ ½(r⊗f + f⊗r) over the six contacts of a disc of radius R and area A, with spacing s ≈ 2R. For a strain ε along y
/// without rotation, each bond along n has N = -k_n s ε n_y² and T = k_s s ε n_x n_y.
TEST_F(FrameForcesOfRock, OfADiscInATriangularLatticeUnderUniaxialStrainAreTheClosedForm) {
    VirtualTest test = prepared();
    // The rock's lattice is slightly irregular, so its discs are moved to the exact positions and bonded there.
    const double strain = -1e-6, spacing = 2.0 * testing::rock_radius - testing::rock_overlap;
    for (StartPlace& start : test.setup.bonds.start) {
        const double row_height = spacing * std::sqrt(0.75), first = testing::rock_radius - testing::rock_overlap;
        const double row = std::round((start.y - first) / row_height);
        const double shift = first + 0.5 * spacing * (std::fmod(row, 2.0) == 0.0 ? 0.0 : 1.0);
        start = {shift + spacing * std::round((start.x - shift) / spacing), first + row_height * row, start.angle};
    }
    Frame frame = taken(test);
    const auto place = [&](BodyIndex b) { return Vec2{test.setup.bonds.start[b].x, test.setup.bonds.start[b].y}; };
    for (BodyIndex b = 0; b < frame.bodies.size(); ++b) {
        frame.bodies[b].x = place(b).x;
        frame.bodies[b].y = (1.0 + strain) * place(b).y;
    }
    const Material& material = test.world.settings.materials[0];
    std::vector<int> partners(frame.bodies.size());
    for (std::size_t k = 0; k < test.setup.bonds.points.size(); ++k) {
        const auto [i, j] = test.setup.bonds.points.pairs[k];
        if (test.setup.apparatus.is_platen(i) || test.setup.apparatus.is_platen(j)) continue;
        ++partners[i];
        ++partners[j];
        const Vec2 normal = (1.0 / norm(place(j) - place(i))) * (place(j) - place(i));
        test.setup.bonds.overlaps[k] = 2.0 * testing::rock_radius - norm(place(j) - place(i));
        frame.shear_force[k] = material.shear_stiffness * strain * spacing * normal.x * normal.y;
    }
    const FrameForces forces = find_forces(PlacedFrame(test.world, test.setup, frame));
    const double area = std::numbers::pi * testing::rock_radius * testing::rock_radius;
    const double unit = -strain * spacing * spacing / area;
    const double kn = material.normal_stiffness, ks = material.shear_stiffness;
    const double yy = 3.0 / 8.0 * unit * (3.0 * kn + ks), xx = 3.0 / 8.0 * unit * (kn - ks);
    double worst = 0.0;
    int inner = 0;
    for (BodyIndex b = 0; b < frame.bodies.size(); ++b) {
        if (partners[b] != 6) continue;
        ++inner;
        const ParticleStress& got = forces.stress[b];
        worst = std::max({worst, std::abs(got.yy - yy), std::abs(got.xx - xx), std::abs(got.xy)});
        if (inner == 1) {
            EXPECT_TRUE(agrees("stress along the load, N/m", got.yy, yy, 1e-5));
            EXPECT_TRUE(agrees("stress across, N/m", got.xx, xx, 1e-5));
        }
    }
    EXPECT_GE(inner, 30);
    EXPECT_TRUE(within("largest deviation of any disc inside, over the stress", worst / yy, 0.0, 1e-5));
}

TEST_F(FrameForcesOfRock, AreZeroBeforeLoadingAndAddUpToTheViewsOfAllPointsLater) {
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        VirtualTest test = prepared(mesh);
        const Frame first = taken(test);
        double most = 0.0;
        for (const ParticleStress& s : find_forces(PlacedFrame(test.world, test.setup, first)).stress)
            most = std::max({most, std::abs(s.xx), std::abs(s.yy), std::abs(s.xy)});
        EXPECT_TRUE(within(fmt::format("{}: stress before loading over the peak", mesh), most / 1e4, 0.0, 1e-6));
        load_specimen(test);
        const Frame last = taken(test);
        const FrameForces forces = find_forces(PlacedFrame(test.world, test.setup, last));
        std::vector<ParticleStress> sums(last.bodies.size());
        for (PointIndex k = 0; k < test.world.points.size(); ++k) {
            const PointView view = view_point(test.world, k);
            const Vec2 force = view.shear_force * perpendicular(view.normal) - view.normal_force * view.normal;
            for (const auto& [body, on, arm] :
                 {std::tuple(view.body_i, force, view.arm_i), std::tuple(view.body_j, -force, view.arm_j)}) {
                sums[body].xx -= arm.x * on.x;
                sums[body].yy -= arm.y * on.y;
                sums[body].xy -= 0.5 * (arm.x * on.y + arm.y * on.x);
            }
        }
        double largest = 0.0, off = 0.0;
        for (BodyIndex b = 0; b < sums.size(); ++b) {
            const ParticleStress& got = forces.stress[b];
            if (test.setup.apparatus.is_platen(b)) {
                EXPECT_EQ(got.yy, 0.0) << "a platen's";
                continue;
            }
            const double share = test.world.settings.materials[0].density / test.world.bodies.inertia[b].mass;
            largest = std::max(largest, std::abs(got.yy));
            off = std::max({off, std::abs(got.xx - share * sums[b].xx), std::abs(got.yy - share * sums[b].yy),
                            std::abs(got.xy - share * sums[b].xy)});
        }
        EXPECT_GT(largest, 1e3);
        EXPECT_TRUE(
            within(fmt::format("{}: largest deviation over the largest stress", mesh), off / largest, 0.0, 1e-9));
    }
}

TEST_F(FrameForcesOfRock, OfASpecimenUnderPressureAreThoseOfItsPoints) {
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        SmallCase wanted;
        wanted.kind = "biaxial";
        wanted.mesh = mesh;
        wanted.output += "\n[confinement]\npressure = 1e4";
        VirtualTest test = prepare_test(read_case(write_small_case(scratch_ / "", wanted)));
        const Frame frame = taken(test);
        const FrameForces forces = find_forces(PlacedFrame(test.world, test.setup, frame));
        double worst = 0.0, largest = 0.0;
        each_bond(test, [&](PointIndex bond, const PointView& view) {
            worst = std::max(worst, std::abs(forces.normal[bond] - view.normal_force));
            largest = std::max(largest, std::abs(view.normal_force));
        });
        // Overlaps are differences of positions, so the round-off of forces is 1e-16 m times 1e7 N/m, for forces of
        // about 100 N.
        EXPECT_TRUE(
            within(fmt::format("{}: largest difference over the largest force", mesh), worst / largest, 0.0, 1e-9));
    }
}

// Between flat faces, the overlap at zero force depends on the rotation of the circles.
TEST_F(FrameForcesOfRock, OfFlatFacesAreThoseOfTheirPoints) {
    ResolvedCase asked =
        read_case(std::filesystem::path(CRACKLE_SOURCE_DIR) / "specimens/jointed/softrock_welded.toml");
    asked.loading.max_axial_strain = 0.004;  // shortly before the peak
    VirtualTest test = prepare_test(asked);
    load_specimen(test);
    const Frame frame = taken(test);
    const FrameForces forces = find_forces(PlacedFrame(test.world, test.setup, frame));
    double worst = 0.0, largest = 0.0, turned = 0.0;
    std::size_t flat = 0;
    each_bond(test, [&](PointIndex bond, const PointView& view) {
        worst = std::max(worst, std::abs(forces.normal[bond] - view.normal_force));
        largest = std::max(largest, std::abs(view.normal_force));
        if (view.kind != PointKind::face_face) return;
        ++flat;
        turned =
            std::max(turned, view.normal_stiffness * std::abs(view.bond_overlap - test.setup.bonds.overlaps[bond]));
    });
    fmt::print("  {} flat faces; turning has taken up to {:.3g} of the largest force\n", flat, turned / largest);
    EXPECT_GT(flat, 50U);
    EXPECT_GT(turned, 0.01 * largest) << "otherwise the test cannot fail";
    EXPECT_TRUE(within("largest difference over the largest force", worst / largest, 0.0, 1e-9));
}

TEST_F(FrameForcesOfRock, FragmentsOfASpecimenSplitAcrossAreItsTwoParts) {
    for (const char* mesh : {"", "voronoi"}) {
        VirtualTest test = prepared(mesh);
        Frame frame = taken(test);
        const std::vector<std::int32_t> whole = find_fragments(test.world, test.setup, frame);
        for (BodyIndex b = 0; b < whole.size(); ++b) EXPECT_EQ(whole[b], test.setup.apparatus.is_platen(b) ? -1 : 0);
        // The part above the cut is smaller than the part below it. A single bond across the cut would hold them
        // together.
        const double cut = 0.7 * test.setup.specimen.height;
        const auto above = [&](BodyIndex b) { return frame.bodies[b].y > cut; };
        std::size_t last = 0;
        for (std::size_t k = 0; k < test.setup.bonds.points.size(); ++k) {
            const ContactPoint point = test.setup.bonds.points[k];
            if (above(point.body_i) == above(point.body_j)) continue;
            frame.states[k] = ContactState::broken_touching;
            last = k;
        }
        const std::vector<std::int32_t> parts = find_fragments(test.world, test.setup, frame);
        for (BodyIndex b = 0; b < parts.size(); ++b)
            EXPECT_EQ(parts[b], test.setup.apparatus.is_platen(b) ? -1
                                : above(b)                        ? 1
                                                                  : 0)
                << test.world.bodies.info(b).id;
        const FragmentSizes figures = measure_fragments(test.world, test.setup, frame);
        EXPECT_EQ(figures.count, 2);
        double all = 0.0, below = 0.0;
        for (BodyIndex b = 0; b < parts.size(); ++b) {
            all += test.setup.apparatus.is_platen(b) ? 0.0 : area_of(test.world, b);
            below += test.setup.apparatus.is_platen(b) || above(b) ? 0.0 : area_of(test.world, b);
        }
        EXPECT_TRUE(within("largest share", figures.largest_share, below / all, 1e-12));
        frame.states[last] = ContactState::bonded_slid;
        EXPECT_EQ(find_fragments(test.world, test.setup, frame), whole);
    }
}

TEST_F(FrameForcesOfRock, FragmentsAreNumberedByAreaThenById) {
    VirtualTest test = prepared();
    Frame frame = taken(test);
    std::fill(frame.states.begin(), frame.states.end(), ContactState::broken);
    const std::vector<std::int32_t> dust = find_fragments(test.world, test.setup, frame);
    std::vector<std::pair<int, std::int32_t>> by_id;
    for (BodyIndex b = 0; b < dust.size(); ++b)
        if (!test.setup.apparatus.is_platen(b)) by_id.emplace_back(test.world.bodies.info(b).id, dust[b]);
    std::sort(by_id.begin(), by_id.end());
    for (std::size_t k = 0; k < by_id.size(); ++k)
        EXPECT_EQ(by_id[k].second, static_cast<std::int32_t>(k)) << "fragments of equal size are ordered by ids";
}

TEST_F(FrameForcesOfRock, FragmentsAreWhatSpreadingAlongIntactBondsReaches) {
    for (const char* mesh : {"", "delaunay"}) {
        VirtualTest test = prepared(mesh);
        load_specimen(test);
        const Frame frame = taken(test);
        // Each body gets the lowest index among the bodies bonded to it, until nothing changes.
        std::vector<BodyIndex> lowest(frame.bodies.size());
        for (BodyIndex b = 0; b < lowest.size(); ++b) lowest[b] = b;
        for (bool changed = true; changed;) {
            changed = false;
            for (PointIndex k = 0; k < test.world.points.size(); ++k) {
                const PointView view = view_point(test.world, k);
                if (!view.bonded || test.setup.apparatus.is_platen(view.body_i) ||
                    test.setup.apparatus.is_platen(view.body_j))
                    continue;
                const BodyIndex low = std::min(lowest[view.body_i], lowest[view.body_j]);
                changed = changed || lowest[view.body_i] != low || lowest[view.body_j] != low;
                lowest[view.body_i] = lowest[view.body_j] = low;
            }
        }
        const std::vector<std::int32_t> got = find_fragments(test.world, test.setup, frame);
        std::set<std::pair<std::int32_t, BodyIndex>> pairs;
        std::set<std::int32_t> numbers;
        std::set<BodyIndex> groups;
        for (BodyIndex b = 0; b < got.size(); ++b) {
            if (test.setup.apparatus.is_platen(b)) continue;
            pairs.emplace(got[b], lowest[b]);
            numbers.insert(got[b]);
            groups.insert(lowest[b]);
        }
        fmt::print("  {}: {} fragments\n", *mesh == '\0' ? "circles" : mesh, groups.size());
        EXPECT_GT(groups.size(), *mesh == '\0' ? 0U : 1U);
        EXPECT_EQ(numbers.size(), groups.size());
        EXPECT_EQ(pairs.size(), groups.size()) << "one fragment per group";
        EXPECT_EQ(*numbers.rbegin(), static_cast<std::int32_t>(groups.size()) - 1);
    }
}

}  // namespace
}  // namespace crackle
