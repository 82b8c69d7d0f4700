// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the neighbour list with a search over all pairs. No touching point may be missed, for any mixture of sizes,
// at rest and in motion, and the values of points must survive a rebuild.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/stepping/time_step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/disordered.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/plain_distance.hpp"

namespace crackle {
namespace {

using testing::distance_to_outline;
using verification::rock;

/// (id of the element's body, element within the body, id of the partner, its circle or -1); walls have ids -1 … -4.
using Touch = std::tuple<int, std::uint32_t, int, std::int64_t>;

std::set<Touch> listed(const World& world) {
    std::set<Touch> touches;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint p = world.points.contact[k];
        const PointView view = view_point(world, k);
        if (view.overlap <= 0.0) continue;
        const BodyInfo i = world.bodies.info(p.body_i);
        const std::uint32_t element = p.element_i - i.first_element;
        if (view.kind == PointKind::element_wall) {
            touches.insert({i.id, element, -1 - static_cast<int>(p.body_j), -1});
            continue;
        }
        const BodyInfo j = world.bodies.info(p.body_j);
        if (view.kind == PointKind::element_outline) {
            touches.insert({i.id, element, j.id, -1});
        } else {
            const std::uint32_t other = p.feature_j >= j.first_element ? p.feature_j - j.first_element : 0;
            const bool first = i.id < j.id;
            touches.insert(first ? Touch{i.id, element, j.id, other} : Touch{j.id, other, i.id, element});
        }
    }
    return touches;
}

std::set<Touch> searched(const World& world) {
    std::set<Touch> touches;
    std::vector<std::vector<Vec2>> places;
    for (std::size_t b = 0; b < world.bodies.size(); ++b)
        places.push_back(element_positions(world, static_cast<BodyIndex>(b)));
    const Domain& d = world.settings.domain;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool chain_i = world.bodies.info(i).piece_count > 0;
        for (std::uint32_t e = 0; e < places[i].size(); ++e) {
            const Vec2 p = places[i][e];
            const double radius = element_of(BodyView(world), i, world.bodies.info(i).first_element + e).radius;
            const double bare = chain_i ? 0.0 : radius;
            const double to_wall[4] = {p.x - d.x1, d.x2 - p.x, p.y - d.y1, d.y2 - p.y};
            for (int wall = 0; wall < 4; ++wall) {
                if (d.wall_present[static_cast<std::size_t>(wall)] && to_wall[wall] < bare)
                    touches.insert({world.bodies.info(i).id, e, -1 - wall, -1});
            }
            for (std::size_t j = 0; j < places.size(); ++j) {
                if (j == i) continue;
                if (world.bodies.info(j).piece_count > 0) {
                    const double reach = chain_i ? world.settings.thick : radius + world.settings.thick;
                    if (distance_to_outline(p, places[j], world.bodies.info(j).closed) < reach)
                        touches.insert({world.bodies.info(i).id, e, world.bodies.info(j).id, -1});
                } else if (!chain_i && world.bodies.info(i).id < world.bodies.info(j).id) {
                    for (std::uint32_t f = 0; f < places[j].size(); ++f) {
                        const double other =
                            element_of(BodyView(world), j, world.bodies.info(j).first_element + f).radius;
                        if (norm(places[j][f] - p) < radius + other)
                            touches.insert({world.bodies.info(i).id, e, world.bodies.info(j).id, f});
                    }
                }
            }
        }
    }
    return touches;
}

