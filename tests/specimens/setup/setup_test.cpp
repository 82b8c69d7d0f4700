// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the record of a specimen at the start of loading: its gauge, for a lattice of known Poisson's ratio, and its
// counts.

#include "specimens/setup/setup.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>
#include <vector>

#include "specimens/case/case_file.hpp"
#include "specimens/elastic/analysis.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::SmallCase;

/// A tall triangular lattice with columns along y that overlaps four walls. Uniaxial stress along the columns gives
/// uniform deformation, including the sides: at a disc of the side, two inclined bonds are in balance as at any other
/// disc.
Scene tall_lattice(const Material& material) {
    const double overlap = testing::rock_overlap, spacing = 2.0 * testing::rock_radius - overlap;
    Scene scene = triangular_lattice(56, 9, testing::rock_radius, overlap, material);
    for (CircleElement& circle : scene.circles)
        circle.centre = {circle.centre.y + 0.5 * spacing, circle.centre.x + 0.5 * spacing};
    scene.time_step = 1e-5;
    scene.domain = {0.0, spacing * (1.0 + 8.0 * std::sqrt(0.75)), 0.0, spacing * 56.0, {true, true, true, true}};
    return scene;
}

/// Axial strain of the middle half of the height, from initial and final positions of discs at the left side.
double strain_of_middle(const TestSetup& setup, const std::vector<double>& rise) {
    const auto by_height = [&](BodyIndex a, BodyIndex b) { return setup.bonds.start[a].y < setup.bonds.start[b].y; };
    const auto [low, high] = std::ranges::minmax_element(setup.gauges.left, by_height);
    return (rise[*high] - rise[*low]) / (setup.bonds.start[*high].y - setup.bonds.start[*low].y);
}

TEST(Gauge, GivesThePoissonsRatioOfATriangularLattice) {
    // With springs kn and ks at every contact, nu = (kn - ks)/(3 kn + ks), from the energy of a uniform strain for the
    // three bond directions. The held ends are softer than the middle. Their influence decreases as exp(-4.2 y/width)
    // (Saint-Venant), to 6e-4 where the gauge begins.
    const testing::ScratchFolder scratch;
    const auto path = testing::write_small_case(scratch / "", [] {
        SmallCase wanted;
        wanted.kind = "compression";
        wanted.max_strain = 2e-5;
        return wanted;
    }());
    Material material = testing::small_rock_scene().materials.front();
    for (const double share : {0.25, 0.6, 1.0}) {
        material.shear_stiffness = share * material.normal_stiffness;
        {
            std::ofstream out(scratch / "rock.dat");
            write_geometry(out, tall_lattice(material));
        }
        ResolvedCase description = read_case(path);
        description.loading.rate = parts::RateTolerance{0.01};
        description.numerics.intact = true;
        VirtualTest test = prepare_test(description);
        const double expected = (1.0 - share) / (3.0 + share);
        const Moduli moduli = moduli_of(test);
        std::vector<double> rise;
        for (const BodyMotion& motion : moduli.solution.displacement) rise.push_back(motion.y);
        EXPECT_TRUE(testing::within(fmt::format("ks/kn = {}: of the solve", share),
                                    moduli.poissons_ratio / strain_of_middle(test.setup, rise), expected, 1e-3));
        load_specimen(test);
        for (std::size_t b = 0; b < rise.size(); ++b)
            rise[b] = test.setup.bonds.start[b].y - test.world.bodies.state[b].y;
        const CurveRow &first = test.state.rows.front(), &last = test.state.rows.back();
        EXPECT_TRUE(testing::within(fmt::format("ks/kn = {}: of the run", share),
                                    (last.lateral_strain - first.lateral_strain) / strain_of_middle(test.setup, rise),
                                    expected, 2e-3));
    }
}

TEST(Setup, CountsContactsThatTouchAndBondsApart) {
    const testing::ScratchFolder scratch;
    VirtualTest test = prepare_test(read_case(testing::write_small_case(scratch / "", {})));
    const auto bonds = static_cast<std::int64_t>(test.setup.bonds.points.size());
    EXPECT_EQ(test.setup.bonds.contacts_initial, bonds);
    for (PointIndex k = 0, loosened = 0; k < test.world.points.size() && loosened < 3; ++k) {
        if ((test.world.points.state[k].flags & point_bonded) == 0) continue;
        test.world.points.state[k].flags &= static_cast<std::uint16_t>(~point_bonded);
        ++loosened;
    }
    Platens platens;
    platens.bottom_id = test.setup.apparatus.bottom_id;
    platens.top_id = test.setup.apparatus.top_id;
    const TestSetup again = record_setup(test.world, Specimen{}, platens, LoadingKind::tension, 0.0);
    EXPECT_EQ(again.bonds.contacts_initial, bonds);
    EXPECT_EQ(static_cast<std::int64_t>(again.bonds.points.size()), bonds - 3);
}

TEST(CurveRow, CountsSlidingPointsThatCarryMoreThanRounding) {
    const testing::ScratchFolder scratch;
    VirtualTest test = prepare_test(read_case(testing::write_small_case(scratch / "", {})));
    const double tension = test.setup.bonds.mean_back_tension;
    const std::vector<double> shear{0.9e-9 * tension, 1.1e-9 * tension, -1.1e-9 * tension, 0.5 * tension};
    const std::int64_t before = observe_row(test.world, test.setup).points_sliding;
    EXPECT_EQ(before, 0);
    for (PointIndex k = 0; k < shear.size(); ++k) {
        test.world.points.state[k].flags |= static_cast<std::uint16_t>(point_touching | point_sliding | point_slid);
        test.world.points.shear_force[k] = shear[k];
    }
    EXPECT_EQ(observe_row(test.world, test.setup).points_sliding, 3);
    test.world.points.state[3].flags &= static_cast<std::uint16_t>(~point_sliding);
    EXPECT_EQ(observe_row(test.world, test.setup).points_sliding, 2) << "one that slid earlier does not count";
}

}  // namespace
}  // namespace crackle
