// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/throughput/feature_costs.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/contact/pass.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/stepping/sweep.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/making/lattices.hpp"
#include "specimens/results/files.hpp"
#include "tests/bench/throughput/least_step.hpp"
#include "tests/bench/throughput/timed_test.hpp"
#include "tests/bench/throughput/walls.hpp"

namespace crackle::throughput {
namespace {

namespace fs = std::filesystem;

constexpr double apothem = 0.02, gap = 1e-3, overlap = 8e-5;  // m; apothem and gap of hexagons, overlap of discs
// At this speed, a body moves by about a hundredth of an overlap during one period of a disc on its springs.
constexpr double stir_speed = 1e-3;  // m/s
constexpr int steps_before_start = 20;
// Number of steps between two calls of the hooks in the loading loop.
constexpr std::int64_t steps_between_looks = 64;

/// Processor time of this thread, s. Other work on the machine affects it less than wall-clock time.
double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// ---- scenes

Scene packed_hexagons(std::int64_t count) {
    const int columns = std::max(3, static_cast<int>(std::lround(std::sqrt(static_cast<double>(count) / 2.0))));
    const int rows = std::max(3, static_cast<int>(count / columns));
    Scene scene = honeycomb(columns, rows, apothem, gap, timed_rock());
    scene.thick = gap + overlap;
    wall_in(scene, 0.5 * scene.thick - overlap);  // corners overlap the walls as much as their neighbours
    return scene;
}

/// The scene at rest in equilibrium, with a time step that is stable with every feature.
Scene settled(Scene scene) {
    constexpr int most_steps = 6000;
    constexpr double rest = 0.1 * stir_speed;
    scene.materials[0].friction_angle = 0.0;
    World world = build_world(scene);
    for (int k = 0; k < most_steps && (k < 100 || world.list.fastest > rest); ++k) step(world);
    for (Body& body : scene.bodies) {
        const std::vector<Vec2> places = element_positions(world, body_of_id(world, body.id));
        for (std::uint32_t k = 0; k < body.circle_count; ++k) scene.circles[body.first_circle + k].centre = places[k];
        for (std::uint32_t k = 0; k < body.vertex_count; ++k) scene.vertices[body.first_vertex + k] = places[k];
    }
    scene.time_step = world.stepping.time_step;
    scene.skin = world.list.skin;
    return scene;
}

struct Features {
    bool dashpots = false, friction = false, bonds = false, consistent = false;
    bool platens = false, two_materials = false, clumps = false;
    bool area = false, coulomb = false, random_strengths = false;
};

/// Adds a block below and a block above the specimen, each as wide as it, held and driven like the platens of a test.
void put_between_platens(Scene& scene) {
    const Domain& domain = scene.domain;
    const double depth = 0.05 * (domain.y2 - domain.y1), outwards = scene.circles.empty() ? 0.5 * scene.thick : 0.0;
    const double low = domain.y1 - outwards, high = domain.y2 + outwards;
    const int last = static_cast<int>(scene.bodies.size());
    const auto drive = [&](const std::vector<Vec2>& corners, int id, double velocity) {
        Control control;
        control.body = static_cast<int>(scene.add_chain_body(id, 0, corners, true));
        control.x = control.rotation = {Drive::velocity, 0.0};
        control.y = {Drive::velocity, velocity};
        scene.controls.push_back(control);
    };
    drive({{domain.x2, low}, {domain.x1, low}, {domain.x1, low - depth}, {domain.x2, low - depth}}, last + 1, 0.0);
    drive({{domain.x1, high}, {domain.x2, high}, {domain.x2, high + depth}, {domain.x1, high + depth}}, last + 2,
          -0.01 * stir_speed);
    scene.domain.wall_present = {false, false, false, false};
}

/// Joins each disc with the next one to a clump of two, if they are side by side.
void join_to_clumps(Scene& scene) {
    std::vector<Body> joined;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        Body body = scene.bodies[b];
        if (b + 1 < scene.bodies.size()) {
            const CircleElement &a = scene.circles[body.first_circle], &next = scene.circles[body.first_circle + 1];
            if (norm(next.centre - a.centre) < 1.05 * (a.radius + next.radius)) {
                body.circle_count = 2;
                ++b;
            }
        }
        joined.push_back(body);
    }
    scene.bodies = joined;
}

void stir(Scene& scene) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const auto k = static_cast<double>(b);
        scene.bodies[b].velocity = {stir_speed * std::sin(1.7 * k), stir_speed * std::cos(2.3 * k)};
    }
}

