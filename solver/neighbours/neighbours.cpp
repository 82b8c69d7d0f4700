// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/neighbours/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "solver/faces/hand_over.hpp"
#include "solver/neighbours/exchange.hpp"
#include "solver/neighbours/near_pairs.hpp"
#include "solver/neighbours/pierced.hpp"
#include "solver/neighbours/point_lists.hpp"

namespace crackle {
namespace {

/// Number of steps for which a neighbour list should last in a bonded world. Building a list and bounding the time step
/// together take as long as 45 steps (rebuild_steps). With lists that lasted for 200 steps, this took 8 % of the time
/// of a test with 300 discs. Lists that last much longer need a wider skin, and would include corners of polygons that
/// never touch.
constexpr double list_lasts = 1000.0;
/// Number of steps between checks whether a narrower skin would suffice.
constexpr std::int64_t look_interval = 64;
constexpr double narrowest_share = 0.01;  // narrowest skin as a fraction of the widest
// A list lasts h/p steps if bodies move by p bounding radii per step and the half skin is h bounding radii. The number
// of listed points, and with it the cost of a step, grows by a fraction of about h (0.8 to 1 times h in a dense packing
// of discs). If a rebuild costs as much as R steps, the total extra cost h + R p/h is smallest for h = √(R p).
constexpr double rebuild_steps = 45.0;
constexpr double widest_own = 0.5;  // largest half skin of a fast body, relative to the median bounding radius

/// Distances by which surface points may have moved since the list was built.
struct Ways {
    double longest = 0.0;  // m, largest distance
    double left = 0.0;     // m, smallest remaining part of a body's half skin
    bool used_up = false;  // whether some body has nearly used up its half skin
};

Ways ways_since_list(const World& world) {
    Ways ways{0.0, std::numeric_limits<double>::infinity(), false};
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies.state[b];
        const ListReference& then = world.list.reference[b];
        double way = norm({body.x - then.x, body.y - then.y});
        if (const std::uint32_t shape = world.bodies.names[b].shape; shape != no_shape)
            way += world.bodies.shapes[shape].reach * std::abs(body.angle - world.list.reference_angles[shape]);
        const double half = world.list.half_skin_of(b);
        ways.longest = std::max(ways.longest, way);
        ways.left = std::min(ways.left, half - way);
        ways.used_up = ways.used_up || way > 0.8 * half;
    }
    return ways;
}

bool skin_follows(const World& world) { return world.bonds.made && world.list.widest_skin > 0.0; }

/// Skin with which a list would last for list_lasts steps at the current rate of motion. @param way largest
/// displacement since the list was built, m
double skin_for(const World& world, double way) {
    const double pace =
        way / static_cast<double>(std::max<std::int64_t>(1, world.stepping.steps - world.list.built_at));
    return std::clamp(2.0 * list_lasts * pace, narrowest_share * world.list.widest_skin, world.list.widest_skin);
}

/// Sets the half skins of all bodies. If even the widest common skin is too narrow, each body's half skin follows from
/// its own speed. Under the DEMseg guide's segment law all half skins are equal, because every listed disc lowers the
/// bound on the time step.
void choose_half_skins(World& world) {
    const double half = 0.5 * world.list.skin;
    world.list.half_skin = half;
    world.list.own_half_skins = {};
    // Before the first time step is known, the velocities of displacement ramps are not set.
    const bool own =
        world.stepping.time_step > 0.0 && world.list.widest_skin > 0.0 && world.list.skin == world.list.widest_skin;
    if (!own || world.settings.segment_law != SegmentLaw::rounded) return;
    const double reach = world.list.widest_skin / skin_share;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies.state[b];
        const double speed = norm({body.vx, body.vy}) + world.bodies.turning_reach(b) * std::abs(body.omega);
        const double lasting = std::sqrt(rebuild_steps * speed * world.stepping.time_step * reach);
        if (!(lasting > half)) continue;
        if (world.list.own_half_skins.empty()) world.list.own_half_skins.assign(world.bodies.size(), half);
        world.list.own_half_skins[b] = std::min(lasting, std::max(half, widest_own * reach));
    }
}

void note_places(World& world) {
    world.list.reference.resize(world.bodies.size());
    world.list.reference_angles.resize(world.bodies.shapes.size());
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies.state[b];
        world.list.reference[b] = {body.x, body.y};
        if (const std::uint32_t shape = world.bodies.names[b].shape; shape != no_shape)
            world.list.reference_angles[shape] = body.angle;
    }
}

void rebuild(World& world) {
    choose_half_skins(world);
    std::vector<std::uint64_t> pairs = near_pairs(world);
    {
        const PhaseTimer timer(world.workers.profile, Phase::listing);
        PointLists lists = list_points(world, pairs);
        std::vector<std::uint64_t>().swap(pairs);  // frees memory for the new points
        exchange_points(world, lists);
        if (world.faces.size() > 0) list_hand_over(world);
        world.workers.plan.valid = false;
        world.workers.marks.resize(world.bodies.size());
    }
    note_places(world);
    world.list.travelled = 0.0;
    const auto& own = world.list.own_half_skins;
    world.list.free_way = own.empty() ? world.list.half_skin : *std::ranges::min_element(own);
    world.list.valid = true;
    world.list.built_at = world.stepping.steps;
    world.list.builds += 1;
}
}  // namespace

bool update_neighbour_list(World& world) {
    if (world.list.valid) {
        const std::int64_t age = world.stepping.steps - world.list.built_at;
        const bool look = skin_follows(world) && age > 0 && age % look_interval == 0;
        if (!look && world.list.travelled <= world.list.free_way) return false;
        // The upper bound on displacements has reached the half skin, so the actual displacements are computed. The
        // list is rebuilt if a body has nearly used up its half skin.
        const Ways ways = ways_since_list(world);
        world.list.travelled = 0.0;
        world.list.free_way = ways.left;
        if (!ways.used_up && !(look && skin_for(world, ways.longest) < 0.25 * world.list.skin)) return false;
        refuse_piercing(world);
        if (skin_follows(world)) world.list.skin = skin_for(world, ways.longest);
    }
    rebuild(world);
    return true;
}

}  // namespace crackle
