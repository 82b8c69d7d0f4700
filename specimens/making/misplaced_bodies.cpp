// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/misplaced_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

struct Place {
    int id = 0;
    Vec2 at;
    double size = 0.0;  ///< square root of the body's area, m
    double along = 0.0;
};

void refuse_outside(const Place& body, const Domain& domain, const std::string& where) {
    const bool across = body.at.x < domain.x1 || body.at.x > domain.x2;
    if (!across && body.at.y >= domain.y1 && body.at.y <= domain.y2) return;
    throw InputError(fmt::format(
        "{}: found the centre of body {} at ({:.6g}, {:.6g}), outside of the domain, {} {:.6g} to {:.6g} m, expected "
        "every body inside; correct or remove it",
        where, body.id, body.at.x, body.at.y, across ? "x" : "y", across ? domain.x1 : domain.y1,
        across ? domain.x2 : domain.y2));
}

}  // namespace

void refuse_misplaced_bodies(const Scene& scene, const std::string& where) {
    // Distance below which two bodies coincide, relative to their size; overlapping bodies of a specimen are much
    // farther apart.
    constexpr double one_place = 0.01;
    // Bodies are sorted along a slanted line, so that bodies in a row or column of a lattice have different
    // coordinates.
    const Vec2 slant{1.0, 0.6180339887};
    std::vector<Place> places;
    places.reserve(scene.bodies.size());
    for (const Body& body : scene.bodies) {
        if (body.vertex_count > 0 && !body.closed) continue;  // open chains are rejected elsewhere
        const MassProperties properties = mass_properties(scene, body);
        const double area = properties.mass / scene.materials[static_cast<std::size_t>(body.material)].density;
        places.push_back({body.id, properties.centroid, std::sqrt(area), dot(slant, properties.centroid)});
        refuse_outside(places.back(), scene.domain, where);
    }
    std::sort(places.begin(), places.end(),
              [](const Place& a, const Place& b) { return a.along != b.along ? a.along < b.along : a.id < b.id; });
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Place& a = places[i];
        const double reach = one_place * a.size * norm(slant);
        for (std::size_t j = i + 1; j < places.size() && places[j].along - a.along <= reach; ++j) {
            const Place& b = places[j];
            if (norm(b.at - a.at) > one_place * std::min(a.size, b.size)) continue;
            throw InputError(
                fmt::format("{}: found bodies {} and {} at the same place, ({:.6g}, {:.6g}), expected each body once; "
                            "remove one of them",
                            where, std::min(a.id, b.id), std::max(a.id, b.id), a.at.x, a.at.y));
        }
    }
}

}  // namespace crackle
