// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the linear analysis of a specimen between its platens: first events against the linear solution and against a
// run, free motions, vibration modes.

#include "specimens/elastic/analysis.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/displace.hpp"
#include "specimens/loading/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "solver/base/errors.hpp"
#include "solver/linear/vibration.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::SmallCase;

class ElasticAnalysisOf : public ::testing::Test {
  protected:
    VirtualTest prepared(const SmallCase& wanted) const {
        return prepare_test(read_case(testing::write_small_case(scratch_ / "", wanted)));
    }
    testing::ScratchFolder scratch_;
};

ElasticAnalysis analysed(const VirtualTest& test, double strain) {
    return analyse_elastic(test.world, test.setup, moduli_of(test), strain, 0);
}

TEST_F(ElasticAnalysisOf, BondForcesOfAllPointsHoldThePlatens) {
    for (const char* mesh : {"", "voronoi"}) {
        SmallCase wanted;
        wanted.mesh = mesh;
        const VirtualTest test = prepared(wanted);
        const double strain = 1e-5;
        const ElasticAnalysis a = analysed(test, strain);
        double pull = 0.0;
        std::size_t k = 0;
        for (PointIndex p = 0; p < test.world.points.size(); ++p) {
            const PointView view = view_point(test.world, p);
            if (!view.bonded) continue;
            const LinearBond& bond = a.bonds.at(k++);
            // Tension: the force transmitted by the upper platen's points, only the normal components where they are
            // vertical.
            if (view.body_i == test.setup.apparatus.top || view.body_j == test.setup.apparatus.top)
                pull -= bond.normal_force * std::abs(view.normal.y);
        }
        EXPECT_EQ(k, a.bonds.size());
        EXPECT_TRUE(agrees(fmt::format("force on the upper platen from the bonds, {}", mesh), pull,
                           a.youngs_modulus * strain * test.setup.specimen.width, 1e-6));
    }
}

/// Normal and shear forces, including signs, must equal those of the world after moving its bodies by the solution.
TEST_F(ElasticAnalysisOf, BondForcesAreThoseOfTheBodiesMoved) {
    for (const char* kind : {"tension", "compression"}) {
        SmallCase wanted;
        wanted.kind = kind;
        VirtualTest test = prepared(wanted);
        constexpr double strain = 1e-7;
        const Moduli moduli = moduli_of(test);
        const ElasticAnalysis a = analyse_elastic(test.world, test.setup, moduli, strain, 0);
        std::vector<BodyMotion> way = moduli.solution.displacement;
        const double sense = test.setup.apparatus.compression ? -strain : strain;
        for (BodyMotion& one : way) one = {sense * one.x, sense * one.y, sense * one.rotation};
        displace(test.world, way);
        compute_forces(test.world);
        std::size_t k = 0;
        double largest = 0.0, worst_normal = 0.0, worst_shear = 0.0;
        for (PointIndex p = 0; p < test.world.points.size(); ++p) {
            const PointView view = view_point(test.world, p);
            if (!view.bonded) continue;
            const LinearBond& bond = a.bonds.at(k++);
            largest = std::max(largest, std::abs(bond.shear_force));
            worst_normal = std::max(worst_normal, std::abs(view.normal_force - bond.normal_force));
            worst_shear = std::max(worst_shear, std::abs(view.shear_force - bond.shear_force));
        }
        // The error is of second order in the rotations, strain times the forces, plus round-off of overlaps of 1e-5 m
        // to 1e-16.
        EXPECT_TRUE(testing::within(fmt::format("normal forces in {}, over the largest shear", kind),
                                    worst_normal / largest, 0.0, 1e-3));
        EXPECT_TRUE(testing::within(fmt::format("shear forces in {}, over the largest", kind), worst_shear / largest,
                                    0.0, 1e-3));
    }
}

TEST_F(ElasticAnalysisOf, EnergyOfTheSolutionIsHalfStressTimesStrain) {
    const VirtualTest test = prepared({});
    const Moduli moduli = moduli_of(test);  // found at a strain of 1
    const double area = test.setup.specimen.width * test.setup.specimen.height;
    EXPECT_TRUE(agrees("stored energy", moduli.solution.energy, 0.5 * moduli.youngs_modulus * area, 1e-9));
}

