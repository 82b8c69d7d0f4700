// SPDX-License-Identifier: GPL-3.0-or-later
// Failures of the engine as exceptions of Python, with the messages of the command line (crackle/_errors.py).
// Tested by tests/tools/python/case_test.py.
#include <fmt/format.h>

#include <exception>
#include <filesystem>

#include "mesher/mesher.hpp"
#include "solver/base/errors.hpp"
#include "specimens/making/hooks.hpp"
#include "tools/python/parts.hpp"

namespace crackle::python {
namespace {

namespace py = pybind11;

void raise(const char* kind, const std::string& text) {
    const py::object type = py::module_::import("crackle._errors").attr(kind);
    PyErr_SetString(type.ptr(), text.c_str());
}

void raise_unstable(const UnstableRun& error) {
    const py::object type = py::module_::import("crackle._errors").attr("UnstableRun");
    py::object raised = type(error.what());
    raised.attr("step") = error.step;
    raised.attr("body") = error.body;
    PyErr_SetObject(type.ptr(), raised.ptr());
}

}  // namespace

void bind_errors(py::module_& /*module*/) {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const OutputError& error) {
            raise("OutputError", error.what());
        } catch (const InputError& error) {
            raise("InputError", error.what());
        } catch (const MeshError& error) {
            raise("InputError", error.what());
        } catch (const UnstableRun& error) {
            raise_unstable(error);
        } catch (const TestInterrupted& error) {
            PyErr_SetString(PyExc_KeyboardInterrupt, error.what());
        } catch (const std::filesystem::filesystem_error& error) {
            raise("InputError",
                  fmt::format("{}: {}, expected a path that can be read and written; check its permissions",
                              error.path1().string(), error.code().message()));
        }
    });
}

}  // namespace crackle::python
