// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/emission/listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/linear/springs.hpp"
#include "solver/measure/last_pass.hpp"
#include "solver/world/point_order.hpp"

namespace crackle {
namespace {

constexpr std::size_t bore_nothing = static_cast<std::size_t>(-1);

// The places where bodies bear load have indices: first all contact points, then two for the two ends of each face.

PointIndex count_places(const World& world) {
    return static_cast<PointIndex>(world.points.size() + 2 * world.faces.size());
}

bool is_face(const World& world, PointIndex k) { return k >= world.points.size(); }

/// Number of an end among those of all faces: twice the face, plus 1 for the end in the direction of t.
PointIndex end_of(const World& world, PointIndex k) { return k - static_cast<PointIndex>(world.points.size()); }

bool is_wall(const World& world, PointIndex k) {
    return !is_face(world, k) && k >= world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
}

ContactPoint contact_of_place(const World& world, PointIndex k) {
    if (!is_face(world, k)) return world.points.contact[k];
    const BodyPair pair = world.faces.bodies[end_of(world, k) / 2];
    return {pair.body_i, pair.body_j, end_of(world, k), end_of(world, k)};
}

bool bore(const World& world, PointIndex k) {
    return is_face(world, k) ? face_bore_in_last_pass(world, end_of(world, k) / 2) : bore_in_last_pass(world, k);
}

PointLoad load_of_place(const World& world, PointIndex k) {
    if (!is_face(world, k)) return load_of_last_pass(world, k);
    return end_load_of_last_pass(world, end_of(world, k) / 2, end_of(world, k) % 2 == 0);
}

PointKind kind_of_place(const World& world, PointIndex k) {
    if (is_face(world, k)) return PointKind::bonded_face;
    int kind = 0;
    while (k >= world.points.kind_begin[static_cast<std::size_t>(kind) + 1]) ++kind;
    return static_cast<PointKind>(kind);
}

bool comes_before(const EarlierForce& a, PointKind kind, const PointKey& key) {
    return a.kind != kind ? a.kind < kind : key_of(kind, a.point) < key;
}

/// Finds a point in a list sorted by kind and key. @return the end of the list if the point is not in it
std::vector<EarlierForce>::const_iterator find_earlier(const std::vector<EarlierForce>& before, PointKind kind,
                                                       const ContactPoint& point) {
    const PointKey key = key_of(kind, point);
    const auto at = std::partition_point(before.begin(), before.end(),
                                         [&](const EarlierForce& one) { return comes_before(one, kind, key); });
    return at != before.end() && at->kind == kind && key_of(kind, at->point) == key ? at : before.end();
}

bool is_source(const OpenEvent& open, BodyIndex body) { return std::ranges::binary_search(open.bodies, body); }

/// Whether a break is that of the bond at a place.
bool broke_at(const BreakEvent& one, PointKind kind, const ContactPoint& place) {
    if (one.kind != kind) return false;
    return kind == PointKind::bonded_face ? one.point.element_i == place.element_i / 2
                                          : same_point(kind, one.point, place);
}

/// Force on body_i just before its bond broke, N, as stored with the break; half of it at either end of a face. The
/// moment of a broken face is not stored; it counts only at platens, since both grains of another face belong to the
/// source.
Vec2 force_of_break(const BreakEvent& one, Vec2 normal) {
    const double share = one.kind == PointKind::bonded_face ? 0.5 : 1.0;
    return share * (one.shear_force * perpendicular(normal) - one.normal_force * normal);
}

double mean_damping_ratio(const World& world, const PlacedApparatus& apparatus) {
    double sum = 0.0;
    std::int64_t count = 0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint point = world.points.contact[k];
        if ((world.points.state[k].flags & point_bonded) == 0 || apparatus.is_platen(point.body_i) ||
            apparatus.is_platen(point.body_j))
            continue;
        // With m the square root of the effective mass, the critical dashpot is 2 sqrt(k_n) m. Damping ratios are
        // stored as dashpots divided by m.
        const ContactLaw& law = world.settings.laws[world.points.state[k].law];
        const double mass = root_mass_of(world, k);
        sum += (law.normal_damping + law.normal_damping_ratio_term * mass) /
               (2.0 * std::sqrt(law.normal_stiffness) * mass);
        ++count;
    }
    for (FaceIndex k = 0; k < world.faces.size(); ++k) {
        const BodyPair pair = world.faces.bodies[k];
        if (apparatus.is_platen(pair.body_i) || apparatus.is_platen(pair.body_j)) continue;
        sum += world.faces.law_of(k).damping_ratio;
        ++count;
    }
    return sum / static_cast<double>(count);
}

}  // namespace