World world_with(Scene scene, const Features& features) {
    Material& rock = scene.materials[0];
    rock.friction_angle = features.friction ? timed_rock().friction_angle : 0.0;
    if (!features.dashpots) rock.damping_ratio.reset();
    if (features.consistent) scene.integrator = Integrator::consistent;
    stir(scene);
    if (features.two_materials) {
        scene.materials.push_back(scene.materials[0]);
        scene.materials[1].friction_angle += 3.0;
        scene.materials[1].normal_stiffness *= 1.01;
        for (std::size_t b = 0; b < scene.bodies.size(); b += 2) scene.bodies[b].material = 1;
    }
    if (features.area) scene.units = StiffnessUnits::area;
    if (features.coulomb) {
        scene.bond_law = BondLaw::coulomb;
        for (Material& material : scene.materials) {
            material.tensile_strength = 1e3 * material.normal_stiffness * overlap;  // strong enough that nothing breaks
            material.cohesion = 2.0 * material.tensile_strength;
            material.residual_friction_angle = material.friction_angle;
        }
    }
    if (features.clumps) join_to_clumps(scene);
    if (features.platens) {
        put_between_platens(scene);
    } else if (features.bonds) {
        scene.domain.x1 -= overlap, scene.domain.y1 -= overlap;
        scene.domain.x2 += overlap, scene.domain.y2 += overlap;
    }
    World world = build_world(scene);
    Bonding bonding;
    bonding.thick = scene.thick;
    if (features.random_strengths) bonding.factors = StrengthFactors(StrengthDistribution::weibull, 0.3, 1);
    if (features.bonds) bond_all(world, bonding);
    for (int k = 0; k < steps_before_start; ++k) step(world);
    return world;
}

std::int64_t loaded_points(const World& world) {
    std::int64_t count = 0;
    for (PointIndex k = 0; k < world.points.size(); ++k) count += view_point(world, k).touching ? 1 : 0;
    return count;
}

// ---- timing

/// Work that consists of steps and can be repeated from the same initial state.
struct Trial {
    std::int64_t particles, contacts;
    std::function<void()> reset;
    std::function<double(std::int64_t)> run;  ///< runs this number of steps; returns the time, s
    std::int64_t together = 1;                ///< the number of steps must be a multiple of this
};

/// @param step function that runs one step of a world
template <class Step>
Trial trial_of(const World& start, World& work, Step step) {
    return {static_cast<std::int64_t>(start.bodies.size()), loaded_points(start), [&start, &work] { work = start; },
            [&work, step](std::int64_t steps) {
                const double begun = processor_seconds();
                for (std::int64_t k = 0; k < steps; ++k) step(work);
                return processor_seconds() - begun;
            }};
}

double run_of(const Trial& trial, std::int64_t steps) {
    trial.reset();
    trial.run(trial.together * std::max<std::int64_t>(1, steps / 16 / trial.together));  // loads the caches
    return trial.run(steps);
}

/// Number of steps that take about `seconds`.
std::int64_t steps_to_fill(const Trial& trial, double seconds) {
    std::int64_t rounds = 1;  // each of trial.together steps
    while (true) {
        const double took = run_of(trial, rounds * trial.together);
        if (took >= 0.2 * seconds)
            return trial.together *
                   std::max<std::int64_t>(1, std::llround(seconds / took * static_cast<double>(rounds)));
        rounds *= 2;
    }
}