TEST_F(ElasticAnalysisOf, FirstSlipAndBreakAreWhereARunHasThem) {
    // Discs are pulled so slowly that the run follows the linear solution until the first point slides.
    SmallCase wanted;
    wanted.rate = 2e-4;
    VirtualTest test = prepared(wanted);
    const ElasticAnalysis a = analysed(test, 1e-5);
    ASSERT_TRUE(a.first_slip && a.first_break);
    EXPECT_LE(a.first_slip->strain, a.first_break->strain);
    const LinearBond& bond = a.bonds[a.first_slip->bond];
    const auto slid = [&](PointIndex k) { return (test.world.points.state[k].flags & point_slid) != 0; };
    PointIndex found = 0;
    while (test.setup.apparatus.axial_strain(test.world) < 2.0 * a.first_slip->strain) {
        step(test.world);
        for (found = 0; found < test.world.points.size() && !slid(found); ++found) {
        }
        if (found < test.world.points.size()) break;
    }
    ASSERT_LT(found, test.world.points.size());
    // The rate error of the run: the initial wave still oscillates by rate·height/c relative to the strain, less than a
    // per cent here.
    EXPECT_TRUE(
        agrees("strain at the first slip", test.setup.apparatus.axial_strain(test.world), a.first_slip->strain, 0.02));
    const ContactPoint point = test.world.points.contact[found];
    const std::pair<int, int> ids =
        std::minmax(test.world.bodies.info(point.body_i).id, test.world.bodies.info(point.body_j).id);
    EXPECT_EQ(ids.first, std::min(bond.body_i, bond.body_j));
    EXPECT_EQ(ids.second, std::max(bond.body_i, bond.body_j));
}

TEST_F(ElasticAnalysisOf, FirstBreakIsTheLeastOfAllBondsAndNoneBreaksBeforeItSlips) {
    SmallCase wanted;
    const ElasticAnalysis a = analysed(prepared(wanted), 1e-5);
    double least = std::numeric_limits<double>::infinity();
    for (const LinearBond& bond : a.bonds) {
        if (bond.normal_force >= 0.0) continue;
        least = std::min(least, -bond.strength / bond.normal_force * a.strain);
        EXPECT_LE(bond.slip_strain, bond.break_strain * (1.0 + 1e-12));
    }
    EXPECT_TRUE(agrees("strain at the first break", a.first_break->strain, least, 1e-12));
    EXPECT_TRUE(agrees("stress at the first break", a.first_break->stress, a.youngs_modulus * least, 1e-12));
}

/// A square lattice of discs between walls instead of the small rock, written with the given number of digits.
ResolvedCase square_lattice_case(const testing::ScratchFolder& folder, const SmallCase& wanted, const char* digits) {
    const std::filesystem::path file = testing::write_small_case(folder / "", wanted);
    constexpr double radius = 0.5, overlap = 1e-4;
    Scene lattice = square_lattice(10, 20, radius, overlap, testing::small_rock_scene().materials[0]);
    double low_x = lattice.circles[0].centre.x, low_y = lattice.circles[0].centre.y, high_x = low_x, high_y = low_y;
    for (CircleElement& circle : lattice.circles) {
        circle.centre = {std::stod(fmt::format(fmt::runtime(digits), circle.centre.x)),
                         std::stod(fmt::format(fmt::runtime(digits), circle.centre.y))};
        low_x = std::min(low_x, circle.centre.x), high_x = std::max(high_x, circle.centre.x);
        low_y = std::min(low_y, circle.centre.y), high_y = std::max(high_y, circle.centre.y);
    }
    const double reach = radius - 0.5 * overlap;
    lattice.domain = {low_x - reach, high_x + reach, low_y - reach, high_y + reach, {true, true, true, true}};
    std::ofstream rock(folder / "rock.dat");
    write_geometry(rock, lattice);
    return read_case(file);
}

TEST_F(ElasticAnalysisOf, ALatticeSqueezedAlongItsAxisHasNoFirstEventAndNoRateOfRounding) {
    for (const char* digits : {"{:.17g}", "{:.12g}", "{:.8g}"}) {
        SmallCase wanted;
        wanted.kind = "compression";
        wanted.max_strain = 0.002;
        ResolvedCase described = square_lattice_case(scratch_, wanted, digits);
        described.loading.rate = parts::RateTolerance{0.1};
        const VirtualTest test = prepare_test(described);
        const ElasticAnalysis a = analysed(test, 1e-5);
        EXPECT_FALSE(a.first_break) << digits << ": at " << a.first_break->strain;
        EXPECT_FALSE(a.first_slip) << digits << ": at " << a.first_slip->strain;
        // A column has 19 contacts and two with the platens, 1e7 N/m each; there are 10 columns in a width of 9.999 m
        // and a height of 19.998 m.
        const double modulus = 10 * 1e7 / 21.0 / 9.999 * 19.998;
        EXPECT_TRUE(agrees(fmt::format("{}: modulus, N/m", digits), a.youngs_modulus, modulus, 1e-3));
        EXPECT_EQ(test.setup.rate_rule.first_strain, 0.002) << digits;
    }
}

