// SPDX-License-Identifier: GPL-3.0-or-later
// Places, holds and drives the two platens.

#include "specimens/setup/platen.hpp"
#include "solver/measure/point_view.hpp"

#include <algorithm>
#include <limits>

namespace crackle {
namespace {

struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};

/// Lowest and highest surface points of the particles (bare corners for polygons).
Extent vertical_extent(const Scene& scene) {
    Extent extent;
    for (const CircleElement& circle : scene.circles) {
        extent.low = std::min(extent.low, circle.centre.y - circle.radius);
        extent.high = std::max(extent.high, circle.centre.y + circle.radius);
    }
    for (const Vec2 corner : scene.vertices) {
        extent.low = std::min(extent.low, corner.y);
        extent.high = std::max(extent.high, corner.y);
    }
    return extent;
}

/// Distance of a bonded platen's line from the domain's face, outwards.
/// @param depth how far inside the face the outermost particle ends
double bonded_offset(const Specimen& specimen, double depth, double thick) {
    if (!specimen.polygons) return thick;
    const bool flat = depth <= specimen.mesh_gap;
    return flat ? 0.5 * specimen.mesh_gap : specimen.mesh_gap - depth;
}

int platen_material(Scene& scene, const Specimen& specimen, const TestCase::Loading& loading) {
    const int of_specimen = specimen.platen_material;
    if (loading.platens != "frictional") return of_specimen;
    Material material = scene.materials[static_cast<std::size_t>(of_specimen)];
    material.friction_angle = material.residual_friction_angle = *loading.platen_friction_angle;
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

void hold(Scene& scene, std::uint32_t body, double velocity) {
    Control control;
    control.body = static_cast<int>(body);
    control.x = {Drive::velocity, 0.0};
    control.y = {Drive::velocity, velocity};
    control.rotation = {Drive::velocity, 0.0};
    scene.controls.push_back(control);
    scene.bodies[body].velocity = {0.0, velocity};
}

/// Circle, clump and polygon centroids are exact for the velocity field; rounding moves nothing that matters here.
void spread_velocity(Scene& scene, const Platens& platens) {
    const double height = platens.top_y - platens.bottom_y;
    for (Body& body : scene.bodies) {
        const double y = mass_properties(scene, body).centroid.y;
        body.velocity = {0.0, platens.velocity * (y - platens.bottom_y) / height};
        body.spin = 0.0;
    }
}

/// What a bonded face of a part lies away from the specimen's, m.
double part_offset(const Specimen& specimen, double thick) {
    return specimen.polygons ? 0.5 * specimen.mesh_gap : thick;
}

int next_id(const Scene& scene) { return std::ranges::max_element(scene.bodies, {}, &Body::id)->id + 1; }

/// The parts of a kind of test that has no platens.
void add_parts(Scene& scene, const Specimen& specimen, const TestCase& test, double thick, Platens& platens) {
    KindRequest request{test, scene.domain, specimen.particle};
    request.offset = part_offset(specimen, thick);
    // Circles that were cut out by their centres reach beyond the outline: half a radius on, none is through it.
    request.cut_offset = specimen.polygons ? request.offset : cut_circles_offset * specimen.particle;
    for (const CircleElement& circle : scene.circles) request.surface.push_back({circle.centre, circle.radius + thick});
    for (const Vec2 corner : scene.vertices) request.surface.push_back({corner, thick});
    platens.apparatus = test_kind(test.loading.kind).apparatus(request, specimen.shape);
    const int material = platen_material(scene, specimen, test.loading);
    platens.bottom_id = next_id(scene);
    platens.top_id = platens.bottom_id - 1;
    platens.parked = platens.bonded ? 0.0 : platen_parking_distance * specimen.height;
    for (const LoadingPart& part : platens.apparatus.parts) {
        std::vector<Vec2> corners = part.corners;
        const bool last = &part == &platens.apparatus.parts.back();
        for (Vec2& corner : corners) corner.y += last ? platens.parked : -platens.parked;
        const std::uint32_t body = scene.add_chain_body(++platens.top_id, material, corners, true);
        Control control;
        control.body = static_cast<int>(body);
        control.x = part.x;
        control.y = part.y;
        control.rotation = part.rotation;
        scene.controls.push_back(control);
    }
}

}  // namespace

Platens add_platens(Scene& scene, const Specimen& specimen, const TestCase& test, double thick) {
    const TestCase::Loading& loading = test.loading;
    const Extent extent = vertical_extent(scene);
    const Domain& domain = scene.domain;
    Platens platens;
    platens.bonded = loading.platens != "frictional";
    platens.apparatus.section = specimen.width;
    platens.apparatus.length = specimen.height;
    scene.domain.wall_present = {false, false, false, false};
    if (!test.uniaxial()) {
        add_parts(scene, specimen, test, thick, platens);
        return platens;
    }
    if (platens.bonded) {
        platens.bottom_y = domain.y1 - bonded_offset(specimen, extent.low - domain.y1, thick);
        platens.top_y = domain.y2 + bonded_offset(specimen, domain.y2 - extent.high, thick);
    } else {
        platens.bottom_y = extent.low - thick;
        platens.top_y = extent.high + thick;
    }
    const double speed = loading.axial_strain_rate.value_or(0.0) * specimen.height;  // by tolerance: set later
    platens.velocity = loading.kind == "tension" ? speed : -speed;
    spread_velocity(scene, platens);

    platens.bottom_id = next_id(scene);
    platens.top_id = platens.bottom_id + 1;
    const int material = platen_material(scene, specimen, loading);
    const double middle = 0.5 * (domain.x1 + domain.x2);
    const double half = 0.5 * platen_width_ratio * specimen.width;
    const double left = middle - half, right = middle + half;
    const double depth = platen_depth_ratio * specimen.height;
    platens.parked = platens.bonded ? 0.0 : platen_parking_distance * specimen.height;
    const double bottom_y = platens.bottom_y - platens.parked;
    const double top_y = platens.top_y + platens.parked;
    // Counter-clockwise, the face first.
    const auto bottom = scene.add_chain_body(
        platens.bottom_id, material,
        {{right, bottom_y}, {left, bottom_y}, {left, bottom_y - depth}, {right, bottom_y - depth}}, true);
    const auto top = scene.add_chain_body(
        platens.top_id, material, {{left, top_y}, {right, top_y}, {right, top_y + depth}, {left, top_y + depth}}, true);
    hold(scene, bottom, 0.0);
    hold(scene, top, platens.velocity);
    return platens;
}

void place_platens(World& world, const Platens& platens) {
    if (platens.bonded) return;
    world.bodies.state[body_of_id(world, platens.bottom_id)].y += platens.parked;
    world.bodies.state[body_of_id(world, platens.top_id)].y -= platens.parked;
    bodies_moved(world);
}

}  // namespace crackle
