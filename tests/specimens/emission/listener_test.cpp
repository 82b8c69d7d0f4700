// SPDX-License-Identifier: GPL-3.0-or-later
// Tests which breaks belong to one event, and the moment of a bond that breaks in a chain, for which it is known.

#include "specimens/emission/listener.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/faces/bond_faces.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/making/materials.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_circles_rock.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle::listener_test {
namespace {

using testing::agrees;
using testing::within;

constexpr double radius = 0.02, stiffness = 1e7, overlap = 1e-7, weak_overlap = 0.5e-7;

/// Four discs in a line at an angle; the last is pulled and the first held, and the middle bond has half the strength.
World chain(double angle, double damping_ratio) {
    const Vec2 along{std::cos(angle), std::sin(angle)};
    Scene scene;
    scene.materials = {undamped_rock(stiffness, 27.0)};
    scene.materials[0].damping_ratio = damping_ratio;
    scene.materials[0].density = 2500.0;
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {true, true, true, true}};
    scene.time_step = 2e-5;  // more than a hundred per period
    double at = -3.0 * radius;
    for (int k = 0; k < 4; ++k) {
        scene.add_circle_body(k + 1, 0, {at * along, radius, 0.0});
        at += 2.0 * radius - (k == 1 ? weak_overlap : overlap);
    }
    const DofControl still{Drive::velocity, 0.0};
    const double speed = 2e-8;  // m/s, so that dashpots carry at most a thousandth of T
    scene.controls = {{0, still, still, still, 0},
                      {3, {Drive::velocity, speed * along.x}, {Drive::velocity, speed * along.y}, still, 0}};
    World world = build_world(scene);
    bond_all(world, 0.0);
    return world;
}

TestSetup ends_of(const World& world) {
    TestSetup setup;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        if (world.bodies.info(b).id == 1) setup.apparatus.bottom = b;
        if (world.bodies.info(b).id == 4) setup.apparatus.top = b;
    }
    return setup;
}

EmissionRule slow_rule() { return {.diameter = 2.0 * radius, .shear_wave_speed = 1.0, .density = 1.0}; }

/// Pulls until the event of the single break has ended.
AcousticEvent pulled_apart(double angle, double damping_ratio) {
    World world = chain(angle, damping_ratio);
    const TestSetup setup = ends_of(world);
    Emission emission;
    emission.rule = slow_rule();
    EmissionListener listener(world, setup, emission);
    std::size_t heard = 0;
    for (int n = 0; n < 2'000'000 && emission.events.empty(); ++n) {
        step(world);
        const bool broke = world.bonds.events.size() > heard;
        if (!listener.must_listen(broke)) continue;
        listener.listen(std::span(world.bonds.events).subspan(heard), 0.25);
        heard = world.bonds.events.size();
    }
    EXPECT_EQ(world.bonds.events.size(), 1U);
    EXPECT_EQ(emission.events.size(), 1U);
    EXPECT_TRUE(emission.open.empty());
    return emission.events.empty() ? AcousticEvent{} : emission.events.front();
}

TEST(EmissionOfAChain, IsAnOpeningWithTheMomentOfWhatItBore) {
    // The source pulled its neighbours, a diameter away on either side, with T = k δ0, and releases them: M = 2 T 2r
    // along the chain. With overcritical damping it comes to rest there.
    const double moment = 2.0 * stiffness * weak_overlap * 2.0 * radius;
    for (const double angle : {0.0, 0.4, 2.0}) {
        const AcousticEvent event = pulled_apart(angle, 2.0);
        const PrincipalMoments m = principal_moments(event.moment);
        EXPECT_TRUE(agrees("moment along the chain, N m", m.largest, moment, 2e-3));
        EXPECT_TRUE(within("across", m.smallest / moment, 0.0, 1e-6));
        EXPECT_TRUE(within("direction", std::sin(m.direction - angle), 0.0, 1e-6));
        EXPECT_TRUE(agrees("R", isotropic_percent(event.moment), 50.0, 1e-5));
        EXPECT_EQ(event.breaks, 1);
        EXPECT_EQ(event.axial_strain, 0.25);
        EXPECT_TRUE(agrees("radius, m", event.radius, 2.0 * radius, 1e-12));
        EXPECT_TRUE(agrees("window, s", event.duration, 4.0 * radius, 1e-12));
    }
}

TEST(EmissionOfAChain, SwingsToTwiceTheMomentWithoutDamping) {
    // Two equal oscillators, each released at a distance of T/k from its equilibrium, so the force swings to -T.
    const double moment = 2.0 * stiffness * weak_overlap * 2.0 * radius;
    const AcousticEvent event = pulled_apart(0.7, 0.0);
    EXPECT_TRUE(agrees("moment along the chain, N m", principal_moments(event.moment).largest, 2.0 * moment, 5e-3));
    EXPECT_GT(event.rise_time, 0.0);
}

