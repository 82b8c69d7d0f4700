// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/emission/listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/errors.hpp"
#include "solver/measure/last_pass.hpp"
#include "solver/world/point_order.hpp"

namespace crackle {
namespace {

constexpr std::size_t bore_nothing = static_cast<std::size_t>(-1);

PointKind kind_of_point(const World& world, PointIndex k) {
    int kind = 0;
    while (k >= world.points.kind_begin[static_cast<std::size_t>(kind) + 1]) ++kind;
    return static_cast<PointKind>(kind);
}

bool comes_before(const EarlierForce& a, PointKind kind, const PointKey& key) {
    return a.kind != kind ? a.kind < kind : key_of(kind, a.point) < key;
}

/// Where a point stands in what is ordered by kind and key; the end if it is not there.
std::vector<EarlierForce>::const_iterator find_earlier(const std::vector<EarlierForce>& before, PointKind kind,
                                                       const ContactPoint& point) {
    const PointKey key = key_of(kind, point);
    const auto at = std::partition_point(before.begin(), before.end(),
                                         [&](const EarlierForce& one) { return comes_before(one, kind, key); });
    return at != before.end() && at->kind == kind && key_of(kind, at->point) == key ? at : before.end();
}

/// Force on body_i just before its bond broke, N: that of the break.
Vec2 force_of_break(const BreakEvent& one, Vec2 normal) {
    return one.shear_force * perpendicular(normal) - one.normal_force * normal;
}

double mean_damping_ratio(const World& world, const TestSetup& setup) {
    double sum = 0.0;
    std::int64_t count = 0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint point = world.points.contact[k];
        if ((world.points.state[k].flags & point_bonded) == 0 || setup.is_platen(point.body_i) ||
            setup.is_platen(point.body_j))
            continue;
        // Shares are in the root mass: the critical dashpot is 2 sqrt(k_n) times it.
        const ContactLaw& law = world.settings.laws[world.points.state[k].law];
        const double mass = world.points.root_mass[k];
        sum += (law.normal_damping + law.normal_damping_ratio_term * mass) /
               (2.0 * std::sqrt(law.normal_stiffness) * mass);
        ++count;
    }
    return sum / static_cast<double>(count);
}

}  // namespace

EmissionRule emission_rule(const World& world, const TestSetup& setup, double youngs_modulus, double poissons_ratio,
                           double thickness) {
    if (!(youngs_modulus > 0.0) || !(poissons_ratio > -1.0)) {
        throw InputError(fmt::format(
            "found E = {:.4g} and nu = {:.4g} of the linear solution, expected E > 0 and nu > -1, which particles "
            "along the sides give",
            youngs_modulus, poissons_ratio));
    }
    EmissionRule rule;
    double mass = 0.0, diameters = 0.0;
    std::int64_t particles = 0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        if (setup.is_platen(static_cast<BodyIndex>(b))) continue;
        const double own = world.bodies.inertia[b].mass;
        const double area = own / world.settings.materials[world.bodies.info(b).material].density;
        mass += own;
        diameters += 2.0 * std::sqrt(area / std::numbers::pi);
        ++particles;
    }
    rule.diameter = diameters / static_cast<double>(particles);
    rule.density = mass / (setup.width * setup.height);
    const double shear_modulus = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
    rule.shear_wave_speed = std::sqrt(shear_modulus / rule.density);
    rule.damping_ratio = mean_damping_ratio(world, setup);
    rule.thickness = world.settings.units == StiffnessUnits::area ? thickness : 1.0;
    return rule;
}

bool EmissionListener::is_source(const OpenEvent& open, BodyIndex body) const {
    return std::ranges::binary_search(open.bodies, body);
}

std::size_t EmissionListener::listen(std::span<const BreakEvent> breaks, double axial_strain) {
    const double now = breaks.empty() ? time_of_last_pass(world_) : breaks.front().time;
    const std::size_t ended = end_if(now);
    for (const BreakEvent& one : breaks) add_break(event_of(one, axial_strain), one, breaks);
    if (changed_ || list_builds_ != world_.list.builds) find_surfaces();
    for (std::size_t k = 0; k < emission_.open.size(); ++k) {
        AcousticEvent& event = emission_.open[k].event;
        const MomentTensor moment = moment_of(emission_.open[k], surfaces_[k]);
        if (!(scalar_moment(moment) > scalar_moment(event.moment))) continue;
        event.moment = moment;
        event.rise_time = now - event.time;
    }
    return ended;
}

std::size_t EmissionListener::end_all() { return end_if(std::numeric_limits<double>::infinity()); }

std::size_t EmissionListener::end_if(double now) {
    const auto over = [&](const OpenEvent& open) { return now > open.event.time + open.event.duration; };
    const std::size_t before = emission_.events.size();
    for (const OpenEvent& open : emission_.open)
        if (over(open)) emission_.events.push_back(open.event);
    std::erase_if(emission_.open, over);
    const std::size_t ended = emission_.events.size() - before;
    changed_ = changed_ || ended > 0;
    return ended;
}

