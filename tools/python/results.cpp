// SPDX-License-Identifier: GPL-3.0-or-later
// Results read back from their folder.
// Tested by tests/tools/python/results_test.py.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <limits>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/campaign/campaign.hpp"
#include "specimens/recordings/recording.hpp"
#include "specimens/summary/summary_file.hpp"
#include "tools/python/arrays.hpp"
#include "tools/python/parts.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::python {
namespace {

py::dict columns(const NumberTable& table, const std::shared_ptr<void>& owner) {
    py::dict all;
    for (std::size_t k = 0; k < table.names.size(); ++k)
        all[py::str(tools::printable(table.names[k]))] = view_of(table.columns[k], owner);
    return all;
}

/// Cells of a recording. Their data are copied, since the records have outlines of varying length.
py::dict cells(const Recording& recording) {
    const auto count = recording.cells.size();
    auto ids = std::make_shared<std::vector<std::int32_t>>(), materials = std::make_shared<std::vector<std::int32_t>>();
    auto x = std::make_shared<std::vector<double>>(), y = std::make_shared<std::vector<double>>();
    auto radius = std::make_shared<std::vector<double>>();
    auto platen = std::make_shared<std::vector<std::uint8_t>>();
    py::list outlines;
    for (std::size_t k = 0; k < count; ++k) {
        const RecordedCell& cell = recording.cells[k];
        ids->push_back(cell.id);
        materials->push_back(cell.material);
        x->push_back(cell.centre.x);
        y->push_back(cell.centre.y);
        radius->push_back(cell.radius);
        platen->push_back(cell.platen ? 1 : 0);
        const auto corners = std::make_shared<std::vector<Vec2>>(cell.outline);
        outlines.append(view_of(*corners, corners));
    }
    py::dict all;
    all["id"] = view_of(*ids, ids);
    all["material"] = view_of(*materials, materials);
    all["x"] = view_of(*x, x);
    all["y"] = view_of(*y, y);
    all["radius"] = view_of(*radius, radius);
    all["platen"] = view_of(*platen, platen).attr("astype")("bool");
    all["outline"] = outlines;
    return all;
}

py::list heads(const Recording& recording) {
    py::list all;
    for (const FrameHead& head : recording.frames) {
        py::dict one;
        one["time"] = head.time;
        one["axial_strain"] = head.axial_strain;
        one["axial_stress"] = head.axial_stress;
        one["step"] = head.step;
        one["roles"] = head.roles;
        one["file"] = tools::printable(head.file);
        all.append(one);
    }
    return all;
}

py::dict frame(const Recording& recording, std::int64_t number) {
    const auto count = static_cast<std::int64_t>(recording.frames.size());
    if (number < -count || number >= count) throw py::index_error(fmt::format("frame {} of {}", number, count));
    const auto found = std::make_shared<RecordedFrame>(
        recording.frame(static_cast<std::size_t>(number < 0 ? number + count : number)));
    py::dict all;
    const auto put = [&](const char* name, const auto& values) { all[name] = view_of(values, found); };
    put("ux", found->ux);
    put("uy", found->uy);
    put("angle", found->angle);
    put("vx", found->vx);
    put("vy", found->vy);
    put("rotation_rate", found->rotation_rate);
    put("stress_xx", found->stress_xx);
    put("stress_yy", found->stress_yy);
    put("stress_xy", found->stress_xy);
    put("fragment", found->fragment);
    put("bond_normal_force", found->normal_force);
    put("bond_shear_force", found->shear_force);
    put("bond_state", found->state);
    put("contact_i", found->contacts.i);
    put("contact_j", found->contacts.j);
    put("contact_x", found->contacts.x);
    put("contact_y", found->contacts.y);
    put("contact_normal_force", found->contacts.normal_force);
    put("contact_shear_force", found->contacts.shear_force);
    return all;
}

py::dict bonds(const Recording& recording) {
    auto i = std::make_shared<std::vector<std::int32_t>>(), j = std::make_shared<std::vector<std::int32_t>>();
    auto x = std::make_shared<std::vector<double>>(), y = std::make_shared<std::vector<double>>();
    for (const RecordedBond& bond : recording.bonds) {
        i->push_back(bond.i);
        j->push_back(bond.j);
        x->push_back(bond.place.x);
        y->push_back(bond.place.y);
    }
    py::dict all;
    all["i"] = view_of(*i, i);
    all["j"] = view_of(*j, j);
    all["x"] = view_of(*x, x);
    all["y"] = view_of(*y, y);
    return all;
}

}  // namespace

void bind_results(py::module_& module) {
    using Shared = std::shared_ptr<Recording>;
    py::class_<Recording, Shared>(module, "Recording")
        .def_property_readonly("kind",
                               [](const Recording& r) {
                                   return r.kind == Recording::Kind::test   ? "test"
                                          : r.kind == Recording::Kind::deck ? "deck"
                                                                            : "particles";
                               })
        .def_property_readonly("frames", &heads)
        .def("frame", &frame, py::arg("number"))
        .def_property_readonly("cells", &cells)
        .def_property_readonly("bonds", &bonds);
    module.def(
        "read_recording",
        [](const std::string& path) {
            const py::gil_scoped_release free;
            return std::make_shared<Recording>(read_recording(path, std::numeric_limits<std::size_t>::max(), 1));
        },
        py::arg("path"));
    using Results = std::shared_ptr<TestResults>;
    py::class_<TestResults, Results>(module, "TestResults")
        .def_property_readonly("summary", [](const TestResults& r) { return text_of(r.summary); })
        .def_property_readonly("curve", [](const Results& r) { return columns(r->curve, r); })
        .def_property_readonly("events", [](const Results& r) { return columns(r->events, r); })
        .def_property_readonly("slips",
                               [](const Results& r) -> py::object {
                                   if (!r->slips) return py::none();
                                   return columns(*r->slips, r);
                               })
        .def_property_readonly("emission", [](const Results& r) -> py::object {
            if (!r->emission) return py::none();
            return columns(*r->emission, r);
        });
    module.def(
        "check_campaign",
        [](const std::string& folder) {
            const py::gil_scoped_release free;
            CampaignLedger::read(ledger_file(folder)).require_whole();
        },
        py::arg("folder"));
    module.def(
        "read_results",
        [](const std::string& folder) {
            const py::gil_scoped_release free;
            return std::make_shared<TestResults>(read_results(folder));
        },
        py::arg("folder"));
}

}  // namespace crackle::python
