// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/meshed_cells.hpp"

#include <fmt/format.h>

#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/joints/joint_faces.hpp"
#include "specimens/joints/mesh_traces.hpp"
#include "specimens/making/cell_bodies.hpp"
#include "specimens/making/side_bodies.hpp"

namespace crackle {
namespace {

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

/// Whether a point lies in a convex, counter-clockwise outline.
bool lies_in(std::span<const Point> outline, Point p) {
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Point a = outline[k], b = outline[(k + 1) % outline.size()];
        if (cross(Point{b.x - a.x, b.y - a.y}, Point{p.x - a.x, p.y - a.y}) < 0.0) return false;
    }
    return true;
}

/// Centres of the cells of a mesh, for Specimen::cell_centres.
std::vector<Vec2> centres_of_cells(const Mesh& mesh, const std::vector<CellCentre>& centres) {
    std::vector<Vec2> found;
    found.reserve(mesh.cells.size());
    for (const Cell& cell : mesh.cells) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        const bool whole =
            cell.centre >= 0 && lies_in(mesh.outline(cell), centres[static_cast<std::size_t>(cell.centre)]);
        const Point at = whole ? centres[static_cast<std::size_t>(cell.centre)] : Point{unknown, unknown};
        found.push_back({at.x, at.y});
    }
    return found;
}

MeshRequest request_of(const parts::Mesh& asked, const Shape& shape, const TestHooks& hooks) {
    MeshRequest request;
    request.interrupted = hooks.interrupted;
    request.outline = outline_of(shape);
    request.kind = asked.kind;
    request.boundary = asked.boundary;
    return request;
}

/// Gap between the cells of a mesh for which the case gives no gap.
double derived_mesh_thick(const Specimen& specimen, const parts::Mesh& asked, const Places& places,
                          const TestHooks& hooks) {
    const Scene& circles = specimen.scene;
    const std::size_t cells = asked.kind == MeshKind::voronoi
                                  ? circles.bodies.size()
                                  : bare_cells(circles, asked, places, specimen.shape, hooks).cells.size();
    const double thick = derived_gap(specimen.shape.area(circles.domain), static_cast<double>(cells));
    hooks.report_stage(
        fmt::format("mesh.thick = {:.4g} m by default: {} times the mean cell size", thick, derived_gap_share));
    return thick;
}

/// Meshes the circles, and reports how the mesh follows the traces of joints.
Mesh mesh_along_joints(Specimen& specimen, const MeshRequest& request, const JointNetwork& joints, const Places& places,
                       const TestHooks& hooks) {
    const Scene& circles = specimen.scene;
    const std::vector<CellCentre> centres = centres_of(circles);
    hooks.report_work(fmt::format("meshing {} centres", centres.size()));
    try {
        Mesh mesh = make_mesh(centres, rectangle(circles.domain), request);
        if (!request.traces.empty()) {
            for (const std::string& line : jointed_mesh_text(mesh, centres, circles.domain, request))
                hooks.report_stage(line);
            if (const std::string as_rock = sources_as_rock(joints); !as_rock.empty())
                specimen.notices.push_back(
                    "joints without mechanical properties (" + as_rock +
                    ") are faces of the mesh with the rock's own properties. They still affect the specimen, because "
                    "they are straight and because Voronoi cells form even rows along them");
        }
        return mesh;
    } catch (const MeshInterrupted&) {
        throw TestInterrupted();
    } catch (const MeshError& error) {
        throw InputError(
            fmt::format("{}: {}{}", places.at(CaseKey::mesh_thick), error.what(), traces_named(joints, error.traces)));
    }
}

