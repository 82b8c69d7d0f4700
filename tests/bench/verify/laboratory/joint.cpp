// SPDX-License-Identifier: GPL-3.0-or-later
// A planar joint without strength in the shear box: two cells, one in each half.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "solver/demseg/geometry.hpp"
#include "solver/measure/point_view.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/temporary_folder.hpp"

namespace crackle::verification {
namespace joint_scenes {
namespace {

constexpr double modulus = 50e9, ratio = 2.0, angle = 30.0;  // Pa, -, degrees
// Pa; small, because the corners of the cells are opposite each other and roll around each other by a fraction of
// pressed over modulus/1000.
constexpr double pressed = 1e4;
constexpr double slow = 2e-6;  // 1/s; dashpots carry a ten-thousandth of the stress
constexpr double side = 0.04;  // m, size of a cell, equal to a disc's diameter

/// Displacement of the joint's upper face along x relative to the lower one, m.
double slip_of(const VirtualTest& test) {
    const auto way = [&](int id) {
        const BodyIndex b = body_of_id(test.world, id);
        const BodyState& body = test.world.bodies.state[b];
        return body.x - test.setup.bonds.start[b].x - (body.angle - test.setup.bonds.start[b].angle) * (side - body.y);
    };
    return way(2) - way(1);
}

struct Sheared {
    VirtualTest test;
    double slip = 0.0;  // m, slip caused by shearing alone
};

/// Shears the joint by its upper box to the given strain; bonds to the boxes do not break.
Sheared sheared(double strain, double rate) {
    Scene scene;
    Material material;
    material.density = 2500.0;
    material.normal_stiffness = 1e9;
    material.shear_stiffness = 0.5e9;
    scene.materials = {material};
    for (int row = 0; row < 2; ++row)
        scene.add_circle_body(row + 1, 0, {{0.5 * side, (0.5 + row) * side}, 0.5 * side, 0.0});
    scene.domain = {0.0, side, 0.0, 2.0 * side, {true, true, true, true}};
    scene.time_step = 1e-8;
    const TemporaryFolder folder;
    {
        std::ofstream out(folder.path() / "discs.dat");
        write_geometry(out, scene);
    }
    std::ofstream(folder.path() / "case.toml") << fmt::format(
        "[particles]\nfile = \"discs.dat\"\n[mesh]\nkind = \"voronoi\"\nthick = {}\n[material]\nunits = \"area\"\n"
        "contact_modulus = {}\nstiffness_ratio = {}\nfriction_angle = {}\nresidual_friction_angle = {}\n"
        "tensile_strength = 1e-3\ncohesion = 1e-3\ndamping_ratio = 0.5\n[bond]\nlaw = \"coulomb\"\n[loading]\n"
        "kind = \"direct_shear\"\nplatens = \"glued\"\nbox_gap = {}\nnormal_stress = {}\naxial_strain_rate = {}\n"
        "max_axial_strain = {}\n",
        1e-3 * side, modulus, ratio, angle, angle, 0.2 * side, pressed, rate, strain);
    Sheared result{prepare_test(read_case(folder.path() / "case.toml"))};
    const double pressed_by = slip_of(result.test);
    load_specimen(result.test);
    result.slip = slip_of(result.test) - pressed_by;
    return result;
}

std::vector<ClaimRow> plane_joint_slips_at_its_friction_and_yields_by_its_shear_stiffness() {
    Rows rows;
    const double strength = pressed * std::tan(angle * std::numbers::pi / 180.0);
    const double stiffness = modulus / ratio / side;  // Pa/m, stiffness of faces of cells at a distance of one side
    const double to_slip = strength / stiffness / side;
    // The couple of the shear forces reduces the normal force at one end; far below the strength, neither end slips.
    const Sheared sticking = sheared(0.05 * to_slip, slow);
    const std::vector<CurveRow>& held = sticking.test.state.rows;  // the first row has only dashpot forces
    rows.relative("shear stiffness, Pa/m", (held.back().axial_stress - held.front().axial_stress) / sticking.slip,
                  stiffness, 1e-3, "reference");
    const Sheared sliding = sheared(3.0 * to_slip, slow);
    rows.relative("largest stress, Pa", sliding.test.state.failure.largest_stress, strength, 1e-3, "reference");
    // The faces at the boxes are as compliant as the joint, so the joint slips only after several times `to_slip`.
    double sum = 0.0, count = 0.0;
    for (const CurveRow& row : sliding.test.state.rows) {
        if (row.axial_strain < 2.0 * to_slip) continue;
        sum += row.axial_stress;
        ++count;
    }
    rows.relative("mean stress while it slips, Pa", sum / count, strength, 1e-3, "reference");
    return rows.take();
}

}  // namespace
}  // namespace joint_scenes

std::vector<Claim> joint_claims() {
    using namespace joint_scenes;
    return {
        {.name = "plane_joint_slips_at_its_friction_and_yields_by_its_shear_stiffness",
         .group = "Laboratory",
         .statement = "in the shear box, a joint without strength slips at σ_n tan φ; before slip, τ over its shear "
                      "displacement is k_s",
         .check = plane_joint_slips_at_its_friction_and_yields_by_its_shear_stiffness,
         .note = "Two cells, one in each half box; their faces to the boxes are in series with the joint."},
    };
}

}  // namespace crackle::verification
