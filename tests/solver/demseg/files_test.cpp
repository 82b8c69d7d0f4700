// SPDX-License-Identifier: GPL-3.0-or-later
// Tests in_bc.dat, in_cf.dat, in_cf0.dat, the state file and the outputs: formats, reading back what was written,
// refusals.

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/demseg/boundary.hpp"
#include "solver/demseg/contact_files.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/demseg/deck_state.hpp"
#include "solver/demseg/outputs.hpp"
#include "solver/demseg/random_circles.hpp"
#include "solver/files/read_file.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/checkpoint.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

using namespace testing;

BoundaryConditions boundary_of(const std::string& text) {
    DeckReader reader("in_bc.dat", text);
    return read_boundary(reader);
}

TEST(Boundary, ReadsAndWritesTheGuidesForceControl) {
    const BoundaryConditions boundary = boundary_of("0 0 20000 100 10\n1\n2\n1\n2 0 1.0d4 1 0.0d0 1 0.0d0\n");
    EXPECT_EQ(boundary.start, DeckStart::fresh);
    EXPECT_EQ(boundary.steps, 20000);
    EXPECT_EQ(boundary.watched, std::vector<int>{2});
    EXPECT_EQ(boundary.controls[0].x, (DofControl{Drive::force, 1e4}));
    EXPECT_EQ(boundary.controls[0].y, (DofControl{Drive::displacement, 0.0}));
    std::ostringstream out;
    write_boundary(out, boundary);
    EXPECT_EQ(out.str(), "0 0 20000 100 10\n1\n2\n1\n2 0 10000 1 0 1 0\n");
}

TEST(Boundary, RefusalsNameTheKey) {
    EXPECT_EQ(refusal([] { boundary_of("2 0 1 1 1 0 0"); }),
              "in_bc.dat:1: jclid: found '2', expected 0 (new), 1 (continued with in_cf.dat) or 3 (bonded)");
    EXPECT_EQ(refusal([] { boundary_of("0 0 10\n0 1 0 0"); }),
              "in_bc.dat:2: nprn1: found '0', expected a whole number from 1 to 1000000000000");
    EXPECT_EQ(refusal([] { boundary_of("0 0 10 1 1\n2\n5 5\n0"); }),
              "in_bc.dat:3: id 2 of npfd: found 5 a second time, expected each body once");
    EXPECT_EQ(refusal([] { boundary_of("0 0 10 1 1\n0\n1\n2 2 0 1 0 1 0"); }),
              "in_bc.dat:4: body 2: fx: found '2', expected a whole number from 0 to 1");
    Scene scene = read_geometry(shipped_deck("circle") / "in_gm.dat");
    EXPECT_EQ(refusal([&] { apply_controls(boundary_of("0 0 10 1 1\n0\n1\n7 0 0 0 0 0 0"), scene); }),
              "in_bc.dat: npbd: found body 7, expected one of the 1 bodies of in_gm.dat");
}

/// Two touching squares and a clump of two circles that touches both a square and a single circle.
Scene mixed_scene() {
    Scene scene;
    Material material;
    material.density = 1.0;
    material.normal_stiffness = 1e4;
    material.shear_stiffness = 5e3;
    material.friction_angle = 30.0;
    scene.materials.push_back(material);
    scene.domain = {0.0, 10.0, 1.0, 10.0, {true, true, true, true}};
    scene.thick = 0.1;
    scene.bare_segment_width = deck_bare_segment_width;
    scene.add_circle_body(1, 0, {{2.0, 3.05}, 0.5, 0.0});
    Body clump;
    clump.id = 2;
    clump.first_circle = static_cast<std::uint32_t>(scene.circles.size());
    clump.circle_count = 2;
    scene.circles.push_back({{2.9, 3.05}, 0.5, 0.0});
    scene.circles.push_back({{3.5, 3.05}, 0.5, 0.0});
    scene.bodies.push_back(clump);
    scene.add_chain_body(3, 0, {{2, 1}, {4, 1}, {4, 2.5}, {2, 2.5}}, true);
    scene.add_chain_body(4, 0, {{4.06, 1}, {6, 1}, {6, 2.5}, {4.06, 2.5}}, true);
    return scene;
}

