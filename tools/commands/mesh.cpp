// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle mesh IN`: makes polygon particles from a packing of circles or a list of centres.

#include "mesher/mesher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/demseg/geometry.hpp"
#include "solver/files/file_kind.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "solver/files/text_lines.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/joints/joint_network.hpp"
#include "specimens/joints/mesh_traces.hpp"
#include "specimens/making/cell_bodies.hpp"
#include "specimens/making/cell_sizes.hpp"
#include "specimens/making/hooks.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/centre_list.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;

/// Joins the four numbers after --domain into one value, since a negative number would be parsed as an option.
Arguments join_domain(Arguments words) {
    const auto found = std::find(words.begin(), words.end(), "--domain");
    if (found == words.end()) return words;
    std::string joined = "--domain=";
    auto word = found + 1;
    for (int k = 0; k < 4 && word != words.end() && number_of(*word); ++k, ++word) joined += (k > 0 ? " " : "") + *word;
    *found = joined;
    words.erase(found + 1, word);
    return words;
}

Domain parse_domain(const std::string& text) {
    std::istringstream words(text);
    Domain domain;
    for (double* value : {&domain.x1, &domain.x2, &domain.y1, &domain.y2}) {
        std::string word;
        words >> word;
        const std::optional<double> number = number_of(word);
        if (!number || !std::isfinite(*number))
            throw InputError(fmt::format("--domain: found '{}', expected four numbers x1 x2 y1 y2 in m", text));
        *value = *number;
    }
    return domain;
}

/// Centres to be meshed, and a description of the origin of each.
struct Source {
    Scene scene;  ///< contains materials and domain of the result, but no bodies
    std::vector<CellCentre> centres;
    std::vector<int> materials;       ///< index of each centre's material
    std::vector<std::string> origin;  ///< origin of each centre, for messages
    std::optional<double> thick;      ///< m, gap between facing edges as given in the deck
};

Source centres_of_list(const std::string& name, const std::string& text, const po::variables_map& values,
                       Messages& messages) {
    const CentreList list = parse_centre_list(name, text);
    if (list.form != "x y")
        messages.notice(fmt::format("{}: read as a list of {}; polygons are made from x and y only", name, list.form));
    Source source;
    for (std::size_t k = 0; k < list.places.size(); ++k) {
        source.centres.push_back({list.places[k].x, list.places[k].y});
        source.origin.push_back(fmt::format("{}:{}", name, list.lines[k]));
    }
    Domain& domain = source.scene.domain;
    if (values.contains("domain") == values.contains("bounding-box")) {
        throw InputError(
            fmt::format("crackle mesh: found {} of --domain x1 x2 y1 y2 and --bounding-box, expected one of them for "
                        "the list of centres {}",
                        values.contains("domain") ? "both" : "neither", name));
    }
    if (values.contains("domain")) {
        domain = parse_domain(values["domain"].as<std::string>());
    } else {
        const auto by_x = [](CellCentre a, CellCentre b) { return a.x < b.x; };
        const auto by_y = [](CellCentre a, CellCentre b) { return a.y < b.y; };
        const auto [left, right] = std::minmax_element(source.centres.begin(), source.centres.end(), by_x);
        const auto [bottom, top] = std::minmax_element(source.centres.begin(), source.centres.end(), by_y);
        domain = {left->x, right->x, bottom->y, top->y};
    }
    Material material;
    material.density = values["density"].as<double>();
    material.normal_stiffness = values["normal-stiffness"].as<double>();
    material.shear_stiffness = values["shear-stiffness"].as<double>();
    material.friction_angle = values["friction-angle"].as<double>();
    source.scene.materials = {material};
    source.materials.assign(source.centres.size(), 0);
    return source;
}

