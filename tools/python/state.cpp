// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/python/state.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <unistd.h>

#include <stdexcept>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/base/fields.hpp"
#include "solver/faces/face_pass.hpp"
#include "solver/geometry/face_motion.hpp"
#include "solver/measure/health.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/state_hash.hpp"
#include "specimens/loading/own_loading.hpp"
#include "tools/python/interrupts.hpp"

namespace crackle::python {
namespace {

const pid_t loaded_in = ::getpid();

constexpr std::int64_t steps_between_health_checks = 100;
constexpr std::int64_t steps_between_questions = 64;

/// A contact point with its values at the current positions.
struct Contact {
    std::int32_t id_i, id_j;  ///< ids of the bodies; -1, -2, -3, -4 for the left, right, bottom, top wall
    BodyIndex body_i, body_j;
    Vec2 position, normal;
    double overlap, normal_force, shear_force, bond_overlap;
    bool bonded, touching, sliding, slid;

    CRACKLE_FIELDS(id_i, id_j, body_i, body_j, position, normal, overlap, normal_force, shear_force, bond_overlap,
                   bonded, touching, sliding, slid);
};

py::array contacts(State& state) {
    const World& world = state.world_with_forces();
    auto found = std::make_shared<std::vector<Contact>>();
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const PointView p = view_point(world, k);
        if (!p.touching && !p.bonded) continue;
        const bool wall = p.kind == PointKind::element_wall;
        found->push_back({world.bodies.names[p.body_i].id,
                          wall ? -1 - static_cast<std::int32_t>(p.body_j) : world.bodies.names[p.body_j].id, p.body_i,
                          p.body_j, p.position, p.normal, p.overlap, p.normal_force, p.shear_force, p.bond_overlap,
                          p.bonded, p.touching, p.sliding, p.slid});
    }
    return view_of(*found, found);
}

/// A face with its motion and forces at the current positions.
struct Face {
    std::int32_t id_i, id_j;
    BodyIndex body_i, body_j;
    Vec2 position, normal;
    double length, opening, sliding, turn;
    double normal_force, shear_force, moment;
    bool bonded, broken_in_shear;

    CRACKLE_FIELDS(id_i, id_j, body_i, body_j, position, normal, length, opening, sliding, turn, normal_force,
                   shear_force, moment, bonded, broken_in_shear);
};

py::array faces(State& state) {
    const World& world = state.world_with_forces();
    auto found = std::make_shared<std::vector<Face>>();
    for (FaceIndex k = 0; k < world.faces.size(); ++k) {
        const auto [i, j] = world.faces.bodies[k];
        const BodyState& body = world.bodies.state[i];
        const FaceForces forces = forces_of_face(world.faces, k);
        const BondFaceMotion motion = world.faces.motion[k];
        const FaceIndex broken = world.faces.broken_at[k];
        const Vec2 position = Vec2{body.x, body.y} + turned_by(body, world.faces.place[k].arm_i) +
                              (0.5 * motion.opening) * motion.normal +
                              (0.5 * motion.sliding) * perpendicular(motion.normal);
        found->push_back({world.bodies.names[i].id, world.bodies.names[j].id, i, j, position, motion.normal,
                          world.faces.springs[k].length, motion.opening, motion.sliding, motion.turn, -forces.normal,
                          forces.shear, forces.moment, broken == no_face,
                          broken != no_face && world.faces.broken[broken].in_shear});
    }
    return view_of(*found, found);
}

/// The current values of the test's curve columns, as one record of an array of length 1.
py::object measured_row(State& state) {
    state.driven();
    const World& world = state.world_with_forces();
    auto row = std::make_shared<std::vector<CurveRow>>(1, observe_row(world, state.test().setup));
    return view_of(*row, row)[py::int_(0)];
}

}  // namespace

void refuse_threads_after_fork(int threads) {
    if (threads <= 1 || ::getpid() == loaded_in) return;
    throw InputError(
        fmt::format("threads: found {} in a process that was forked after crackle was imported, expected 1; use one "
                    "thread per process, or start processes with multiprocessing's method \"spawn\"",
                    threads));
}