TEST(FreeMotions, AreCountedAndNamedAndDoNotSpoilTheSolution) {
    // A held chain of three discs, a disc attached to its end by one contact, a floating disc, and a floating pair.
    const Material material = verification::rock();
    Scene scene = disc_chain(4, 0.02, 0.0399, material);
    scene.add_circle_body(10, 0, {{0.5, 0.5}, 0.02, 0.0});
    scene.add_circle_body(11, 0, {{0.7, 0.5}, 0.02, 0.0});
    scene.add_circle_body(12, 0, {{0.7399, 0.5}, 0.02, 0.0});
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    const BodyIndex low = body_of_id(world, 1), high = body_of_id(world, 3);
    const FreeMotions free = find_free_motions(world, {low, high});
    // Free motions: 1 for the attached disc, which rolls about its contact, 3 for the floating disc, and for the pair 3
    // as a whole and 1 hinge motion.
    EXPECT_EQ(free.count, 8);
    std::vector<int> ids;
    for (const BodyIndex b : free.bodies) ids.push_back(world.bodies.info(b).id);
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(ids, (std::vector<int>{4, 10, 11, 12}));
    const ElasticSolution solution = solve_elastic(world, {{low, {}}, {high, {1e-6, 0.0, 0.0}}});
    EXPECT_TRUE(agrees("force of two springs in series", solution.reaction[1].x, 0.5 * 1e7 * 1e-6, 1e-9));
    EXPECT_TRUE(
        testing::within("the pendant disc goes along", solution.displacement[body_of_id(world, 4)].x, 1e-6, 1e-14));
}

/// Discs without shear springs roll on each other: 584 contacts do not constrain all of the 3 x 304 motions.
TEST(ElasticAnalysis, NamesAMechanismWhichHasNoModulus) {
    const ResolvedCase rock =
        read_case(std::filesystem::path(CRACKLE_SOURCE_DIR) / "specimens/guide_rock/circles_tension.toml");
    EXPECT_TRUE(bond_test(rock).small_strain);
    ResolvedCase smooth = rock, loose = rock;
    smooth.material.friction_angle = 0.0;
    loose.material.shear_stiffness = 0.0;
    for (ResolvedCase test : {smooth, loose}) {
        const VirtualTest made = bond_test(test);
        EXPECT_FALSE(made.small_strain);
        EXPECT_NE(made.no_small_strain.find("found a mechanism"), std::string::npos) << made.no_small_strain;
        EXPECT_TRUE(std::isnan(made.state.youngs_modulus));
        test.loading.rate = parts::RateTolerance{0.01};
        try {
            prepare_test(test);
            ADD_FAILURE() << "expected an error, got a rate";
        } catch (const InputError& error) {
            fmt::print("  {}\n", error.what());
            EXPECT_NE(std::string(error.what()).find("found a mechanism"), std::string::npos) << error.what();
        }
    }
}

TEST(VibrationModes, OfAHeldChainAreTheClosedForm) {
    constexpr int count = 17;
    Scene scene = disc_chain(count, 0.02, 0.0399, verification::rock(45.0, 0.0));  // no shear springs
    const DofControl held{Drive::velocity, 0.0}, loose{};
    for (int k = 0; k < count; ++k)
        scene.controls.push_back({k, k == 0 || k == count - 1 ? held : loose, held, held, 0});
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    const double mass = world.bodies.inertia[0].mass;
    const std::vector<VibrationMode> modes = lowest_modes(world, 4, 0);
    for (int n = 1; n <= 4; ++n) {
        const double expected = 2.0 * std::sqrt(1e7 / mass) * std::sin(0.5 * std::numbers::pi * n / (count - 1));
        EXPECT_TRUE(
            agrees(fmt::format("mode {}, rad/s", n), modes[static_cast<std::size_t>(n - 1)].frequency, expected, 1e-7));
    }
}

}  // namespace
}  // namespace crackle
