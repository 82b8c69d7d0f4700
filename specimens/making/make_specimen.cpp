// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/make_specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/demseg/geometry.hpp"
#include "specimens/joints/joint_faces.hpp"
#include "specimens/joints/joint_network.hpp"
#include "specimens/making/cell_sizes.hpp"
#include "specimens/making/cut_shape.hpp"
#include "specimens/making/meshed_cells.hpp"
#include "specimens/making/misplaced_bodies.hpp"
#include "specimens/making/packed_circles.hpp"
#include "specimens/making/side_bodies.hpp"
#include "specimens/packing/packing.hpp"

namespace crackle {
namespace {

void scale_damping(Material& material, double by) {
    if (material.damping_ratio) *material.damping_ratio *= by;
    material.normal_damping *= by;
    material.shear_damping *= by;
}

Scene packed_scene(const parts::Particles& particles, const parts::Procedure& test, const TestHooks& hooks,
                   Specimen& specimen) {
    Packing packing = packing_of(particles, test.numerics.threads, test.places, hooks);
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
                    packing.report.mean_overlap, particles.packing()->seed));
    for (Material& material : packing.scene.materials) particles.material.apply_to(material);
    return std::move(packing.scene);
}

Scene read_particles(const parts::Particles& particles, const Places& places, const TestHooks& hooks,
                     std::vector<std::string>& notices) {
    const std::filesystem::path& path = std::get<parts::ParticleFile>(particles.source).path;
    DeckReader reader = DeckReader::open(path);
    Scene scene = read_deck_geometry(reader).scene;
    refuse_misplaced_bodies(scene, places.at(CaseKey::particles_file));
    if (const auto ignored = reader.ignored_numbers()) notices.push_back(*ignored);
    for (Material& material : scene.materials) particles.material.apply_to(material);
    hooks.report_stage(fmt::format("read {} bodies from {}", scene.bodies.size(), path.string()));
    return scene;
}

/// Sets velocities and gravity to zero: a test starts with bodies at rest in a world without gravity.
void bring_to_rest(Scene& scene, std::vector<std::string>& notices) {
    if (scene.gravity.x != 0.0 || scene.gravity.y != 0.0) {
        notices.push_back("the particle file's gravity is ignored: tests run without gravity");
    }
    scene.gravity = {};
    scene.controls.clear();
    for (Body& body : scene.bodies) {
        body.velocity = {};
        body.spin = 0.0;
    }
}