/// Replaces the circles with the cells; ids count from 1 in mesh order.
void take_cells(Specimen& specimen, const Mesh& mesh, bool domain_boundary) {
    Scene& scene = specimen.scene;
    std::vector<int> materials;
    std::vector<char> touches_left, touches_right;
    for (const Body& body : scene.bodies) {
        materials.push_back(body.material);
        touches_left.push_back(circle_overlaps_side(scene, body, Wall::left) ? 1 : 0);
        touches_right.push_back(circle_overlaps_side(scene, body, Wall::right) ? 1 : 0);
    }
    specimen.centres = static_cast<std::int64_t>(scene.bodies.size());
    specimen.cell_centres = centres_of_cells(mesh, centres_of(scene));
    scene.bodies.clear();
    scene.circles.clear();
    scene.vertices.clear();
    specimen.left_ids.clear();
    specimen.right_ids.clear();
    add_cell_bodies(scene, mesh, materials);
    int id = 0;
    for (const Cell& cell : mesh.cells) {
        ++id;
        if (cell_on_side(cell, Wall::left, domain_boundary, touches_left)) specimen.left_ids.push_back(id);
        if (cell_on_side(cell, Wall::right, domain_boundary, touches_right)) specimen.right_ids.push_back(id);
    }
}

}  // namespace

JointNetwork joints_of(Specimen& specimen, const JointRequest& asked, const TestHooks& hooks) {
    JointNetwork joints = make_joints(asked, specimen.scene.domain, specimen.scene.bodies.size());
    const std::string cleaned = cleaning_text(joints.cleaning);
    if (joints.cleaning.changed())
        specimen.notices.push_back(cleaned);
    else if (!cleaned.empty())
        hooks.report_stage(cleaned);
    specimen.notices.insert(specimen.notices.end(), joints.notices.begin(), joints.notices.end());
    return joints;
}

void name_traces(Specimen& specimen, const JointNetwork& joints) {
    for (const JointTrace& trace : joints.traces)
        specimen.traces.push_back({joints.sources[trace.source].name, trace.length()});
}

Mesh bare_cells(const Scene& circles, const parts::Mesh& asked, const Places& places, const Shape& shape,
                const TestHooks& hooks) {
    try {
        return make_mesh(centres_of(circles), rectangle(circles.domain), request_of(asked, shape, hooks));
    } catch (const MeshInterrupted&) {
        throw TestInterrupted();
    } catch (const MeshError& error) {
        throw InputError(fmt::format("{}: {}", places.at(CaseKey::mesh_kind), error.what()));
    }
}

CellSizes mesh_specimen(Specimen& specimen, const parts::Mesh& asked, const JointRequest& asked_joints,
                        const Places& places, const TestHooks& hooks) {
    MeshRequest request = request_of(asked, specimen.shape, hooks);
    const auto* gap = std::get_if<parts::MeshGap>(&asked.gap);
    specimen.mesh_thick = gap != nullptr ? gap->thick : derived_mesh_thick(specimen, asked, places, hooks);
    request.mesh_gap = specimen.mesh_thick;
    if (gap != nullptr) request.inset = gap->inset;
    specimen.mesh_gap = parts::MeshGap{specimen.mesh_thick, request.inset}.between_edges();
    request.merge_destroyed = asked.merge_destroyed;
    JointNetwork joints;
    if (!asked_joints.empty()) {
        joints = joints_of(specimen, asked_joints, hooks);
        request.traces = mesh_traces(joints);
    }
    const Mesh mesh = mesh_along_joints(specimen, request, joints, places, hooks);
    take_cells(specimen, mesh, request.kind == MeshKind::voronoi || request.boundary == Boundary::domain);
    if (!request.traces.empty()) {
        check_apertures(asked_joints, specimen.mesh_gap, true);
        set_joints(specimen.scene, mesh, joints);
        name_traces(specimen, joints);
    }
    specimen.polygons = true;
    specimen.kind = request.kind == MeshKind::voronoi ? SpecimenKind::voronoi : SpecimenKind::delaunay;
    specimen.segments = mesh.report.segments;
    hooks.report_stage(fmt::format("meshed into {} {} cells with {} segments", mesh.report.cells,
                                   name_of(specimen.kind), mesh.report.segments));
    if (const std::string small = small_cell_text(mesh); !small.empty()) specimen.notices.push_back(small);
    return measure_cells(mesh);
}

}  // namespace crackle