VirtualTest& State::test() const {
    if (test_ == nullptr)
        throw std::runtime_error(
            "found a State used after its callback, expected its use only inside the callback; keep arrays or numbers "
            "from it instead");
    if (stepping_)
        throw std::runtime_error(
            "found a World that another thread is stepping, expected one that is not in use; wait until that thread's "
            "step() has returned");
    return *test_;
}

World& State::world_with_forces() {
    World& found = world();
    if (!found.stepping.forces_current) {
        refuse_threads_after_fork(found.workers.threads);
        settle();
        compute_forces(found);
    }
    return found;
}

VirtualTest& State::driven() const {
    VirtualTest& found = test();
    if (found.setup.apparatus.parts.empty())
        throw InputError("world: found particles without platens, expected a world made from a case");
    return found;
}

void State::stop() {
    static_cast<void>(test());
    if (own_)
        throw InputError(
            "stop: found a World, expected the State of a test in its callback; to end a World, take no more steps");
    stop_asked_ = true;
}

void State::over() {
    settle();
    test_ = nullptr;
}

void OwnWorld::step(std::int64_t count) {
    if (count < 0) throw InputError(fmt::format("step: found {}, expected a number of steps >= 0", count));
    World& stepped = world();
    refuse_threads_after_fork(stepped.workers.threads);
    settle();
    Interrupts interrupts;
    const Stepping stepping(*this);
    run_free(interrupts, [&] {
        for (std::int64_t k = 0; k < count; ++k) {
            if (k % steps_between_questions == 0 && interrupts.heard()) break;
            if (stepped.stepping.steps % steps_between_health_checks == 0) {
                compute_forces(stepped);
                check_health(stepped);
            }
            crackle::step(stepped);
        }
    });
}