Source centres_of_deck(const std::string& name, const std::string& text, const po::variables_map& values,
                       Messages& messages) {
    DeckReader reader(name, text);
    const Scene circles = read_deck_geometry(reader).scene;
    if (const auto ignored = reader.ignored_numbers()) messages.notice(*ignored);
    for (const char* option :
         {"domain", "bounding-box", "density", "normal-stiffness", "shear-stiffness", "friction-angle"}) {
        if (values.contains(option) && !values[option].defaulted()) {
            throw InputError(
                fmt::format("crackle mesh: --{}: found together with {}, a particle file that contains this value "
                            "itself; leave the option out, or give a list of centres with x y on each line",
                            option, name));
        }
    }
    Source source;
    for (const Body& body : circles.bodies) {
        if (body.circle_count != 1) {
            throw InputError(fmt::format("{}: found body {}, a {}, expected bodies that are single circles", name,
                                         body.id,
                                         body.circle_count > 1 ? "clump"
                                         : body.closed         ? "polygon"
                                                               : "chain of segments"));
        }
        const Vec2 centre = circles.circles[body.first_circle].centre;
        source.centres.push_back({centre.x, centre.y});
        source.materials.push_back(body.material);
        source.origin.push_back(fmt::format("circle {} of {}", body.id, name));
    }
    source.scene = circles;
    source.thick = circles.thick;
    source.scene.bodies.clear();
    source.scene.circles.clear();
    // The time step for the circles does not apply to polygons; 0 means that the time step is chosen from the stable
    // bound of the polygons.
    source.scene.time_step = 0.0;
    return source;
}

/// @param joints the joints whose traces are in the request; empty if it has no traces
Mesh mesh_source(const Source& source, const MeshRequest& request, const JointNetwork& joints) {
    const Domain& domain = source.scene.domain;
    try {
        return make_mesh(source.centres, {domain.x1, domain.x2, domain.y1, domain.y2}, request);
    } catch (const MeshError& error) {
        std::string named;
        for (const int centre : error.centres) {
            named += fmt::format("{}centre {} is {}", named.empty() ? " (" : ", ", centre,
                                 source.origin[static_cast<std::size_t>(centre)]);
        }
        throw InputError(error.what() + named + (named.empty() ? "" : ")") + traces_named(joints, error.traces));
    }
}

Scene scene_of(Source source, const Mesh& mesh, double thick) {
    Scene scene = std::move(source.scene);
    scene.thick = thick;
    add_cell_bodies(scene, mesh, source.materials);
    validate(scene);
    return scene;
}

bool is_first(const po::variables_map& values, const char* option, const char* first, const char* second) {
    const std::string word = values[option].as<std::string>();
    if (word != first && word != second)
        throw InputError(fmt::format("--{}: found {}, expected {} or {}", option, word, first, second));
    return word == first;
}

/// The kinds of mesh to make: both if none is given, as in volonoi.f.
std::vector<MeshKind> kinds_of(const po::variables_map& values) {
    if (!values.contains("kind")) return {MeshKind::delaunay, MeshKind::voronoi};
    return {mesh_kind(values)};
}

MeshRequest request_of(const po::variables_map& values, MeshKind kind, const Source& source) {
    MeshRequest request;
    request.kind = kind;
    request.boundary = is_first(values, "boundary", "domain", "centres") ? Boundary::domain : Boundary::centres;
    if (kind == MeshKind::voronoi && request.boundary == Boundary::centres) {
        if (values.contains("kind")) {
            throw InputError(
                "--boundary: found centres with --kind voronoi, expected domain, which Voronoi cells always fill");
        }
        request.boundary = Boundary::domain;
    }
    if (!values.contains("thick") && !source.thick) {
        throw InputError(
            "--thick: found nothing, expected the gap between facing edges in m, which a list of centres does not "
            "contain");
    }
    request.mesh_gap = values.contains("thick") ? values["thick"].as<double>() : *source.thick;
    if (values.contains("inset")) request.inset = values["inset"].as<double>();
    request.merge_destroyed = values.contains("merge");
    return request;
}

/// The case that defines the traces, given by the option --joints.
std::optional<JointCase> joints_case(const po::variables_map& values) {
    if (!values.contains("joints")) return std::nullopt;
    const fs::path file = values["joints"].as<std::string>();
    JointCase test = CaseFiles(file).joints();
    if (test.joints.empty())
        throw InputError(
            fmt::format("{}: found no [[joint_set]] and no [[trace]], expected at least one", file.string()));
    return test;
}

/// Paths of the output files, in the order of `kinds`.
std::vector<fs::path> output_paths(const po::variables_map& values, const std::vector<MeshKind>& kinds,
                                   const fs::path& input) {
    const fs::path asked = values.contains("output") ? values["output"].as<std::string>() : "";
    const bool folder = asked.empty() || fs::is_directory(asked);
    if (!folder && kinds.size() > 1) {
        throw InputError(
            fmt::format("--output: found {}, which is not a folder, expected a folder for in_gm_tri.dat and "
                        "in_gm_volo.dat; give --kind to write one file",
                        asked.string()));
    }
    std::vector<fs::path> inputs{input};
    if (const auto joints = joints_case(values))
        inputs.insert(inputs.end(), joints->files.begin(), joints->files.end());
    std::vector<fs::path> paths;
    for (const MeshKind kind : kinds) {
        const char* usual = kind == MeshKind::delaunay ? "in_gm_tri.dat" : "in_gm_volo.dat";
        paths.push_back(output_file(folder ? asked / usual : asked, values.contains("force"), inputs));
    }
    return paths;
}

