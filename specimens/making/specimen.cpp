// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mesher/mesher.hpp"
#include "solver/base/errors.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/demseg/geometry.hpp"
#include "specimens/joints/joint_faces.hpp"
#include "specimens/joints/joint_network.hpp"
#include "specimens/joints/mesh_traces.hpp"
#include "specimens/making/cell_bodies.hpp"
#include "specimens/making/cell_sizes.hpp"
#include "specimens/making/cut_shape.hpp"
#include "specimens/making/misplaced_bodies.hpp"
#include "specimens/making/side_bodies.hpp"
#include "specimens/packing/packing.hpp"

namespace crackle {
namespace {

void scale_damping(Material& material, double by) {
    if (material.damping_ratio) *material.damping_ratio *= by;
    material.normal_damping *= by;
    material.shear_damping *= by;
}

/// Adds file and line to an error of a packing.
InputError located(const ResolvedCase& test, const PackingError& error) {
    using enum CaseKey;
    constexpr std::array keys{packing_width,        packing_count,         packing_radius_min,
                              packing_radius_max,   packing_radius_median, packing_radius_log_deviation,
                              packing_mean_overlap, packing_void_ratio};
    const auto input = static_cast<std::size_t>(error.input);
    if (input < keys.size() && test.places.gives(keys[input])) return InputError(test.at(keys[input]) + error.text);
    return InputError(fmt::format("{}: {}", test.at(CaseKey::packing), error.what()));
}

Rectangle rectangle(const Domain& domain) { return {domain.x1, domain.x2, domain.y1, domain.y2}; }

std::vector<CellCentre> centres_of(const Scene& circles) {
    std::vector<CellCentre> centres;
    for (const Body& body : circles.bodies) {
        const Vec2 centre = mass_properties(circles, body).centroid;
        centres.push_back({centre.x, centre.y});
    }
    return centres;
}

std::vector<Point> outline_of(const Shape& shape) {
    std::vector<Point> outline;
    outline.reserve(shape.outline.size());
    for (const Vec2 corner : shape.outline) outline.push_back({corner.x, corner.y});
    return outline;
}

/// Cells meshed from circles, without gaps between the cells.
Mesh bare_cells(const ResolvedCase& test, const Scene& circles, const Shape& shape = {}, const TestHooks& hooks = {}) {
    MeshRequest request;
    request.interrupted = hooks.interrupted;
    request.outline = outline_of(shape);
    request.kind = test.mesh->kind;
    request.boundary = test.mesh->boundary;
    try {
        return make_mesh(centres_of(circles), rectangle(circles.domain), request);
    } catch (const MeshInterrupted&) {
        throw TestInterrupted();
    } catch (const MeshError& error) {
        throw InputError(fmt::format("{}: {}", test.at(CaseKey::mesh_kind), error.what()));
    }
}

// Number of packings tried for cells of a given size, and accepted errors. In a box of a few hundred circles, one
// circle more or less changes the mean size by about the accepted error. Another arrangement changes the spread by half
// of its accepted error.
constexpr int cell_packings = 4;
constexpr double met_diameter_share = 0.002, met_spread = 0.02;

Packing packed(const ResolvedCase& test, const PackingRequest& request, const PackingCallback& progress) {
    try {
        return make_packing(request, progress);
    } catch (const PackingError& error) {
        throw located(test, error);
    }
}

/// Packs circles whose cells have the requested diameters, or come as close as possible.
Packing pack_for_cells(const ResolvedCase& test, const parts::CellDiameters& cells, PackingRequest request,
                       const PackingCallback& progress) {
    const CellSizes asked{cells.mean, cells.spread};
    std::optional<Packing> best;
    double best_miss = 0.0, scale = 1.0, correction = 0.0;
    for (int k = 0; k < cell_packings && !(best && best_miss <= 1.0); ++k) {
        try {
            request.sizes = scaled(radii_for_cells(test.mesh->kind, cells.radii, asked, correction), scale);
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", test.at(CaseKey::packing_cell_spread), error.what()));
        }
        Packing packing = packed(test, request, progress);
        const CellSizes reached = measure_cells(bare_cells(test, packing.scene));
        const double miss = std::max(std::abs(reached.mean / asked.mean - 1.0) / met_diameter_share,
                                     std::abs(reached.spread - asked.spread) / met_spread);
        if (!best || miss < best_miss) {
            best = std::move(packing);
            best_miss = miss;
        }
        scale *= asked.mean / reached.mean;
        // The spread is corrected only once: the remaining error is random, and each change of the spread also changes
        // the mean.
        if (k == 0 && std::abs(reached.spread - asked.spread) > met_spread) correction = asked.spread - reached.spread;
    }
    return std::move(*best);
}

Packing pack(const ResolvedCase& test, PackingRequest request, const PackingCallback& progress) {
    const auto& sizes = test.packing()->sizes;
    if (const auto* cells = std::get_if<parts::CellDiameters>(&sizes))
        return pack_for_cells(test, *cells, std::move(request), progress);
    if (const auto* radii = std::get_if<UniformRadii>(&sizes)) request.sizes = *radii;
    if (const auto* radii = std::get_if<LognormalRadii>(&sizes)) request.sizes = *radii;
    if (const auto* file = std::get_if<parts::SieveFile>(&sizes)) request.sizes = read_sieve_curve(file->path);
    return packed(test, request, progress);
}

}  // namespace

Packing packing_of(const ResolvedCase& test, const TestHooks& hooks) {
    const parts::Packing& asked = *test.packing();
    PackingRequest request;
    if (const auto* box = std::get_if<parts::Box>(&asked.box)) {
        request.width = box->width;
        request.height = box->height;
    } else {
        request.count = std::get<parts::CircleCount>(asked.box).count;
        request.height_to_width = std::get<parts::CircleCount>(asked.box).height_to_width;
    }
    if (const auto* target = std::get_if<parts::MeanOverlap>(&asked.target))
        request.mean_overlap = target->value;
    else
        request.void_ratio = std::get<parts::VoidRatio>(asked.target).value;
    request.seed = static_cast<std::uint64_t>(asked.seed);
    request.threads = test.numerics.threads;
    test.material.apply_to(request.material);
    request.material.tensile_strength = request.material.cohesion = 0.0;  // nothing is bonded yet
    const auto make = [&] {
        return pack(test, request, [&](const PackingProgress& p) {
            hooks.report_work(fmt::format("{} (draw {}): unbalanced by {:.1e} of the mean contact force", p.stage,
                                          p.attempt, p.residual));
        });
    };
    return hooks.keep_packing ? hooks.keep_packing(test, request, make) : make();
}

namespace {

Scene packed_scene(const ResolvedCase& test, const TestHooks& hooks, Specimen& specimen) {
    Packing packing = packing_of(test, hooks);
    const PackingReport& report = packing.report;
    specimen.notices = packing_notices(report);
    specimen.packing = {{"void_ratio", report.void_ratio},
                        {"mean_overlap", report.mean_overlap},
                        {"coordination", report.coordination},
                        {"coordination_of_carrying", report.coordination_of_carrying},
                        {"floating", static_cast<double>(report.floating)},
                        {"stress_x", report.stress_x},
                        {"stress_y", report.stress_y},
                        {"anisotropy", report.anisotropy},
                        {"unbalanced", report.residual},
                        {"radius_scale", report.radius_scale}};
    hooks.report_stage(
        fmt::format("packed {} circles into {:.4g} m x {:.4g} m: void ratio {:.4g}, mean overlap {:.4g} m, seed {}",
                    packing.report.circles, packing.report.width, packing.report.height, packing.report.void_ratio,
                    packing.report.mean_overlap, test.packing()->seed));
    for (Material& material : packing.scene.materials) test.material.apply_to(material);
    return std::move(packing.scene);
}

Scene read_particles(const ResolvedCase& test, const TestHooks& hooks, std::vector<std::string>& notices) {
    const std::filesystem::path& path = std::get<parts::ParticleFile>(test.source).path;
    DeckReader reader = DeckReader::open(path);
    Scene scene = read_deck_geometry(reader).scene;
    refuse_misplaced_bodies(scene, test.at(CaseKey::particles_file));
    if (const auto ignored = reader.ignored_numbers()) notices.push_back(*ignored);
    for (Material& material : scene.materials) test.material.apply_to(material);
    hooks.report_stage(fmt::format("read {} bodies from {}", scene.bodies.size(), path.string()));
    return scene;
}

/// Sets velocities and gravity to zero: a test starts with bodies at rest in a world without gravity.
void bring_to_rest(Scene& scene, std::vector<std::string>& notices) {
    if (scene.gravity.x != 0.0 || scene.gravity.y != 0.0) {
        notices.push_back("the particle file's gravity is left out: tests run without");
    }
    scene.gravity = {};
    scene.controls.clear();
    for (Body& body : scene.bodies) {
        body.velocity = {};
        body.spin = 0.0;
    }
}

/// Checks that the bodies are all circles (or clumps) or all polygons, because the two kinds are bonded to platens
/// differently.
void classify(Specimen& specimen, const ResolvedCase& test) {
    std::size_t circles = 0, polygons = 0, triangles = 0;
    for (const Body& body : specimen.scene.bodies) {
        if (body.circle_count > 0) ++circles;
        if (body.vertex_count > 0 && !body.closed) {
            throw InputError(
                fmt::format("{}: found body {}, an open chain, expected circles, clumps or polygons; remove it",
                            test.at(CaseKey::particles_file), body.id));
        }
        if (body.closed) ++polygons;
        if (body.closed && body.vertex_count == 3) ++triangles;
    }
    if (circles + polygons == 0) {
        throw InputError(fmt::format("{}: found no particles, expected at least one; check the file",
                                     test.at(CaseKey::particles_file)));
    }
    if (circles > 0 && polygons > 0) {
        throw InputError(fmt::format("{}: found {} circle bodies and {} polygons, expected one kind",
                                     test.at(CaseKey::particles_file), circles, polygons));
    }
    specimen.polygons = polygons > 0;
    specimen.kind = circles > 0             ? SpecimenKind::circles
                    : triangles == polygons ? SpecimenKind::delaunay
                                            : SpecimenKind::voronoi;
}

void measure_circles(Specimen& specimen) {
    if (specimen.scene.circles.empty()) return;
    double sum = 0.0;
    for (const CircleElement& circle : specimen.scene.circles) sum += circle.radius;
    specimen.mean_radius = sum / static_cast<double>(specimen.scene.circles.size());
    for (const Body& body : specimen.scene.bodies) {
        if (circle_overlaps_side(specimen.scene, body, Wall::left)) specimen.left_ids.push_back(body.id);
        if (circle_overlaps_side(specimen.scene, body, Wall::right)) specimen.right_ids.push_back(body.id);
    }
}

/// Area of the tested part, m2.
double area_of(const Shape& shape, const Domain& box) {
    if (shape.outline.empty()) return (box.x2 - box.x1) * (box.y2 - box.y1);
    double twice = 0.0;
    for (std::size_t k = 0; k < shape.outline.size(); ++k) {
        const Vec2 a = shape.outline[k], b = shape.outline[k + 1 == shape.outline.size() ? 0 : k + 1];
        twice += a.x * b.y - b.x * a.y;
    }
    return 0.5 * twice;
}

/// Gap between the cells of a case that gives none.
double derived_mesh_thick(const ResolvedCase& test, const Scene& circles, const Shape& shape, const TestHooks& hooks) {
    const std::size_t cells = test.mesh->kind == MeshKind::voronoi
                                  ? circles.bodies.size()
                                  : bare_cells(test, circles, shape, hooks).cells.size();
    const double thick = derived_gap(area_of(shape, circles.domain), static_cast<double>(cells));
    hooks.report_stage(
        fmt::format("mesh.thick = {:.4g} m by default: {} of the mean cell size", thick, derived_gap_share));
    return thick;
}

// Deviations of the cells from the requested sizes above which a notice is given. The limit for the spread is twice the
// error of the fit.
constexpr double noticed_diameter_share = 0.01, noticed_spread = 0.02;

/// Adds the sizes of the cells to the description of the packing.
void record_cells(Specimen& specimen, const ResolvedCase& test, const CellSizes& cells, const TestHooks& hooks) {
    if (test.packing() == nullptr) return;
    specimen.packing.emplace_back("cell_diameter", cells.mean);
    specimen.packing.emplace_back("cell_spread", cells.spread);
    const auto* asked = std::get_if<parts::CellDiameters>(&test.packing()->sizes);
    std::string text = fmt::format("cells: mean diameter {:.4g} m, spread {:.3g}", cells.mean, cells.spread);
    if (asked != nullptr) text += fmt::format("; asked {:.4g} m, {:.3g}", asked->mean, asked->spread);
    hooks.report_stage(text);
    if (asked == nullptr) return;
    if (std::abs(cells.mean / asked->mean - 1.0) <= noticed_diameter_share &&
        std::abs(cells.spread - asked->spread) <= noticed_spread)
        return;
    specimen.notices.push_back(text + "; more circles would meet them better");
}

/// Reports how traces were cleaned, and adds a notice if cleaning changed anything.
void report_cleaning(const Cleaning& cleaning, Specimen& specimen, const TestHooks& hooks) {
    const std::string text = cleaning_text(cleaning);
    if (cleaning.changed())
        specimen.notices.push_back(text);
    else if (!text.empty())
        hooks.report_stage(text);
}

/// Replaces the circles with polygons around their centres; ids count from 1 in mesh order.
void mesh_specimen(Specimen& specimen, const ResolvedCase& test, const TestHooks& hooks) {
    const Scene circles = specimen.scene;
    const std::vector<CellCentre> centres = centres_of(circles);
    std::vector<int> materials;
    std::vector<char> touches_left, touches_right;
    for (const Body& body : circles.bodies) {
        materials.push_back(body.material);
        touches_left.push_back(circle_overlaps_side(circles, body, Wall::left) ? 1 : 0);
        touches_right.push_back(circle_overlaps_side(circles, body, Wall::right) ? 1 : 0);
    }
    MeshRequest request;
    request.kind = test.mesh->kind;
    request.boundary = test.mesh->boundary;
    request.interrupted = hooks.interrupted;
    const auto* gap = std::get_if<parts::MeshGap>(&test.mesh->gap);
    specimen.mesh_thick = gap != nullptr ? gap->thick : derived_mesh_thick(test, circles, specimen.shape, hooks);
    request.mesh_gap = specimen.mesh_thick;
    request.outline = outline_of(specimen.shape);
    if (gap != nullptr) request.inset = gap->inset;
    request.merge_destroyed = test.mesh->merge_destroyed;
    JointNetwork joints;
    if (!test.joints.empty()) {
        joints = make_joints(test.joints, circles.domain, centres.size());
        request.traces = mesh_traces(joints);
        report_cleaning(joints.cleaning, specimen, hooks);
        specimen.notices.insert(specimen.notices.end(), joints.notices.begin(), joints.notices.end());
    }
    Mesh mesh;
    hooks.report_work(fmt::format("meshing {} centres", centres.size()));
    try {
        mesh = make_mesh(centres, rectangle(circles.domain), request);
        if (!request.traces.empty()) {
            for (const std::string& line : jointed_mesh_text(mesh, centres, circles.domain, request))
                hooks.report_stage(line);
            if (const std::string as_rock = sources_as_rock(joints); !as_rock.empty())
                specimen.notices.push_back(
                    "joints without mechanics (" + as_rock +
                    ") are faces of the mesh with the rock's own properties: they change it by being straight, Voronoi "
                    "cells by their even rows, too");
        }
    } catch (const MeshInterrupted&) {
        throw TestInterrupted();
    } catch (const MeshError& error) {
        throw InputError(
            fmt::format("{}: {}{}", test.at(CaseKey::mesh_thick), error.what(), traces_named(joints, error.traces)));
    }

    Scene scene = circles;
    scene.bodies.clear();
    scene.circles.clear();
    scene.vertices.clear();
    specimen.left_ids.clear();
    specimen.right_ids.clear();
    const bool domain_boundary = request.kind == MeshKind::voronoi || request.boundary == Boundary::domain;
    add_cell_bodies(scene, mesh, materials);
    if (!request.traces.empty()) {
        check_apertures(test.joints, specimen.mesh_thick, true);
        set_joints(scene, mesh, joints);
        for (const JointTrace& trace : joints.traces)
            specimen.traces.push_back({joints.sources[trace.source].name, trace.length()});
    }
    int id = 0;
    for (const Cell& cell : mesh.cells) {
        ++id;
        if (cell_on_side(cell, Wall::left, domain_boundary, touches_left)) specimen.left_ids.push_back(id);
        if (cell_on_side(cell, Wall::right, domain_boundary, touches_right)) specimen.right_ids.push_back(id);
    }
    specimen.scene = std::move(scene);
    specimen.polygons = true;
    specimen.kind = request.kind == MeshKind::voronoi ? SpecimenKind::voronoi : SpecimenKind::delaunay;
    specimen.mesh_gap = request.inset ? 2.0 * *request.inset : request.mesh_gap;
    specimen.centres = static_cast<std::int64_t>(centres.size());
    specimen.segments = mesh.report.segments;
    hooks.report_stage(fmt::format("meshed into {} {} cells with {} segments", mesh.report.cells,
                                   name_of(specimen.kind), mesh.report.segments));
    if (const std::string small = small_cell_text(mesh); !small.empty()) specimen.notices.push_back(small);
    record_cells(specimen, test, measure_cells(mesh), hooks);
}

/// Adds traces to a specimen of circles; circles on a trace get flat faces along it.
void joint_circles(Specimen& specimen, const ResolvedCase& test, const TestHooks& hooks) {
    Scene& scene = specimen.scene;
    const auto refuse = [&](const char* found) {
        throw InputError(
            fmt::format("{}: found {} with joints, expected circles, or a [packing] with [mesh]; remove "
                        "[[joint_set]] and [[trace]]",
                        test.at(CaseKey::particles_file), found));
    };
    if (specimen.polygons) refuse("polygons");
    if (std::ranges::any_of(scene.bodies, [](const Body& body) { return body.circle_count != 1; })) refuse("clumps");
    const JointNetwork joints = make_joints(test.joints, scene.domain, scene.bodies.size());
    check_apertures(test.joints, std::ranges::min(scene.circles, {}, &CircleElement::radius).radius, false);
    set_joints_of_circles(scene, joints);
    report_cleaning(joints.cleaning, specimen, hooks);
    specimen.notices.insert(specimen.notices.end(), joints.notices.begin(), joints.notices.end());
    double length = 0.0;
    for (const JointTrace& trace : joints.traces) {
        specimen.traces.push_back({joints.sources[trace.source].name, trace.length()});
        length += trace.length();
    }
    hooks.report_stage(fmt::format("joints: {} traces of {:.6g} m among the circles", joints.traces.size(), length));
    if (const std::string as_rock = sources_as_rock(joints); !as_rock.empty())
        specimen.notices.push_back("joints without mechanics (" + as_rock + ") change nothing among circles");
}

void measure_polygons(Specimen& specimen, const ResolvedCase& test) {
    specimen.mesh_gap = specimen.scene.thick;
    const bool across_gaps = test.bond_facts().bonds_across_gaps;
    if (across_gaps ? test.bond.thick && *test.bond.thick < specimen.mesh_gap
                    : !test.bond.thick || *test.bond.thick <= specimen.mesh_gap) {
        throw InputError(fmt::format(
            "{}: found {}, expected {} the particle file's thick = {} m; the excess is the "
            "overlap that bonds the polygons",
            test.at(CaseKey::bond_thick), test.bond.thick ? fmt::format("{} m", *test.bond.thick) : "nothing",
            across_gaps ? "at least" : "more than", specimen.mesh_gap));
    }
    for (const Body& body : specimen.scene.bodies) specimen.segments += body.vertex_count;
    specimen.left_ids = polygons_on_side(specimen.scene, Wall::left);
    specimen.right_ids = polygons_on_side(specimen.scene, Wall::right);
}

/// Replaces the materials with those of the minerals, followed by [material], which the platens keep. Each grain gets
/// its mineral's material.
void take_minerals(Specimen& specimen, const ResolvedCase& test, const TestHooks& hooks) {
    Scene& scene = specimen.scene;
    specimen.platen_material = scene.bodies.front().material;
    const std::vector<parts::Mineral>& minerals = test.minerals.list;
    if (minerals.empty()) return;
    if (scene.materials.size() > 1) {
        throw InputError(
            fmt::format("{}: found a particle file with {} materials, expected one; remove [[mineral]] to use the "
                        "file's materials, or keep only one material in the file",
                        test.places.at(CaseKey::mineral, 0), scene.materials.size()));
    }
    const Material rock = scene.materials.front();
    for (std::size_t k = 0; k < minerals.size(); ++k) {
        scene.materials.insert(scene.materials.end() - 1, rock);
        minerals[k].material.apply_to(scene.materials[k]);
    }
    specimen.platen_material = static_cast<int>(minerals.size());
    scene.material_pairs = test.minerals.pairs;
    specimen.minerals = assign_minerals(scene, test.minerals, test.places, specimen.notices);
    hooks.report_stage(mineral_shares_text(specimen.minerals));
}

/// Mean size of the bodies to be made, m.
double particle_size(const Specimen& specimen, const ResolvedCase& test) {
    const Domain& box = specimen.scene.domain;
    const bool meshed = test.mesh.has_value();
    if (!meshed && !specimen.polygons) return 2.0 * specimen.mean_radius;
    const double cells = static_cast<double>(specimen.scene.bodies.size()) *
                         (meshed && test.mesh->kind == MeshKind::delaunay ? 2.0 : 1.0);
    return std::sqrt((box.x2 - box.x1) * (box.y2 - box.y1) / cells);
}

/// Finds the bodies for measuring lateral strain, if the kind of test defines regions for them.
void find_sides(Specimen& specimen) {
    const Shape& shape = specimen.shape;
    const bool measured = shape.left && shape.right;
    specimen.left_ids = measured ? bodies_within(specimen.scene, *shape.left) : std::vector<int>{};
    specimen.right_ids = measured ? bodies_within(specimen.scene, *shape.right) : std::vector<int>{};
}

}  // namespace

Specimen make_specimen(const ResolvedCase& test, const TestHooks& hooks) {
    Specimen specimen;
    specimen.scene =
        test.packing() != nullptr ? packed_scene(test, hooks, specimen) : read_particles(test, hooks, specimen.notices);
    classify(specimen, test);
    bring_to_rest(specimen.scene, specimen.notices);
    measure_circles(specimen);
    specimen.particle = particle_size(specimen, test);
    specimen.shape = test_kind(test.loading.kind).shape({test, specimen.scene.domain, specimen.particle});
    cut_shape(specimen.scene, specimen.shape, specimen.polygons, test);
    const bool meshed = test.mesh.has_value();
    if (!meshed) take_minerals(specimen, test, hooks);
    if (!specimen.polygons) hooks.report_made(circles_file, specimen.scene);
    if (meshed) {
        if (specimen.polygons) {
            throw InputError(
                fmt::format("{}: found a particle file of polygons, expected circles to mesh; remove [mesh]",
                            test.at(CaseKey::mesh)));
        }
        mesh_specimen(specimen, test, hooks);
        take_minerals(specimen, test, hooks);
    } else if (specimen.polygons) {
        measure_polygons(specimen, test);
    }
    if (!meshed && !test.joints.empty()) joint_circles(specimen, test, hooks);
    if (specimen.polygons) hooks.report_made(polygons_file, specimen.scene);
    for (Material& material : specimen.scene.materials) scale_damping(material, test.damping_scale);
    if (!test.uniaxial()) find_sides(specimen);
    specimen.area = area_of(specimen.shape, specimen.scene.domain);
    specimen.width = specimen.shape.width;
    specimen.height = specimen.shape.height;
    return specimen;
}

}  // namespace crackle
