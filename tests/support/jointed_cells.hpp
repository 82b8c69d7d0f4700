// SPDX-License-Identifier: GPL-3.0-or-later
// Square cells in rows and columns, with joint traces between some of them.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/materials.hpp"

namespace crackle::testing {

struct JointedCells {
    int columns = 4, rows = 4;
    double size = 0.02, thick = 2e-5;  // m
    double modulus = 5e9;              // Pa
    double damping_ratio = 0.1;
    /// Traces through all cells, by the row above which or the column to the right of which they run. The value is an
    /// index into `joints`, or -1 for a trace that behaves like the rock. Traces run upwards or to the right.
    std::map<int, int> above_row, right_of_column;
    std::vector<Joint> joints;
    Integrator integrator = Integrator::leapfrog;
};

/// The scene; ids start at 1, row by row from the lower left.
inline Scene jointed_scene(const JointedCells& cells) {
    Scene scene;
    Material rock = undamped_rock(cells.modulus, 35.0, 0.4);
    rock.residual_friction_angle = 30.0;
    rock.tensile_strength = 2e6;
    rock.cohesion = 6e6;
    rock.damping_ratio = cells.damping_ratio;
    scene.materials = {rock};
    scene.thick = cells.thick;
    scene.domain.wall_present = {false, false, false, false};
    scene.bond_law = BondLaw::coulomb;
    scene.units = StiffnessUnits::area;
    scene.integrator = cells.integrator;
    scene.joints = cells.joints;
    std::map<std::pair<bool, int>, TraceSide> trace_at;
    for (const auto& [upright, lines] : {std::pair{false, &cells.above_row}, std::pair{true, &cells.right_of_column}}) {
        for (const auto& [line, joint] : *lines) {
            trace_at[{upright, line}] = 2 * static_cast<TraceSide>(scene.trace_joints.size());
            scene.trace_joints.push_back(joint);
        }
    }
    const auto side = [&](bool upright, int line, TraceSide right) {
        const auto found = trace_at.find({upright, line});
        return found == trace_at.end() ? no_side : found->second + right;
    };
    std::vector<TraceSide> sides;
    const double h = 0.5 * cells.thick;
    for (int r = 0; r < cells.rows; ++r) {
        for (int c = 0; c < cells.columns; ++c) {
            const Vec2 low{cells.size * c, cells.size * r}, high{low.x + cells.size, low.y + cells.size};
            scene.add_chain_body(
                r * cells.columns + c + 1, 0,
                {{low.x + h, low.y + h}, {high.x - h, low.y + h}, {high.x - h, high.y - h}, {low.x + h, high.y - h}},
                true);
            // Cells above a trace, or to the left of one that runs upwards, are on its left side.
            sides.insert(sides.end(),
                         {side(false, r - 1, 0), side(true, c, 0), side(false, r, 1), side(true, c - 1, 1)});
        }
    }
    scene.edge_sides = sides;
    return scene;
}

inline World jointed_world(const JointedCells& cells) {
    Bonding bonding;
    bonding.thick = cells.thick;
    bonding.gap = 0.05 * cells.thick;
    World world = build_world(jointed_scene(cells));
    bond_all(world, bonding);
    return world;
}

}  // namespace crackle::testing