/// Measures `trial` and `other` in pairs; the order alternates.
FeatureRow compare(const FeatureStudy& study, FeatureRow row, const Trial& other, const Trial& trial) {
    const std::int64_t steps = steps_to_fill(trial.together > 1 ? trial : other, study.seconds);
    const auto contact_seconds = [steps](const Trial& of, double seconds) {
        return seconds / static_cast<double>(steps * of.contacts);
    };
    std::vector<double> times, ratios, differences;
    for (int k = 0; k < study.pairs; ++k) {
        double before = 0.0, after = 0.0;
        if (k % 2 == 0) before = run_of(other, steps);
        after = run_of(trial, steps);
        if (k % 2 != 0) before = run_of(other, steps);
        before = contact_seconds(other, before);
        after = contact_seconds(trial, after);
        times.push_back(after);
        ratios.push_back(after / before);
        differences.push_back(after - before);
    }
    row.particles = trial.particles;
    row.contacts = trial.contacts;
    row.contact_seconds = median_interval(times).median;
    row.particle_seconds =
        row.contact_seconds * static_cast<double>(trial.contacts) / static_cast<double>(trial.particles);
    row.ratio = median_interval(ratios);
    row.difference = median_interval(differences);
    return row;
}

// ---- rows

struct Rung {
    const char *feature, *beside;
    Features features;
};

const std::vector<Rung>& rungs() {
    static const std::vector<Rung> all{
        {"normal springs", "", {}},
        {"dashpots", "normal springs", {.dashpots = true}},
        {"friction", "dashpots", {.dashpots = true, .friction = true}},
        {"consistent integrator", "friction", {.dashpots = true, .friction = true, .consistent = true}},
        {"bonds", "friction", {.dashpots = true, .friction = true, .bonds = true}},
        {"driven platens", "bonds", {.dashpots = true, .friction = true, .bonds = true, .platens = true}},
        {"two materials", "bonds", {.dashpots = true, .friction = true, .bonds = true, .two_materials = true}},
        {"area units", "bonds", {.dashpots = true, .friction = true, .bonds = true, .area = true}},
        {"coulomb bonds", "bonds", {.dashpots = true, .friction = true, .bonds = true, .coulomb = true}},
        {"random strengths",
         "coulomb bonds",
         {.dashpots = true, .friction = true, .bonds = true, .coulomb = true, .random_strengths = true}},
        {"clumps of two", "bonds", {.dashpots = true, .friction = true, .bonds = true, .clumps = true}},
    };
    return all;
}

using Add = std::function<void(const FeatureRow&)>;

FeatureRow row_of(FeatureRowKind kind, const std::string& bodies, const std::string& feature,
                  const std::string& beside) {
    return {kind, bodies, feature, beside, 0, 0, 0.0, 0.0, {}, {}};
}

void add_rungs(const FeatureStudy& study, const std::string& bodies, const Scene& scene, const Add& add) {
    const auto start_of = [&](const std::string& feature) {
        for (const Rung& rung : rungs())
            if (rung.feature == feature) return world_with(scene, rung.features);
        throw InputError("feature costs: found no row " + feature);
    };
    for (const Rung& rung : rungs()) {
        if (rung.features.clumps && scene.circles.empty()) continue;
        const bool first = *rung.beside == '\0';
        const World start = world_with(scene, rung.features),
                    start_beside = start_of(first ? rung.feature : rung.beside);
        World work = start, work_beside = start_beside;
        const Trial trial = trial_of(start, work, [](World& world) { step(world); });
        const Trial beside = trial_of(start_beside, work_beside, [](World& world) { step(world); });
        FeatureRow row =
            compare(study, row_of(FeatureRowKind::added, bodies, rung.feature, first ? "the same again" : rung.beside),
                    beside, trial);
        add(row);
    }
}

