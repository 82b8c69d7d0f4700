// SPDX-License-Identifier: GPL-3.0-or-later
// Elasticity of boxes of cells bonded by faces: patches, moduli, beams and the stable step.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/linear/absolute_bound.hpp"
#include "solver/linear/critical_step.hpp"
#include "solver/linear/elastic.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/dense_stiffness.hpp"
#include "tests/bench/verify/scenes/loaded_cells.hpp"

namespace crackle::verification {
namespace elastic_faces {
namespace {

constexpr double granite_nu = 0.26;

// ---- patches

/// Number of faces between each cell and the nearest cell that is not completely surrounded by faces.
std::vector<int> depths(const World& world) {
    const Faces& faces = world.faces;
    std::vector<Vec2> closing(world.bodies.size());
    for (FaceIndex k = 0; k < faces.size(); ++k) {
        const Vec2 normal = faces.springs[k].length * faces.place[k].normal_i;
        closing[faces.bodies[k].body_i] = closing[faces.bodies[k].body_i] + normal;
        closing[faces.bodies[k].body_j] = closing[faces.bodies[k].body_j] - normal;
    }
    constexpr int far = 1000;
    std::vector<int> depth(world.bodies.size(), far);
    for (std::size_t b = 0; b < depth.size(); ++b)
        if (norm(closing[b]) > 1e-9) depth[b] = 0;
    for (int round = 0; round < 20; ++round)
        for (const BodyPair& pair : faces.bodies) {
            depth[pair.body_i] = std::min(depth[pair.body_i], depth[pair.body_j] + 1);
            depth[pair.body_j] = std::min(depth[pair.body_j], depth[pair.body_i] + 1);
        }
    return depth;
}

/// Strains a box without rotation, so that forces are linear in the strain, and adds rows about its inner cells.
void add_patch(Rows& rows, const std::string& name, CellWorld cells, const FaceBonding& bonding) {
    Faces& faces = cells.world.faces = bond_faces(cells.world, bonding);
    constexpr double xx = 0.3, yy = -0.1, xy = 0.2;
    const auto strain = [&](double by) {
        for (BodyIndex b = 0; b < cells.world.bodies.size(); ++b) {
            BodyState& body = cells.world.bodies.state[b];
            const Vec2 x = cells.seeds[b];
            body.x += by * (xx * x.x + xy * x.y);
            body.y += by * (xy * x.x + yy * x.y);
        }
        compute_face_forces(cells.world);
        return cells.world.bodies.force;
    };
    const Array<BodyForce> forces = strain(1.0);
    const Array<CellPressure> pressures = faces.cells;
    double largest = 0.0;
    for (const PointForce& one : faces.force) largest = std::max(largest, std::hypot(one.fx, one.fy));
    // Forces act in the middle of the opening, so moments have a second-order part. It is the same for the opposite
    // strain and cancels in the difference.
    const Array<BodyForce> opposite = strain(-2.0);
    const double modulus = bonding.materials[0].moduli.pressure;
    const std::vector<int> depth = depths(cells.world);
    double residual = 0.0, moment = 0.0, pressure = 0.0;
    int inner = 0;
    for (BodyIndex b = 0; b < depth.size(); ++b) {
        if (depth[b] < 2) continue;
        ++inner;
        residual = std::max(residual, std::hypot(forces[b].fx, forces[b].fy));
        moment = std::max(moment, 0.5 * std::abs(forces[b].torque - opposite[b].torque));
        pressure = std::max(pressure, std::abs(pressures[b].pressure / modulus - (xx + yy)));
    }
    rows.at_least(name + ": cells inside", inner, 20.0, "size of the box");
    rows.absolute(name + ": force on a cell over the largest of a face", residual / largest, 0.0, 1e-12, "rounding");
    rows.absolute(name + ": moment on a cell over the same, m", moment / largest, 0.0, 1e-12, "rounding");
    rows.absolute(name + ": pressure of a cell over its modulus, less the dilation", pressure, 0.0, 1e-12, "rounding");
}

/// Circumcentre of a triangle before the inset of its mesh, which shrinks it about the centre of its incircle.
Vec2 circumcentre_of(const World& world, BodyIndex b, double gap) {
    const BodyInfo info = world.bodies.info(b);
    Vec2 p[3];
    for (std::uint32_t e = 0; e < 3; ++e) {
        const Element& corner = world.bodies.elements[info.first_element + e];
        p[e] = {corner.x, corner.y};
    }
    const double a = norm(p[2] - p[1]), bb = norm(p[0] - p[2]), c = norm(p[1] - p[0]);
    const Vec2 centre = (1.0 / (a + bb + c)) * (a * p[0] + bb * p[1] + c * p[2]);
    const double inner = std::abs(cross(p[1] - p[0], p[2] - p[0])) / (a + bb + c);
    for (Vec2& corner : p) corner = centre + (1.0 + 0.5 * gap / inner) * (corner - centre);
    const Vec2 u = p[1] - p[0], v = p[2] - p[0];
    const double scale = 0.5 / cross(u, v);
    const BodyState& body = world.bodies.state[b];
    return Vec2{body.x, body.y} + p[0] +
           scale * Vec2{v.y * dot(u, u) - u.y * dot(v, v), u.x * dot(v, v) - v.x * dot(u, u)};
}

std::vector<ClaimRow> uniform_strain_balances_every_cell() {
    Rows rows;
    const CellWorld cells = build_box({});
    add_patch(rows, "Voronoi cells", cells, elastic_rock(cells, CellBox{}.gap, granite_nu, 1.0));

    const CellBox box{.kind = MeshKind::delaunay};
    std::mt19937 random(2);
    const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    std::vector<Point> seeds;  // corners of nearly equilateral triangles
    constexpr int lines = 14;
    for (int r = 0; r < lines; ++r)
        for (int c = 0; c < lines; ++c) {
            const double x = c + (r % 2 == 0 ? 0.25 : 0.75) + 0.15 * number();
            seeds.push_back({x / lines, (r + 0.5 + 0.15 * number()) / lines});
        }
    MeshRequest request;
    request.kind = box.kind;
    request.mesh_gap = box.gap;
    CellWorld triangles = world_of(box, make_mesh(seeds, {0.0, 1.0, 0.0, 1.0}, request), seeds);
    FaceBonding bonding = elastic_rock(triangles, box.gap, granite_nu, 1.0);
    bonding.reference.clear();
    bonding.least_distance_share = 1e-3;
    for (BodyIndex b = 0; b < triangles.seeds.size(); ++b)
        triangles.seeds[b] = circumcentre_of(triangles.world, b, box.gap);
    add_patch(rows, "triangles about circumcentres", triangles, bonding);
    return rows.take();
}

// ---- moduli

/// Young's modulus and Poisson's ratio of a box between platens without shear stiffness.
struct BoxModuli {
    double youngs, poissons;
};

/// Moduli of a shortened box. @param motion displacements from the world's state @param force on the upper platen, N
BoxModuli moduli_from(const CellBox& box, const CellWorld& cells, const std::vector<BodyMotion>& motion, double force,
                      double shortening) {
    // Lateral strain by regression over the reference points.
    double n = 0.0, x = 0.0, u = 0.0, xx = 0.0, xu = 0.0;
    for (BodyIndex b = 0; b < cells.world.bodies.size(); ++b) {
        if (b == cells.platens[0] || b == cells.platens[1]) continue;
        const Vec2 at = cells.seeds[b];
        const BodyMotion& m = motion[b];
        const double moved = m.x - m.rotation * (at.y - cells.world.bodies.state[b].y);
        n += 1.0, x += at.x, u += moved, xx += at.x * at.x, xu += at.x * moved;
    }
    const double lateral = (n * xu - x * u) / (n * xx - x * x), axial = -shortening / box.height;
    return {force / (box.width * axial), -lateral / axial};
}

BoxModuli solved_moduli(const CellBox& box, const FaceBonding& bonding, CellWorld cells) {
    cells.world.faces = bond_faces(cells.world, bonding);
    const double shortening = 1e-3 * box.height;
    const ElasticSolution solution =
        solve_elastic(cells.world, {{cells.platens[0], {}}, {cells.platens[1], {0.0, -shortening, 0.0}}});
    return moduli_from(box, cells, solution.displacement, solution.reaction[1].y, shortening);
}

std::vector<ClaimRow> box_has_the_moduli_of_its_rock() {
    Rows rows;
    const auto add = [&](const std::string& name, const BoxModuli& got, double nu, double tolerance,
                         const std::string& estimate) {
        rows.relative(name + ": E, Pa", got.youngs, 1.0, tolerance, estimate);
        rows.absolute(name + ": ν", got.poissons, nu, tolerance, estimate);
    };
    for (const double nu : {0.0, granite_nu, 0.4}) {
        const CellBox box{.width = 1.0, .height = 1.6, .columns = 8, .rows = 13, .platens = true};
        const CellWorld cells = build_box(box);
        add(fmt::format("κ = 1, ν = {}", nu), solved_moduli(box, elastic_rock(cells, box.gap, nu, 1.0), cells), nu,
            1e-9, "the solve");
    }
    const CellBox box{.columns = 28, .rows = 29, .platens = true};
    const CellWorld cells = build_box(box);
    constexpr double correction = 0.29;
    for (const double ratio : {1.0 / 1.6, 0.5})
        add(fmt::format("κ = {}, ν = {}", ratio, granite_nu),
            solved_moduli(box, elastic_rock(cells, box.gap, granite_nu, ratio, correction), cells), granite_nu, 0.01,
            "rows at the sides");
    FaceBonding bare = elastic_rock(cells, box.gap, granite_nu, 1.0);
    constexpr double nu = 0.2;
    bare.materials[0].moduli = face_moduli_without_pressure(1.0, nu, correction);
    add("no pressure, ν = 0.2", solved_moduli(box, bare, cells), nu, 0.02, "rows at the sides");
    return rows.take();
}

std::vector<ClaimRow> box_is_run_to_the_moduli_of_its_rock() {
    Rows rows;
    const CellBox box{.columns = 6, .rows = 6, .platens = true};
    FaceLaw law;
    law.damping_ratio = 0.3;
    CellSpecimen s = bond_cells(box, 1.0, law, granite_nu, PlatenFaces::smooth);
    const CellWorld start = s.cells;
    s.world().stepping.time_step = 0.5 * s.exact_step();
    // The strain rises slowly and then rests, while dashpots end the vibration.
    constexpr double strain = 1e-5;
    constexpr int ramp = 4000;
    drive_platens(s, -strain / (ramp * s.world().stepping.time_step));
    for (int n = 0; n < ramp; ++n) s.step();
    drive_platens(s, 0.0);
    for (int n = 0; n < 6000; ++n) s.step();
    compute_forces(s.world());
    std::vector<BodyMotion> motion;
    for (BodyIndex b = 0; b < s.world().bodies.size(); ++b) {
        const BodyState &then = start.world.bodies.state[b], &now = s.world().bodies.state[b];
        motion.push_back({now.x - then.x, now.y - then.y, now.angle - then.angle});
    }
    const BoxModuli got =
        moduli_from(box, start, motion, -s.world().bodies.force[s.cells.platens[1]].fy, strain * box.height);
    rows.relative("E, Pa", got.youngs, 1.0, 1e-3, "vibration");
    rows.absolute("ν", got.poissons, granite_nu, 1e-3, "vibration");
    return rows.take();
}

// ---- beams

/// Bending stiffness of a beam of cells, relative to E I/l. Its ends are rotated in opposite senses, without shear.
double bending_stiffness(int depth, double ratio) {
    constexpr double span = 3.0, turn = 1e-3;  // m, rad
    const CellBox box{
        .width = 1.0, .height = span, .columns = depth, .rows = static_cast<int>(span * depth), .platens = true};
    CellWorld cells = build_box(box);
    cells.world.faces = bond_faces(cells.world, elastic_rock(cells, box.gap, granite_nu, ratio));
    // Each platen turns about the middle of its end of the beam.
    const auto about_end = [&](BodyIndex b, double y, double angle) {
        const BodyState& body = cells.world.bodies.state[b];
        return Prescribed{b, {-angle * (body.y - y), angle * (body.x - 0.5 * box.width), angle}};
    };
    const ElasticSolution solution = solve_elastic(
        cells.world, {about_end(cells.platens[0], 0.0, -0.5 * turn), about_end(cells.platens[1], span, 0.5 * turn)});
    // Energy ½Mφ, with M = EIφ/l and I = 1/12.
    return solution.energy / (0.5 * turn * turn / (12.0 * span));
}

std::vector<ClaimRow> beam_of_cells_bends_as_timoshenkos() {
    Rows rows;
    for (const int depth : {6, 12, 24}) {
        rows.relative(fmt::format("{} cells, κ = 1: M over E I φ/l", depth), bending_stiffness(depth, 1.0), 1.0, 0.005,
                      "reference");
        // If the shear springs are softer than the normal springs, the outermost rows, 1/depth of all, are stiffer.
        rows.relative(fmt::format("{} cells, κ = 1/1.6: M over E I φ/l", depth), bending_stiffness(depth, 1.0 / 1.6),
                      1.0, 0.4 / depth, "rows at the sides");
    }
    return rows.take();
}

// ---- step

std::vector<ClaimRow> step_of_faces_is_exact_and_its_bound_close() {
    Rows rows;
    for (const int lloyd : {0, 2, 20}) {
        for (const double damping : {0.0, 0.1}) {
            CellWorld cells = build_box({.columns = 12, .rows = 12, .lloyd = lloyd});
            FaceBonding bonding = elastic_rock(cells, CellBox{}.gap, granite_nu, 1.0 / 1.6);
            bonding.materials[0].law.damping_ratio = damping;
            cells.world.faces = bond_faces(cells.world, bonding);
            const CriticalStep exact = critical_step(cells.world, ClosedPoints::touching);
            const double bound = absolute_step_bound(cells.world, ClosedPoints::touching) / exact.root;
            const std::string name = fmt::format("{} Lloyd rounds, damping {}: ", lloyd, damping);
            rows.exactly(name + "proved by Cholesky", exact.proved ? 1.0 : 0.0, 1.0);
            rows.at_most(name + "guaranteed bound over the exact step", bound, 1.0 + 1e-9, "a bound");
            // With damping, the bound is less tight, since stiffness and damping are largest in different cells.
            rows.at_least(name + "the same", bound, damping > 0.0 ? 0.88 : 0.9, "reference");
        }
    }
    CellSpecimen s = bond_cells({.columns = 4, .rows = 4, .gap = 1e-3}, 1.0 / 1.6, {});
    rows.relative("16 cells: exact step over that of the dense matrix",
                  s.exact_step() * highest_frequency(s.world(), dense_stiffness(s.world(), 1e-5)) / 2.0, 1.0, 1e-7,
                  "differences");
    return rows.take();
}

}  // namespace
}  // namespace elastic_faces

std::vector<Claim> face_elasticity_claims() {
    using namespace elastic_faces;
    constexpr const char* group = "Faces";
    return {
        {.name = "uniform_strain_balances_every_cell",
         .group = group,
         .statement = "under uniform strain every inner cell is in equilibrium and has the pressure λ(ε_xx + ε_yy), if "
                      "k_t = k_n",
         .check = uniform_strain_balances_every_cell},
        {.name = "box_has_the_moduli_of_its_rock",
         .group = group,
         .statement = "a box of cells between smooth platens has the E and ν of its material, exactly if k_t = k_n",
         .check = box_has_the_moduli_of_its_rock,
         .note = "Sparse solve; ν by regression over the reference points. For other κ, c_κ corrects the inner cells "
                 "only, and rows at the sides are stiffer."},
        {.name = "box_is_run_to_the_moduli_of_its_rock",
         .group = group,
         .statement = "a box that is compressed step by step and comes to rest has the E and ν of its material",
         .check = box_is_run_to_the_moduli_of_its_rock},
        {.name = "beam_of_cells_bends_as_timoshenkos",
         .group = group,
         .statement = "a beam of cells in pure bending has M = E I φ/l",
         .check = beam_of_cells_bends_as_timoshenkos,
         .slow = true,
         .note = "κ = 1/1.6 without c_κ."},
        {.name = "step_of_faces_is_exact_and_its_bound_close",
         .group = group,
         .statement = "the exact step of intact faces is 2/ω of the dense matrix of the force routine, and the "
                      "guaranteed bound is between 0.9 and 1 of it",
         .check = step_of_faces_is_exact_and_its_bound_close},
    };
}

}  // namespace crackle::verification
