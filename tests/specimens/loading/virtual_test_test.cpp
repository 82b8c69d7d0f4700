// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a specimen between its platens: their positions and measurements.

#include "specimens/loading/virtual_test.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/making/make_specimen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"
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

class VirtualRock : public ::testing::Test {
  protected:
    VirtualTest prepare(const SmallCase& wanted) const {
        return prepare_test(read_case(write_small_case(scratch_ / "", wanted)));
    }
    VirtualTest tested(const SmallCase& wanted) const {
        VirtualTest test = prepare(wanted);
        load_specimen(test);
        return test;
    }
    ScratchFolder scratch_;
};

TEST_F(VirtualRock, CirclesOverlapTheirPlatensByWhatTheyOverlappedTheWalls) {
    const VirtualTest test = prepare({});
    const Scene packed = testing::small_rock_scene();
    int platen_bonds = 0;
    double worst = 0.0;
    for (PointIndex k = 0; k < test.world.points.size(); ++k) {
        const ContactPoint point = test.world.points.contact[k];
        if ((test.world.points.state[k].flags & point_bonded) == 0) continue;
        const bool top = point.body_j == test.setup.apparatus.top;
        if (!top && point.body_j != test.setup.apparatus.bottom) continue;
        ++platen_bonds;
        const int id = test.world.bodies.info(point.body_i).id;
        const auto body =
            std::find_if(packed.bodies.begin(), packed.bodies.end(), [&](const Body& b) { return b.id == id; });
        ASSERT_NE(body, packed.bodies.end()) << id;
        const double y = packed.circles[body->first_circle].centre.y;
        const double to_wall = testing::rock_radius - (top ? packed.domain.y2 - y : y - packed.domain.y1);
        worst = std::max(worst, std::abs(test.world.points.bond_overlap[k] - to_wall));
    }
    EXPECT_EQ(platen_bonds, 6 + 5) << "the lowest row has six discs, the highest five";
    EXPECT_TRUE(within("largest difference of the overlaps, m", worst, 0.0, 1e-15));
}

TEST_F(VirtualRock, PolygonsStandAsFarFromTheirPlatensAsFromEachOther) {
    for (const char* kind : {"voronoi", "delaunay"}) {
        SmallCase wanted;
        wanted.mesh = kind;
        const VirtualTest test = prepare(wanted);
        double low = 1.0, high = 0.0;
        int platen_bonds = 0;
        for (PointIndex k = 0; k < test.world.points.size(); ++k) {
            const ContactPoint point = test.world.points.contact[k];
            if ((test.world.points.state[k].flags & point_bonded) == 0 ||
                (point.body_j != test.setup.apparatus.top && point.body_j != test.setup.apparatus.bottom))
                continue;
            ++platen_bonds;
            low = std::min(low, test.world.points.bond_overlap[k]);
            high = std::max(high, test.world.points.bond_overlap[k]);
        }
        fmt::print("  {}: {} platen bonds\n", kind, platen_bonds);
        EXPECT_GE(platen_bonds, 20);
        EXPECT_TRUE(agrees("smallest overlap with a platen, m", low, 8e-5, 1e-9));
        EXPECT_TRUE(agrees("largest overlap with a platen, m", high, 8e-5, 1e-9));
    }
}

TEST_F(VirtualRock, BeginsWithVelocityLinearBetweenThePlatensAndNoWalls) {
    const VirtualTest test = prepare({});
    const double low = element_positions(test.world, test.setup.apparatus.bottom)[0].y;
    const double high = element_positions(test.world, test.setup.apparatus.top)[0].y;
    const double speed = 0.02 * test.setup.specimen.height;
    double worst = 0.0;
    for (BodyIndex b = 0; b < test.world.bodies.size(); ++b) {
        const BodyState& body = test.world.bodies.state[b];
        const double share = b == test.setup.apparatus.top      ? 1.0
                             : b == test.setup.apparatus.bottom ? 0.0
                                                                : (body.y - low) / (high - low);
        worst = std::max(worst, std::abs(body.vy - speed * share));
        EXPECT_EQ(body.vx, 0.0);
        EXPECT_EQ(body.omega, 0.0);
    }
    EXPECT_TRUE(within("largest deviation of the velocities, m/s", worst, 0.0, 1e-15));
    EXPECT_EQ(test.world.settings.domain.wall_present, (std::array<bool, 4>{false, false, false, false}));
}