/// Compares a virtual test with all its observers and files to the steps of its world alone.
void add_observers(const FeatureStudy& study, const std::string& kind, const Add& add) {
    const TimedSpecimen specimen{kind, study.count, 1, 4.0 * study.seconds};
    VirtualTest test = bond_timed_test(specimen, study.scratch / kind);
    std::filesystem::remove_all(study.scratch / kind / "out");  // results of an earlier study
    OutputFolder output = OutputFolder::create(study.scratch / kind / "out", Earlier::refused, {});
    TestFiles files(output, "", test.state, {});
    const auto load = [&](std::int64_t steps) {
        const std::int64_t end = test.world.stepping.steps + steps;
        const double begun = processor_seconds();
        double took = 0.0;  // time at the last hook; excludes the frame at the peak, which a test draws only once
        TestHooks hooks;
        hooks.interrupted = [&] {
            took = processor_seconds() - begun;
            return test.world.stepping.steps >= end;
        };
        load_specimen(test, hooks, &files);
        return took;
    };
    load(steps_between_looks);  // the first checkpoint has now been written
    const VirtualTest start = test;
    const auto reset = [&] { test = start; };
    const std::int64_t contacts = loaded_points(start.world);
    const Trial steps_alone{test.setup.specimen.particles, contacts, reset,
                            [&](std::int64_t steps) {
                                const double begun = processor_seconds();
                                for (std::int64_t k = 0; k < steps; ++k) step(test.world);
                                return processor_seconds() - begun;
                            },
                            steps_between_looks};
    const Trial observed{test.setup.specimen.particles, contacts, reset, load, steps_between_looks};
    add(compare(study,
                row_of(FeatureRowKind::added, kind == "circles" ? "discs" : kind, "curve, events, frames of a test",
                       "its steps alone"),
                steps_alone, observed));
}

/// Hexagons at rest that are bonded by faces, with or without pressures of the cells; faces carry all loads.
World world_of_faces(const Scene& hexagons, bool pressure) {
    Scene scene = hexagons;
    scene.bond_law = BondLaw::face;
    scene.units = StiffnessUnits::area;
    stir(scene);
    World world = build_world(scene);
    constexpr double youngs_modulus = 1e7, poissons_ratio = 0.25;  // Pa; about as stiff as contact points
    FaceMaterial rock;
    rock.moduli = pressure ? face_moduli(youngs_modulus, poissons_ratio, 1.0 / 1.6, 0.0)
                           : face_moduli_without_pressure(youngs_modulus, poissons_ratio, 0.0);
    rock.law.tensile_strength = youngs_modulus;  // so strong that nothing breaks
    rock.law.cohesion = 2.0 * youngs_modulus;
    rock.law.moment_share = 0.6;
    rock.law.damping_ratio = timed_rock().damping_ratio.value_or(0.0);
    FaceBonding bonding;
    bonding.materials = {rock};
    bonding.gap = gap;
    bond_by_faces(world, bonding);
    for (int k = 0; k < steps_before_start; ++k) step(world);
    return world;
}

/// Compares cells bonded by faces with the same cells bonded by points, and cells with pressures to cells without.
void add_faces(const FeatureStudy& study, const Add& add) {
    const Scene hexagons = packed_hexagons(study.count);
    const World points = world_with(hexagons, {.dashpots = true, .friction = true, .bonds = true, .coulomb = true}),
                faces = world_of_faces(hexagons, false), pressed = world_of_faces(hexagons, true);
    World work_points = points, work_faces = faces, work_pressed = pressed;
    const auto trial = [&](const World& start, World& work) {
        Trial one = trial_of(start, work, [](World& world) { step(world); });
        one.contacts = static_cast<std::int64_t>(faces.faces.size());
        return one;
    };
    add(compare(study, row_of(FeatureRowKind::added, "hexagons", "faces", "coulomb bonds"), trial(points, work_points),
                trial(faces, work_faces)));
    add(compare(study, row_of(FeatureRowKind::added, "hexagons", "pressures of cells", "faces"),
                trial(faces, work_faces), trial(pressed, work_pressed)));
}

struct Absence {
    const char* feature;
    Features scene;
    ContactFeatures without;
    bool ContactFeatures::*absent;
};