double mean_field_shear_modulus(const World& world, const TestSetup& setup) {
    std::vector<BodyMotion> shear(world.bodies.size());  // motion for a shear strain of 1
    for (std::size_t b = 0; b < shear.size(); ++b)
        shear[b] = {0.5 * world.bodies.state[b].y, 0.5 * world.bodies.state[b].x, 0.0};
    double twice_energy = 0.0;
    for (const Spring& spring : springs_of(world, ClosedPoints::bonded)) {
        if (setup.apparatus.is_platen(spring.i) || setup.apparatus.is_platen(spring.j)) continue;
        twice_energy += spring.stiffness * times(spring, spring.push, shear) * times(spring, spring.gradient, shear);
    }
    for (FaceIndex k = 0; k < world.faces.size(); ++k) {
        const auto [i, j] = world.faces.bodies[k];
        if (setup.apparatus.is_platen(i) || setup.apparatus.is_platen(j)) continue;
        const FaceSprings springs = world.faces.springs[k];
        const Vec2 normal = world.faces.motion[k].normal, apart{shear[j].x - shear[i].x, shear[j].y - shear[i].y};
        const double opening = dot(apart, normal), sliding = dot(apart, perpendicular(normal));
        twice_energy += springs.normal * opening * opening + springs.shear * sliding * sliding;
    }
    return twice_energy / setup.specimen.area;
}

EmissionRule emission_rule(const World& world, const TestSetup& setup, double youngs_modulus, double poissons_ratio,
                           double thickness) {
    EmissionRule rule;
    rule.mean_field = !setup.apparatus.uniaxial || std::isnan(youngs_modulus) || std::isnan(poissons_ratio);
    const double shear_modulus =
        rule.mean_field ? mean_field_shear_modulus(world, setup) : youngs_modulus / (2.0 * (1.0 + poissons_ratio));
    if (!(shear_modulus > 0.0)) {
        throw InputError(
            fmt::format("found a shear modulus of {:.4g} N/m, expected one above 0: it follows from E = {:.4g} and nu "
                        "= {:.4g} of the linear solution",
                        shear_modulus, youngs_modulus, poissons_ratio));
    }
    double mass = 0.0, diameters = 0.0;
    std::int64_t particles = 0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        if (setup.apparatus.is_platen(static_cast<BodyIndex>(b))) continue;
        const double own = world.bodies.inertia[b].mass;
        const double area = own / world.settings.materials[world.bodies.info(b).material].density;
        mass += own;
        diameters += 2.0 * std::sqrt(area / std::numbers::pi);
        ++particles;
    }
    rule.diameter = diameters / static_cast<double>(particles);
    rule.density =
        mass / (setup.apparatus.uniaxial ? setup.specimen.width * setup.specimen.height : setup.specimen.area);
    rule.shear_wave_speed = std::sqrt(shear_modulus / rule.density);
    rule.damping_ratio = mean_damping_ratio(world, setup.apparatus);
    rule.thickness = world.settings.units == StiffnessUnits::area ? thickness : 1.0;
    return rule;
}

std::size_t EmissionListener::listen(std::span<const BreakEvent> breaks, double axial_strain) {
    const double now = breaks.empty() ? time_of_last_pass(world_) : breaks.front().time;
    const std::size_t ended = end_before(now);
    if (emission_.open.empty() && breaks.empty()) return ended;
    if (list_builds_ != world_.list.builds) list_points();
    for (const BreakEvent& one : breaks) add_break(event_of(one, axial_strain), one, breaks);
    for (std::size_t k = 0; k < emission_.open.size(); ++k) {
        if (!surfaces_[k].found) surfaces_[k] = surface_of(emission_.open[k]);
        AcousticEvent& event = emission_.open[k].event;
        const MomentTensor moment = moment_of(emission_.open[k], surfaces_[k]);
        if (!(scalar_moment(moment) > scalar_moment(event.moment))) continue;
        event.moment = moment;
        event.rise_time = now - event.time;
    }
    return ended;
}

std::size_t EmissionListener::end_all() { return end_before(std::numeric_limits<double>::infinity()); }

std::size_t EmissionListener::end_before(double now) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < emission_.open.size(); ++k) {
        const AcousticEvent& event = emission_.open[k].event;
        if (now > event.time + event.duration) {
            emission_.events.push_back(event);
            continue;
        }
        if (kept != k) {
            emission_.open[kept] = std::move(emission_.open[k]);
            surfaces_[kept] = std::move(surfaces_[k]);
        }
        ++kept;
    }
    const std::size_t ended = emission_.open.size() - kept;
    emission_.open.resize(kept);
    surfaces_.resize(kept);
    return ended;
}

std::size_t EmissionListener::event_of(const BreakEvent& one, double axial_strain) {
    for (std::size_t k = 0; k < emission_.open.size(); ++k) {
        const AcousticEvent& event = emission_.open[k].event;
        if (norm(one.position - event.centre) <= event.radius) return k;
    }
    OpenEvent begun;
    begun.event.time = one.time;
    begun.event.axial_strain = axial_strain;
    emission_.open.push_back(std::move(begun));
    surfaces_.emplace_back();
    return emission_.open.size() - 1;
}

