// SPDX-License-Identifier: GPL-3.0-or-later
// Builds a world from a scene: orders bodies by position, transforms outlines into body frames, and derives contact
// laws from material pairs.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "solver/contact/joint_law.hpp"
#include "solver/geometry/flat_faces.hpp"
#include "solver/linear/step_bound.hpp"
#include "solver/measure/outside.hpp"
#include "solver/scene/convex_pieces.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/time_step.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

/// Diameter of a disc with the same radius of gyration as the body, m.
double equivalent_diameter(const MassProperties& body) { return std::sqrt(8.0 * body.moment / body.mass); }

/// Scene indices of bodies, sorted in rows along the shorter side of the scene; the height of a row is the median
/// diameter. Consecutive bodies then have consecutive neighbours in the same row and in the next. For a million discs a
/// step takes 0.6 times as long as with Morton order, because memory is read in an order that the processor predicts.
std::vector<std::uint32_t> spatial_order(const std::vector<MassProperties>& properties) {
    Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
    std::vector<double> diameters;
    for (const MassProperties& p : properties) {
        low = {std::min(low.x, p.centroid.x), std::min(low.y, p.centroid.y)};
        high = {std::max(high.x, p.centroid.x), std::max(high.y, p.centroid.y)};
        diameters.push_back(equivalent_diameter(p));
    }
    const auto middle = diameters.begin() + static_cast<std::ptrdiff_t>(diameters.size() / 2);
    if (diameters.empty()) return {};
    std::nth_element(diameters.begin(), middle, diameters.end());
    const bool upright = high.y - low.y >= high.x - low.x;
    struct Place {
        double row, along;
        auto operator<=>(const Place&) const = default;
    };
    std::vector<Place> places;
    for (const MassProperties& p : properties) {
        const Vec2 c = p.centroid - low;
        places.push_back({std::floor((upright ? c.y : c.x) / *middle), upright ? c.x : c.y});
    }
    std::vector<std::uint32_t> order(properties.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return places[a] < places[b]; });
    return order;
}

Edge edge_between(Vec2 a, Vec2 b) {
    const double length = norm(b - a);
    return {a.x, a.y, (b.x - a.x) / length, (b.y - a.y) / length, length};
}

std::vector<std::vector<std::uint32_t>> pieces_of(int id, std::span<const Vec2> frame) {
    try {
        return convex_pieces(frame);
    } catch (const InputError& error) {
        throw InputError(fmt::format("body {}: {}", id, error.what()));
    }
}

/// Sets Edge::cone for the edges of a convex piece. @param ring the edges of the piece, counter-clockwise
void set_cones(std::span<Edge> ring) {
    for (std::size_t e = 0; e < ring.size(); ++e) {
        Edge &edge = ring[e], &next = ring[(e + 1) % ring.size()];
        const double sine = edge.tx * next.ty - edge.ty * next.tx, cosine = edge.tx * next.tx + edge.ty * next.ty;
        // If the outline continues straight, no point has this corner as its closest point.
        const double cotangent = sine > 0.0 ? cosine / sine : std::numeric_limits<double>::max();
        edge.cone[1] = -cotangent;
        next.cone[0] = cotangent;
    }
}

void add_pieces(World& world, const BodyName& name, BodyShape& shape, std::span<const Vec2> frame) {
    shape.first_piece = static_cast<std::uint32_t>(world.bodies.pieces.size());
    const auto next_edge = [&] { return static_cast<std::uint32_t>(world.bodies.edges.size()); };
    if (name.closed) {
        for (const std::vector<std::uint32_t>& ring : pieces_of(name.id, frame)) {
            world.bodies.pieces.push_back({next_edge(), static_cast<std::uint32_t>(ring.size()), true});
            for (std::size_t k = 0; k < ring.size(); ++k) {
                world.bodies.edges.push_back(edge_between(frame[ring[k]], frame[ring[(k + 1) % ring.size()]]));
            }
            set_cones(std::span(world.bodies.edges).last(ring.size()));
        }
    } else {
        for (std::size_t k = 0; k + 1 < frame.size(); ++k) {
            world.bodies.pieces.push_back({next_edge(), 1, false});
            world.bodies.edges.push_back(edge_between(frame[k], frame[k + 1]));
        }
    }
    shape.piece_count = static_cast<std::uint32_t>(world.bodies.pieces.size()) - shape.first_piece;
}