TEST_F(VirtualRock, PulledFailsWithPositiveStressAndBalancedEnergy) {
    const VirtualTest test = tested({});
    EXPECT_TRUE(test.state.failure.failed);
    EXPECT_EQ(test.state.ended_by, ended_by_failure);
    EXPECT_GT(test.state.failure.peak_stress, 0.0);
    EXPECT_GT(test.world.bodies.state[test.setup.apparatus.top].y, test.setup.apparatus.top_start);
    EXPECT_EQ(static_cast<std::int64_t>(test.world.bonds.events.size()), test.world.bonds.broken);
    EXPECT_EQ(test.state.breaks_in_shear + test.state.breaks_in_tension, test.world.bonds.broken);
    const CurveRow& last = test.state.rows.back();
    const CurveRow& first = test.state.rows.front();
    EXPECT_EQ(last.bonds_broken, test.world.bonds.broken);
    const double balance = last.kinetic_energy - first.kinetic_energy + last.strain_energy + last.dashpot_loss +
                           last.friction_loss + last.fracture_loss - last.platen_work;
    EXPECT_TRUE(agrees("energy_error against the columns, J", balance, last.energy_error, 1e-6));
    EXPECT_TRUE(within("energy balance over work", balance / last.platen_work, 0.0, 5e-3));
    // The stress cannot exceed what the bonds across the narrower row can carry.
    const double bound = 6.0 * 1e7 * 2.0 * testing::rock_overlap / test.setup.specimen.width;
    EXPECT_LT(test.state.failure.peak_stress, bound);
}

TEST_F(VirtualRock, SqueezedIsStrongerThanPulledAndWidens) {
    SmallCase squeezed;
    squeezed.kind = "compression";
    const VirtualTest compression = tested(squeezed);
    const VirtualTest tension = tested({});
    fmt::print("  strength {:.4g} N/m squeezed, {:.4g} N/m pulled\n", compression.state.failure.peak_stress,
               tension.state.failure.peak_stress);
    EXPECT_GT(compression.state.failure.peak_stress, tension.state.failure.peak_stress);
    EXPECT_GT(compression.state.rows[10].lateral_strain, 0.0);
    EXPECT_LT(tension.state.rows[10].lateral_strain, 0.0);
    EXPECT_LT(compression.world.bodies.state[compression.setup.apparatus.top].y, compression.setup.apparatus.top_start);
}

TEST_F(VirtualRock, FrictionalPlatensStartWithoutForceAndHoldNoBond) {
    SmallCase wanted;
    wanted.kind = "compression";
    wanted.loading = "platens = \"frictional\"\nplaten_friction_angle = 5";
    VirtualTest test = prepare(wanted);
    for (const BodyPair& bond : test.setup.bonds.points.pairs) {
        EXPECT_NE(bond.body_j, test.setup.apparatus.top);
        EXPECT_NE(bond.body_j, test.setup.apparatus.bottom);
    }
    load_specimen(test);
    EXPECT_LT(std::abs(test.state.rows.front().axial_stress), 1e-3 * test.state.failure.peak_stress);
    EXPECT_GT(test.state.failure.peak_stress, 1e3) << "N/m: the platens press";
    EXPECT_TRUE(std::isfinite(test.state.youngs_modulus)) << "of the specimen with bonded platens";
}

