// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/python/reports.hpp"

#include <functional>
#include <limits>

#include "tools/commands/commands.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::python {
namespace {

namespace py = pybind11;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t widest_text = 200;  // columns; the receiver shortens the text further if necessary

std::function<void(const std::string&)> teller(const py::object& report, Interrupts& interrupts, const char* kind) {
    return
        [&report, &interrupts, kind](const std::string& text) { call_report(report, interrupts, kind, text, unknown); };
}

}  // namespace

bool call_report(const py::object& report, Interrupts& interrupts, const char* kind, const std::string& text,
                 double share) {
    const py::gil_scoped_acquire lock;
    try {
        report(kind, tools::printable(text), share);
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
    hooks.stage = teller(report, interrupts, "stage");
    hooks.detail = teller(report, interrupts, "detail");
    hooks.working = teller(report, interrupts, "work");
    hooks.progress = [&report, &interrupts](const TestProgress& test) {
        const tools::Progress shown = tools::shown_progress(test);
        call_report(report, interrupts, "progress", tools::progress_text(shown, widest_text), shown.share);
    };
    return hooks;
}

tools::Listener reporting_listener(const py::object& report, Interrupts& interrupts) {
    tools::Listener listener;
    listener.progress = [&report, &interrupts](const tools::Progress& shown) {
        if (!report.is_none() && !interrupts.pending())
            call_report(report, interrupts, "progress", tools::progress_text(shown, widest_text), shown.share);
        if (interrupts.heard()) throw TestInterrupted();
    };
    if (report.is_none()) return listener;
    listener.stage = teller(report, interrupts, "stage");
    listener.detail = teller(report, interrupts, "detail");
    listener.notice = [&report, &interrupts](const std::string& text) {
        call_report(report, interrupts, "stage", "notice: " + text, unknown);
    };
    return listener;
}

}  // namespace crackle::python