TEST(ContactFiles, BackTensionsOfEveryKindOfPointComeBack) {
    const Scene scene = mixed_scene();
    World world = build_world(scene);
    std::ostringstream unbonded, bonded, again;
    write_back_tensions(unbonded, scene, world);
    const std::int64_t bonds = bond_all(world, scene.thick);
    EXPECT_EQ(bonds, 8) << "circle on clump, three circles on the square, four corners between the squares";
    write_back_tensions(bonded, scene, world);
    EXPECT_EQ(unbonded.str(), bonded.str())
        << "without bonds, the file contains the back-tensions that follow from the overlaps";

    World copy = build_world(scene);
    DeckReader reader("in_cf0.dat", bonded.str());
    read_back_tensions(reader, scene, copy);
    EXPECT_EQ(copy.bonds.initial, bonds);
    EXPECT_EQ(copy.bonds.interfaces_initial, 4);
    write_back_tensions(again, scene, copy);
    EXPECT_EQ(bonded.str(), again.str());
    for (std::size_t k = 0; k < world.points.size(); ++k) {
        EXPECT_NEAR(copy.points.bond_overlap[k], world.points.bond_overlap[k], 1e-17);
        EXPECT_EQ(copy.points.state[k].flags, world.points.state[k].flags);
    }
}

TEST(ContactFiles, SegmentsUnderTheGuidesLawComeBackByTheirNumbers) {
    Scene scene = mixed_scene();
    scene.segment_law = SegmentLaw::demseg;
    scene.gravity = {3.0, -10.0};
    World world = build_world(scene);
    const std::int64_t bonds = bond_all(world, scene.thick);
    // The single circle is above a corner, where two segments end. Bodies 3 and 4 face each other with edges 2 and 4.
    // The ends of these edges are opposite each other and also belong to edges 1 and 3, which gives three more pairs at
    // either end.
    EXPECT_EQ(bonds, 5 + 1 + 6) << "circles, the facing pair, pairs at its ends";
    std::ostringstream tensions, again;
    write_back_tensions(tensions, scene, world);
    EXPECT_NE(tensions.str().find(" 2 4\n"), std::string::npos) << tensions.str();
    EXPECT_NE(tensions.str().find(" 4 2\n"), std::string::npos) << tensions.str();
    World copy = build_world(scene);
    DeckReader reader("in_cf0.dat", tensions.str());
    read_back_tensions(reader, scene, copy);
    EXPECT_EQ(copy.bonds.initial, bonds);
    write_back_tensions(again, scene, copy);
    EXPECT_EQ(again.str(), tensions.str());

    for (int n = 0; n < 50; ++n) step(world);
    std::ostringstream contacts, contacts_again;
    write_contacts(contacts, scene, world);
    DeckReader contact_reader("in_cf.dat", contacts.str());
    World other = build_world(scene);
    read_contacts(contact_reader, scene, other);
    write_contacts(contacts_again, scene, other);
    EXPECT_EQ(contacts_again.str(), contacts.str());

    scene.segment_law = SegmentLaw::rounded;
    World rounded = build_world(scene);
    DeckReader foreign("in_cf0.dat", tensions.str());
    EXPECT_NE(refusal([&] { read_back_tensions(foreign, scene, rounded); }).find("found no contact"),
              std::string::npos);
}

TEST(ContactFiles, GuidesChainListsBothDirections) {
    const Scene scene = read_geometry(shipped_deck("chain_pulled") / "in_gm.dat");
    World world = build_world(scene);
    bond_all(world, 0.0);
    std::ostringstream out;
    write_back_tensions(out, scene, world);
    DeckReader ours("new_in_cf0.dat", out.str()),
        guides = DeckReader::open(shipped_deck("chain_pulled") / "in_cf0.dat");
    while (!guides.at_end()) ASSERT_NEAR(ours.number("value"), guides.number("value"), 1e-4);
    EXPECT_TRUE(ours.at_end());
}

TEST(ContactFiles, SpringsBondsAndFlagsComeBack) {
    Scene scene = mixed_scene();
    scene.gravity = {3.0, -10.0};
    World world = build_world(scene);
    bond_all(world, scene.thick);
    for (int n = 0; n < 50; ++n) step(world);
    std::ostringstream out, again;
    write_contacts(out, scene, world);
    EXPECT_NE(out.str().find("\n-3 "), std::string::npos) << "a contact with the floor or:\n" << out.str();
    // A continued run starts from the scene at the end; here only ids matter.
    World copy = build_world(scene);
    DeckReader reader("in_cf.dat", out.str());
    read_contacts(reader, scene, copy);
    write_contacts(again, scene, copy);
    EXPECT_EQ(out.str(), again.str());
}