constexpr double side = 0.04, modulus = 1e9, strength = 1e3;  // m, Pa, Pa

/// Four square cells in a row, bonded by faces; the last is pulled and the first held, and the middle face has half the
/// strength. Their stiffness is that of cells without a pressure, with Poisson's ratio 0.
World row_of_cells(double damping_ratio) {
    Scene scene;
    Material rock = undamped_rock(stiffness, 27.0);
    rock.density = 2500.0;
    scene.materials = {rock};
    scene.units = StiffnessUnits::area;
    scene.bond_law = BondLaw::face;
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {true, true, true, true}};
    scene.thick = 0.02 * side;
    scene.time_step = 2e-7;
    const double half = 0.5 * scene.thick;
    for (int k = 0; k < 4; ++k) {
        const double x = (k - 2) * side;
        scene.add_chain_body(
            k + 1, 0,
            {{x + half, half}, {x + side - half, half}, {x + side - half, side - half}, {x + half, side - half}}, true);
    }
    const DofControl still{Drive::velocity, 0.0};
    scene.controls = {{0, still, still, still, 0}, {3, {Drive::velocity, 4e-6}, still, still, 0}};
    World world = build_world(scene);
    FaceBonding bonding;
    bonding.materials.push_back({face_moduli_without_pressure(modulus, 0.0, 0.0), {}});
    bonding.materials[0].law.tensile_strength = strength;
    bonding.materials[0].law.cohesion = 10.0 * strength;
    bonding.materials[0].law.damping_ratio = damping_ratio;
    bonding.gap = scene.thick;
    bonding.platens = PlatenFaces::bonded;
    bond_by_faces(world, bonding);
    for (FaceIndex k = 0; k < world.faces.size(); ++k)
        if (world.faces.bodies[k].body_i == 1 && world.faces.bodies[k].body_j == 2) world.faces.strength_share[k] = 0.5;
    return world;
}

TEST(EmissionOfFaces, HasTheMomentOfWhatTheTwoCellsBore) {
    // The two cells pulled their neighbours, a side away on either side, with F = T L/2 each, and release them.
    const double moment = 2.0 * (0.5 * strength * side) * side;
    for (const double damping_ratio : {2.0, 0.0}) {
        World world = row_of_cells(damping_ratio);
        const TestSetup setup = ends_of(world);
        Emission emission;
        emission.rule = {.diameter = side, .shear_wave_speed = 1.0, .density = 1.0};
        EmissionListener listener(world, setup, emission);
        std::size_t heard = 0;
        for (int n = 0; n < 2'000'000 && emission.events.empty(); ++n) {
            step(world);
            if (!listener.must_listen(world.bonds.events.size() > heard)) continue;
            listener.listen(std::span(world.bonds.events).subspan(heard), 0.25);
            heard = world.bonds.events.size();
        }
        ASSERT_EQ(emission.events.size(), 1U);
        const AcousticEvent& event = emission.events.front();
        const PrincipalMoments m = principal_moments(event.moment);
        // Without damping, the cells swing to the other side of their rest, as two equal oscillators.
        EXPECT_TRUE(agrees("moment along the row, N m", m.largest, damping_ratio > 0.0 ? moment : 2.0 * moment, 5e-3));
        EXPECT_TRUE(within("across", m.smallest / moment, 0.0, 1e-6));
        EXPECT_EQ(event.breaks, 1);
    }
}

/// Passes breaks to the listener as if they had been found in a world at rest.
class Clustering : public ::testing::Test {
  protected:
    Clustering() : world_(chain(0.0, 0.1)), setup_(ends_of(world_)), listener_(world_, setup_, emission_) {
        emission_.rule = {.diameter = 1.0, .shear_wave_speed = 4.0, .density = 1.0};  // the window is 0.5 s
        compute_forces(world_);
    }
    std::size_t hear(double time, std::initializer_list<Vec2> places) {
        world_.stepping.time = time;
        std::vector<BreakEvent> breaks;
        for (const Vec2 place : places) {
            BreakEvent one{};
            one.time = time;
            one.position = place;
            one.energy = 2.0;
            one.shear_mode = place.y > 0.0;
            one.kind = PointKind::circle_circle;
            one.point = world_.points.contact[0];
            breaks.push_back(one);
        }
        return listener_.listen(breaks, time);
    }

    World world_;
    TestSetup setup_;
    Emission emission_;
    EmissionListener listener_;
};