/// Sets Edge::outline_of for outlines that are one convex piece. For these outlines, kernels need no search as long as
/// the edge faced last is still the closest edge.
void mark_outlines(World& world) {
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyInfo info = world.bodies.info(b);
        if (info.piece_count != 1 || !world.bodies.pieces[info.first_piece].closed) continue;
        const Piece& piece = world.bodies.pieces[info.first_piece];
        for (std::uint32_t e = 0; e < piece.edge_count; ++e)
            world.bodies.edges[piece.first_edge + e].outline_of = static_cast<BodyIndex>(b);
    }
    world.bodies.convex_outlines = std::all_of(world.bodies.edges.begin(), world.bodies.edges.end(),
                                               [](const Edge& edge) { return edge.outline_of != no_body; });
}

/// Adds the elements of a body: the vertices of a chain, or the circles of a clump. The radii of vertices follow from
/// the thickness.
void add_elements(World& world, const Scene& scene, const Body& body, const MassProperties& properties,
                  const BodyName& name, BodyState& state) {
    BodyShape shape{};
    shape.moment = properties.moment;
    shape.first_element = static_cast<std::uint32_t>(world.bodies.elements.size());
    shape.element_count = body.circle_count + body.vertex_count;
    for (std::uint32_t k = 0; k < body.circle_count; ++k) {
        const CircleElement& circle = scene.circles[body.first_circle + k];
        const Vec2 offset = circle.centre - properties.centroid;
        world.bodies.elements.push_back({offset.x, offset.y, circle.radius, scene.thick});
        shape.reach = std::max(shape.reach, norm(offset) + circle.radius);
    }
    if (!scene.edge_sides.empty()) {
        world.bodies.element_sides.resize(world.bodies.elements.size(), no_side);
        const auto own = std::span(scene.edge_sides).subspan(body.first_vertex, body.vertex_count);
        world.bodies.element_sides.insert(world.bodies.element_sides.end(), own.begin(), own.end());
    }
    std::vector<Vec2> frame;
    for (std::uint32_t k = 0; k < body.vertex_count; ++k) {
        const Vec2 offset = scene.vertices[body.first_vertex + k] - properties.centroid;
        frame.push_back(offset);
        world.bodies.elements.push_back({offset.x, offset.y, 0.5 * scene.thick, 0.5 * scene.thick});
        shape.reach = std::max(shape.reach, norm(offset));
    }
    if (!frame.empty()) {
        state.angle = correctly_rounded::atan2(frame[1].y - frame[0].y, frame[1].x - frame[0].x);
        add_pieces(world, name, shape, frame);
    }
    world.bodies.shapes.push_back(shape);
}

/// Adds the segments for the DEMseg guide's segment law, which uses the outline itself instead of its convex pieces.
void add_segments(World& world, const BodyInfo& info) {
    for (std::uint32_t e = 0; e < info.element_count; ++e) {
        const Element& a = world.bodies.elements[info.first_element + e];
        const bool last = e + 1 == info.element_count;
        if (info.piece_count == 0 || (last && !info.closed)) {
            world.bodies.segments.push_back({a.x, a.y, 1.0, 0.0, 0.0});
            continue;
        }
        const Element& b = world.bodies.elements[info.first_element + (last ? 0 : e + 1)];
        world.bodies.segments.push_back(edge_between({a.x, a.y}, {b.x, b.y}));
    }
}

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Sets upper bounds on inverse masses and lever arms. Driving a body can only reduce its inverse masses. A contact
/// position lies within the overlap, and thus within the bounding radius of both bodies; 10 % is added for extreme
/// overlaps.
void bound_pushes(Bodies& bodies) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const BodyInertia& inertia = bodies.inertia[b];
        const double reach = 1.1 * bodies.info(b).reach;
        const double inverse_mass = std::max(inertia.inverse_mass_x, inertia.inverse_mass_y);
        bodies.push_bound.push_back({infinite, inverse_mass + inertia.inverse_moment * reach * reach, reach});
    }
}

void add_body(World& world, const Scene& scene, const Body& body, const MassProperties& properties) {
    const bool single_circle = body.circle_count == 1;
    const BodyName name{body.id, static_cast<std::uint16_t>(body.material), body.closed,
                        single_circle ? no_shape : static_cast<std::uint32_t>(world.bodies.shapes.size())};
    BodyState state{
        properties.centroid.x, properties.centroid.y, body.velocity.x, body.velocity.y, body.spin, {1.0, 0.0}, 0.0};
    if (body.circle_count > 0) state.angle = scene.circles[body.first_circle].angle;
    if (single_circle) {
        state.x = scene.circles[body.first_circle].centre.x;
        state.y = scene.circles[body.first_circle].centre.y;
        state.shape[0] = scene.circles[body.first_circle].radius;
    } else {
        add_elements(world, scene, body, properties, name, state);
    }
    world.bodies.state.push_back(state);
    world.bodies.inertia.push_back(
        {1.0 / properties.mass, 1.0 / properties.mass, 1.0 / properties.moment, properties.mass});
    world.bodies.names.push_back(name);
    if (!single_circle && world.settings.segment_law != SegmentLaw::rounded)
        add_segments(world, world.bodies.info(world.bodies.size() - 1));
}

