// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/scenes/between_platens.hpp"

#include <cmath>
#include <utility>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/time_step.hpp"
#include "specimens/making/disordered.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {

LoadedSpecimen between_platens(Kind kind, double speed, const IntactOptions& intact, double friction_angle,
                               double damping_ratio, double time_step) {
    Scene scene;
    double bottom = -0.5e-3, top = 8 * 0.04 + 0.5e-3, bond_thick = 1.08e-3;
    if (kind == Kind::discs) {
        DisorderedDiscs request;
        request.columns = 8, request.rows = 12, request.mean_overlap = 2e-4;
        scene = disordered_discs(request, rock(friction_angle));
        scene.thick = bond_thick = 1e-3;
        const double reach = 0.02 + scene.thick - 2e-4;  // platens overlap the end rows as discs do
        bottom = -reach;
        top = 11.0 * (0.04 - 2e-4) * 0.5 * std::sqrt(3.0) + reach;
    } else {
        ShakenCells request;
        request.columns = 5, request.rows = 8, request.flat_ends = true;
        scene = shaken_cells(request, rock(friction_angle));
    }
    constexpr int lower = 9001, upper = 9002;
    scene.add_chain_body(lower, 0, {{-0.1, bottom}, {0.6, bottom}}, false);
    scene.add_chain_body(upper, 0, {{-0.1, top}, {0.6, top}}, false);
    const auto count = static_cast<int>(scene.bodies.size());
    const DofControl held{Drive::velocity, 0.0};
    scene.controls.push_back({count - 2, held, held, held, 0});
    scene.controls.push_back({count - 1, held, {Drive::velocity, speed}, held, 0});
    scene.intact = intact;
    scene.materials[0].damping_ratio = damping_ratio;
    LoadedSpecimen loaded;
    loaded.world = build_world(std::move(scene));
    World& world = loaded.world;
    bond_all(world, bond_thick);
    if (time_step > 0.0) set_time_step(world, time_step);
    loaded.low = body_of_id(world, lower), loaded.high = body_of_id(world, upper);
    loaded.height = top - bottom;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        if (b == loaded.low || b == loaded.high) continue;
        world.bodies.state[b].vy = speed * (world.bodies.state[b].y - bottom) / loaded.height;
    }
    return loaded;
}

}  // namespace crackle::verification
