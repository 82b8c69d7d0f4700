// SPDX-License-Identifier: GPL-3.0-or-later
// Passes the engine's reports to a Python callable report(kind, text, share). `kind` is "stage", "detail", "work" or
// "progress"; `share` is the completed fraction, 0 to 1, or NaN. If the callable is None, nothing is reported.
// Tested by tests/tools/python/run_test.py.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "specimens/making/hooks.hpp"
#include "tools/python/interrupts.hpp"
#include "tools/terminal/messages.hpp"

namespace crackle::python {

/// Hooks that pass the reports of a test to `report` and poll for interrupts. An exception raised by `report` ends the
/// work like an interrupt. Both arguments must outlive the hooks.
TestHooks reporting_hooks(const pybind11::object& report, Interrupts& interrupts);

/// Listener that passes the messages of a crackle command to `report`; notices have the kind "stage". After an
/// interrupt, the next progress message throws TestInterrupted.
tools::Listener reporting_listener(const pybind11::object& report, Interrupts& interrupts);

/// Calls report() with the interpreter lock held. @return false if it raised an exception
bool call_report(const pybind11::object& report, Interrupts& interrupts, const char* kind, const std::string& text,
                 double share);

}  // namespace crackle::python
