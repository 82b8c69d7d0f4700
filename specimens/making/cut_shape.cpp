// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/cut_shape.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

constexpr std::size_t fewest_bodies = 10;  // smallest number of bodies that must remain after cutting

/// Copy of a scene with only some of its bodies, which must be circles. @param keep  returns whether to keep a body
template <class Keep>
Scene part_of(const Scene& scene, const Keep& keep) {
    Scene part = scene;
    part.bodies.clear();
    part.circles.clear();
    for (const Body& body : scene.bodies) {
        if (!keep(body)) continue;
        part.bodies.push_back(body);
        part.bodies.back().first_circle = static_cast<std::uint32_t>(part.circles.size());
        const auto circles = std::span(scene.circles).subspan(body.first_circle, body.circle_count);
        part.circles.insert(part.circles.end(), circles.begin(), circles.end());
    }
    return part;
}

}  // namespace

void cut_shape(Scene& scene, const Shape& shape, bool polygons, bool meshed, const parts::Procedure& test) {
    if (shape.whole()) return;
    if (polygons && !shape.outline.empty()) {
        throw InputError(
            fmt::format("{}: found a particle file of polygons, expected circles or a [packing] with kind = "
                        "\"{}\", since polygons cannot be cut",
                        test.at(CaseKey::particles_file), name_of(test.loading.kind)));
    }
    const bool slot = shape.notch && !meshed && !polygons;
    scene = polygons ? scene : part_of(scene, [&](const Body& body) {
        const Vec2 centre = mass_properties(scene, body).centroid;
        if (!shape.holds(centre)) return false;
        return !(slot && shape.notch->distance(centre) < scene.circles[body.first_circle].radius);
    });
    if (scene.bodies.size() < fewest_bodies) {
        throw InputError(
            fmt::format("{}: found {} particles in the shape cut from the packing, expected at least {}; make the "
                        "particles smaller, or the specimen larger",
                        test.at(CaseKey::loading_kind), scene.bodies.size(), fewest_bodies));
    }
}

std::vector<int> bodies_within(const Scene& scene, const Region& region) {
    std::vector<int> ids;
    for (const Body& body : scene.bodies)
        if (region.holds(mass_properties(scene, body).centroid)) ids.push_back(body.id);
    return ids;
}

}  // namespace crackle
