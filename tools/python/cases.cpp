// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a test case from a file, from TOML text, or from the tables of a dict as JSON.
// Tested by tests/tools/python/case_test.py.
#include <pybind11/stl.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "specimens/case/case_file.hpp"
#include "tools/python/parts.hpp"

namespace crackle::python {

namespace py = pybind11;

void bind_cases(py::module_& module) {
    py::class_<ResolvedCase>(module, "Case",
                             "One virtual test as described by a case, checked and with defaults filled in.")
        .def_readonly("title", &ResolvedCase::title, "Name of the test in the case.")
        .def_property_readonly(
            "kind", [](const ResolvedCase& test) { return name_of(test.loading.kind); },
            "Kind of test (loading.kind), for example \"tension\".")
        .def_property_readonly("stress_unit", &ResolvedCase::stress_unit, "\"Pa\" or \"N/m\".")
        .def(
            "resolved",
            [](const ResolvedCase& test) {
                std::ostringstream text;
                write_resolved_case(text, test, ".");
                return text.str();
            },
            "The case as TOML with every value stated, each with its unit and a description.")
        .def("__repr__", [](const ResolvedCase& test) { return "<crackle.Case '" + test.title + "'>"; });
    py::class_<JointCase>(module, "Joints", "The joints of a case.");
    module.def(
        "read_case_file", [](const std::string& path) { return read_case(std::filesystem::path(path)); },
        py::arg("path"));
    module.def(
        "read_case_text",
        [](const std::string& text, const std::string& name, bool json) {
            return read_case(CaseText{name, text, json});
        },
        py::arg("text"), py::arg("name"), py::arg("json"));
    module.def(
        "read_joints_file", [](const std::string& path) { return CaseFiles(std::filesystem::path(path)).joints(); },
        py::arg("path"), "The joints of a file, which need not be a complete case.");
    module.def(
        "read_joints_text",
        [](const std::string& text, const std::string& name, bool json) {
            return CaseFiles(CaseText{name, text, json}).joints();
        },
        py::arg("text"), py::arg("name"), py::arg("json"),
        "The joints of a TOML text, which need not be a complete case.");
    module.def(
        "joints_of_case", [](const ResolvedCase& test) { return joints_of(test); }, py::arg("case"));
    module.def(
        "files_of_joints",
        [](const std::string& path) {
            std::vector<std::string> all;
            for (const std::filesystem::path& file : CaseFiles(std::filesystem::path(path)).joints().files)
                all.push_back(file.string());
            return all;
        },
        py::arg("path"), "All files that are read for the joints of a file, including that file.");
    module.def("case_keys", [] {
        std::ostringstream text;
        describe_case_keys(text);
        return text.str();
    });
}

}  // namespace crackle::python