/// A mesh, with its deck and its report lines.
struct Meshed {
    MeshKind kind = MeshKind::voronoi;
    fs::path output;
    MeshReport report;
    Domain domain;
    double gap = 0.0;
    std::string deck;                // text of the deck to write
    std::vector<std::string> lines;  // report lines about its joints
};

/// @param from source of the gap, in brackets; empty if the command line gave it
void print_report(const Meshed& made, const std::string& from) {
    const MeshReport& report = made.report;
    const Domain& domain = made.domain;
    print_text(
        fmt::format("centres          {} in x {:.6g} to {:.6g}, y {:.6g} to {:.6g}\n", report.centres, domain.x1,
                    domain.x2, domain.y1, domain.y2) +
        fmt::format("gap              {:.6g}{}\n", made.gap, from) +
        fmt::format("cells            {} ({})\n", report.cells, name_of(made.kind)) +
        fmt::format("segments         {}\n", report.segments) +
        fmt::format("shortest edge    {:.6g}\n", report.shortest_edge) +
        fmt::format("smallest angle   {:.4g} degrees\n", report.smallest_angle) +
        fmt::format("cells destroyed  {}{}\n", report.cells_destroyed, report.cells_destroyed > 0 ? " (merged)" : "") +
        fmt::format("area             {:.9g}, {:.9g} after the inset\n", report.area_before_inset,
                    report.area_after_inset) +
        fmt::format("written          {}\n", made.output.string()));
    for (const std::string& line : made.lines) print_text(line + '\n');
}

}  // namespace

MeshKind mesh_kind(const po::variables_map& values) {
    if (!values.contains("kind")) throw InputError("--kind: found nothing, expected delaunay or voronoi");
    return is_first(values, "kind", "delaunay", "voronoi") ? MeshKind::delaunay : MeshKind::voronoi;
}

Scene meshed_scene(const std::string& name, const std::string& text, const po::variables_map& values, MeshKind kind,
                   Messages& messages, MeshReport& report, std::vector<std::string>* of_joints,
                   const std::function<bool()>& interrupted) {
    refuse_foreign(name, text, "a particle file (in_gm.dat), or a list of centres x y");
    Source source = looks_like_centre_list(text) ? centres_of_list(name, text, values, messages)
                                                 : centres_of_deck(name, text, values, messages);
    MeshRequest request = request_of(values, kind, source);
    request.interrupted = interrupted;
    messages.detail(fmt::format("read {} centres from {}, {} bytes", source.centres.size(), name, text.size()));
    messages.progress().step(1.0, fmt::format("meshing {} centres", source.centres.size()));
    JointNetwork joints;
    if (const auto test = joints_case(values))
        joints = make_joints(test->joints, source.scene.domain, source.centres.size());
    request.traces = mesh_traces(joints);
    Mesh made;
    try {
        made = mesh_source(source, request, joints);
        if (of_joints != nullptr) {
            *of_joints = joints.notices;
            if (const std::string cleaning = cleaning_text(joints.cleaning); !cleaning.empty())
                of_joints->push_back(cleaning);
            if (!request.traces.empty()) {
                const auto more = jointed_mesh_text(made, source.centres, source.scene.domain, request);
                of_joints->insert(of_joints->end(), more.begin(), more.end());
            }
        }
    } catch (const MeshInterrupted&) {
        throw TestInterrupted();
    }
    if (const std::string small = small_cell_text(made); of_joints != nullptr && !small.empty())
        of_joints->push_back("notice: " + small);
    messages.detail(fmt::format("meshed {} cells of {} segments", made.report.cells, made.report.segments));
    report = made.report;
    return scene_of(std::move(source), made, request.mesh_gap);
}

