// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/python/reports.hpp"

#include <limits>

#include "tools/commands/commands.hpp"

namespace crackle::python {
namespace {

namespace py = pybind11;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t widest_text = 200;  // columns; whoever shows it cuts it

}  // namespace

bool call_report(const py::object& report, Interrupts& interrupts, const char* kind, const std::string& text,
                 double share) {
    const py::gil_scoped_acquire lock;
    try {
        report(kind, text, share);
    } catch (const py::error_already_set& error) {
        interrupts.raised(error);
        return false;
    }
    return true;
}

TestHooks reporting_hooks(const py::object& report, Interrupts& interrupts) {
    TestHooks hooks;
    hooks.interrupted = [&interrupts] { return interrupts.heard(); };
    if (report.is_none()) return hooks;
    const auto teller = [&report, &interrupts](const char* kind) {
        return [&report, &interrupts, kind](const std::string& text) {
            call_report(report, interrupts, kind, text, unknown);
        };
    };
    hooks.stage = teller("stage");
    hooks.detail = teller("detail");
    hooks.working = teller("work");
    hooks.progress = [&report, &interrupts](const TestProgress& test) {
        const tools::Progress shown = tools::shown_progress(test);
        call_report(report, interrupts, "progress", tools::progress_text(shown, widest_text), shown.share);
    };
    return hooks;
}

}  // namespace crackle::python
