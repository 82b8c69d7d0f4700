// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that bind the parts of the module `crackle._engine`, one source file each. The Python package crackle/ is
// built on this module.
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
