// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/python/case_test.py.
#include "tools/python/parts.hpp"

PYBIND11_MODULE(_engine, module) {
    using namespace crackle::python;
    module.doc() = "The engine of crackle; the package `crackle` is its interface.";
    bind_errors(module);
    bind_cases(module);
    bind_particles(module);
    bind_commands(module);
    bind_tests(module);
    bind_worlds(module);
    bind_results(module);
}