/// Discs of very different sizes, clumps, polygons, chains and platens at random positions.
Scene mixture(std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    Scene scene;
    scene.materials = {rock()};
    scene.thick = 0.02;
    scene.domain = {-1.0, 11.0, -1.0, 11.0, {true, true, true, true}};
    int id = 0;
    const auto place = [&] { return Vec2{uniform_number(generator, 0.0, 10.0), uniform_number(generator, 0.0, 10.0)}; };
    const auto turned = [&](std::vector<Vec2> outline, Vec2 at, double size) {
        const double angle = uniform_number(generator, 0.0, 6.3), c = std::cos(angle), s = std::sin(angle);
        for (Vec2& p : outline) p = at + size * Vec2{c * p.x - s * p.y, s * p.x + c * p.y};
        return outline;
    };
    for (int k = 0; k < 300; ++k) scene.add_circle_body(++id, 0, {place(), uniform_number(generator, 0.02, 0.2), 0.0});
    for (int k = 0; k < 3; ++k) scene.add_circle_body(++id, 0, {place(), uniform_number(generator, 0.5, 2.0), 0.0});
    for (int k = 0; k < 20; ++k) {
        const Vec2 at = place();
        scene.add_circle_body(++id, 0, {at, uniform_number(generator, 0.05, 0.2), 0.0});
        scene.circles.push_back({at + Vec2{0.15, 0.05}, 0.1, 0.0});
        scene.bodies.back().circle_count = 2;
    }
    for (int k = 0; k < 40; ++k)
        scene.add_chain_body(
            ++id, 0, turned({{0, 0}, {1, 0.1}, {0.7, 0.9}, {-0.1, 0.6}}, place(), uniform_number(generator, 0.1, 1.0)),
            true);
    for (int k = 0; k < 5; ++k)  // an L
        scene.add_chain_body(++id, 0, turned({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, place(), 0.4), true);
    for (int k = 0; k < 10; ++k) scene.add_chain_body(++id, 0, turned({{0, 0}, {1, 0}, {1, 1}}, place(), 0.5), false);
    scene.add_chain_body(++id, 0, {{-0.9, -0.3}, {10.9, -0.2}}, false);  // a platen, far larger than all other bodies
    scene.add_chain_body(++id, 0, {{-0.9, 10.2}, {10.9, 10.3}}, false);
    for (Body& body : scene.bodies) {
        body.velocity = {uniform_number(generator, -1.0, 1.0), uniform_number(generator, -1.0, 1.0)};
        body.spin = uniform_number(generator, -1.0, 1.0);
    }
    return scene;
}

std::size_t missed(const World& world) {
    const std::set<Touch> plain = searched(world), quick = listed(world);
    std::size_t count = 0;
    for (const Touch& touch : plain) count += quick.contains(touch) ? 0u : 1u;
    EXPECT_EQ(quick.size(), plain.size());
    return count;
}

TEST(NeighbourList, MissesNoTouchingPointOfAnyMixtureOfSizes) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const World world = build_world(mixture(seed));
        const std::size_t touching = searched(world).size();
        EXPECT_EQ(missed(world), 0u) << "seed " << seed;
        EXPECT_GT(touching, 200u);
        if (seed == 1)
            fmt::print("  {} bodies, {} touching points, {} listed\n", world.bodies.size(), touching,
                       world.points.size());
    }
}

/// Squares much smaller than the thickness, across which they touch.
TEST(NeighbourList, MissesNoTouchingPointAcrossAThicknessBeyondTheBodies) {
    std::mt19937_64 generator(3);
    Scene scene;
    scene.materials = {rock()};
    scene.thick = 0.5;
    scene.domain = {-1.0, 11.0, -1.0, 11.0, {false, false, false, false}};
    for (int id = 1; id <= 200; ++id) {
        const double x = uniform_number(generator, 0.0, 10.0), y = uniform_number(generator, 0.0, 10.0);
        scene.add_chain_body(id, 0, {{x, y}, {x + 0.01, y}, {x + 0.01, y + 0.01}, {x, y + 0.01}}, true);
    }
    const World world = build_world(scene);
    EXPECT_EQ(missed(world), 0U);
    EXPECT_GT(searched(world).size(), 500U);
}