void EmissionListener::add_break(std::size_t number, const BreakEvent& one, std::span<const BreakEvent> breaks) {
    OpenEvent& open = emission_.open[number];
    AcousticEvent& event = open.event;
    open.places.push_back(one.position);
    event.breaks += 1;
    event.breaks_in_shear += one.shear_mode ? 1 : 0;
    event.energy += one.energy;
    Vec2 sum;
    for (const Vec2 place : open.places) sum = sum + place;
    event.centre = (1.0 / static_cast<double>(open.places.size())) * sum;
    double farthest = 0.0;
    for (const Vec2 place : open.places) farthest = std::max(farthest, norm(place - event.centre));
    event.radius = emission_.rule.diameter + farthest;
    event.duration = one.time - event.time + emission_.rule.window(event.radius);
    for (const BodyIndex body : {one.point.body_i, one.point.body_j}) {
        if (setup_.apparatus.is_platen(body) || is_source(open, body)) continue;
        add_body(open, body, breaks);
        surfaces_[number].found = false;
    }
}

void EmissionListener::add_body(OpenEvent& open, BodyIndex body, std::span<const BreakEvent> breaks) {
    for (const PointIndex k : points_of(body)) {
        const ContactPoint point = contact_of_place(world_, k);
        // Points between two source bodies are permanently excluded.
        if (!is_wall(world_, k) && is_source(open, point.body_i == body ? point.body_j : point.body_i)) continue;
        const PointKind kind = kind_of_place(world_, k);
        const auto broke =
            std::ranges::find_if(breaks, [&](const BreakEvent& one) { return broke_at(one, kind, point); });
        if (broke == breaks.end() && !bore(world_, k)) continue;
        const PointLoad load = load_of_place(world_, k);
        const Vec2 force = broke == breaks.end() ? load.force : force_of_break(*broke, load.normal);
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

void EmissionListener::list_points() {
    list_builds_ = world_.list.builds;
    for (Surface& surface : surfaces_) surface.found = false;
    points_begin_.assign(world_.bodies.size() + 1, 0);
    const auto visit = [&](auto&& with) {
        for (PointIndex k = 0; k < count_places(world_); ++k) {
            const ContactPoint point = contact_of_place(world_, k);
            with(point.body_i, k);
            if (!is_wall(world_, k)) with(point.body_j, k);
        }
    };
    visit([&](BodyIndex b, PointIndex /*k*/) { ++points_begin_[b + 1]; });
    for (std::size_t b = 0; b < world_.bodies.size(); ++b) points_begin_[b + 1] += points_begin_[b];
    points_.resize(points_begin_.back());
    std::vector<PointIndex> next(points_begin_.begin(), points_begin_.end() - 1);
    visit([&](BodyIndex b, PointIndex k) { points_[next[b]++] = k; });
    marks_.assign(world_.bodies.size(), 0);
}

EmissionListener::PointRange EmissionListener::points_of(BodyIndex body) const {
    return PointRange(points_).subspan(points_begin_[body], points_begin_[body + 1] - points_begin_[body]);
}

EmissionListener::Surface EmissionListener::surface_of(const OpenEvent& open) {
    Surface surface;
    surface.found = true;
    std::vector<bool> listed(open.before.size(), false);
    for (const BodyIndex body : open.bodies) marks_[body] = 1;
    for (const BodyIndex body : open.bodies) {
        for (const PointIndex k : points_of(body)) {
            const ContactPoint point = contact_of_place(world_, k);
            const bool of_i = point.body_i == body;
            if (!is_wall(world_, k) && marks_[of_i ? point.body_j : point.body_i] != 0) continue;
            const PointKind kind = kind_of_place(world_, k);
            const auto found = find_earlier(open.before, kind, point);
            const auto at = static_cast<std::size_t>(found - open.before.cbegin());
            const bool loaded = found != open.before.cend();
            if (loaded) listed[at] = true;
            surface.points.push_back({k, of_i, loaded ? at : bore_nothing});
        }
    }
    for (const BodyIndex body : open.bodies) marks_[body] = 0;
    for (std::size_t k = 0; k < listed.size(); ++k)
        if (!listed[k]) surface.gone.push_back(k);
    return surface;
}

MomentTensor EmissionListener::moment_of(const OpenEvent& open, const Surface& surface) const {
    MomentTensor moment;
    for (const SurfacePoint& on : surface.points) {
        const bool loaded = on.before != bore_nothing, bears = bore(world_, on.point);
        if (!loaded && !bears) continue;
        const PointLoad load = bears ? load_of_place(world_, on.point) : PointLoad{};
        const EarlierForce* const earlier = loaded ? &open.before[on.before] : nullptr;
        const Vec2 change = loaded ? load.force - earlier->force : load.force;
        moment.add(on.of_i ? -change : change, (loaded ? earlier->place : load.place) - open.event.centre);
    }
    for (const std::size_t k : surface.gone) {
        const EarlierForce& earlier = open.before[k];
        moment.add(is_source(open, earlier.point.body_i) ? earlier.force : -earlier.force,
                   earlier.place - open.event.centre);
    }
    return moment;
}

}  // namespace crackle
