// SPDX-License-Identifier: GPL-3.0-or-later
// Converts errors of the engine to Python exceptions, with the messages of the command line (crackle/_errors.py).
// Tested by tests/tools/python/case_test.py.
#include <fmt/format.h>

#include <exception>
#include <filesystem>

#include "mesher/mesher.hpp"
#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "specimens/making/hooks.hpp"
#include "tools/python/parts.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::python {
namespace {

namespace py = pybind11;

/// Raises a Python exception. @param text message, which may contain names and contents of files; bytes that are not
/// valid UTF-8 are escaped, since Python accepts only UTF-8
void raise(const char* kind, const std::string& text) {
    const py::object type = py::module_::import("crackle._errors").attr(kind);
    PyErr_SetString(type.ptr(), tools::printable(text).c_str());
}

void raise_unstable(const UnstableRun& error) {
    const py::object type = py::module_::import("crackle._errors").attr("UnstableRun");
    py::object raised = type(tools::printable(error.what()));
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
        } catch (const SystemFailure& error) {
            raise("SystemFailure", error.what());
        } catch (const UnstableRun& error) {
            raise_unstable(error);
        } catch (const TestInterrupted& error) {
            PyErr_SetString(PyExc_KeyboardInterrupt, error.what());
        } catch (const std::filesystem::filesystem_error& error) {
            raise(is_about_the_path(error.code().value()) ? "InputError" : "SystemFailure",
                  fmt::format("{}: {}, expected a path that can be read and written; check its permissions",
                              error.path1().string(), error.code().message()));
        }
    });
}

}  // namespace crackle::python