/// Bodies with many points (platens), few or none, on one and several threads; points of smaller kinds come first, then
/// those of the largest kind.
TEST(NeighbourList, EveryBodyAddsUpItsPointsInTheirOrder) {
    for (const int threads : {1, 3}) {
        World world = build_world(mixture(5));
        set_threads(world, threads);
        for (int n = 0; n < 20; ++n) step(world);
        compute_forces(world);
        std::vector<BodyForce> sums(world.bodies.size(), BodyForce{0.0, 0.0, 0.0});
        std::vector<int> additions(world.bodies.size());
        std::set<int> points_a_body;
        const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
        const auto add_kind = [&](std::size_t kind) {
            for (PointIndex k = world.points.kind_begin[kind]; k < world.points.kind_begin[kind + 1]; ++k) {
                const PointForce& force = world.points.force[k];
                BodyForce& on_i = sums[world.points.contact[k].body_i];
                on_i = {on_i.fx + force.fx, on_i.fy + force.fy, on_i.torque + force.torque_i};
                ++additions[world.points.contact[k].body_i];
                if (k >= walls) continue;
                ++additions[world.points.contact[k].body_j];
                BodyForce& on_j = sums[world.points.contact[k].body_j];
                on_j = {on_j.fx - force.fx, on_j.fy - force.fy, on_j.torque + force.torque_j};
            }
        };
        std::size_t largest = 0;
        const auto points_of = [&](std::size_t kind) {
            return world.points.kind_begin[kind + 1] - world.points.kind_begin[kind];
        };
        for (std::size_t kind = 1; kind < point_kinds; ++kind)
            if (points_of(kind) > points_of(largest)) largest = kind;
        for (std::size_t kind = 0; kind < point_kinds; ++kind)
            if (kind != largest) add_kind(kind);
        add_kind(largest);
        for (std::size_t b = 0; b < sums.size(); ++b) {
            EXPECT_EQ(world.bodies.force[b].fx, sums[b].fx) << b;
            EXPECT_EQ(world.bodies.force[b].fy, sums[b].fy) << b;
            EXPECT_EQ(world.bodies.force[b].torque, sums[b].torque) << b;
            points_a_body.insert(additions[b]);
        }
        EXPECT_TRUE(points_a_body.contains(0));
        EXPECT_GE(points_a_body.size(), 8U);
    }
}

TEST(NeighbourList, MissesNoTouchingPointInMotionBetweenRebuilds) {
    for (const double skin : {0.02, 0.1, 0.3}) {
        Scene scene = mixture(20);
        scene.allow_unstable = true;  // the heap starts with deep overlaps and flies apart
        scene.skin = skin;
        scene.thick = 0.02;
        scene.time_step = 2e-3;
        scene.materials[0].normal_stiffness = 10.0;  // soft, so that bodies pass through each other
        scene.materials[0].shear_stiffness = 5.0;
        scene.domain.wall_present = {false, false, false, false};
        World world = build_world(scene);
        std::size_t touching = 0, checks = 0;
        for (int n = 1; n <= 400; ++n) {
            compute_forces(world);
            if (n % 7 == 0) {
                EXPECT_EQ(missed(world), 0u) << "skin " << skin << ", step " << n;
                touching += listed(world).size();
                ++checks;
            }
            advance(world);
        }
        fmt::print("  skin {:.3g} m: {} rebuilds in 400 steps, {} touching points on average\n", world.list.skin,
                   world.list.builds, touching / checks);
        EXPECT_GT(world.list.builds, 3);
        EXPECT_LT(world.list.builds, 400);
    }
}

/// The skin of a bonded scene at rest and then flying apart, compared with the same scene with its widest skin
/// throughout.
struct SkinTrace {
    double distance;     // largest of a body's surface between the two runs, over the mean reach
    std::size_t spared;  // number of points not listed at rest
};

