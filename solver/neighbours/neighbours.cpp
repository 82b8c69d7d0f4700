// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/neighbours/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "solver/neighbours/exchange.hpp"
#include "solver/neighbours/near_pairs.hpp"
#include "solver/neighbours/pierced.hpp"
#include "solver/neighbours/point_lists.hpp"

namespace crackle {
namespace {

/// Steps that a list of a bonded world is to last. Building it, with the bound on the step, costs what some 30 steps
/// do: at 200 that was 8 % of a test of 300 discs. Longer, polygons list corners that nothing brings together.
constexpr double list_lasts = 1000.0;
/// Steps between two looks whether a narrower skin would do.
constexpr std::int64_t look_interval = 64;
constexpr double narrowest_share = 0.01;  // of the widest skin
// A body that moves by p reaches a step and has a half skin of h reaches lasts h/p steps and lists about as many
// points more by the share of h (discs in a dense packing: 0.8 to 1 of those that touch a reach). With a rebuild worth
// R steps the sum h + R p/h is least at h = √(R p).
constexpr double rebuild_steps = 45.0;
constexpr double widest_own = 0.5;  // of the median reach: half skins of fast bodies

/// How far surface points can have gone since the list was built.
struct Ways {
    double longest = 0.0;  // m
    double left = 0.0;     // m, least that any has left of its half skin
    bool used_up = false;  // some has hardly anything left
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

/// The skin that lasts for list_lasts steps like those since the list was built. @param way the longest since then, m
double skin_for(const World& world, double way) {
    const double pace =
        way / static_cast<double>(std::max<std::int64_t>(1, world.stepping.steps - world.list.built_at));
    return std::clamp(2.0 * list_lasts * pace, narrowest_share * world.list.widest_skin, world.list.widest_skin);
}

/// Half skins of all bodies by how fast they are now. Where no skin is wide enough a body's own speed counts; under the
/// guide's law every listed disc bounds the step, so that none is listed early.
void choose_half_skins(World& world) {
    const double half = 0.5 * world.list.skin;
    world.list.half_skin = half;
    world.list.own_half_skins = {};
    // Before there is a step, ramps have no velocity yet.
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
        std::vector<std::uint64_t>().swap(pairs);  // the lists need the room
        exchange_points(world, lists);
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
        // The bound is used up: look how far bodies really went, and rebuild if one has little left of its skin.
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