CommandLine describe_mesh() {
    const Material usual{2500.0, 1.0e7, 2.5e6, 0.0, 0.0, {}, 27.0};
    const auto number = [] { return po::value<double>()->value_name("X"); };
    const auto word = [](const char* name) { return po::value<std::string>()->value_name(name); };
    po::options_description options, plain;
    options.add_options()("kind", word("KIND"),
                          "delaunay or voronoi (default: both, in two files, as DEMseg's volonoi.f does)")  //
        ("thick", number(), "gap between facing edges (default: the value of thick in in_gm.dat)")          //
        ("inset", number(), "depth by which edges move inwards, m (default: half the gap)")                 //
        ("boundary", word("WHICH")->default_value("domain"),
         "outer edge of the triangles. domain: flat faces for platens, made by projecting the outer centres; centres: "
         "the outermost centres, as volonoi.f made the 537 triangles from 304 circles in DEMseg's guide")      //
        ("merge", "merge cells that the inset destroys into their neighbours, instead of reporting an error")  //
        ("joints", word("FILE"),
         "file that defines joints, whose traces become edges of cells (see crackle joints)")  //
        ("output,o", word("FILE"),
         "file to write, or folder for the files (default: in_gm_tri.dat or in_gm_volo.dat)")  //
        ("force", "replace an existing output");
    plain.add_options()("domain", word("X1 X2 Y1 Y2"), "the domain, m")               //
        ("bounding-box", "use the bounding box of the centres as the domain")         //
        ("density", number()->default_value(usual.density), "kg/m2")                  //
        ("normal-stiffness", number()->default_value(usual.normal_stiffness), "N/m")  //
        ("shear-stiffness", number()->default_value(usual.shear_stiffness), "N/m")    //
        ("friction-angle", number()->default_value(usual.friction_angle), "degrees");
    return {
        .synopses = {"crackle mesh IN [--kind delaunay|voronoi] [--thick T] [OPTIONS]"},
        .description =
            "Makes polygons from the centres of the circles in IN. IN is an in_gm.dat, or a list of centres with one x "
            "y per line (or x y r of circles). Each polygon is inset along every edge, so that facing edges stand T "
            "apart, and T/2 from the domain's faces. Writes particle files of polygons (in_gm_tri.dat, "
            "in_gm_volo.dat). Lengths are in the units of IN.",
        .options = {{"options", options}, {"options for a list of centres", plain}},
        .operand = "IN",
        .choices = {{"kind", {"delaunay", "voronoi"}}, {"boundary", {"domain", "centres"}}},
        .verbose = "time taken by each stage in seconds, and numbers of centres, cells and segments",
        .examples = {{"crackle mesh in_gm.dat", "cells of both kinds, as volonoi.f makes them"},
                     {"crackle mesh in_gm.dat --kind voronoi --thick 1e-3", "the cells of a packing"},
                     {"crackle mesh in_gm.dat --kind delaunay --thick 1e-3 --boundary centres",
                      "triangles between the circles' centres only"},
                     {"crackle mesh in_gm.dat --kind delaunay --thick 1e-3 --joints specimens/jointed/two_sets.toml",
                      "triangles along joints"},
                     {"crackle mesh centres.txt --kind voronoi --thick 0 --domain 0 1 0 2",
                      "cells around your own centres, without gaps"}},
        .prepared = join_domain};
}

int mesh(const Invocation& given) {
    const po::variables_map& values = given.values;
    if (given.operands.empty()) {
        throw InputError(
            "crackle mesh: found no IN, expected an in_gm.dat or a list of centres (see crackle mesh --help)");
    }
    const std::string& name = given.operands.front();
    const std::vector<MeshKind> kinds = kinds_of(values);
    const std::vector<fs::path> outputs = output_paths(values, kinds, name);
    Messages& messages = given.messages;
    messages.progress().begin("reading " + name, 3.0, "");
    const std::string text = read_text(name);
    // All meshes are made before the first is written, so that an error in one of them leaves both files unchanged.
    std::vector<Meshed> made;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        Meshed& one = made.emplace_back();
        one.kind = kinds[k];
        one.output = outputs[k];
        const Scene scene = meshed_scene(name, text, values, one.kind, messages, one.report, &one.lines);
        one.domain = scene.domain;
        one.gap = scene.thick;
        std::ostringstream deck;
        write_geometry(deck, scene);
        one.deck = std::move(deck).str();
    }
    const std::string from = values.contains("thick") ? "" : fmt::format(" (thick of {})", name);
    for (const Meshed& one : made) {
        messages.progress().step(2.0, fmt::format("writing {} cells", one.report.cells));
        replace_file(one.output, one.deck);
        messages.make_room();
        messages.detail(fmt::format("wrote {} bytes", one.deck.size()));
        if (!messages.quiet()) print_report(one, from);
    }
    return exit_done;
}

}  // namespace crackle::tools
