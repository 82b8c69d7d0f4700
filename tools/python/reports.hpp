// SPDX-License-Identifier: GPL-3.0-or-later
// What the engine says while it works, for a callable of Python: report(kind, text, share), kind one of "stage",
// "detail", "work" and "progress", share done from 0 to 1 or not a number. None hears nothing.
// Tested by tests/tools/python/run_test.py.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "specimens/making/hooks.hpp"
#include "tools/python/interrupts.hpp"
#include "tools/terminal/messages.hpp"

namespace crackle::python {

/// Hooks that report and hear interrupts; what `report` raises ends the work as an interrupt does. All three are kept
/// by reference.
TestHooks reporting_hooks(const pybind11::object& report, Interrupts& interrupts);

/// The same of what a command of the program prints beside its results; its notices are stages. Drawing its progress
/// throws TestInterrupted where an interrupt was heard.
tools::Listener reporting_listener(const pybind11::object& report, Interrupts& interrupts);

/// Calls report() with the lock taken. @return whether it went without an exception
bool call_report(const pybind11::object& report, Interrupts& interrupts, const char* kind, const std::string& text,
                 double share);

}  // namespace crackle::python
