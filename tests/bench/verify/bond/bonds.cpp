// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds: which loads break them, which do not, and that every break is recorded once.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/checkpoint.hpp"
#include "solver/world/world.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/bonded_bodies.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace {

std::vector<ClaimRow> bond_squeezed_to_ten_times_its_strength_holds() {
    Rows rows;
    Scene scene;
    scene.materials = {rock()};
    scene.materials[0].damping_ratio = 0.3;
    scene.domain.wall_present = {false, false, false, false};
    const double overlap = 1e-4;
    scene.add_circle_body(1, 0, {{0.0, 0.0}, 0.02, 0.0});
    scene.add_circle_body(2, 0, {{0.04 - overlap, 0.0}, 0.02, 0.0});
    const DofControl held{Drive::velocity, 0.0};
    scene.controls.push_back({0, held, held, held, 0});
    scene.controls.push_back({1, {Drive::displacement, -10.0 * overlap}, held, {}, 20000});
    World world = build_world(std::move(scene));
    rows.exactly("bonds", static_cast<double>(bond_all(world, 0.0)), 1.0);
    for (int n = 0; n < 25000; ++n) step(world);
    compute_forces(world);
    const BodyIndex fixed = body_of_id(world, 1);
    rows.relative("squeezing force over strength", -world.bodies.force[fixed].fx / (1e7 * overlap), 10.0, 1e-9,
                  "rounding");
    rows.exactly("bonds broken", static_cast<double>(world.bonds.broken), 0.0);
    rows.exactly("events", static_cast<double>(world.bonds.events.size()), 0.0);
    return rows.take();
}

/// A disc hits another that it barely overlaps.
Array<BodyState> rebound(double overlap, bool bonded, std::int64_t& broken) {
    Scene scene;
    scene.materials = {rock()};
    scene.domain.wall_present = {false, false, false, false};
    scene.add_circle_body(1, 0, {{0.0, 0.0}, 0.02, 0.0});
    scene.add_circle_body(2, 0, {{0.04 - overlap, 0.0}, 0.02, 0.0});
    scene.bodies[0].velocity = {0.01, 0.003};
    scene.bodies[1].spin = 0.2;
    scene.safety_factor = 0.02;
    World world = build_world(std::move(scene));
    if (bonded) bond_all(world, 0.0);
    for (int n = 0; n < 1000; ++n) step(world);
    broken = world.bonds.broken;
    return world.bodies.state;
}

std::vector<ClaimRow> bond_of_vanishing_strength_equals_no_bond() {
    Rows rows;
    double errors[2] = {};
    for (int k = 0; k < 2; ++k) {
        const double overlap = k == 0 ? 2e-9 : 2e-11;  // m
        std::int64_t broken = 0, none = 0;
        const Array<BodyState> with = rebound(overlap, true, broken), without = rebound(overlap, false, none);
        for (std::size_t b = 0; b < 2; ++b) {
            errors[k] = std::max({errors[k], std::abs(with[b].vx - without[b].vx) / 0.01,
                                  std::abs(with[b].vy - without[b].vy) / 0.01,
                                  0.02 * std::abs(with[b].omega - without[b].omega) / 0.01});
        }
        // The bond pulls with k_n δ0 throughout the contact, π√(m/2k_n), which changes the velocity by π√(2k_n/m)δ0,
        // relative to 0.01 m/s. The shear limit, which is equally small, adds the same amount.
        const double estimate = 2.0 * 3.2 * std::sqrt(2.0 * 1e7 / 3.14) * overlap / 0.01;
        rows.absolute(fmt::format("overlap {} m: velocity of separation over that of impact", overlap), errors[k], 0.0,
                      estimate, "k_n δ₀ × contact time");
        rows.exactly(fmt::format("overlap {} m: bonds broken", overlap), static_cast<double>(broken), 1.0);
    }
    rows.at_most("difference at a hundredth of the strength, over it", errors[1] / errors[0], 0.02, "linear");
    return rows.take();
}