/// Determines the kind of the specimen. All bodies must be circles (or clumps), or all must be polygons, because the
/// two are bonded to platens differently.
void classify(Specimen& specimen, const Places& places) {
    std::size_t circles = 0, polygons = 0, triangles = 0;
    for (const Body& body : specimen.scene.bodies) {
        if (body.circle_count > 0) ++circles;
        if (body.vertex_count > 0 && !body.closed) {
            throw InputError(
                fmt::format("{}: found body {}, an open chain, expected circles, clumps or polygons; remove it",
                            places.at(CaseKey::particles_file), body.id));
        }
        if (body.closed) ++polygons;
        if (body.closed && body.vertex_count == 3) ++triangles;
    }
    if (circles + polygons == 0) {
        throw InputError(fmt::format("{}: found no particles, expected at least one; check the file",
                                     places.at(CaseKey::particles_file)));
    }
    if (circles > 0 && polygons > 0) {
        throw InputError(fmt::format("{}: found {} circle bodies and {} polygons, expected one kind",
                                     places.at(CaseKey::particles_file), circles, polygons));
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

// Deviations of the cells from the requested sizes above which a notice is given. The limit for the spread is twice the
// error of the measured spreads in cell_sizes.cpp.
constexpr double noticed_diameter_share = 0.01, noticed_spread = 0.02;

/// Adds the sizes of the cells to the description of the packing.
void record_cells(Specimen& specimen, const parts::Packing& packing, const CellSizes& cells, const TestHooks& hooks) {
    specimen.packing.emplace_back("cell_diameter", cells.mean);
    specimen.packing.emplace_back("cell_spread", cells.spread);
    const auto* asked = std::get_if<parts::CellDiameters>(&packing.sizes);
    std::string text = fmt::format("cells: mean diameter {:.4g} m, spread {:.3g}", cells.mean, cells.spread);
    if (asked != nullptr) text += fmt::format("; asked {:.4g} m, {:.3g}", asked->mean, asked->spread);
    hooks.report_stage(text);
    if (asked == nullptr) return;
    if (std::abs(cells.mean / asked->mean - 1.0) <= noticed_diameter_share &&
        std::abs(cells.spread - asked->spread) <= noticed_spread)
        return;
    specimen.notices.push_back(text + "; more circles would come closer to the requested sizes");
}

/// Adds the traces of joints to a specimen of circles; circles on a trace get flat faces along it.
void joint_circles(Specimen& specimen, const JointRequest& asked, const Places& places, const TestHooks& hooks) {
    Scene& scene = specimen.scene;
    const auto refuse = [&](const char* found) {
        throw InputError(
            fmt::format("{}: found {} with joints, expected circles, or a [packing] with [mesh]; remove "
                        "[[joint_set]] and [[trace]]",
                        places.at(CaseKey::particles_file), found));
    };
    if (specimen.polygons) refuse("polygons");
    if (std::ranges::any_of(scene.bodies, [](const Body& body) { return body.circle_count != 1; })) refuse("clumps");
    const JointNetwork joints = joints_of(specimen, asked, hooks);
    check_apertures(asked, std::ranges::min(scene.circles, {}, &CircleElement::radius).radius, false);
    set_joints_of_circles(scene, joints);
    name_traces(specimen, joints);
    double length = 0.0;
    for (const JointTrace& trace : joints.traces) length += trace.length();
    hooks.report_stage(fmt::format("joints: {} traces with a total length of {:.6g} m among the circles",
                                   joints.traces.size(), length));
    if (const std::string as_rock = sources_as_rock(joints); !as_rock.empty())
        specimen.notices.push_back("joints without mechanical properties (" + as_rock +
                                   ") have no effect among circles");
}

void measure_polygons(Specimen& specimen) {
    specimen.mesh_gap = specimen.scene.thick;
    for (const Body& body : specimen.scene.bodies) specimen.segments += body.vertex_count;
    specimen.left_ids = polygons_on_side(specimen.scene, Wall::left);
    specimen.right_ids = polygons_on_side(specimen.scene, Wall::right);
}

/// Replaces the scene's materials with one for each mineral, followed by [material], which the platens keep. Each grain
/// gets its mineral's material.
void take_minerals(Specimen& specimen, const parts::Minerals& asked, const Places& places, const TestHooks& hooks) {
    Scene& scene = specimen.scene;
    specimen.platen_material = scene.bodies.front().material;
    const std::vector<parts::Mineral>& minerals = asked.list;
    if (minerals.empty()) return;
    if (scene.materials.size() > 1) {
        throw InputError(
            fmt::format("{}: found a particle file with {} materials, expected one; remove [[mineral]] to use the "
                        "file's materials, or keep only one material in the file",
                        places.at(CaseKey::mineral, 0), scene.materials.size()));
    }
    const Material rock = scene.materials.front();
    for (std::size_t k = 0; k < minerals.size(); ++k) {
        scene.materials.insert(scene.materials.end() - 1, rock);
        minerals[k].material.apply_to(scene.materials[k]);
    }
    specimen.platen_material = static_cast<int>(minerals.size());
    scene.material_pairs = asked.pairs;
    specimen.minerals = assign_minerals(scene, asked, places, specimen.notices);
    hooks.report_stage(mineral_shares_text(specimen.minerals));
}

/// Mean size of the tested bodies, m. @param mesh  the requested mesh; null if the bodies are tested as they are
double particle_size(const Specimen& specimen, const parts::Mesh* mesh) {
    const Domain& box = specimen.scene.domain;
    if (mesh == nullptr && !specimen.polygons) return 2.0 * specimen.mean_radius;
    const double cells = static_cast<double>(specimen.scene.bodies.size()) *
                         (mesh != nullptr && mesh->kind == MeshKind::delaunay ? 2.0 : 1.0);
    return std::sqrt((box.x2 - box.x1) * (box.y2 - box.y1) / cells);
}

/// Finds the bodies for measuring lateral strain, if the kind of test defines regions for them.
void find_sides(Specimen& specimen) {
    const Shape& shape = specimen.shape;
    const bool measured = shape.left && shape.right;
    specimen.left_ids = measured ? bodies_within(specimen.scene, *shape.left) : std::vector<int>{};
    specimen.right_ids = measured ? bodies_within(specimen.scene, *shape.right) : std::vector<int>{};
}

/// Packs the particles or reads them from a file, sets their velocities to zero, and removes all particles outside the
/// shape of the test.
Specimen cut_particles(const parts::Particles& particles, const parts::Procedure& test, const TestHooks& hooks) {
    Specimen specimen;
    specimen.scene = particles.packing() != nullptr ? packed_scene(particles, test, hooks, specimen)
                                                    : read_particles(particles, test.places, hooks, specimen.notices);
    specimen.scene.units = particles.material.units;
    specimen.material = particles.material;
    specimen.mineral_parts = particles.minerals;
    classify(specimen, test.places);
    bring_to_rest(specimen.scene, specimen.notices);
    measure_circles(specimen);
    const parts::Mesh* mesh = particles.mesh ? &*particles.mesh : nullptr;
    specimen.particle = particle_size(specimen, mesh);
    specimen.shape = test_kind(test.loading.kind).shape({test, specimen.scene.domain, specimen.particle});
    cut_shape(specimen.scene, specimen.shape, specimen.polygons, mesh != nullptr, test);
    return specimen;
}

}  // namespace

Specimen make_specimen(const parts::Particles& particles, const parts::Procedure& test, const TestHooks& hooks) {
    Specimen specimen = cut_particles(particles, test, hooks);
    const Places& places = test.places;
    if (particles.mesh) {
        if (specimen.polygons) {
            throw InputError(
                fmt::format("{}: found a particle file of polygons, expected circles to mesh; remove [mesh]",
                            places.at(CaseKey::mesh)));
        }
        hooks.report_made(circles_file, specimen.scene);
        const CellSizes cells = mesh_specimen(specimen, *particles.mesh, particles.joints, places, hooks);
        if (particles.packing() != nullptr) record_cells(specimen, *particles.packing(), cells, hooks);
        take_minerals(specimen, particles.minerals, places, hooks);
    } else {
        take_minerals(specimen, particles.minerals, places, hooks);
        if (specimen.polygons)
            measure_polygons(specimen);
        else
            hooks.report_made(circles_file, specimen.scene);
        if (!particles.joints.empty()) joint_circles(specimen, particles.joints, places, hooks);
    }
    if (specimen.polygons) hooks.report_made(polygons_file, specimen.scene);
    for (Material& material : specimen.scene.materials) scale_damping(material, particles.damping_scale);
    if (!test.uniaxial()) find_sides(specimen);
    specimen.area = specimen.shape.area(specimen.scene.domain);
    specimen.width = specimen.shape.width;
    specimen.height = specimen.shape.height;
    return specimen;
}

}  // namespace crackle
