// SPDX-License-Identifier: GPL-3.0-or-later
// One open frictional joint through a specimen between frictionless platens, its sides under dead loads.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "tools/bench/verify/groups.hpp"
#include "tools/bench/verify/joints/jointed_rock.hpp"
#include "tools/bench/verify/rows.hpp"

namespace crackle::verification {
namespace {

constexpr double pressure = 5e6, friction = 25.0;               // Pa, degrees
constexpr double platen_rate = 0.05, strain_under_load = 3e-4;  // 1/s; at which the pressure is on
constexpr double strain_at_most = 2e-3;                         // where nothing slips
// Shares of the gap between cells that the faces have slid when stress is measured: corners have left the ends of the
// faces that they bonded to, and not yet met the rounded ends of the next ones, on which they ride up.
constexpr double wide_gap = 3e-3;  // m
constexpr double slid_from = 0.3, slid_to = 0.7;
constexpr double degrees_of_arc = std::numbers::pi / 180.0;
constexpr int lower_id = 100'001, upper_id = 100'002;  // platens

/// Pa, at which the plane slips. @param beta rad, between it and the load
double strength_of_plane(double beta) {
    const double f = std::tan(friction * degrees_of_arc);
    return pressure + 2.0 * pressure * f / ((1.0 - f * std::tan(beta)) * std::sin(2.0 * beta));
}

/// From the middle of the left side to that of the right one, up to the right.
TestCase::Trace plane_at(double beta) {
    const double rise = 0.5 * rock_width / std::tan(beta);
    TestCase::Trace plane;
    plane.name = "plane";
    plane.points = std::vector{0.0, 0.5 * rock_height - rise, rock_width, 0.5 * rock_height + rise};
    plane.own.bonded = false;
    plane.own.friction_angle = friction;
    return plane;
}

/// Each cell with a face on a side gets the pressure on it, inwards. Faces count to where they met before the inset.
/// @param gap m, by which cells lie apart
void press_side(Scene& scene, bool left, double gap) {
    struct Face {
        int body;
        double low, high;  // m
    };
    std::vector<Face> faces;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        Face face{static_cast<int>(b), rock_height, 0.0};
        for (std::uint32_t v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) {
            const Vec2 corner = scene.vertices[v];
            if ((left ? corner.x : rock_width - corner.x) > 0.6 * gap) continue;
            face.low = std::min(face.low, corner.y);
            face.high = std::max(face.high, corner.y);
        }
        if (face.high > face.low) faces.push_back(face);
    }
    std::ranges::sort(faces, {}, &Face::low);
    faces.front().low = 0.0;
    faces.back().high = rock_height;
    for (std::size_t k = 0; k + 1 < faces.size(); ++k)
        faces[k].high = faces[k + 1].low = 0.5 * (faces[k].high + faces[k + 1].low);
    for (const Face& face : faces) {
        Control load;
        load.body = face.body;
        load.x = {Drive::force, (left ? pressure : -pressure) * (face.high - face.low)};
        scene.controls.push_back(load);
    }
}

void add_platens(Scene& scene, double gap) {
    constexpr double beyond = 0.5 * rock_width, depth = 0.1;  // m
    Material smooth = scene.materials.front();
    smooth.friction_angle = smooth.residual_friction_angle = 0.0;
    scene.materials.push_back(smooth);
    const auto add = [&](int id, double low, double high, double speed) {
        Control hold;
        hold.body = static_cast<int>(scene.add_chain_body(
            id, 1, {{-beyond, low}, {rock_width + beyond, low}, {rock_width + beyond, high}, {-beyond, high}}, true));
        hold.x = hold.rotation = {Drive::velocity, 0.0};
        hold.y = {Drive::velocity, speed};
        scene.controls.push_back(hold);
    };
    add(lower_id, -depth, -0.5 * gap, 0.0);
    add(upper_id, rock_height + 0.5 * gap, rock_height + depth, -platen_rate * rock_height);
}

/// m, that the cells on the left of the trace have moved along it against those on its right. @param start places
double slip_of(const World& world, const Array<BodyState>& start, Vec2 along) {
    Vec2 ways[2];
    double counts[2] = {0.0, 0.0};
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        const BodyInfo info = world.bodies.info(b);
        const Vec2 way{world.bodies.state[b].x - start[b].x, world.bodies.state[b].y - start[b].y};
        for (std::uint32_t e = info.first_element; e < info.first_element + info.element_count; ++e) {
            const TraceSide side = world.bodies.element_sides[e];
            if (side == no_side) continue;
            ways[side % 2] = ways[side % 2] + way;
            counts[side % 2] += 1.0;
        }
    }
    return std::abs(dot((1.0 / counts[0]) * ways[0] - (1.0 / counts[1]) * ways[1], along));
}