TEST_F(VirtualRock, CornersPressedThroughAPlatensFaceArePushedBackInProportion) {
    // Behind a single segment, corners would be pushed out on the far side, and the strength would be k_n t per corner.
    SmallCase wanted;
    wanted.mesh = "voronoi";
    wanted.kind = "compression";
    wanted.loading = "platens = \"frictional\"\nplaten_friction_angle = 5";
    VirtualTest test = prepare(wanted);
    World& world = test.world;
    const double thick = world.settings.thick;
    world.bodies.state[test.setup.apparatus.bottom].y += 2.5 * thick;
    world.bodies.state[test.setup.apparatus.top].y -= 2.5 * thick;
    for (BodyState& body : world.bodies.state) body.vx = body.vy = body.omega = 0.0;  // removes the forces of dashpots
    world.list.valid = world.stepping.forces_current = false;
    compute_forces(world);
    for (const BodyIndex platen : {test.setup.apparatus.bottom, test.setup.apparatus.top}) {
        const double outwards = platen == test.setup.apparatus.top ? 1.0 : -1.0;
        const double face = element_positions(world, platen)[0].y;
        double expected = 0.0, deepest = 0.0;
        for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
            if (test.setup.apparatus.is_platen(b)) continue;
            for (const Vec2 corner : element_positions(world, b)) {
                const double depth = outwards * (corner.y - face);
                expected += 1e7 * std::max(0.0, thick + depth);
                deepest = std::max(deepest, depth);
            }
        }
        EXPECT_GT(deepest, 1.4 * thick);
        EXPECT_TRUE(agrees("force on the platen, N", outwards * world.bodies.force[platen].fy, expected, 1e-9));
    }
}

TEST_F(VirtualRock, HalfTheStepGivesThePeakWithinFivePercent) {
    SmallCase coarse, fine;
    fine.numerics = "safety_factor = 0.4";
    EXPECT_TRUE(agrees("peak at half the step, N/m", tested(fine).state.failure.peak_stress,
                       tested(coarse).state.failure.peak_stress, 0.05));
}

TEST_F(VirtualRock, EnergyOfARunToFailureClosesBetterWithTheStep) {
    // A break accounts for the work of its forces during the drift in which it is found, so the error is of second
    // order.
    std::vector<double> errors;
    for (const char* share : {"0.8", "0.4", "0.2"}) {
        SmallCase wanted;
        wanted.mesh = "voronoi";
        wanted.numerics = std::string("safety_factor = ") + share;
        const VirtualTest test = tested(wanted);
        ASSERT_TRUE(test.state.failure.failed);
        const CurveRow& end = test.state.rows.back();
        errors.push_back(end.energy_error / end.platen_work);
        fmt::print("  {} of the bound: {:.3g} of the work\n", share, errors.back());
    }
    EXPECT_LT(std::abs(errors[0]), 1e-4);
    EXPECT_LT(std::abs(errors[2]), 0.3 * std::abs(errors[0]))
        << "second order gives a sixteenth, apart from the times of single breaks";
}

TEST_F(VirtualRock, NoTermOfTheAccountOfEnergyCouldBeMissing) {
    // Each loss alone is much larger than the closing error; for dashpots, in each direction separately.
    for (const bool shear : {false, true}) {
        SmallCase wanted;
        wanted.mesh = "voronoi";
        wanted.numerics = "safety_factor = 0.4";
        ResolvedCase description = read_case(write_small_case(scratch_ / "", wanted));
        description.material.damping_ratio.reset();
        description.material.normal_damping = shear ? 0.0 : 2000.0;  // N s/m, about 0.2 of the critical damping
        description.material.shear_damping = shear ? 1000.0 : 0.0;
        VirtualTest test = prepare_test(description);
        load_specimen(test);
        ASSERT_GT(test.world.bonds.broken, 0);
        const CurveRow& end = test.state.rows.back();
        const double open = std::abs(end.energy_error / end.platen_work);
        const std::map<std::string, double> terms{{shear ? "shear dashpots" : "normal dashpots", end.dashpot_loss},
                                                  {"friction", end.friction_loss},
                                                  {"fracture", end.fracture_loss},
                                                  {"strain", end.strain_energy},
                                                  {"kinetic", end.kinetic_energy}};
        for (const auto& [name, joules] : terms) {
            fmt::print("  {}: {:.3g} of the work, {:.2g} left open\n", name, joules / end.platen_work, open);
            EXPECT_GT(joules / end.platen_work, 10.0 * open) << name;
        }
    }
}

