// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the directions of cracks, for a specimen pulled apart and for cracks set by hand.

#include "specimens/measures/crack_rose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/frames/crack_faces.hpp"
#include "specimens/frames/fragments.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/measures/fragment_sizes.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

class CrackedRock : public ::testing::Test {
  protected:
    VirtualTest prepared(const std::string& mesh) const {
        testing::SmallCase wanted;
        wanted.mesh = mesh;
        wanted.rate = 0.05;
        return prepare_test(read_case(testing::write_small_case(scratch_ / "", wanted)));
    }
    testing::ScratchFolder scratch_;
};

TEST_F(CrackedRock, HasACrackForEachBrokenBondBetweenParticlesByKindAndTime) {
    for (const char* mesh : {"", "voronoi"}) {
        const VirtualTest test = prepared(mesh);
        ContactHistory history;
        double lengths = 0.0;
        std::size_t between_particles = 0;
        for (PointIndex bond = 0; bond < test.setup.bonds.points.size(); ++bond) {
            Crack crack;
            crack.bond = bond;
            crack.time = static_cast<double>(bond);
            crack.shear_mode = bond % 3 == 0;
            crack.orientation = -0.5 * std::numbers::pi + 0.2;  // direction of the normal; the crack is at 0.2 rad
            history.cracks.push_back(crack);
            const ContactPoint point = test.setup.bonds.points[bond];
            if (test.setup.apparatus.is_platen(point.body_i) || test.setup.apparatus.is_platen(point.body_j)) continue;
            lengths += length_of_face(test.world, test.setup, bond);
            ++between_particles;
        }
        ASSERT_LT(between_particles, test.setup.bonds.points.size()) << "platens have bonds, too";
        const double peak = 0.5 * static_cast<double>(test.setup.bonds.points.size());
        const CrackRoses roses = find_crack_roses(test.world, test.setup, history, peak);
        double length = 0.0;
        std::size_t count = 0;
        for (const Rose* rose :
             {&roses.tension_to_peak, &roses.shear_to_peak, &roses.tension_after, &roses.shear_after}) {
            EXPECT_GT(rose->count, 0u);
            EXPECT_TRUE(within("direction, degrees", rose->mean_direction(), 0.2 * 180.0 / std::numbers::pi, 1e-9));
            EXPECT_TRUE(within("resultant of parallel ones", rose->resultant(), 1.0, 1e-12));
            length += rose->weight;
            count += rose->count;
        }
        EXPECT_EQ(count, between_particles);
        EXPECT_TRUE(agrees("length of all, m", length, lengths, 1e-12));
        const auto shares =
            static_cast<double>(roses.shear_to_peak.count) / static_cast<double>(roses.tension_to_peak.count);
        EXPECT_TRUE(within("shear to tension up to the peak", shares, 0.5, 0.1));
        const CrackRoses no_peak = find_crack_roses(test.world, test.setup, history, std::nan(""));
        EXPECT_EQ(no_peak.tension_after.count + no_peak.shear_after.count, 0u);
        EXPECT_EQ(no_peak.tension_to_peak.count + no_peak.shear_to_peak.count, between_particles);
    }
}

TEST_F(CrackedRock, HasFragmentsOfTheSizesOfItsParts) {
    VirtualTest test = prepared("");
    compute_forces(test.world);
    look_at_contacts(test.world, test.state.history);
    Frame frame;
    take_frame(test.world, test.setup.bonds, test.state.history, CurveRow{}, 0, frame);
    FragmentSizes whole = measure_fragments(test.world, test.setup, frame);
    EXPECT_EQ(whole.count, 1);
    EXPECT_TRUE(std::isnan(whole.law.size));
    const double disc = std::numbers::pi * testing::rock_radius * testing::rock_radius;
    const double area = disc * static_cast<double>(test.setup.specimen.particles);
    EXPECT_TRUE(agrees("D50 of one fragment, m", whole.median_size, std::sqrt(4.0 * area / std::numbers::pi), 1e-12));
    std::ranges::fill(frame.states, ContactState::broken);
    const FragmentSizes dust = measure_fragments(test.world, test.setup, frame);
    EXPECT_EQ(dust.count, test.setup.specimen.particles);
    EXPECT_TRUE(agrees("D50 of dust, m", dust.median_size, 2.0 * testing::rock_radius, 1e-12));
    EXPECT_EQ(dust.law.pieces, 0u) << "tiny fragments are not part of the fit";
}

}  // namespace
}  // namespace crackle