/// Mean axial stress while it slips, the error of the energy's account over the work, and breaks.
struct Slipped {
    double stress, energy_error, broken;
};

Slipped slip(const char* kind, std::int64_t seed, double beta) {
    TestCase test = jointed_rock(kind, seed);
    test.mesh.thick = wide_gap;
    test.trace.push_back(plane_at(beta));
    const Specimen specimen = make_specimen(test, {});
    const double gap = specimen.mesh_gap;
    Scene scene = specimen.scene;
    scene.thick = gap;
    scene.bond_law = BondLaw::coulomb;
    scene.units = StiffnessUnits::area;
    scene.time_step = 0.0;
    scene.domain.wall_present = {false, false, false, false};
    press_side(scene, true, gap);
    press_side(scene, false, gap);
    add_platens(scene, gap);
    World world = build_world(std::move(scene));
    const BodyIndex lower = body_of_id(world, lower_id), upper = body_of_id(world, upper_id);
    Bonding bonding;
    bonding.thick = gap;
    bonding.gap = 0.05 * gap;
    bonding.leaves = [&](BodyIndex i, BodyIndex j) { return i == lower || i == upper || j == lower || j == upper; };
    bond_all(world, bonding);
    std::vector<double> loads;
    loads.reserve(world.bodies.controls.size());
    for (const ControlState& control : world.bodies.controls) loads.push_back(control.dof[0].value);
    const Array<BodyState> start = world.bodies.state;
    const Vec2 along{std::sin(beta), std::cos(beta)};
    double sum = 0.0, count = 0.0;
    for (double slid = 0.0; slid < slid_to * gap; slid = slip_of(world, start, along)) {
        const double strain = (start[upper].y - world.bodies.state[upper].y) / rock_height;
        if (strain > strain_at_most) break;
        const double share = std::min(1.0, strain / strain_under_load);
        for (std::size_t k = 0; k < loads.size(); ++k) world.bodies.controls[k].dof[0].value = share * loads[k];
        for (int n = 0; n < 20; ++n) step(world);
        if (slid < slid_from * gap) continue;
        compute_forces(world);
        sum += 0.5 * (world.bodies.force[upper].fy - world.bodies.force[lower].fy) / rock_width;
        ++count;
    }
    const Ledger ledger = measure_ledger(world);
    return {sum / count, ledger.closing_error / (std::abs(ledger.displacement_work) + std::abs(ledger.force_work)),
            static_cast<double>(world.bonds.broken)};
}

std::vector<ClaimRow> plane_of_weakness_slips_at_its_strength() {
    Rows rows;
    const auto compare = [&](const char* kind, std::int64_t seed, double beta) {
        const Slipped got = slip(kind, seed, beta * degrees_of_arc);
        const std::string name = fmt::format("{}, packing {}, {:.0f} degrees: ", kind, seed, beta);
        rows.relative(name + "axial stress, Pa", got.stress, strength_of_plane(beta * degrees_of_arc), 0.02,
                      "reference");
        rows.absolute(name + "closing error of energy over work", got.energy_error, 0.0, 1e-3, "reference");
        rows.exactly(name + "bonds broken", got.broken, 0.0);
    };
    for (const double beta : {30.0, 40.0, 50.0, 60.0}) compare("voronoi", 1, beta);
    for (const double beta : {35.0, 55.0}) compare("delaunay", 2, beta);
    return rows.take();
}

}  // namespace

std::vector<Claim> weakness_plane_claims() {
    return {
        {.name = "plane_of_weakness_slips_at_its_strength",
         .group = "Joints",
         .statement = "an open joint through the free sides slips at σ1 = σ3 + 2σ3 tan φ/[(1 - tan φ tan β) sin 2β]",
         .check = plane_of_weakness_slips_at_its_strength,
         .slow = true,
         .note = "Jaeger 1960, without cohesion; frictionless platens, dead loads on the sides, height twice the "
                 "width, β between plane and load. Mean axial stress while it slips by 0.3 to 0.7 of the gap between "
                 "cells: farther on corners ride up the rounded ends of the next faces, under much stress by some "
                 "degrees."},
    };
}

}  // namespace crackle::verification