OpenEvent& EmissionListener::event_of(const BreakEvent& one, double axial_strain) {
    for (OpenEvent& open : emission_.open)
        if (norm(one.position - open.event.centre) <= open.event.radius) return open;
    OpenEvent begun;
    begun.event.time = one.time;
    begun.event.axial_strain = axial_strain;
    return emission_.open.emplace_back(begun);
}

void EmissionListener::add_break(OpenEvent& open, const BreakEvent& one, std::span<const BreakEvent> breaks) {
    changed_ = true;
    AcousticEvent& event = open.event;
    open.places.push_back(one.position);
    open.last = one.time;
    event.breaks += 1;
    event.breaks_in_shear += one.shear_mode ? 1 : 0;
    event.energy += one.energy;
    Vec2 sum;
    for (const Vec2 place : open.places) sum = sum + place;
    event.centre = (1.0 / static_cast<double>(open.places.size())) * sum;
    double farthest = 0.0;
    for (const Vec2 place : open.places) farthest = std::max(farthest, norm(place - event.centre));
    event.radius = emission_.rule.diameter + farthest;
    event.duration = open.last - event.time + emission_.rule.window(event.radius);
    for (const BodyIndex body : {one.point.body_i, one.point.body_j})
        if (!setup_.is_platen(body) && !is_source(open, body)) add_body(open, body, breaks);
}

void EmissionListener::add_body(OpenEvent& open, BodyIndex body, std::span<const BreakEvent> breaks) {
    const auto& pairs = world_.points.contact.pairs;
    const PointIndex walls = world_.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    for (PointIndex k = 0; k < pairs.size(); ++k) {
        const bool of_i = pairs[k].body_i == body, of_j = k < walls && pairs[k].body_j == body;
        if (!of_i && !of_j) continue;
        // What lies between two source bodies does not count, and never will again.
        if (k < walls && is_source(open, of_i ? pairs[k].body_j : pairs[k].body_i)) continue;
        const PointKind kind = kind_of_point(world_, k);
        const ContactPoint point = world_.points.contact[k];
        const PointLoad load = load_of_last_pass(world_, k);
        Vec2 force = load.force;
        for (const BreakEvent& one : breaks)
            if (one.kind == kind && same_point(kind, one.point, point)) force = force_of_break(one, load.normal);
        if (force != Vec2{}) open.before.push_back({kind, point, force, load.place});
    }
    open.bodies.insert(std::ranges::lower_bound(open.bodies, body), body);
    std::erase_if(open.before, [&](const EarlierForce& earlier) {
        return earlier.kind != PointKind::element_wall && is_source(open, earlier.point.body_i) &&
               is_source(open, earlier.point.body_j);
    });
    std::ranges::sort(open.before, [](const EarlierForce& a, const EarlierForce& b) {
        return comes_before(a, b.kind, key_of(b.kind, b.point));
    });
}

void EmissionListener::find_surfaces() {
    list_builds_ = world_.list.builds;
    changed_ = false;
    surfaces_.assign(emission_.open.size(), {});
    marks_.assign(world_.bodies.size(), 0);
    for (const OpenEvent& open : emission_.open)
        for (const BodyIndex body : open.bodies) marks_[body] = 1;
    const auto& pairs = world_.points.contact.pairs;
    const PointIndex walls = world_.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    std::vector<PointIndex> near;
    for (PointIndex k = 0; k < pairs.size(); ++k)
        if (marks_[pairs[k].body_i] != 0 || (k < walls && marks_[pairs[k].body_j] != 0)) near.push_back(k);
    for (std::size_t n = 0; n < emission_.open.size(); ++n) {
        const OpenEvent& open = emission_.open[n];
        std::vector<bool> listed(open.before.size(), false);
        for (const PointIndex k : near) {
            const bool of_i = is_source(open, pairs[k].body_i), of_j = k < walls && is_source(open, pairs[k].body_j);
            if (of_i == of_j) continue;
            const PointKind kind = kind_of_point(world_, k);
            const ContactPoint point = world_.points.contact[k];
            const auto found = find_earlier(open.before, kind, point);
            const auto at = static_cast<std::size_t>(found - open.before.cbegin());
            const bool bore = found != open.before.cend();
            if (bore) listed[at] = true;
            surfaces_[n].points.push_back({k, of_i, bore ? at : bore_nothing});
        }
        for (std::size_t k = 0; k < listed.size(); ++k)
            if (!listed[k]) surfaces_[n].gone.push_back(k);
    }
}

MomentTensor EmissionListener::moment_of(const OpenEvent& open, const Surface& surface) const {
    MomentTensor moment;
    for (const SurfacePoint& on : surface.points) {
        const PointLoad load = load_of_last_pass(world_, on.point);
        Vec2 change = load.force, place = load.place;
        if (on.before != bore_nothing) {
            change = change - open.before[on.before].force;
            place = open.before[on.before].place;
        }
        if (change != Vec2{}) moment.add(on.of_i ? -change : change, place - open.event.centre);
    }
    for (const std::size_t k : surface.gone) {
        const EarlierForce& earlier = open.before[k];
        moment.add(is_source(open, earlier.point.body_i) ? earlier.force : -earlier.force,
                   earlier.place - open.event.centre);
    }
    return moment;
}

}  // namespace crackle
