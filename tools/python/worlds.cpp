// SPDX-License-Identifier: GPL-3.0-or-later
// The Python class `World`: a test in memory that Python code advances step by step.
// Tested by tests/tools/python/world_test.py.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/change_law.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/time_step.hpp"
#include "specimens/loading/prepare.hpp"
#include "tools/python/particles.hpp"
#include "tools/python/parts.hpp"
#include "tools/python/reports.hpp"
#include "tools/python/state.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::python {
namespace {

using Shared = std::shared_ptr<OwnWorld>;

void use_threads(World& world, int threads) {
    const tools::ThreadRoom room = tools::room_for_threads(threads);
    refuse_threads_after_fork(room.threads);
    set_threads(world, room.threads);
}

Shared world_of_case(ResolvedCase description, int threads, const py::object& report) {
    if (threads > 0) description.numerics.threads = threads;
    Interrupts interrupts;
    const TestHooks hooks = reporting_hooks(report, interrupts);
    auto test = std::make_shared<VirtualTest>();
    const int asked = description.numerics.threads;
    refuse_threads_after_fork(asked);
    run_free(interrupts, [&] { *test = prepare_test(description, hooks); });
    use_threads(test->world, asked);
    return std::make_shared<OwnWorld>(std::move(test));
}

Shared world_of_particles(const Particles& particles, int threads, bool walls) {
    auto test = std::make_shared<VirtualTest>();
    Scene scene = particles.scene;
    if (!walls) scene.domain.wall_present = {false, false, false, false};
    scene.driven_contacts = DrivenContacts::all;  // all contacts, since the caller may request any force
    const py::gil_scoped_release free;
    test->world = build_world(std::move(scene));
    use_threads(test->world, threads);
    return std::make_shared<OwnWorld>(std::move(test));
}

std::int64_t add_bonds(State& state, const std::vector<std::pair<int, int>>& ids, double gap) {
    World& world = state.world();
    if (!(gap >= 0.0)) throw InputError(fmt::format("gap: found {}, expected a length >= 0 in m", gap));
    std::vector<BodyPair> pairs;
    for (const auto& [i, j] : ids) pairs.push_back({body_of_id(world, i), body_of_id(world, j)});
    state.settle();
    return bond_pairs(world, pairs, gap);
}

void set_property(State& state, const std::string& name, double value, std::pair<int, int> materials) {
    World& world = state.world();
    if (materials.first < 1 || materials.second < 1)
        throw InputError(fmt::format("{}: found materials {} and {}, expected numbers from 1", name, materials.first,
                                     materials.second));
    state.settle();
    change_law(world, static_cast<std::size_t>(materials.first - 1), static_cast<std::size_t>(materials.second - 1),
               name, value);
}

/// Converts a velocity, None (free), or ("force", value) to a control.
DofControl drive_of(const char* name, const py::object& asked) {
    if (asked.is_none()) return {};
    std::pair<std::string, double> given{"velocity", 0.0};
    try {
        if (py::isinstance<py::tuple>(asked) || py::isinstance<py::list>(asked))
            given = asked.cast<std::pair<std::string, double>>();
        else
            given.second = asked.cast<double>();
    } catch (const py::cast_error&) {
        given.first.clear();
    }
    const bool force = given.first == "force";
    if ((!force && given.first != "velocity") || !std::isfinite(given.second))
        throw InputError(fmt::format(
            "{}: found {:.60}, expected a velocity in m/s or rad/s, ('force', a number in N or N m), or None", name,
            std::string(py::repr(asked))));
    return {force ? Drive::force : Drive::velocity, given.second};
}

void drive(State& state, int id, const py::object& x, const py::object& y, const py::object& rotation) {
    World& world = state.world();
    const BodyIndex body = body_of_id(world, id);
    const DofControl dof[3] = {drive_of("x", x), drive_of("y", y), drive_of("rotation", rotation)};
    state.settle();
    set_control(world, body, dof, 0);
    velocities_changed(world);
}

}  // namespace

void bind_worlds(py::module_& module) {
    bind_state(module);
    py::class_<OwnWorld, State, Shared>(module, "World")
        .def(py::init(&world_of_case), py::arg("case"), py::arg("threads"), py::arg("report"))
        .def(py::init(&world_of_particles), py::arg("particles"), py::arg("threads"), py::arg("walls"))
        .def("__repr__",
             [](const OwnWorld& s) -> std::string {
                 if (s.is_stepped()) return "<crackle.World: another thread is stepping it>";
                 const World& world = s.world();
                 return fmt::format("<crackle.World: {} bodies, {} of {} bonds broken, {} steps>", world.bodies.size(),
                                    world.bonds.broken, world.bonds.initial, world.stepping.steps);
             })
        .def("step", &OwnWorld::step, py::arg("count") = 1,
             "Takes `count` steps. Other Python threads run meanwhile, and Ctrl-C interrupts the run between two "
             "steps. Raises UnstableRun if the energy grows without bound.")
        .def("add_bonds", &add_bonds, py::arg("pairs"), py::arg("gap") = 0.0,
             "Bonds unbonded contact points between pairs of ids if their overlap exceeds -gap (m), by the world's "
             "bond law. Returns the number of new bonds. A gap > 0 needs bond.law = \"coulomb\". The energy account "
             "starts again.")
        .def("set_property", &set_property, py::arg("name"), py::arg("value"),
             py::arg("materials") = std::pair<int, int>(1, 1),
             "Changes normal_stiffness, shear_stiffness (N/m; Pa with material.units = \"area\"), friction_angle, "
             "residual_friction_angle (degrees), tensile_strength or cohesion (N; Pa) of contacts between two "
             "materials, which are numbered from 1. The stable time step is computed again, and the energy account "
             "starts again.")
        .def("drive", &drive, py::arg("id"), py::arg("x") = py::none(), py::arg("y") = py::none(),
             py::arg("rotation") = py::none(),
             "Drives the body with this id from now on. x, y and rotation are each a velocity (m/s, rad/s), ('force', "
             "value) (N, N m), or None for free motion.")
        .def_property(
            "threads", [](const OwnWorld& s) { return s.world().workers.threads; },
            [](OwnWorld& s, int threads) { use_threads(s.world(), threads); },
            "Number of threads for further steps; results do not depend on it.");
}

}  // namespace crackle::python
