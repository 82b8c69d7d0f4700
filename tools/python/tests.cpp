// SPDX-License-Identifier: GPL-3.0-or-later
// Runs tests that write a results folder, as `crackle test` does.
// Tested by tests/tools/python/run_test.py.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

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

/// Returns a function that calls `call` with the state of the test. An exception raised by `call` interrupts the test.
std::function<AfterLook(VirtualTest&)> caller_of(const py::object& call, std::int64_t every, Interrupts& interrupts) {
    return [&call, every, &interrupts](VirtualTest& test) {
        const py::gil_scoped_acquire lock;
        const auto moment = std::make_shared<State>(test);
        try {
            call(moment);
            if (every == 0 && !moment->stop_asked() && platen_speed(test) == 0.0)
                throw InputError(
                    "platen speed: found 0, set by a callback at rows, expected another speed, because no further row "
                    "is reached while the platen is at rest; run the callback at a fixed interval of steps instead, "
                    "for example every = 1000");
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

/// Runs `work` with hooks. @return tuple of the results folder, whether the companion tests were interrupted, and
/// whether the test had been finished before
template <class Work>
py::tuple run(const py::object& report, const py::object& call, std::int64_t every, const Work& work) {
    if (every < 0) throw InputError(fmt::format("every: found {}, expected \"row\" or a number of steps >= 1", every));
    Interrupts interrupts;
    TestHooks hooks = reporting_hooks(report, interrupts);
    if (!call.is_none()) {
        hooks.look = caller_of(call, every, interrupts);
        hooks.look_every = every;
    }
    TestOutcome outcome;
    run_free(interrupts, [&] { outcome = work(hooks); });
    return py::make_tuple(outcome.folder.string(), outcome.unverified, outcome.was_finished);
}

}  // namespace

void bind_tests(py::module_& module) {
    py::class_<TestOptions>(module, "TestOptions")
        .def(py::init<>())
        .def_readwrite("folder", &TestOptions::folder)
        .def_readwrite("force", &TestOptions::force)
        .def_readwrite("verify", &TestOptions::verify)
        .def_readwrite("profile", &TestOptions::profile)
        .def_readwrite("threads", &TestOptions::threads)
        .def_readwrite("endless", &TestOptions::endless)
        .def_readwrite("command", &TestOptions::command);
    module.def(
        "run_test",
        [](ResolvedCase description, TestOptions options, bool allow_unstable, const py::object& report,
           const py::object& call, std::int64_t every) {
            if (allow_unstable) description.numerics.allow_unstable = true;
            if (options.verify && !call.is_none())
                throw InputError(
                    "crackle test: found verify with a callback, expected only one of them, since companion tests run "
                    "without callbacks");
            const std::int64_t threads = options.threads > 0 ? options.threads : description.numerics.threads;
            tools::limit_threads(options, threads);
            refuse_threads_after_fork(static_cast<int>(std::min<std::int64_t>(threads, options.most_threads)));
            return run(report, call, every,
                       [&](const TestHooks& hooks) { return run_test(description, options, hooks); });
        },
        py::arg("case"), py::arg("options"), py::arg("allow_unstable"), py::arg("report"), py::arg("call"),
        py::arg("every"));
    module.def(
        "resume_test",
        [](TestOptions options, const py::object& report, const py::object& call, std::int64_t every) {
            tools::limit_threads(options, tools::threads_to_resume(options));
            refuse_threads_after_fork(options.most_threads);
            return run(report, call, every, [&](const TestHooks& hooks) { return resume_test(options, hooks); });
        },
        py::arg("options"), py::arg("report"), py::arg("call"), py::arg("every"));
}

}  // namespace crackle::python