void bind_state(py::module_& module) {
    py::class_<State, std::shared_ptr<State>>(
        module, "State",
        "A test in memory. Arrays are read-only views of the engine's own memory, which show the state at the time "
        "they were taken; a view kept while the engine continues does not change. Bodies are in the engine's order; "
        "`names` has their ids.")
        .def_property_readonly(
            "steps", [](const State& s) { return s.world().stepping.steps; }, "Steps done.")
        .def_property_readonly(
            "time", [](const State& s) { return s.world().stepping.time; }, "s")
        .def_property_readonly(
            "time_step", [](const State& s) { return s.world().stepping.time_step; }, "Duration of the next step, s.")
        .def_property_readonly(
            "axial_strain", [](const State& s) { return s.driven().setup.apparatus.axial_strain(s.world()); },
            "Axial strain from the motion of the driving part, positive in the test's loading direction.")
        .def_property(
            "platen_speed", [](const State& s) { return platen_speed(s.driven()); },
            [](State& s, double speed) {
                s.driven();
                s.settle();
                set_platen_speed(s.test(), speed);
            },
            "Speed of the driving part in the test's loading direction, m/s; negative while it moves back. Once it is "
            "set, rate_tolerance no longer controls the loading rate; a notice in the summary states the strain at "
            "which it was set.")
        .def_property_readonly(
            "length", [](const State& s) { return s.driven().setup.apparatus.length; },
            "Length to which strains refer, m; platen_speed divided by this length is the strain rate.")
        .def_property_readonly(
            "section", [](const State& s) { return s.driven().setup.apparatus.section; },
            "Width to which stresses refer, m.")
        .def("row", &measured_row,
             "One row of the curve, measured now: axial_strain, axial_stress (N/m, or Pa), stress_top, stress_bottom, "
             "lateral_strain, bonds_broken, energies in J, ... as crackle test --files lists them.")
        .def_property_readonly(
            "bodies", [](State& s) { return s.lend(s.world().bodies.state); },
            "Array view with one record per body: x, y (m), vx, vy (m/s, half a step before x, y), omega (rad/s), "
            "shape (radius and 0 for a circle; otherwise cosine and sine of the body's rotation), angle (rad).")
        .def_property_readonly(
            "names", [](State& s) { return s.lend(s.world().bodies.names); },
            "Array view with one record per body: id, material (index), closed, and shape (index of the body's outline "
            "in the engine; 2**32 - 1 for a single circle).")
        .def_property_readonly(
            "masses", [](State& s) { return s.lend(s.world().bodies.inertia); },
            "Array view with one record per body: mass (kg), and the inverse mass and inverse moment of inertia used "
            "in a time step; these are 0 for driven motions.")
        .def_property_readonly(
            "forces", [](State& s) { return s.lend(s.world_with_forces().bodies.force); },
            "Array view with one record per body: fx, fy (N) and torque (N m), the resultants of the body's contact "
            "forces.")
        .def_property_readonly(
            "bonds", [](State& s) { return s.lend(s.world().points.state); },
            "Array view with one record per contact point: law (index into `laws`), flags (bits 1: touching, 2: "
            "bonded, 4: sliding; further bits are internal).")
        .def_property_readonly(
            "pairs", [](State& s) { return s.lend(s.world().points.contact.pairs); },
            "Array view with one record per contact point: body_i and body_j, indices into `bodies`.")
        .def_property_readonly(
            "shear_forces", [](State& s) { return s.lend(s.world().points.shear_force); },
            "Array view with one value per contact point: elastic shear force, N.")
        .def_property_readonly(
            "bond_overlaps", [](State& s) { return s.lend(s.world().points.bond_overlap); },
            "Array view with one value per contact point: overlap at bonding, m.")
        .def(
            "contacts", &contacts,
            "A copy of the contact points that touch or are bonded. Fields: id_i, id_j (-1 to -4 for a wall), body_i, "
            "body_j, "
            "position (m), normal (from i to j), overlap (m), normal_force (N, compression positive), shear_force (N), "
            "bond_overlap (m), bonded, touching, sliding, slid.")
        .def("faces", &faces,
             "A copy of the faces of a specimen bonded by faces; otherwise empty. Fields: id_i, id_j, body_i, body_j, "
             "position (m, of the midpoint), normal (from i to j), length (m). Motion of j relative to i since "
             "bonding: opening (m, along the normal), sliding (m, along the normal turned by +90 degrees), turn "
             "(rad). Forces on i: normal_force (N, compression positive), shear_force (N), moment (N m). State: "
             "bonded, broken_in_shear.")
        .def_property_readonly(
            "rows", [](State& s) { return s.lend(s.test().state.rows); },
            "Array view with one record per row: the curve so far, including all rows by which peak and failure are "
            "judged; empty for a World. A record keeps the whole view alive: to keep a single row use row(), or a "
            "record's copy().")
        .def_property_readonly(
            "events", [](State& s) { return s.lend(s.world().bonds.events); },
            "Array view with one record per event: bond breaks since the last call of the callback; for a World, all "
            "bond breaks so far.")
        .def_property_readonly(
            "bonds_broken", [](const State& s) { return s.world().bonds.broken; },
            "Number of bonds that have broken so far.")
        .def_property_readonly(
            "bonds_initial", [](const State& s) { return s.world().bonds.initial; },
            "Number of bonds that have been made.")
        .def_property_readonly(
            "laws", [](State& s) { return s.lend(s.world().settings.laws); },
            "Array view of the contact laws: for the material pairs (1,1), (1,2), (2,2), (1,3)..., then for these "
            "pairs with unbreakable bonds, then for materials against walls.")
        .def_property_readonly(
            "notices", [](const State& s) { return s.test().setup.origin.notices; },
            "Notices on the specimen and its loading: a list of texts, as in a summary.")
        .def_property_readonly(
            "platens",
            [](const State& s) {
                py::list ids;
                for (const SetupPart& part : s.driven().setup.apparatus.parts)
                    ids.append(s.world().bodies.names[part.body].id);
                return ids;
            },
            "Ids of the bodies that hold and drive the specimen; the driving body is last.")
        .def(
            "index", [](const State& s, int id) { return body_of_id(s.world(), id); }, py::arg("id"),
            "Index into `bodies` of the body with this id. Raises InputError if no body has it.")
        .def(
            "state_hash", [](const State& s) { return fmt::format("{:016x}", hash_state(s.world())); },
            "Hash of the complete state; equal states have equal hashes.")
        .def("stop", &State::stop,
             "Ends the test after this callback; the test is complete, and its last row is the current state. Raises "
             "InputError for a World, RuntimeError after the callback.");
}

}  // namespace crackle::python
