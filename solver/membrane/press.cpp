// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/membrane/press.hpp"

#include "solver/geometry/geometry.hpp"

namespace crackle {
namespace {

Vec2 place_of(const World& world, const MembranePoint& point) {
    const BodyState& body = world.bodies.state[point.body];
    return Vec2{body.x, body.y} + turned(body, {point.x, point.y, 0.0, 0.0});
}

/// Calls visit(point, position, force) for every point of a chain.
/// @return contribution of the chain to the area, minus the area swept by its ends on platens @param parted set to true
/// if a piece has become too long
template <class Visit>
double visit_chain(const World& world, std::size_t begin, std::size_t end, bool closed, bool& parted, Visit&& visit) {
    const Membrane& membrane = world.membrane;
    const auto at = [&](std::size_t k) { return place_of(world, membrane.points[k]); };
    const auto half_force = [&](Vec2 a, Vec2 b) { return 0.5 * membrane.pressure * Vec2{b.y - a.y, a.x - b.x}; };
    const auto look = [&](Vec2 a, Vec2 b, std::size_t k) {
        const double longest = membrane.points[k].longest;
        parted = parted || !(dot(b - a, b - a) <= longest * longest);
    };
    const Vec2 first = at(begin), last = at(end - 1);
    double area = closed ? -0.5 * (last.x + first.x) * (first.y - last.y) : last.x * last.y - first.x * first.y;
    Vec2 before{};  // half of the force on the piece of the chain before the point
    if (closed) {
        before = half_force(last, first);
        look(last, first, begin);
    }
    const Vec2 of_closing = before;
    Vec2 place = first;
    for (std::size_t k = begin; k + 1 < end; ++k) {
        const Vec2 next = at(k + 1);
        const Vec2 half = half_force(place, next);
        look(place, next, k + 1);
        visit(membrane.points[k], place, before + half);
        area -= 0.5 * (place.x + next.x) * (next.y - place.y);
        before = half;
        place = next;
    }
    visit(membrane.points[end - 1], place, before + of_closing);
    return area;
}

/// Calls visit(point, position, force) for the points of all chains. @return enclosed area, m²
template <class Visit>
double visit_points(const World& world, bool& parted, Visit&& visit) {
    const Membrane& membrane = world.membrane;
    const std::size_t count = membrane.points.size();
    if (count == 0) return 0.0;
    if (membrane.top == no_body) return visit_chain(world, 0, count, true, parted, visit);
    return visit_chain(world, 0, membrane.left_end, false, parted, visit) +
           visit_chain(world, membrane.left_end, count, false, parted, visit);
}

void add(BodyForce& sum, const BodyState& body, Vec2 place, Vec2 force) {
    sum.fx += force.x;
    sum.fy += force.y;
    sum.torque += (place.x - body.x) * force.y - (place.y - body.y) * force.x;
}

}  // namespace

void press_membrane(World& world) {
    Membrane& membrane = world.membrane;
    bool parted = false;
    const double area = visit_points(world, parted, [&](const MembranePoint& point, Vec2 place, Vec2 force) {
        add(world.bodies.force[point.body], world.bodies.state[point.body], place, force);
    });
    membrane.parted = parted;
    if (membrane.known) {
        const double work = -membrane.pressure * (area - membrane.area);
        membrane.work += work;
        world.account.force_work += work;
    }
    membrane.known = true;
    membrane.area = area;
}

BodyForce membrane_force_on(const World& world, BodyIndex body) {
    BodyForce sum{};
    bool parted = false;
    visit_points(world, parted, [&](const MembranePoint& point, Vec2 place, Vec2 force) {
        if (point.body == body) add(sum, world.bodies.state[body], place, force);
    });
    return sum;
}

double membrane_area(const World& world) {
    bool parted = false;
    return visit_points(world, parted, [](const MembranePoint&, Vec2, Vec2) {});
}

}  // namespace crackle