/// Combined value k = 2k₁k₂/(k₁+k₂) of two springs in series, twice the series stiffness. Equal values are returned
/// unchanged, since the formula could change the last bit.
double in_series(double a, double b) { return a == b ? a : 2.0 * a * b / (a + b); }

/// Makes the bonds of a law unbreakable.
void hold(ContactLaw& law) {
    law.break_overlap = -infinite;
    law.tensile_strength = law.cohesion = infinite;
}

ContactLaw law_between(const Material& a, const Material& b, const MaterialPair& pair, const Settings& settings) {
    ContactLaw law{};
    law.normal_stiffness = pair.normal_stiffness.value_or(in_series(a.normal_stiffness, b.normal_stiffness));
    law.shear_stiffness = pair.shear_stiffness.value_or(in_series(a.shear_stiffness, b.shear_stiffness));
    // A material's damping ratio defines dashpots for its own stiffness; the dashpots of two materials act in series.
    const auto ratio_term = [](const Material& m, double stiffness) {
        return m.damping_ratio ? 2.0 * *m.damping_ratio * std::sqrt(stiffness) : 0.0;
    };
    law.normal_damping_ratio_term = in_series(ratio_term(a, a.normal_stiffness), ratio_term(b, b.normal_stiffness));
    law.shear_damping_ratio_term = in_series(ratio_term(a, a.shear_stiffness), ratio_term(b, b.shear_stiffness));
    const double ratio = in_series(a.damping_ratio.value_or(0.0), b.damping_ratio.value_or(0.0));
    if (pair.normal_stiffness) law.normal_damping_ratio_term = 2.0 * ratio * std::sqrt(law.normal_stiffness);
    if (pair.shear_stiffness) law.shear_damping_ratio_term = 2.0 * ratio * std::sqrt(law.shear_stiffness);
    law.normal_damping = in_series(a.damping_ratio ? 0.0 : a.normal_damping, b.damping_ratio ? 0.0 : b.normal_damping);
    law.shear_damping = in_series(a.damping_ratio ? 0.0 : a.shear_damping, b.damping_ratio ? 0.0 : b.shear_damping);
    const double angle = pair.friction_angle.value_or(std::min(a.friction_angle, b.friction_angle));
    law.friction = law.bond_friction = friction_coefficient(angle);
    for (const BondConstant& constant : facts_of(settings.bond_law).constants) {
        const std::optional<double> weaker =
            std::min(a.bond_constants().*constant.given, b.bond_constants().*constant.given);
        const double value = (pair.bond.*constant.given).value_or(*weaker);
        law.*constant.of_law = constant.in_law(constant.is_angle ? std::min(value, angle) : value);
    }
    if (settings.intact.no_sliding) law.friction = infinite;
    if (settings.intact.no_breaking) hold(law);
    return law;
}

/// The scene's entry for a pair of materials; an empty entry if the scene has none.
MaterialPair pair_of(const Scene& scene, std::size_t a, std::size_t b) {
    const std::pair<int, int> wanted = std::minmax(static_cast<int>(a), static_cast<int>(b));
    for (const MaterialPair& pair : scene.material_pairs)
        if (std::pair<int, int>(std::minmax(pair.a, pair.b)) == wanted) return pair;
    return {};
}

/// Builds the contact laws in the order required by Settings::laws.
void build_laws(World& world, const Scene& scene) {
    Settings& settings = world.settings;
    const std::vector<Material>& materials = settings.materials;
    for (std::size_t b = 0; b < materials.size(); ++b)
        for (std::size_t a = 0; a <= b; ++a)
            settings.laws.push_back(law_between(materials[a], materials[b], pair_of(scene, a, b), settings));
    for (std::size_t pair = 0; pair < settings.pair_count(); ++pair) {
        ContactLaw law = settings.laws[pair];
        hold(law);
        law.friction = infinite;  // a point with an unbreakable bond never slides
        settings.laws.push_back(law);
    }
    // A domain wall has the stiffness, damping and friction of the body that touches it.
    for (const Material& a : materials) settings.laws.push_back(law_between(a, a, {}, settings));
    derive_joint_laws(settings);
    if (world.settings.laws.size() > std::numeric_limits<std::uint16_t>::max()) {
        throw InputError(settings.joints.empty()
                             ? fmt::format("materials: found {}, expected at most 255", settings.materials.size())
                             : fmt::format("joints: found {} joints with {} materials, which need {} contact laws, "
                                           "expected at most {} laws; use fewer joints or materials",
                                           settings.joints.size(), settings.materials.size(), settings.laws.size(),
                                           std::numeric_limits<std::uint16_t>::max()));
    }
}