TEST(ContactFiles, RefuseWhatCannotBe) {
    const Scene scene = read_geometry(shipped_deck("chain_pulled") / "in_gm.dat");
    const auto tensions = [&](const std::string& text) {
        return refusal([&] {
            World world = build_world(scene);
            DeckReader reader("in_cf0.dat", text);
            read_back_tensions(reader, scene, world);
        });
    };
    std::string rest;
    for (int id = 3; id <= 20; ++id) rest += std::to_string(id) + " 0\n";
    EXPECT_EQ(tensions("1 1\n2 -2e7\n2 1\n1 -2e7\n" + rest), "accepted");
    EXPECT_EQ(tensions("1 1\n2 2e7\n"),
              "in_cf0.dat:2: body 1: back-tension 1: value: found '2e7', expected 0 or a negative number, "
              "because tension is negative");
    EXPECT_EQ(tensions("1 1\n2 -2e7\n2 0\n" + rest),
              "in_cf0.dat:2: bodies 1 and 2: found the back-tension -20000000 in one list and none in the other, "
              "expected the same in both");
    EXPECT_EQ(tensions("1 1\n99 -2e7\n"),
              "in_cf0.dat:2: body 1: back-tension 1: other body: found '99', expected another body of in_gm.dat");
    EXPECT_EQ(tensions("2 1\n"), "in_cf0.dat:1: body id: found '2', expected 1, in the order of in_gm.dat");
    std::string far = "1 1\n3 -2e7\n2 0\n3 1\n1 -2e7\n";
    for (int id = 4; id <= 20; ++id) far += std::to_string(id) + " 0\n";
    EXPECT_EQ(tensions(far),
              "in_cf0.dat:2: bodies 1 and 3: found no contact, expected bonded bodies to touch; check that in_gm.dat "
              "and in_cf0.dat are from the same run");
}

TEST(ContactFiles, TwoColumnsThatLeaveElementsOpenAreRefusedOnTheirOwnLine) {
    const Scene scene = mixed_scene();
    for (const char* columns : {"3 -2e3", "3 -2e3 1", "3 -2e3 to the square 1 0"}) {
        World world = build_world(scene);
        DeckReader reader("in_cf0.dat", fmt::format("1 1\n{}\n2 0\n3 1\n1 -2e3 0 1\n4 0\n", columns));
        EXPECT_EQ(refusal([&] { read_back_tensions(reader, scene, world); }),
                  "in_cf0.dat:2: body 1: back-tension 1: found no element numbers after the value, expected "
                  "the four values other body, value, own_element and other_element, because bodies 1 and 3 are not "
                  "both single circles; "
                  "remove the file to bond all bodies that overlap");
    }
}

TEST(ContactFiles, BondsOfTwoHeldBodiesAreRead) {
    Scene scene = read_geometry(shipped_deck("chain_pulled") / "in_gm.dat");
    World free = build_world(scene);
    bond_all(free, 0.0);
    std::ostringstream tensions, contacts;
    write_back_tensions(tensions, scene, free);
    write_contacts(contacts, scene, free);
    const DofControl held{Drive::displacement, 0.0};
    for (const int body : {0, 1, 19}) scene.controls.push_back({body, held, held, held, 100});
    scene.driven_contacts = DrivenContacts::all;
    World world = build_world(scene);
    DeckReader reader("in_cf0.dat", tensions.str());
    read_back_tensions(reader, scene, world);
    EXPECT_EQ(world.bonds.initial, 19);
    World other = build_world(scene);
    DeckReader contact_reader("in_cf.dat", contacts.str());
    read_contacts(contact_reader, scene, other);
    EXPECT_EQ(other.bonds.initial, 19);
    scene.circles[scene.bodies[0].first_circle].centre.x -= 1.0;  // away from the second body, which is also held
    World apart = build_world(scene);
    DeckReader far("in_cf0.dat", tensions.str());
    EXPECT_NE(refusal([&] { read_back_tensions(far, scene, apart); }).find("found no contact"), std::string::npos);
}