TEST_F(Clustering, JoinsWhatIsNearInPlaceAndTime) {
    EXPECT_FALSE(listener_.must_listen(false));
    hear(10.0, {{0.0, 0.0}});
    EXPECT_TRUE(listener_.must_listen(false));
    hear(10.4, {{0.8, 0.0}});  // within 1 m and 0.5 s of the first
    ASSERT_EQ(emission_.open.size(), 1U);
    const AcousticEvent& event = emission_.open[0].event;
    EXPECT_EQ(event.breaks, 2);
    EXPECT_TRUE(agrees("centre, m", event.centre.x, 0.4, 1e-12));
    EXPECT_TRUE(agrees("radius, m", event.radius, 1.4, 1e-12));
    EXPECT_TRUE(agrees("duration, s", event.duration, 0.4 + 0.7, 1e-12));
    hear(11.05, {{-0.9, 0.0}});  // outside the initial radius and window, inside the enlarged ones
    EXPECT_EQ(emission_.open.size(), 1U);
    EXPECT_EQ(event.breaks, 3);
    EXPECT_EQ(event.energy, 6.0);
    EXPECT_EQ(event.time, 10.0);
    EXPECT_EQ(event.axial_strain, 10.0);
}

TEST_F(Clustering, PartsWhatIsFarInPlaceOrTime) {
    hear(10.0, {{0.0, 0.0}, {1.01, 0.0}});
    EXPECT_EQ(emission_.open.size(), 2U) << "beyond the disc";
    EXPECT_EQ(hear(10.51, {{0.0, 0.3}}), 2U) << "both windows have ended";
    ASSERT_EQ(emission_.events.size(), 2U);
    EXPECT_EQ(emission_.events[1].centre.x, 1.01);
    EXPECT_EQ(emission_.open.size(), 1U);
    EXPECT_EQ(emission_.open[0].event.breaks_in_shear, 1);
    EXPECT_EQ(listener_.end_all(), 1U);
    EXPECT_EQ(emission_.events.size(), 3U);
}

TEST(EmissionRule, TakesTheSpeedFromModuliAndMassesInEitherUnits) {
    const testing::ScratchFolder scratch;
    testing::write_circles_rock(scratch / "");
    ResolvedCase wanted = read_case(scratch / "compression.toml");
    wanted.output.emission = true;
    const VirtualTest area = prepare_test(wanted);
    const EmissionRule& rule = area.state.emission.rule;
    ASSERT_TRUE(rule.on());
    // Results by hand, for circles of 2600 kg/m3 with a porosity of one sixth and a thickness of 1 m.
    double mass = 0.0, diameters = 0.0;
    for (std::size_t b = 0; b < area.world.bodies.size(); ++b) {
        if (area.setup.apparatus.is_platen(static_cast<BodyIndex>(b))) continue;
        const double r = area.world.bodies.state[b].shape[0];
        mass += 2600.0 * std::numbers::pi * r * r;
        diameters += 2.0 * r;
    }
    const double density = mass / (area.setup.specimen.width * area.setup.specimen.height);
    EXPECT_TRUE(agrees("density, kg/m2", rule.density, density, 1e-12));
    EXPECT_GT(rule.density, 2000.0);
    EXPECT_LT(rule.density, 2400.0);
    EXPECT_TRUE(
        agrees("diameter, m", rule.diameter, diameters / static_cast<double>(area.setup.specimen.particles), 1e-12));
    EXPECT_TRUE(agrees("damping ratio", rule.damping_ratio, 0.2, 1e-6));  // factors have single precision
    const double shear_modulus = area.state.youngs_modulus / 2.0 / (1.0 + area.state.poissons_ratio);
    EXPECT_TRUE(agrees("speed, m/s", rule.shear_wave_speed, std::sqrt(shear_modulus / density), 1e-12));
    EXPECT_GT(rule.shear_wave_speed, 1000.0);
    EXPECT_LT(rule.shear_wave_speed, 4000.0);
    EXPECT_EQ(rule.thickness, 1.0);
}

TEST(EmissionRule, GoesByAMeanFieldWhereModuliAreNotKnown) {
    // For a shear strain of 1, a bond of length l along an axis is sheared by l/2, and a diagonal one is stretched by
    // l/2.
    const World level = chain(0.0, 0.1), slanted = chain(0.25 * std::numbers::pi, 0.1);
    TestSetup setup = ends_of(level);
    setup.specimen.area = 0.01;
    setup.specimen.width = setup.specimen.height = 0.1;
    const double length = 2.0 * radius - overlap, ratio = level.settings.laws[0].shear_stiffness / stiffness;
    double sum = 0.0;
    for (const double l : {length, 2.0 * radius - weak_overlap, length}) sum += 0.25 * stiffness * l * l;
    EXPECT_TRUE(agrees("G of a level chain, N/m", mean_field_shear_modulus(level, setup),
                       ratio * sum / setup.specimen.area, 1e-9));
    EXPECT_TRUE(agrees("of a slanted one", mean_field_shear_modulus(slanted, setup), sum / setup.specimen.area, 1e-9));
    const EmissionRule rule = emission_rule(level, setup, std::nan(""), std::nan(""), 1.0);
    EXPECT_TRUE(rule.mean_field);
    EXPECT_TRUE(
        agrees("speed, m/s", rule.shear_wave_speed, std::sqrt(ratio * sum / setup.specimen.area / rule.density), 1e-9));
}