TEST_F(VirtualRock, HalfTheStepIsHalfAlsoWhereTheBoundRulesIt) {
    for (const char* share : {"0.4", "1.0"}) {
        SmallCase wanted;
        wanted.mesh = "voronoi";
        wanted.numerics = std::string("safety_factor = ") + share;
        ResolvedCase description = read_case(write_small_case(scratch_ / "", wanted));
        VirtualTest whole = prepare_test(description);
        description.step_scale = 0.5;
        VirtualTest half = prepare_test(description);
        for (VirtualTest* test : {&whole, &half}) {
            for (int k = 0; k < 20; ++k) step(test->world);
        }
        const bool bound_rules = whole.world.stepping.step_bound < whole.world.stepping.step_goal;
        fmt::print("  safety factor {}, {} rules: {:.4g} s, half of it expected, got {:.4g} s\n", share,
                   bound_rules ? "the bound" : "the goal", whole.world.stepping.time_step,
                   half.world.stepping.time_step);
        EXPECT_EQ(bound_rules, share == std::string("1.0"));
        EXPECT_NEAR(half.world.stepping.time_step, 0.5 * whole.world.stepping.time_step,
                    1e-3 * whole.world.stepping.time_step);
    }
}

TEST_F(VirtualRock, TooLargeATimeStepIsRefusedWithTheBound) {
    SmallCase wanted;
    wanted.numerics = "time_step = 1.0e-2";
    try {
        prepare(wanted);
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("found 0.01 s, expected at most"), std::string::npos) << error.what();
    }
}

std::string refusal_of(const std::filesystem::path& path) {
    try {
        prepare_test(read_case(path));
    } catch (const InputError& error) {
        fmt::print("  {}\n", error.what());
        return error.what();
    }
    return "accepted";
}

TEST_F(VirtualRock, CellsHaveTheMaterialOfTheirSeeds) {
    SmallCase wanted;
    wanted.mesh = "voronoi";
    const auto path = write_small_case(scratch_ / "", wanted);
    Scene scene = testing::small_rock_scene();
    Material soft = scene.materials[0];
    soft.normal_stiffness = 1e6;
    scene.materials.push_back(soft);
    for (std::size_t b = 0; b < scene.bodies.size(); b += 3) scene.bodies[b].material = 1;
    std::ofstream out(scratch_ / "rock.dat");
    write_geometry(out, scene);
    out.close();
    const Specimen specimen = make_specimen(read_case(path), {});
    ASSERT_EQ(specimen.scene.bodies.size(), scene.bodies.size());
    int soft_cells = 0;
    for (const Body& cell : specimen.scene.bodies) {
        const Vec2 centre = mass_properties(specimen.scene, cell).centroid;
        const auto nearest =
            std::min_element(scene.bodies.begin(), scene.bodies.end(), [&](const Body& a, const Body& b) {
                return norm(scene.circles[a.first_circle].centre - centre) <
                       norm(scene.circles[b.first_circle].centre - centre);
            });
        EXPECT_EQ(cell.material, nearest->material) << "cell " << cell.id;
        soft_cells += cell.material;
    }
    EXPECT_GT(soft_cells, 20);
}

TEST_F(VirtualRock, RaggedFacesThatPlatensHoldByACornerAreRefused) {
    const auto with = [&](const char* kind, const std::string& more, const std::string& loading) {
        SmallCase wanted;
        wanted.mesh = kind;
        wanted.kind = "compression";
        wanted.loading = loading;
        const auto path = write_small_case(scratch_ / "", wanted);
        std::string text = read_file(path);
        text.insert(text.find("[bond]"), more + "\n");
        const std::string lattice = "[particles]\nfile = \"rock.dat\"\n[material]\n";
        text.replace(text.find(lattice), lattice.size(),
                     "[packing]\ncount = 80\nradius_min = 0.015\nradius_max = 0.025\nmean_overlap = 8e-5\n[material]\n"
                     "density = 2500\nnormal_stiffness = 1e7\nshear_stiffness = 2.5e6\nfriction_angle = 27\n");
        std::ofstream(path) << text;
        return refusal_of(path);
    };
    EXPECT_NE(with("delaunay", "boundary = \"seeds\"", "").find("expected them to reach over half of it"),
              std::string::npos);
    EXPECT_EQ(with("delaunay", "boundary = \"seeds\"", "platens = \"frictional\"\nplaten_friction_angle = 5"),
              "accepted");
    EXPECT_NE(with("voronoi", "boundary = \"seeds\"", "").find("expected \"domain\""), std::string::npos);
    EXPECT_NE(with("voronoi", "inset = 0.6e-3", "").find("more than twice mesh.inset"), std::string::npos);
    EXPECT_EQ(with("voronoi", "inset = 0.5e-3", ""), "accepted");
}