const std::vector<Absence>& absences() {
    static const std::vector<Absence> all{
        {"dashpots", {.friction = true}, {true, false, false, false}, &ContactFeatures::damping},
        {"friction", {.dashpots = true}, {false, true, false, false}, &ContactFeatures::friction},
        {"consistent integrator",
         {.dashpots = true, .friction = true},
         {true, true, false, false},
         &ContactFeatures::consistent},
        {"bonds", {.dashpots = true, .friction = true}, {true, true, false, false}, &ContactFeatures::bonds},
    };
    return all;
}

/// Brings the world to rest, so that repeated force passes change nothing.
void hold_still(World& world) {
    for (BodyState& body : world.bodies.state) body.vx = body.vy = body.omega = 0.0;
}

void force_pass(World& world, const ContactFeatures& features) {
    clear_forces(world);
    chosen_sweep()(world, {world, features}, nullptr, 0.0);
}

/// Compares force passes alone, in which an overhead is most visible.
void add_absent_kernels(const FeatureStudy& study, const std::string& bodies, const Scene& scene, const Add& add) {
    for (const Absence& absence : absences()) {
        World start = world_with(scene, absence.scene);
        hold_still(start);
        World work = start;
        const ContactFeatures without = absence.without;
        {
            const Trial direct = trial_of(start, work, [without](World& world) { force_pass(world, without); });
            const Trial picked = trial_of(start, work, [](World& world) { force_pass(world, features_of(world)); });
            add(compare(study,
                        row_of(FeatureRowKind::dispatched, bodies, absence.feature, "kernel compiled without it"),
                        direct, picked));
        }
        ContactFeatures with = without;
        with.*absence.absent = true;
        make_room_for(start, with);
        work = start;
        const Trial direct = trial_of(start, work, [without](World& world) { force_pass(world, without); });
        const Trial forced = trial_of(start, work, [with](World& world) { force_pass(world, with); });
        add(compare(study, row_of(FeatureRowKind::forced, bodies, absence.feature, "kernel compiled without it"),
                    direct, forced));
    }
}

/// Compares whole steps of discs without most features to the least step for these discs.
void add_absent_parts(const FeatureStudy& study, const Scene& scene, const Add& add) {
    struct Part {
        const char *absent, *beside;
        std::function<void(World&)> other, step;
    };
    const auto add_parts = [&](const Features& present, const std::vector<Part>& parts) {
        const World start = world_with(scene, present);
        World work = start;
        for (const Part& part : parts)
            add(compare(study, row_of(FeatureRowKind::dispatched, "discs", part.absent, part.beside),
                        trial_of(start, work, part.other), trial_of(start, work, part.step)));
    };
    const auto least = [](const ContactFeatures& features) {
        return [features](World& world) { least_step(world, features); };
    };
    const auto whole = [](World& world) { step(world); };
    constexpr ContactFeatures springs{false, false, false, false}, bonded{true, true, true, false};
    const char* const all_else = "gravity, turning, controls, profile, threads, losses, breaks, list";
    add_parts({}, {{all_else, "least step of springs", least(springs), whole}});
    add_parts({.dashpots = true, .friction = true, .bonds = true},
              {{all_else, "least step of bonded discs", least(bonded), whole}});
    const World start = world_with(scene, {.dashpots = true, .friction = true, .bonds = true});
    World work = start;
    Profile profile;
    const Trial plain = trial_of(start, work, [](World& world) { step(world); });
    Trial profiled = plain;
    profiled.reset = [&] {
        work = start;
        work.workers.profile = &profile;
    };
    add(compare(study, row_of(FeatureRowKind::forced, "discs", "profile", "step without it"), plain, profiled));
}

}  // namespace

void measure_feature_costs(const FeatureStudy& study, const std::function<void(const FeatureRow&)>& add) {
    const Scene discs = settled(timed_discs(study.count)), hexagons = settled(packed_hexagons(study.count));
    add_rungs(study, "discs", discs, add);
    add_observers(study, "circles", add);
    add_rungs(study, "hexagons", hexagons, add);
    add_observers(study, "voronoi", add);
    add_faces(study, add);
    add_absent_kernels(study, "discs", discs, add);
    add_absent_parts(study, discs, add);
    add_absent_kernels(study, "hexagons", hexagons, add);
}

}  // namespace crackle::throughput