/// Message about an in_cf.dat for the mixed scene: bodies 1 (circle), 2 (clump), 3 and 4 (squares).
std::string contacts_refusal(const std::string& text, World* world = nullptr, double speed = 0.0) {
    return refusal([&] {
        Scene scene = mixed_scene();
        for (Body& body : scene.bodies) {
            if (body.id == 4) body.velocity = {speed, 0.0};
        }
        World fresh = build_world(scene);
        DeckReader reader("in_cf.dat", text);
        read_contacts(reader, scene, fresh);
        if (world != nullptr) *world = std::move(fresh);
    });
}

TEST(ContactFiles, AContactListedFromItsOtherBodyIsTheSame) {
    World from_one, from_other;
    ASSERT_EQ(contacts_refusal("1 0\n2 0\n3 1\n4 2 0 5.5 -2e3 1\n4 0\n", &from_one), "accepted");
    ASSERT_EQ(contacts_refusal("1 0\n2 0\n3 0\n4 1\n3 0 2 5.5 -2e3 1\n", &from_other), "accepted");
    EXPECT_EQ(from_one.bonds.initial, 1);
    EXPECT_TRUE(save_world(from_one) == save_world(from_other));
    ASSERT_EQ(contacts_refusal("1 0\n2 0\n3 0\n4 1\n3 0 2 5.5 0 1\n", &from_other), "accepted");
    double shear = 0.0;
    for (const double force : from_other.points.shear_force) shear += force;
    EXPECT_EQ(shear, 5.5) << "the spring of a point without a bond";
}

TEST(ContactFiles, UnknownContactsDuplicatesAndBondedWallsAreRefusedWithTheirLine) {
    EXPECT_EQ(
        contacts_refusal("1 0\n2 0\n3 1\n4 1 0 5.5 0 0\n4 0\n"),
        "in_cf.dat:4: body 3: contact 1: found no contact between its element 1 and element 0 of body 4, expected "
        "these elements to touch; check that in_gm.dat and in_cf.dat are from the same run")
        << "corner 1 is on the far side";
    EXPECT_EQ(
        contacts_refusal("1 0\n2 0\n3 1\n4 2 1 5.5 0 0\n4 0\n"),
        "in_cf.dat:4: body 3: contact 1: found no contact between its element 2 and element 1 of body 4, expected "
        "these elements to touch; check that in_gm.dat and in_cf.dat are from the same run");
    EXPECT_EQ(contacts_refusal("1 0\n2 0\n3 1\n3 2 0 5.5 0 0\n4 0\n"),
              "in_cf.dat:4: body 3: contact 1: other body: found '3', expected another body of in_gm.dat, or -1 to -4 "
              "for a wall");
    EXPECT_EQ(contacts_refusal("1 0\n2 0\n3 2\n4 2 0 5.5 0 0\n4 2 0 5.5 0 0\n4 0\n"),
              "in_cf.dat:5: body 3: contact 2: found the contact with body 4 a second time, expected each contact "
              "point only once");
    EXPECT_EQ(contacts_refusal("1 0\n2 0\n3 1\n4 2 0 5.5 0 0\n4 1\n3 0 2 5.5 0 0\n"),
              "in_cf.dat:6: body 4: contact 1: found the contact with body 3 a second time, expected each contact "
              "point only once");
    EXPECT_EQ(contacts_refusal("1 0\n2 0\n3 1\n-3 2 0 5.5 -1e3 0\n4 0\n"),
              "in_cf.dat:4: body 3: contact 1: back-tension: found '-1e3', expected 0; domain walls are never bonded");
}

TEST(ContactFiles, AContactThatOpenedBeyondTheListInItsLastStepIsOver) {
    EXPECT_EQ(contacts_refusal("1 0\n2 0\n3 1\n4 1 0 5.5 0 0\n4 0\n", nullptr, 1e6), "accepted");
}