void rank_by_size(World& world) {
    const std::size_t n = world.bodies.size();
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return world.bodies.info(a).reach > world.bodies.info(b).reach;
    });
    world.list.size_rank.resize(n);
    for (std::size_t r = 0; r < n; ++r) world.list.size_rank[order[r]] = static_cast<std::uint32_t>(r);
    if (world.list.skin == 0.0)
        world.list.skin = world.list.widest_skin = skin_share * world.bodies.info(order[n / 2]).reach;
    world.list.fastest_allowed_move = 0.5 * world.bodies.info(order[n - 1]).reach;
}

void refuse_bodies_outside(const World& world) {
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        if (!outside_domain(world, b)) continue;
        throw InputError(
            fmt::format("body {}: found its centroid at ({:.6g}, {:.6g}), beyond a wall of the domain, expected it "
                        "inside the domain; move the body, widen the domain, or hold the body fixed",
                        world.bodies.info(b).id, world.bodies.state[b].x, world.bodies.state[b].y));
    }
}

void choose_time_step(World& world, const Scene& scene) {
    world.stepping.automatic_step = scene.time_step == 0.0;
    if (world.stepping.automatic_step && !std::isfinite(world.stepping.step_bound)) {
        throw InputError(
            "time step: found 0 (automatic), expected a number > 0 in s; every body is held, so a time step cannot be "
            "derived");
    }
    world.stepping.time_step =
        world.stepping.automatic_step ? derived_step_share(world) * world.stepping.step_bound : scene.time_step;
    if (!world.stepping.automatic_step && !world.stepping.allow_unstable &&
        world.stepping.time_step > world.stepping.step_bound) {
        throw InputError(fmt::format(
            "time step: found {} s, expected at most the stable bound of this scene, {:.6g} s; give a smaller time "
            "step, leave it out to have it chosen automatically, or run with --allow-unstable to find the limit",
            world.stepping.time_step, world.stepping.step_bound));
    }
}

}  // namespace

World build_world(Scene scene) {
    validate(scene);
    World world;
    world.settings.materials = scene.materials;
    world.settings.joints = scene.joints;
    world.settings.trace_joints = scene.trace_joints;
    world.settings.domain = scene.domain;
    world.settings.thick = scene.thick;
    world.settings.segment_law = scene.segment_law;
    world.settings.integrator = scene.integrator;
    world.settings.bond_law = scene.bond_law;
    world.settings.units = scene.units;
    world.settings.gravity = scene.gravity;
    world.settings.driven_contacts = scene.driven_contacts;
    world.stepping.safety_factor = scene.safety_factor;
    world.stepping.step_scale = scene.step_scale;
    world.stepping.allow_unstable = scene.allow_unstable;
    world.settings.intact = scene.intact;
    world.workers.threads = scene.threads;
    world.workers.blocks_done.assign(static_cast<std::size_t>(scene.threads), 0);
    world.list.skin = scene.skin;
    world.stepping.kick_share = scene.first_kick == FirstKick::full ? 1.0 : 0.5;

    std::vector<MassProperties> properties;
    properties.reserve(scene.bodies.size());
    for (const Body& body : scene.bodies) properties.push_back(mass_properties(scene, body));
    const std::vector<std::uint32_t> order = spatial_order(properties);
    std::vector<BodyIndex> internal_of(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        internal_of[order[k]] = static_cast<BodyIndex>(k);
        add_body(world, scene, scene.bodies[order[k]], properties[order[k]]);
    }
    mark_outlines(world);
    if (!scene.trace_pieces.empty()) lay_flat_faces(world, scene.trace_pieces);
    world.bodies.state.shrink_to_fit();
    world.bodies.inertia.shrink_to_fit();
    world.bodies.names.shrink_to_fit();
    world.bodies.shapes.shrink_to_fit();
    world.bodies.elements.shrink_to_fit();
    world.bodies.element_sides.shrink_to_fit();
    world.bodies.pieces.shrink_to_fit();
    world.bodies.edges.shrink_to_fit();
    if (world.settings.integrator == Integrator::consistent) {
        world.account.opening_defects.assign(world.bodies.size(), 0.0);
        world.bodies.last_force.assign(world.bodies.size(), BodyForce{});
        bound_pushes(world.bodies);
    }
    world.bodies.force.assign(world.bodies.size(), BodyForce{});
    build_laws(world, scene);
    rank_by_size(world);
    // Controls must be built first, since the inverse masses of driven bodies affect m_eff and the stable bound.
    build_controls(world, scene, internal_of);
    refuse_bodies_outside(world);
    refresh_neighbours(world);
    choose_time_step(world, scene);
    build_controls(world, scene, internal_of);  // built again, since ramp velocities depend on the time step
    return world;
}

}  // namespace crackle