TEST(EmissionRule, OfADiscHasItsDensityAndTheDashpotsThatAreGiven) {
    World world = chain(0.0, 0.1);
    TestSetup setup = ends_of(world);
    setup.apparatus.uniaxial = false;
    setup.specimen.width = setup.specimen.height = 0.1;
    setup.specimen.area = 0.25 * std::numbers::pi * 0.01;  // area of the disc in that box
    const double mass = 2500.0 * std::numbers::pi * radius * radius;
    const auto rule = [&] { return emission_rule(world, setup, std::nan(""), std::nan(""), 1.0); };
    EXPECT_TRUE(agrees("density, kg/m2", rule().density, 4.0 * mass / setup.specimen.area, 1e-12));
    EXPECT_TRUE(agrees("damping ratio", rule().damping_ratio, 0.1, 1e-12));
    // Critical damping is 2 sqrt(k m/2) for two equal masses on a spring, and 2 sqrt(k m) for one mass on a held body.
    // The chain has one spring of the first kind and two of the second.
    const double critical = 2.0 * std::sqrt(stiffness * 0.5 * mass);
    for (ContactLaw& law : world.settings.laws) {
        law.normal_damping = 0.3 * critical;
        law.normal_damping_ratio_term = 0.0;
    }
    EXPECT_TRUE(agrees("damping ratio of dashpots in N s/m", rule().damping_ratio,
                       (0.3 + 2.0 * 0.3 / std::numbers::sqrt2) / 3.0, 1e-12));
}

TEST(EmissionRule, OfAMeanFieldIsNoSlowerThanThatOfTheModuli) {
    for (const char* mesh : {"", "voronoi"}) {
        const testing::ScratchFolder scratch;
        testing::SmallCase wanted;
        wanted.mesh = mesh;
        const VirtualTest test = prepare_test(read_case(testing::write_small_case(scratch / "", wanted)));
        const double known = test.state.youngs_modulus / 2.0 / (1.0 + test.state.poissons_ratio);
        const double over = mean_field_shear_modulus(test.world, test.setup) / known;
        fmt::print("  {}: {:.3f} times the shear modulus of the solution\n", *mesh == '\0' ? "circles" : mesh, over);
        std::size_t of_platens = 0;
        for (const BodyPair& bond : test.setup.bonds.points.pairs)
            of_platens +=
                test.setup.apparatus.is_platen(bond.body_i) || test.setup.apparatus.is_platen(bond.body_j) ? 1 : 0;
        const double left_out = static_cast<double>(of_platens) / static_cast<double>(test.setup.bonds.points.size());
        EXPECT_GE(over, 1.0 - left_out) << "Voigt's bound, less the platens' share of the bonds";
        EXPECT_LT(over, 1.5);
    }
}

TEST(EmissionRule, IsRefusedWithoutAShearModulus) {
    const World world = chain(0.0, 0.1);
    TestSetup setup = ends_of(world);
    setup.specimen.area = 0.01;
    EXPECT_THROW(emission_rule(world, setup, -1e9, 0.2, 1.0), InputError);
}

TEST(EmissionOfATest, HoldsEveryBreakOnce) {
    for (const char* mesh : {"", "voronoi"}) {
        const testing::ScratchFolder scratch;
        testing::SmallCase wanted;
        wanted.kind = "compression";
        wanted.mesh = mesh;
        wanted.max_strain = 0.02;
        wanted.output += "\nemission = true";
        VirtualTest test = prepare_test(read_case(testing::write_small_case(scratch / "", wanted)));
        load_specimen(test);
        const std::vector<AcousticEvent>& events = test.state.emission.events;
        std::int64_t breaks = 0, in_shear = 0;
        double energy = 0.0;
        for (const AcousticEvent& event : events) {
            breaks += event.breaks;
            in_shear += event.breaks_in_shear;
            energy += event.energy;
            EXPECT_TRUE(std::isfinite(scalar_moment(event.moment)));
            EXPECT_LE(event.rise_time, event.duration * (1.0 + 1e-12));
        }
        EXPECT_GT(events.size(), 5U);
        EXPECT_EQ(breaks, test.world.bonds.broken);
        EXPECT_EQ(in_shear, test.state.breaks_in_shear);
        EXPECT_TRUE(agrees("energy, J", energy, test.world.account.fracture_loss, 1e-9));
        EXPECT_TRUE(test.state.emission.open.empty());
    }
}

}  // namespace
}  // namespace crackle::listener_test
