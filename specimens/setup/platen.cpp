// SPDX-License-Identifier: GPL-3.0-or-later
// Adds the parts that hold and drive the specimen: two platens, or the jaws, pads or boxes of its kind of test.

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

/// Outermost surface points of the particles along x or y (for polygons the corners, without the rounding).
Extent extent_along(const Scene& scene, double Vec2::*axis) {
    Extent extent;
    for (const CircleElement& circle : scene.circles) {
        extent.low = std::min(extent.low, circle.centre.*axis - circle.radius);
        extent.high = std::max(extent.high, circle.centre.*axis + circle.radius);
    }
    for (const Vec2 corner : scene.vertices) {
        extent.low = std::min(extent.low, corner.*axis);
        extent.high = std::max(extent.high, corner.*axis);
    }
    return extent;
}

/// Distance from the domain's face outwards to the face of a bonded platen, m.
/// @param depth  distance from the domain's face inwards to the outermost end of a particle
double bonded_offset(const Specimen& specimen, double depth, double thick) {
    if (!specimen.polygons) return thick;
    const bool flat = depth <= specimen.mesh_gap;
    return flat ? 0.5 * specimen.mesh_gap : specimen.mesh_gap - depth;
}

/// Adds a copy of the platens' material with another friction angle, degrees, and returns its index.
int material_with_friction(Scene& scene, const Specimen& specimen, double angle) {
    Material material = scene.materials[static_cast<std::size_t>(specimen.platen_material)];
    material.friction_angle = material.residual_friction_angle = angle;
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

int platen_material(Scene& scene, const Specimen& specimen, const parts::Loading& loading) {
    if (loading.platens != PlatenKind::frictional) return specimen.platen_material;
    return material_with_friction(scene, specimen, loading.platen_friction_angle);
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

/// Gives each body a velocity that grows linearly from the lower to the upper platen with the height of its centroid.
void spread_velocity(Scene& scene, const Platens& platens) {
    const double height = platens.top_y - platens.bottom_y;
    for (Body& body : scene.bodies) {
        const double y = mass_properties(scene, body).centroid.y;
        body.velocity = {0.0, platens.velocity * (y - platens.bottom_y) / height};
        body.spin = 0.0;
    }
}

/// Distance between the specimen's face and the face of a part bonded to it, m.
double part_offset(const Specimen& specimen, double thick) {
    return specimen.polygons ? 0.5 * specimen.mesh_gap : thick;
}

int next_id(const Scene& scene) { return std::ranges::max_element(scene.bodies, {}, &Body::id)->id + 1; }

/// Adds the parts for a kind of test without platens.
void add_parts(Scene& scene, const Specimen& specimen, const parts::Procedure& test, double thick, Platens& platens) {
    KindRequest request{test, scene.domain, specimen.particle};
    request.offset = part_offset(specimen, thick);
    // Circles selected by their centres extend beyond the outline. The offset of half a radius prevents a circle from
    // passing through the face.
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

/// Adds the blocks that press on the sides of the specimen; they extend beyond both platens.
/// @param sides  extent of the particles along x
void add_walls(Scene& scene, const Specimen& specimen, const parts::Procedure& test, double thick,
               const Platens& platens, const Extent& sides) {
    const int material = material_with_friction(scene, specimen, 0.0);
    const double force = test.pressure() * specimen.height;
    const double depth = platen_depth_ratio * specimen.width, beyond = platen_depth_ratio * specimen.height;
    const double low = platens.bottom_y - beyond, high = platens.top_y + beyond;
    const auto add = [&](int id, double face, double outwards) {
        const double x = face + outwards * platens.walls_parked, back = x + outwards * depth;
        // Corners counter-clockwise, starting with the corners of the face.
        std::vector<Vec2> corners = outwards < 0.0 ? std::vector<Vec2>{{x, low}, {x, high}, {back, high}, {back, low}}
                                                   : std::vector<Vec2>{{x, high}, {x, low}, {back, low}, {back, high}};
        Control control;
        control.body = static_cast<int>(scene.add_chain_body(id, material, corners, true));
        control.x = {Drive::force, -outwards * force};
        control.y = control.rotation = {Drive::velocity, 0.0};
        scene.controls.push_back(control);
    };
    add(platens.bottom_id + 1, sides.low - thick, -1.0);
    add(platens.bottom_id + 2, sides.high + thick, 1.0);
    scene.driven_contacts = DrivenContacts::none;
}

}  // namespace

Platens add_platens(Scene& scene, const Specimen& specimen, const parts::Procedure& test, double thick) {
    const parts::Loading& loading = test.loading;
    const Extent extent = extent_along(scene, &Vec2::y), sides = extent_along(scene, &Vec2::x);
    const Domain& domain = scene.domain;
    Platens platens;
    platens.bonded = loading.platens != PlatenKind::frictional;
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
    // The speed is set later if the loading rate is derived from a tolerance.
    const double* rate = loading.axial_strain_rate();
    const double speed = rate != nullptr ? *rate * specimen.height : 0.0;
    platens.velocity = test_kind(loading.kind).compression ? -speed : speed;
    spread_velocity(scene, platens);

    platens.walls = test.confinement && test.confinement->by_walls();
    platens.bottom_id = next_id(scene);
    platens.top_id = platens.bottom_id + (platens.walls ? 3 : 1);
    const int material = platen_material(scene, specimen, loading);
    const double middle = 0.5 * (domain.x1 + domain.x2);
    const double half = 0.5 * platen_width_ratio * specimen.width;
    const double left = middle - half, right = middle + half;
    const double depth = platen_depth_ratio * specimen.height;
    platens.parked = platens.bonded ? 0.0 : platen_parking_distance * specimen.height;
    const double bottom_y = platens.bottom_y - platens.parked;
    const double top_y = platens.top_y + platens.parked;
    // Corners counter-clockwise, starting with the corners of the face.
    const auto bottom = scene.add_chain_body(
        platens.bottom_id, material,
        {{right, bottom_y}, {left, bottom_y}, {left, bottom_y - depth}, {right, bottom_y - depth}}, true);
    const auto top = scene.add_chain_body(
        platens.top_id, material, {{left, top_y}, {right, top_y}, {right, top_y + depth}, {left, top_y + depth}}, true);
    hold(scene, bottom, 0.0);
    hold(scene, top, platens.velocity);
    if (platens.walls) {
        platens.walls_parked = platen_parking_distance * specimen.width;
        add_walls(scene, specimen, test, thick, platens, sides);
    }
    return platens;
}

void place_platens(World& world, const Platens& platens) {
    if (platens.bonded && !platens.walls) return;
    world.bodies.state[body_of_id(world, platens.bottom_id)].y += platens.parked;
    world.bodies.state[body_of_id(world, platens.top_id)].y -= platens.parked;
    if (platens.walls) {
        world.bodies.state[body_of_id(world, platens.bottom_id + 1)].x += platens.walls_parked;
        world.bodies.state[body_of_id(world, platens.bottom_id + 2)].x -= platens.walls_parked;
    }
    bodies_moved(world);
}

}  // namespace crackle