SkinTrace trace_of_skin(Scene scene, double thick, double share) {
    scene.domain.wall_present = {false, false, false, false};
    scene.time_step = 2e-5;
    World follows = build_world(scene);
    const double widest = follows.list.skin;
    scene.skin = widest;
    World stays = build_world(scene);
    for (World* world : {&follows, &stays}) bond_all(*world, thick);
    std::size_t fewest = follows.points.size();
    double narrowest = widest, widest_again = 0.0;
    const auto run = [&](int steps) {
        for (int n = 0; n < steps; ++n) {
            for (World* world : {&follows, &stays}) compute_forces(*world);
            fewest = std::min(fewest, follows.points.size());
            narrowest = std::min(narrowest, follows.list.skin);
            if (n % 37 == 0) {
                EXPECT_EQ(missed(follows), 0u) << "step " << follows.stepping.steps;
            }
            for (World* world : {&follows, &stays}) advance(*world);
        }
        widest_again = follows.list.skin;
    };
    run(200);  // at rest
    fmt::print("  at rest: skin {:.3g} of {:.3g} m, {} points of {}\n", narrowest, widest, fewest, stays.points.size());
    EXPECT_LT(narrowest, 0.02 * widest);
    const std::size_t spared = stays.points.size() - fewest;
    for (World* world : {&follows, &stays})
        verification::shake(*world, share * verification::breaking_energy(*world), 5);
    run(1500);
    EXPECT_GT(follows.bonds.broken, 50);
    EXPECT_GT(widest_again, 0.2 * widest);
    EXPECT_EQ(stays.list.skin, widest);
    const double own =
        follows.list.own_half_skins.empty() ? 0.0 : *std::ranges::max_element(follows.list.own_half_skins);
    EXPECT_GT(own, 0.6 * widest) << "no fast body has a larger skin";
    EXPECT_LT(follows.list.builds, stays.list.builds);
    fmt::print("  flying apart: skin {:.3g} m, {} bonds broken, {} rebuilds against {}\n", widest_again,
               follows.bonds.broken, follows.list.builds, stays.list.builds);
    EXPECT_EQ(follows.bonds.broken, stays.bonds.broken);
    double worst = 0.0, reach = 0.0;
    for (std::size_t b = 0; b < follows.bodies.size(); ++b) {
        const BodyState &one = follows.bodies.state[b], &other = stays.bodies.state[b];
        reach += follows.bodies.info(b).reach / static_cast<double>(follows.bodies.size());
        worst = std::max(worst, std::hypot(one.x - other.x, one.y - other.y) +
                                    follows.bodies.info(b).reach * std::abs(one.angle - other.angle));
    }
    fmt::print("  largest distance between the two runs: {:.2g} of a mean reach\n", worst / reach);
    return {worst / reach, spared};
}

TEST(NeighbourList, SkinOfBondedDiscsFollowsTheMotionMissesNothingAndChangesNothing) {
    DisorderedDiscs request;
    request.columns = 10, request.rows = 10;
    EXPECT_EQ(trace_of_skin(disordered_discs(request, rock()), 0.0, 20.0).distance, 0.0);
}

/// The list determines the order in which forces on a body are added. This causes about 20 rounding errors of 1e-16 per
/// step in 1700 steps, which collisions amplify.
TEST(NeighbourList, SkinOfBondedCellsFollowsTheMotionMissesNothingAndChangesRoundingAlone) {
    ShakenCells request;
    request.columns = 8, request.rows = 8;
    const SkinTrace trace = trace_of_skin(shaken_cells(request, rock()), 1.08e-3, 20.0);
    EXPECT_LT(trace.distance, 1e-8);
    EXPECT_GT(trace.spared, 0u);
}

TEST(NeighbourList, RebuildKeepsSpringsBondsAndFlags) {
    DisorderedDiscs request;
    request.columns = 8, request.rows = 8, request.shake = 5e-5;
    Material material = rock(10.0);
    World world = build_world(disordered_discs(request, material));
    bond_all(world, 0.0);
    verification::shake(world, 0.3 * verification::breaking_energy(world), 5);
    for (int n = 0; n < 200; ++n) step(world);
    World again = world;
    again.list.valid = false;
    refresh_neighbours(again);
    EXPECT_GT(again.list.builds, world.list.builds);
    using Memory = std::tuple<double, double, std::uint16_t>;
    const auto memory = [](const World& w) {
        std::map<std::pair<int, int>, Memory> result;
        for (PointIndex k = 0; k < w.points.size(); ++k) {
            const ContactPoint p = w.points.contact[k];
            const auto flags =
                static_cast<std::uint16_t>(w.points.state[k].flags & ~point_counted);  // a rebuild counts points again
            if (w.points.shear_force[k] == 0.0 && flags == 0) continue;
            result[{w.bodies.info(p.body_i).id, w.bodies.info(p.body_j).id}] = {w.points.shear_force[k],
                                                                                w.points.bond_overlap[k], flags};
        }
        return result;
    };
    EXPECT_GT(memory(world).size(), 50u);
    EXPECT_TRUE(memory(world) == memory(again));
}