TEST_F(VirtualRock, LoosePiecesAreRefused) {
    const auto path = write_small_case(scratch_ / "", {});
    Scene scene = testing::small_rock_scene();
    double middle = 0.0;
    for (const CircleElement& circle : scene.circles) middle += circle.centre.y;
    middle /= static_cast<double>(scene.circles.size());
    for (CircleElement& circle : scene.circles) circle.centre.y += circle.centre.y > middle ? 1e-3 : 0.0;
    scene.domain.y2 += 1e-3;
    std::ofstream out(scratch_ / "rock.dat");
    write_geometry(out, scene);
    out.close();
    EXPECT_NE(refusal_of(path).find("expected a specimen in one piece"), std::string::npos);
}

TEST_F(VirtualRock, NothingToBondWithAPlatenIsRefused) {
    const auto path = write_small_case(scratch_ / "", {});
    Scene scene = testing::small_rock_scene();
    scene.domain.y2 += 0.01;
    std::ofstream out(scratch_ / "rock.dat");
    write_geometry(out, scene);
    out.close();
    EXPECT_NE(refusal_of(path).find("upper platen"), std::string::npos);
}

TEST_F(VirtualRock, UnderTheGuidesLawIntactRunOfCirclesHasTheModulusOfTheSolve) {
    // With polygons this holds only as long as no disc passes the end of a segment, where the overlap jumps. In a mesh
    // of thousands of pairs that happens at once. Here only the platens are segments; the verification claims include
    // polygons.
    for (const char* law : {"demseg", "demseg_mean"}) {
        SmallCase wanted;
        wanted.rate = 0.002;
        wanted.max_strain = 1e-4;
        wanted.numerics = fmt::format("intact = true\ncontact_law = \"{}\"", law);
        const VirtualTest test = tested(wanted);
        const auto& rows = test.state.rows;
        const CurveRow &half = rows[rows.size() / 2], &last = rows.back();
        EXPECT_TRUE(agrees(fmt::format("E of circles, {}", law),
                           (last.axial_stress - half.axial_stress) / (last.axial_strain - half.axial_strain),
                           test.state.youngs_modulus, 5e-3));
    }
}

TEST_F(VirtualRock, UnderTheGuidesLawPolygonsHoldOnToTheirPlatensBySegmentPairs) {
    SmallCase wanted;
    wanted.mesh = "voronoi";
    wanted.numerics = "contact_law = \"demseg\"";
    const VirtualTest test = prepare(wanted);
    int facing = 0;
    double worst = 0.0;
    for (PointIndex k = 0; k < test.world.points.size(); ++k) {
        const PointView view = view_point(test.world, k);
        if (!view.bonded) continue;
        EXPECT_EQ(view.kind, PointKind::segment_segment);
        if (!test.setup.apparatus.is_platen(view.body_i) && !test.setup.apparatus.is_platen(view.body_j)) continue;
        // If both ends of an edge are in front of the platen's face, the overlap is twice the excess of bond.thick over
        // the gap. With one end it is once the excess; a platen's own corners are too far away.
        const double ends = view.overlap > 1.2e-4 ? 2.0 : 1.0;
        facing += ends > 1.5 ? 1 : 0;
        worst = std::max(worst, std::abs(view.overlap - ends * 8e-5));
    }
    EXPECT_EQ(facing, 6 + 5) << "one edge of every cell in the end rows";
    EXPECT_TRUE(within("overlaps with the platens, m", worst, 0.0, 1e-12));
    const TestSetup& setup = test.setup;
    fmt::print("  {} bonds, mean back-tension {:.4g} N a pair of elements\n", setup.bonds.points.size(),
               setup.bonds.mean_back_tension);
    EXPECT_EQ(static_cast<std::int64_t>(setup.bonds.points.size()), test.world.bonds.initial);
}

}  // namespace
}  // namespace crackle
