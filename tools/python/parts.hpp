// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the module `crackle._engine`, one source each; the package crackle/ in Python is made of them.
// Tested by tests/tools/python/case_test.py.
#pragma once

#include <pybind11/pybind11.h>

namespace crackle::python {

void bind_errors(pybind11::module_& module);
void bind_cases(pybind11::module_& module);
void bind_particles(pybind11::module_& module);
void bind_commands(pybind11::module_& module);
void bind_tests(pybind11::module_& module);
void bind_worlds(pybind11::module_& module);
void bind_results(pybind11::module_& module);

}  // namespace crackle::python
