// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that are run with their folder, as `crackle test` does.
// Tested by tests/tools/python/run_test.py.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <string>

#include "solver/base/errors.hpp"
#include "specimens/loading/own_loading.hpp"
#include "specimens/loading/run.hpp"
#include "tools/commands/commands.hpp"
#include "tools/python/parts.hpp"
#include "tools/python/reports.hpp"
#include "tools/python/state.hpp"

namespace crackle::python {
namespace {

struct Asked {
    std::string folder;
    bool force = false, verify = false, profile = false, endless = false, allow_unstable = false;
    int threads = 0;
    std::string command;
};

/// Calls `call` with the moment. What it raises interrupts the test.
std::function<AfterLook(VirtualTest&)> caller_of(const py::object& call, std::int64_t every, Interrupts& interrupts) {
    return [&call, every, &interrupts](VirtualTest& test) {
        const py::gil_scoped_acquire lock;
        const auto moment = std::make_shared<State>(test);
        try {
            call(moment);
            if (every == 0 && !moment->stop_asked() && platen_speed(test) == 0.0)
                throw InputError(
                    "platen speed: found 0 set by a callback at rows, expected another: no row comes while the platen "
                    "stands; call at steps (every = 1000, say)");
        } catch (const py::error_already_set& error) {
            interrupts.raised(error);
        } catch (const InputError& error) {
            const py::object type = py::module_::import("crackle._errors").attr("InputError");
            PyErr_SetString(type.ptr(), error.what());
            interrupts.raised(py::error_already_set());
        }
        moment->over();
        if (interrupts.pending()) return AfterLook::interrupt;
        return moment->stop_asked() ? AfterLook::end : AfterLook::go_on;
    };
}

TestOptions options_of(const Asked& asked) {
    TestOptions options;
    options.folder = asked.folder;
    options.force = asked.force;
    options.verify = asked.verify;
    options.profile = asked.profile;
    options.endless = asked.endless;
    options.command = asked.command;
    if (asked.threads < 0)
        throw InputError(fmt::format("crackle test: threads: found {}, expected a whole number >= 1", asked.threads));
    options.threads = asked.threads;
    return options;
}

/// Runs `work` with hooks. @return folder, whether the companions were interrupted, whether nothing was left to do
template <class Work>
py::tuple run(const py::object& report, const py::object& call, std::int64_t every, const Work& work) {
    if (every < 0) throw InputError(fmt::format("every: found {}, expected a number of steps >= 1, or rows", every));
    Interrupts interrupts;
    TestHooks hooks = reporting_hooks(report, interrupts);
    if (!call.is_none()) {
        hooks.look = caller_of(call, every, interrupts);
        hooks.look_every = every;
    }
    TestOutcome outcome;
    try {
        const py::gil_scoped_release free;
        outcome = work(hooks);
    } catch (const TestInterrupted&) {
        interrupts.rethrow();
        throw;
    }
    interrupts.rethrow();
    return py::make_tuple(outcome.folder.string(), outcome.unverified, outcome.was_finished);
}

}  // namespace

void bind_tests(py::module_& module) {
    py::class_<Asked>(module, "TestOptions")
        .def(py::init<>())
        .def_readwrite("folder", &Asked::folder)
        .def_readwrite("force", &Asked::force)
        .def_readwrite("verify", &Asked::verify)
        .def_readwrite("profile", &Asked::profile)
        .def_readwrite("endless", &Asked::endless)
        .def_readwrite("allow_unstable", &Asked::allow_unstable)
        .def_readwrite("threads", &Asked::threads)
        .def_readwrite("command", &Asked::command);
    module.def(
        "run_test",
        [](TestCase description, const Asked& asked, const py::object& report, const py::object& call,
           std::int64_t every) {
            TestOptions options = options_of(asked);
            if (asked.allow_unstable) description.numerics.allow_unstable = true;
            if (asked.verify && !call.is_none())
                throw InputError(
                    "crackle test: found verify with a callback, expected one of them: companions run "
                    "without it");
            const std::int64_t threads = asked.threads > 0 ? asked.threads : description.numerics.threads;
            tools::limit_threads(options, threads);
            refuse_threads_after_fork(static_cast<int>(std::min<std::int64_t>(threads, options.most_threads)));
            return run(report, call, every,
                       [&](const TestHooks& hooks) { return run_test(description, options, hooks); });
        },
        py::arg("case"), py::arg("options"), py::arg("report"), py::arg("call"), py::arg("every"));
    module.def(
        "resume_test",
        [](const Asked& asked, const py::object& report, const py::object& call, std::int64_t every) {
            TestOptions options = options_of(asked);
            tools::limit_threads(options, asked.threads > 0 ? asked.threads : options.most_threads);
            refuse_threads_after_fork(options.most_threads);
            return run(report, call, every, [&](const TestHooks& hooks) { return resume_test(options, hooks); });
        },
        py::arg("options"), py::arg("report"), py::arg("call"), py::arg("every"));
}

}  // namespace crackle::python
