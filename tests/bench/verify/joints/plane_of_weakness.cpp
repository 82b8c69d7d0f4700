// SPDX-License-Identifier: GPL-3.0-or-later
// One open frictional joint through a specimen between frictionless platens, with dead loads on its sides.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/making/make_specimen.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/joints/jointed_rock.hpp"
#include "tests/bench/verify/rows.hpp"

namespace crackle::verification {
namespace {

constexpr double pressure = 5e6, friction = 25.0;               // Pa, degrees
constexpr double platen_rate = 0.05, strain_under_load = 3e-4;  // 1/s; strain at which the full pressure acts
constexpr double strain_at_most = 2e-3;                         // strain at which the run ends if nothing slips
// Range of slip in which the stress is measured, relative to the gap between cells. At these slips, corners have left
// the ends of the faces to which they were bonded. They have not yet reached the rounded ends of the next faces, onto
// which they would ride up.
constexpr double wide_gap = 3e-3;  // m
constexpr double slid_from = 0.3, slid_to = 0.7;
// Flat faces of circles have no corners, so slip continues for more than one circle.
constexpr double circles_slid_from = 0.1 * circles_diameter, circles_slid_to = 1.2 * circles_diameter;
constexpr double circles_rate = 0.03, circles_damping = 0.8;  // 1/s; damped more, since the blocks slip farther
constexpr double circles_thick = 1e-3;                        // m
constexpr double degrees_of_arc = std::numbers::pi / 180.0;
constexpr int lower_id = 100'001, upper_id = 100'002;  // platens

/// Axial stress at which the plane slips, Pa. @param beta angle between plane and load, rad
double strength_of_plane(double beta) {
    const double f = std::tan(friction * degrees_of_arc);
    return pressure + 2.0 * pressure * f / ((1.0 - f * std::tan(beta)) * std::sin(2.0 * beta));
}

/// A trace through the centre, from the left side up to the right side. @param beta angle to the vertical, rad
MeasuredTraces plane_at(double beta) {
    const double rise = 0.5 * rock_width / std::tan(beta);
    Joint open;
    open.bonded = false;
    open.friction_angle = friction;
    return {"plane", std::vector<Vec2>{{0.0, 0.5 * rock_height - rise}, {rock_width, 0.5 * rock_height + rise}}, open};
}

/// Applies the inward pressure to each cell with a face on one side, and to each circle that reaches this side. Faces
/// have their lengths before the inset.
/// @param gap gap between cells, m
void press_side(Scene& scene, bool left, double gap) {
    struct Face {
        int body;
        double low, high;  // m
    };
    std::vector<Face> faces;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        Face face{static_cast<int>(b), rock_height, 0.0};
        if (body.circle_count == 1) {
            const CircleElement& circle = scene.circles[body.first_circle];
            if ((left ? circle.centre.x : rock_width - circle.centre.x) <= circle.radius)
                face = {face.body, circle.centre.y - circle.radius, circle.centre.y + circle.radius};
        }
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

/// @param off distance of the platens from the box, m @param rate 1/s
void add_platens(Scene& scene, double off, double rate) {
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
    add(lower_id, -depth, -off, 0.0);
    add(upper_id, rock_height + off, rock_height + depth, -rate * rock_height);
}

/// Mean displacement along the trace of the cells on its left relative to those on its right, m. @param start initial
/// positions
double slip_of(const World& world, const Array<BodyState>& start, Vec2 along) {
    Vec2 ways[2];
    double counts[2] = {0.0, 0.0};
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        const BodyInfo info = world.bodies.info(b);
        const Vec2 way{world.bodies.state[b].x - start[b].x, world.bodies.state[b].y - start[b].y};
        const auto add = [&](TraceSide side) {
            if (side == no_side) return;
            ways[side % 2] = ways[side % 2] + way;
            counts[side % 2] += 1.0;
        };
        if (info.single_circle)
            for (const FlatFace& face : world.bodies.flat_faces_of(b)) add(face.side);
        else if (!world.bodies.element_sides.empty())
            for (std::uint32_t e = info.first_element; e < info.first_element + info.element_count; ++e)
                add(world.bodies.element_sides[e]);
    }
    return std::abs(dot((1.0 / counts[0]) * ways[0] - (1.0 / counts[1]) * ways[1], along));
}

/// Actual force on the sides of the upper block, relative to the force of the pressure on it; they differ because a
/// circle belongs to one block as a whole.
double pressed_on_upper(const World& world, const Array<BodyState>& start, double beta) {
    const Vec2 middle{0.5 * rock_width, 0.5 * rock_height}, along{std::sin(beta), std::cos(beta)};
    double force = 0.0;
    for (const ControlState& control : world.bodies.controls) {
        if (control.dof[0].drive != Drive::force) continue;
        const auto faces = world.bodies.flat_faces_of(control.body);
        const Vec2 from_middle = Vec2{start[control.body].x, start[control.body].y} - middle;
        const bool upper = faces.empty() ? cross(along, from_middle) > 0.0 : (faces.front().side & 1) == 0;
        force += upper ? control.dof[0].value : 0.0;
    }
    return force * std::tan(beta) / (pressure * rock_width);
}

/// Mean, smallest and largest axial stress during slip, error of the energy account relative to the work, and number of
/// breaks.
struct Slipped {
    double stress, least, most, energy_error, broken;
    double pressed;  // relative force on the sides of the upper block, see pressed_on_upper()
};

Slipped slip(SpecimenKind kind, std::int64_t seed, double beta) {
    ResolvedCase test = jointed_rock(kind, seed);
    const bool circles = kind == SpecimenKind::circles;
    if (circles)
        test.material.damping_ratio = circles_damping;
    else
        test.mesh->gap = parts::MeshGap{wide_gap, {}};
    test.joints.traces.push_back(plane_at(beta));
    const Specimen specimen = make_specimen(test, {});
    const double gap = specimen.mesh_gap;
    const double from = circles ? circles_slid_from : slid_from * gap, to = circles ? circles_slid_to : slid_to * gap;
    Scene scene = specimen.scene;
    scene.thick = circles ? circles_thick : gap;
    scene.bond_law = BondLaw::coulomb;
    scene.units = StiffnessUnits::area;
    scene.time_step = 0.0;
    scene.domain.wall_present = {false, false, false, false};
    press_side(scene, true, gap);
    press_side(scene, false, gap);
    add_platens(scene, circles ? circles_thick : 0.5 * gap, circles ? circles_rate : platen_rate);
    World world = build_world(std::move(scene));
    const BodyIndex lower = body_of_id(world, lower_id), upper = body_of_id(world, upper_id);
    Bonding bonding;
    bonding.thick = world.settings.thick;
    bonding.gap = 0.05 * gap;
    bonding.range = circles ? bonded_range : 0.0;
    bonding.leaves = [&](BodyIndex i, BodyIndex j) { return i == lower || i == upper || j == lower || j == upper; };
    bond_all(world, bonding);
    std::vector<double> loads;
    loads.reserve(world.bodies.controls.size());
    for (const ControlState& control : world.bodies.controls) loads.push_back(control.dof[0].value);
    const Array<BodyState> start = world.bodies.state;
    const Vec2 along{std::sin(beta), std::cos(beta)};
    double sum = 0.0, count = 0.0, least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (double slid = 0.0; slid < to; slid = slip_of(world, start, along)) {
        const double strain = (start[upper].y - world.bodies.state[upper].y) / rock_height;
        if (strain > strain_at_most + from / rock_height && slid < from) break;
        const double share = std::min(1.0, strain / strain_under_load);
        for (std::size_t k = 0; k < loads.size(); ++k) world.bodies.controls[k].dof[0].value = share * loads[k];
        for (int n = 0; n < 20; ++n) step(world);
        if (slid < from) continue;
        compute_forces(world);
        const double stress = 0.5 * (world.bodies.force[upper].fy - world.bodies.force[lower].fy) / rock_width;
        least = std::min(least, stress);
        most = std::max(most, stress);
        sum += stress;
        ++count;
    }
    const Ledger ledger = measure_ledger(world);
    return {sum / count,
            least,
            most,
            ledger.closing_error / (std::abs(ledger.displacement_work) + std::abs(ledger.force_work)),
            static_cast<double>(world.bonds.broken),
            circles ? pressed_on_upper(world, start, beta) : 1.0};
}

std::vector<ClaimRow> plane_among_circles_slips_on_and_on() {
    Rows rows;
    for (const double beta : {35.0, 45.0, 55.0}) {
        const Slipped got = slip(SpecimenKind::circles, 1, beta * degrees_of_arc);
        const double expected = got.pressed * strength_of_plane(beta * degrees_of_arc);
        const std::string name = fmt::format("{:.0f} degrees: ", beta);
        rows.relative(name + "axial stress, Pa", got.stress, expected, 1e-3, "inertia");
        rows.relative(name + "smallest axial stress, Pa", got.least, expected, 2e-3, "inertia");
        rows.relative(name + "largest axial stress, Pa", got.most, expected, 2e-3, "inertia");
        rows.absolute(name + "closing error of energy over work", got.energy_error, 0.0, 1e-3, "reference");
        rows.exactly(name + "bonds broken", got.broken, 0.0);
    }
    return rows.take();
}

std::vector<ClaimRow> plane_of_weakness_slips_at_its_strength() {
    Rows rows;
    const auto compare = [&](SpecimenKind kind, std::int64_t seed, double beta) {
        const Slipped got = slip(kind, seed, beta * degrees_of_arc);
        const std::string name = fmt::format("{}, packing {}, {:.0f} degrees: ", name_of(kind), seed, beta);
        rows.relative(name + "axial stress, Pa", got.stress, strength_of_plane(beta * degrees_of_arc), 0.02,
                      "reference");
        rows.absolute(name + "closing error of energy over work", got.energy_error, 0.0, 1e-3, "reference");
        rows.exactly(name + "bonds broken", got.broken, 0.0);
    };
    for (const double beta : {30.0, 40.0, 50.0, 60.0}) compare(SpecimenKind::voronoi, 1, beta);
    for (const double beta : {35.0, 55.0}) compare(SpecimenKind::delaunay, 2, beta);
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
                 "width, β is the angle between plane and load. The axial stress is the mean over slips of 0.3 to 0.7 "
                 "of the gap between cells. At larger slips, corners climb the rounded ends of the next faces, by "
                 "several degrees at high stress."},
        {.name = "plane_among_circles_slips_on_and_on",
         .group = "Joints",
         .statement =
             "an open joint among circles slips at this strength over more than a diameter, without interlocking",
         .check = plane_among_circles_slips_on_and_on,
         .slow = true,
         .note = "As above, with flat faces of circles (solver/MODEL.md 5.4), over slips of 0.1 to 1.2 diameters; the "
                 "pressure is that on the circles of the upper block."},
    };
}

}  // namespace crackle::verification
