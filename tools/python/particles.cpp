// SPDX-License-Identifier: GPL-3.0-or-later
// Particles at rest, as created by `pack` and `mesh` or read from particle files.
// Tested by tests/tools/python/commands_test.py.
#include "tools/python/particles.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <filesystem>
#include <sstream>
#include <vector>

#include "mesher/mesher.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/demseg/geometry.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/making/make_specimen.hpp"
#include "specimens/packing/packing.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/python/arrays.hpp"
#include "tools/python/parts.hpp"
#include "tools/python/reports.hpp"
#include "tools/python/state.hpp"

namespace crackle::python {
namespace {

/// dtype with those members of Body that can be fields of a numpy array.
py::dtype body_dtype() {
    const Body body;
    DtypeParts parts(&body);
    parts("id", body.id);
    parts("material", body.material);
    parts("velocity", body.velocity);
    parts("spin", body.spin);
    parts("first_circle", body.first_circle);
    parts("circle_count", body.circle_count);
    parts("first_vertex", body.first_vertex);
    parts("vertex_count", body.vertex_count);
    parts("closed", body.closed);
    return parts.dtype(sizeof(Body));
}

py::dtype circle_dtype() {
    const CircleElement circle;
    DtypeParts parts(&circle);
    parts("centre", circle.centre);
    parts("radius", circle.radius);
    parts("angle", circle.angle);
    return parts.dtype(sizeof(CircleElement));
}

std::string text_of(Scene scene) {
    for (Material& material : scene.materials) material.damping_ratio.reset();  // not part of the file format
    std::ostringstream text;
    write_geometry(text, scene);
    return text.str();
}

void write(const Scene& scene, const std::string& path, bool force) {
    output_file(path, force);
    make_folder(folder_of(path));
    replace_file(path, text_of(scene));
}

std::shared_ptr<Particles> pack(const tools::Arguments& words, const py::object& report) {
    const tools::ParsedWords parsed = tools::parse_words("crackle pack", tools::describe_pack(), words);
    tools::Messages messages(tools::Loudness::quiet);
    const PackingRequest request = tools::packing_request(parsed.values, messages);
    Interrupts interrupts;
    const auto progress = [&](const PackingProgress& p) {
        if (!interrupts.heard() && !report.is_none())
            call_report(report, interrupts, "work",
                        fmt::format("{} (draw {}): unbalanced by {:.1e} of the mean contact force", p.stage, p.attempt,
                                    p.residual),
                        0.0);
        if (interrupts.heard()) throw TestInterrupted();
    };
    auto made = std::make_shared<Particles>();
    run_free(interrupts, [&] {
        Packing packing = make_packing(request, progress);
        made->scene = std::move(packing.scene);
        made->packing = packing.report;
    });
    return made;
}

std::shared_ptr<Particles> mesh(const std::string& name, const std::string& text, const tools::Arguments& words,
                                const py::object& report) {
    const tools::ParsedWords parsed = tools::parse_words("crackle mesh", tools::describe_mesh(), words);
    Interrupts interrupts;
    tools::Messages messages(reporting_listener(report, interrupts));
    auto made = std::make_shared<Particles>();
    MeshReport of_mesh;
    std::vector<std::string> of_joints;
    const MeshKind kind = tools::mesh_kind(parsed.values);
    run_free(interrupts, [&] {
        messages.progress().begin("reading " + name, 3.0, "");
        made->scene = tools::meshed_scene(name, text, parsed.values, kind, messages, of_mesh, &of_joints,
                                          [&] { return interrupts.heard(); });
    });
    made->mesh = of_mesh;
    made->notices = of_joints;
    return made;
}

/// The particles of a case, before they are bonded.
std::shared_ptr<Particles> specimen(ResolvedCase test, int threads, const py::object& report) {
    if (threads > 0) test.numerics.threads = threads;
    refuse_threads_after_fork(test.numerics.threads);
    Interrupts interrupts;
    const TestHooks hooks = reporting_hooks(report, interrupts);
    auto made = std::make_shared<Particles>();
    run_free(interrupts, [&] {
        Specimen unbonded = make_specimen(test, hooks);
        made->scene = std::move(unbonded.scene);
        made->notices = std::move(unbonded.notices);
    });
    return made;
}

py::dict facts(const Particles& particles) {
    py::dict all;
    if (const auto& p = particles.packing) {
        all["circles"] = p->circles;
        all["width"] = p->width;
        all["height"] = p->height;
        all["radius_min"] = p->radius_min;
        all["radius_max"] = p->radius_max;
        all["void_ratio"] = p->void_ratio;
        all["mean_overlap"] = p->mean_overlap;
        all["contacts"] = p->circle_contacts;
        all["coordination"] = p->coordination;
        all["coordination_of_carrying"] = p->coordination_of_carrying;
        all["floating"] = p->floating;
        all["stress_x"] = p->stress_x;
        all["stress_y"] = p->stress_y;
        all["anisotropy"] = p->anisotropy;
        all["residual"] = p->residual;
        all["radius_scale"] = p->radius_scale;
        all["notices"] = packing_notices(*p);
    }
    if (const auto& m = particles.mesh) {
        all["centres"] = m->centres;
        all["cells"] = m->cells;
        all["segments"] = m->segments;
        all["shortest_edge"] = m->shortest_edge;
        all["smallest_angle"] = m->smallest_angle;
        all["cells_destroyed"] = m->cells_destroyed;
        all["area_before_inset"] = m->area_before_inset;
        all["area_after_inset"] = m->area_after_inset;
        all["notices"] = particles.notices;
    } else if (!particles.notices.empty()) {
        all["notices"] = particles.notices;
    }
    return all;
}

}  // namespace

void bind_particles(py::module_& module) {
    using Shared = std::shared_ptr<Particles>;
    py::class_<Particles, Shared>(module, "Particles",
                                  "Circles or polygons at rest: a packing, a mesh, or the contents of a particle file.")
        .def_property_readonly(
            "bodies",
            [](const Shared& p) {
                return view_of(body_dtype(), p->scene.bodies.size(), sizeof(Body), p->scene.bodies.data(), keep(p));
            },
            "Array view of shape (bodies,) with the fields id, material (index), velocity (x, y in m/s), spin (rad/s), "
            "first_circle and circle_count into `circles`, first_vertex and vertex_count into `vertices`, closed.")
        .def_property_readonly(
            "circles",
            [](const Shared& p) {
                return view_of(circle_dtype(), p->scene.circles.size(), sizeof(CircleElement), p->scene.circles.data(),
                               keep(p));
            },
            "Array view of shape (circles,) with the fields centre (x, y in m), radius (m) and angle (rad).")
        .def_property_readonly(
            "vertices", [](const Shared& p) { return view_of(p->scene.vertices, p); },
            "Array view of shape (vertices,) with x and y in m: the corners of all polygons and chains.")
        .def_property_readonly(
            "domain",
            [](const Particles& p) {
                const Domain& d = p.scene.domain;
                return py::make_tuple(d.x1, d.x2, d.y1, d.y2);
            },
            "x1, x2, y1, y2 in m.")
        .def_property_readonly("facts", &facts,
                               "Report of `crackle pack` or `crackle mesh`; empty for a file that was read.")
        .def(
            "text", [](const Particles& p) { return text_of(p.scene); },
            "The text of a particle file with these particles.")
        .def(
            "write", [](const Particles& p, const std::string& path, bool force) { write(p.scene, path, force); },
            py::arg("path"), py::arg("force") = false,
            "Writes the particle file (in_gm.dat). Raises InputError if it exists, unless force is true.")
        .def("__len__", [](const Particles& p) { return p.scene.bodies.size(); })
        .def("__repr__", [](const Particles& p) {
            return fmt::format("<crackle.Particles: {} bodies, {} circles, {} corners>", p.scene.bodies.size(),
                               p.scene.circles.size(), p.scene.vertices.size());
        });
    module.def("pack", &pack, py::arg("words"), py::arg("report"));
    module.def("specimen", &specimen, py::arg("case"), py::arg("threads"), py::arg("report"));
    module.def("mesh", &mesh, py::arg("name"), py::arg("text"), py::arg("words"), py::arg("report"));
    module.def(
        "read_particles",
        [](const std::string& path) {
            auto made = std::make_shared<Particles>();
            DeckReader reader = DeckReader::open(path);
            made->scene = read_deck_geometry(reader).scene;
            const auto ignored = reader.ignored_numbers();
            if (ignored && PyErr_WarnEx(PyExc_UserWarning, ignored->c_str(), 1) != 0) throw py::error_already_set();
            return made;
        },
        py::arg("path"));
    module.def(
        "refuse_replacing",
        [](const std::string& output, bool force, const std::vector<std::string>& inputs) {
            output_file(output, force, std::vector<std::filesystem::path>(inputs.begin(), inputs.end()));
        },
        py::arg("output"), py::arg("force"), py::arg("inputs"));
    module.def(
        "read_text", [](const std::string& path) { return py::bytes(read_text(path)); }, py::arg("path"));
}

}  // namespace crackle::python