/// Two bodies side by side, discs or squares, which can be bonded at an overlap of 1e-4 m.
World bonded_pair(bool squares, const IntactOptions& intact, double speed = 0.0) {
    Scene scene;
    scene.materials = {rock()};
    scene.intact = intact;
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {false, false, false, false}};
    if (squares) {
        scene.thick = 1e-3;
        const double left = 0.04 + 0.9e-3;
        scene.add_chain_body(1, 0, {{0.0, 0.0}, {0.04, 0.0}, {0.04, 0.04}, {0.0, 0.04}}, true);
        scene.add_chain_body(2, 0, {{left, 0.0}, {left + 0.04, 0.0}, {left + 0.04, 0.04}, {left, 0.04}}, true);
    } else {
        scene.add_circle_body(1, 0, {{0.0, 0.0}, 0.02, 0.0});
        scene.add_circle_body(2, 0, {{0.04 - 1e-4, 0.0}, 0.02, 0.0});
    }
    scene.bodies[1].velocity = {speed, 0.0};
    World world = build_world(scene);
    bond_all(world, scene.thick);
    return world;
}

std::int64_t bonds_held(const World& world) {
    return std::count_if(world.points.state.begin(), world.points.state.end(),
                         [](const PointState& p) { return (p.flags & point_bonded) != 0; });
}

TEST(NeighbourList, IntactBondsHoldAtAnyOpening) {
    for (const bool squares : {false, true}) {
        for (const bool no_new_contacts : {false, true}) {
            World world = bonded_pair(squares, {true, true, no_new_contacts});
            const BodyIndex far = body_of_id(world, 2);
            for (const double skins : {0.5, 2.5, 30.0, 1.0}) {
                const double start = world.bodies.state[far].x, opening = skins * world.list.skin;
                world.bodies.state[far].x += opening;
                world.list.valid = false;
                world.stepping.forces_current = false;
                compute_forces(world);
                const std::string claim = fmt::format("{} opened by {} skins", squares ? "squares" : "discs", skins);
                EXPECT_EQ(bonds_held(world), world.bonds.initial) << claim;
                EXPECT_TRUE(testing::agrees(claim + ": pull over stiffness, m", -world.bodies.force[far].fx / 1e7,
                                            static_cast<double>(world.bonds.initial) * opening, 1e-9));
                world.bodies.state[far].x = start;
            }
        }
    }
}

TEST(NeighbourList, IntactBondsOfAWholeSpecimenKeepTheirOrderWhenItIsBlownUp) {
    DisorderedDiscs request;
    request.columns = 6, request.rows = 6;
    Scene scene = disordered_discs(request, rock());
    scene.domain.wall_present = {false, false, false, false};
    scene.intact = {true, true, false};
    World world = build_world(scene);
    ASSERT_GT(bond_all(world, 0.0), 60);
    const auto bonds = [&] {
        std::vector<std::pair<std::uint64_t, double>> all;
        for (PointIndex k = 0; k < world.points.size(); ++k) {
            if ((world.points.state[k].flags & point_bonded) == 0) continue;
            const ContactPoint p = world.points.contact[k];
            all.emplace_back((static_cast<std::uint64_t>(p.body_i) << 32) | p.body_j, world.points.bond_overlap[k]);
        }
        return all;
    };
    const auto before = bonds();
    for (const double scale : {1.5, 1.3, 0.7, 1.0}) {
        const Array<BodyState> start = world.bodies.state;
        for (BodyState& body : world.bodies.state) body.x *= scale, body.y *= scale;
        world.list.valid = false;
        world.stepping.forces_current = false;
        compute_forces(world);
        EXPECT_TRUE(bonds() == before) << "blown up by " << scale;
        double sum = 0.0, size = 0.0;
        for (const BodyForce& force : world.bodies.force) sum += force.fx, size += std::abs(force.fx);
        EXPECT_LE(std::abs(sum), 1e-12 * size) << "action and reaction, scaled by " << scale;
        world.bodies.state = start;
    }
}

TEST(NeighbourList, ABreakThatOpensBeyondTheSkinInOneStepGivesItsEvent) {
    for (const bool squares : {false, true}) {
        const double step_length = bonded_pair(squares, {}).stepping.time_step;
        World world = bonded_pair(squares, {}, 0.3 * 0.02 / step_length);  // three times the skin per step
        step(world);
        compute_forces(world);
        EXPECT_EQ(static_cast<std::int64_t>(world.bonds.events.size()), world.bonds.initial)
            << (squares ? "squares" : "discs");
        EXPECT_EQ(world.bonds.broken, world.bonds.initial);
        EXPECT_EQ(world.bonds.interfaces_lost, 1);
    }
}

}  // namespace
}  // namespace crackle