/// Identifies bonds and breaks between the same two bodies, since an interface of polygons has several.
using Pair = std::pair<int, int>;
std::vector<Pair> bonded_pairs(const World& world) {
    std::vector<Pair> pairs;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points.state[k].flags & point_bonded) == 0) continue;
        const ContactPoint point = world.points.contact[k];
        pairs.emplace_back(std::minmax(world.bodies.info(point.body_i).id, world.bodies.info(point.body_j).id));
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}
std::vector<Pair> broken_pairs(const std::vector<BreakEvent>& events) {
    std::vector<Pair> pairs;
    pairs.reserve(events.size());
    for (const BreakEvent& event : events) pairs.emplace_back(std::minmax(event.body_i, event.body_j));
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

constexpr int burst_steps = 3000;

std::vector<ClaimRow> break_list_is_the_difference_of_bond_sets() {
    Rows rows;
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        World world = bursting_specimen(kind);
        const std::vector<Pair> before = bonded_pairs(world);
        for (int n = 0; n < burst_steps; ++n) step(world);
        compute_forces(world);
        const std::vector<Pair> after = bonded_pairs(world), broken = broken_pairs(world.bonds.events);
        std::vector<Pair> lost, off;
        std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(lost));
        std::set_symmetric_difference(lost.begin(), lost.end(), broken.begin(), broken.end(), std::back_inserter(off));
        const std::string name = name_of(kind);
        rows.at_least(name + ": bonds broken", static_cast<double>(broken.size()), 20.0, "it bursts");
        rows.at_least(name + ": bonds that hold", static_cast<double>(after.size()), 20.0, "some bonds hold");
        rows.exactly(name + ": bonds lost without an event, or events without a lost bond",
                     static_cast<double>(off.size()), 0.0);
        rows.exactly(name + ": counted as broken", static_cast<double>(world.bonds.broken),
                     static_cast<double>(lost.size()));
    }
    return rows.take();
}

std::vector<ClaimRow> splitting_a_run_loses_no_break() {
    Rows rows;
    const auto key = [](const BreakEvent& event) {
        return std::tuple(event.step, event.body_i, event.body_j, event.position.x, event.position.y, event.energy);
    };
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        World straight = bursting_specimen(kind);
        World split = straight;
        for (int n = 0; n < burst_steps; ++n) step(straight);
        std::mt19937_64 generator(7);
        std::vector<BreakEvent> events;
        int parts = 0;
        for (int n = 0; n < burst_steps; ++n) {
            if (uniform_below(generator, 200) == 0) {
                if (parts % 2 == 1) compute_forces(split);  // stopped either after the force pass or after the step
                events.insert(events.end(), split.bonds.events.begin(), split.bonds.events.end());
                split.bonds.events.clear();
                split = load_world(save_world(split), "memory");
                ++parts;
            }
            step(split);
        }
        events.insert(events.end(), split.bonds.events.begin(), split.bonds.events.end());
        std::size_t off = std::max(events.size(), straight.bonds.events.size());
        if (events.size() == straight.bonds.events.size()) {
            off = 0;
            for (std::size_t k = 0; k < events.size(); ++k)
                off += key(events[k]) == key(straight.bonds.events[k]) ? 0 : 1;
        }
        const std::string name = name_of(kind);
        rows.at_least(name + ": parts of the run", parts, 5.0, "it is split");
        rows.at_least(name + ": breaks", static_cast<double>(straight.bonds.events.size()), 20.0, "it bursts");
        rows.exactly(name + ": breaks that differ from those of the uninterrupted run", static_cast<double>(off), 0.0);
    }
    return rows.take();
}

}  // namespace

std::vector<Claim> bond_claims() {
    constexpr const char* group = "Bonds";
    return {
        {.name = "bond_squeezed_to_ten_times_its_strength_holds",
         .group = group,
         .statement = "compression breaks no bond",
         .check = bond_squeezed_to_ten_times_its_strength_holds},
        {.name = "bond_of_vanishing_strength_equals_no_bond",
         .group = group,
         .statement = "strength → 0 equals unbonded",
         .check = bond_of_vanishing_strength_equals_no_bond},
        {.name = "break_list_is_the_difference_of_bond_sets",
         .group = group,
         .statement = "there is one event for every broken bond, and no other",
         .check = break_list_is_the_difference_of_bond_sets},
        {.name = "splitting_a_run_loses_no_break",
         .group = group,
         .statement =
             "a run that is stopped, saved and continued has the same breaks as an uninterrupted run, to the bit",
         .check = splitting_a_run_loses_no_break},
    };
}

}  // namespace crackle::verification