TEST(DeckOutputs, RowsHoldTheWorldThatTheyWereWrittenFrom) {
    Scene scene = mixed_scene();
    scene.gravity = {3.0, -10.0};
    scene.add_chain_body(5, 0, {{7.0, 3.0}, {8.0, 4.0}, {9.0, 3.5}}, false);
    World world = build_world(scene);
    bond_all(world, scene.thick);
    for (int n = 0; n < 50; ++n) step(world);
    compute_forces(world);
    std::vector<BodyIndex> order;
    for (const Body& body : scene.bodies) order.push_back(body_of_id(world, body.id));
    const ScratchFolder scratch;
    DeckOutputs out(scratch / "", OutputMode::fresh);
    out.write_frame(world, order);
    out.write_energy_row(world, order);
    out.write_force_rows(world, order);
    out.flush();
    const Rows velocities = read_rows(scratch / "velocity_y.dat"), forces = read_rows(scratch / "f-d_curve.dat");
    Rows places, segments, contacts;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const BodyIndex b = order[k];
        const double id = scene.bodies[k].id;
        const BodyState& state = world.bodies.state[b];
        const BodyForce& force = world.bodies.force[b];
        EXPECT_EQ(velocities[k], (std::vector{50.0, id, state.vy}));
        EXPECT_EQ(forces[k], (std::vector{50.0, id, force.fx, state.x, force.fy, state.y, force.torque, state.angle}));
        const std::vector<Vec2> at = element_positions(world, b);
        for (std::size_t e = 0; e < at.size(); ++e) {
            const Vec2 next = at[(e + 1) % at.size()];
            if (scene.bodies[k].circle_count > 0)
                places.push_back({id, 0.5, at[e].x, at[e].y, state.angle});
            else if (scene.bodies[k].closed || e + 1 < at.size())
                segments.push_back({id, at[e].x, at[e].y, next.x, next.y});
        }
    }
    EXPECT_EQ(places.size(), 3u);
    EXPECT_EQ(segments.size(), 4u + 4u + 2u);
    places.insert(places.end(), segments.begin(), segments.end());
    EXPECT_EQ(read_frames(scratch / "output.dat").at(0).rows, places);

    const Rows whole = read_frames(scratch / "cont.dat").at(0).rows,
               details = read_frames(scratch / "cont2.dat").at(0).rows;
    std::size_t row = 0, bonded = 0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const PointView view = view_point(world, k);
        if ((world.points.state[k].flags & point_touching) == 0) continue;
        const PointForce& force = world.points.force[k];
        EXPECT_EQ((std::vector(whole.at(row).begin() + 2, whole[row].end())),
                  (std::vector{view.position.x, view.position.y, force.fx, force.fy}));
        const double tension = view.bonded ? view.normal_stiffness * view.bond_overlap : 0.0;
        EXPECT_EQ((std::vector(details.at(row).begin() + 2, details[row].end())),
                  (std::vector{view.normal.x, view.normal.y, view.overlap, view.normal_force, view.shear_force,
                               tension > 0.0 ? -tension : 0.0}));
        bonded += view.bonded ? 1 : 0;
        ++row;
    }
    EXPECT_EQ(row, whole.size());
    EXPECT_GE(bonded, 1u);
    const Ledger e = measure_ledger(world);
    EXPECT_NE(e.potential, e.kinetic);
    EXPECT_EQ(read_rows(scratch / "energy.dat").at(0),
              (std::vector{50.0, e.potential, e.kinetic, e.strain, e.dashpot_loss, e.friction_loss, e.displacement_work,
                           e.force_work, e.closing_error - e.law_loss, e.fracture_loss}));
}

TEST(RandomCircles, CountIsTheGuidesAndSeedsRepeat) {
    const RandomGeometry guide = read_random_geometry(shipped_deck("repose") / "in_gm.dat");
    EXPECT_EQ(random_circle_count(guide), 582);
    const auto text = [&](std::uint64_t seed) {
        std::ostringstream out;
        write_geometry(out, make_random_circles(guide, seed).scene);
        return out.str();
    };
    EXPECT_EQ(text(5), text(5));
    EXPECT_NE(text(5), text(6));
    double mean = 0.0;
    const Scene scene = make_random_circles(guide, 1).scene;
    for (const CircleElement& circle : scene.circles) {
        EXPECT_GE(circle.radius, 1.0);
        EXPECT_LT(circle.radius, 2.0);
        EXPECT_GE(circle.centre.x, circle.radius);
        EXPECT_LE(circle.centre.y, 80.0 - circle.radius);
        mean += circle.radius / 582.0;
    }
    EXPECT_TRUE(within("mean radius (3 standard errors)", mean, 1.5, 3.0 * 0.2887 / std::sqrt(582.0)));
}

}  // namespace
}  // namespace crackle
