// SPDX-License-Identifier: GPL-3.0-or-later
// Computes mass properties of bodies, and validates scenes. All later code relies on these checks.

#include "solver/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <span>
#include <unordered_set>
#include <utility>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

[[noreturn]] void refuse(const std::string& where, double found, const std::string& expected) {
    throw InputError(fmt::format("{}: found {}, expected {}", where, found, expected));
}

void require_positive(const std::string& where, double value, const char* unit) {
    if (!(value > 0.0) || !is_a_size(value))
        refuse(where, value, fmt::format("a number from 1e-30 to 1e30 in {}", unit));
}

void require_not_negative(const std::string& where, double value, const char* unit) {
    if (!(value >= 0.0) || !is_a_size(value))
        refuse(where, value, fmt::format("0, or a number from 1e-30 to 1e30 in {}", unit));
}

void require_finite(const std::string& where, double value) {
    if (!std::isfinite(value)) refuse(where, value, "a finite number");
}

double signed_area(std::span<const Vec2> corners) {
    // The area is computed relative to the first corner, to keep full precision for a body far from the origin.
    double twice = 0.0;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        twice += cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    }
    return 0.5 * twice;
}

bool segments_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    const double abc = cross(b - a, c - a), abd = cross(b - a, d - a);
    const double cda = cross(d - c, a - c), cdb = cross(d - c, b - c);
    return ((abc > 0.0 && abd < 0.0) || (abc < 0.0 && abd > 0.0)) &&
           ((cda > 0.0 && cdb < 0.0) || (cda < 0.0 && cdb > 0.0));
}

MassProperties polygon_properties(std::span<const Vec2> corners, double density) {
    const Vec2 origin = corners[0];
    double area = 0.0, second_moment = 0.0;
    Vec2 first_moment;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const Vec2 a = corners[k] - origin, b = corners[k + 1] - origin;
        const double twice = cross(a, b);
        area += 0.5 * twice;
        first_moment = first_moment + (twice / 6.0) * (a + b);
        second_moment += twice / 12.0 * (dot(a, a) + dot(a, b) + dot(b, b));
    }
    const Vec2 offset = (1.0 / area) * first_moment;
    return {density * area, origin + offset, density * (second_moment - area * dot(offset, offset))};
}

MassProperties open_chain_properties(std::span<const Vec2> joints, double mass_per_length) {
    MassProperties result;
    for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
        const double mass = mass_per_length * norm(joints[k + 1] - joints[k]);
        result.mass += mass;
        result.centroid = result.centroid + (0.5 * mass) * (joints[k] + joints[k + 1] - 2.0 * joints[0]);
    }
    result.centroid = joints[0] + (1.0 / result.mass) * result.centroid;
    for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
        const double length = norm(joints[k + 1] - joints[k]);
        const Vec2 offset = 0.5 * (joints[k] + joints[k + 1]) - result.centroid;
        result.moment += mass_per_length * length * (length * length / 12.0 + dot(offset, offset));
    }
    return result;
}

MassProperties clump_properties(std::span<const CircleElement> circles, double density) {
    MassProperties result;
    for (const CircleElement& circle : circles) {
        const double mass = density * std::numbers::pi * circle.radius * circle.radius;
        result.mass += mass;
        result.centroid = result.centroid + mass * (circle.centre - circles[0].centre);
    }
    result.centroid = circles[0].centre + (1.0 / result.mass) * result.centroid;
    for (const CircleElement& circle : circles) {
        const double mass = density * std::numbers::pi * circle.radius * circle.radius;
        const Vec2 offset = circle.centre - result.centroid;
        result.moment += mass * (0.5 * circle.radius * circle.radius + dot(offset, offset));
    }
    return result;
}

/// Checks constants of bonds. @param whose owner of the friction angle, for the message @param friction_angle largest
/// residual friction angle, degrees
void validate_bond_constants(const std::string& name, const BondConstants& constants, const char* whose,
                             double friction_angle) {
    for (const BondConstant& constant : all_bond_constants()) {
        const std::optional<double> value = constants.*constant.given;
        if (!value) continue;
        const std::string what = name + constant.spoken();
        if (!constant.is_angle) require_not_negative(what, *value, "N");
        if (constant.is_angle && !(*value >= 0.0 && *value <= friction_angle))
            refuse(what, *value,
                   fmt::format("an angle from 0 to the friction angle{}, {:g} deg", whose, friction_angle));
    }
}

void validate_material(const Material& material, std::size_t index) {
    const std::string name = fmt::format("material {}: ", index + 1);
    require_positive(name + "density", material.density, "kg/m2");
    require_positive(name + "normal stiffness", material.normal_stiffness, "N/m");
    require_not_negative(name + "shear stiffness", material.shear_stiffness, "N/m");
    require_not_negative(name + "normal damping", material.normal_damping, "N s/m");
    require_not_negative(name + "shear damping", material.shear_damping, "N s/m");
    if (material.damping_ratio) require_not_negative(name + "damping ratio", *material.damping_ratio, "-");
    if (!(material.friction_angle >= 0.0 && material.friction_angle < 90.0)) {
        refuse(name + "friction angle", material.friction_angle, "degrees in 0 <= φ < 90");
    }
    validate_bond_constants(name, material.bond_constants(), "", material.friction_angle);
}

/// Refuses combinations of options that the bond laws and joints do not support.
void validate_laws(const Scene& scene) {
    const auto any_material = [&](auto has) { return std::ranges::any_of(scene.materials, has); };
    const auto any_pair = [&](auto has) { return std::ranges::any_of(scene.material_pairs, has); };
    const auto guide = [&] { return scene.segment_law != SegmentLaw::rounded; };
    const BondLawFacts& bonds = facts_of(scene.bond_law);
    const char* law = name_of(scene.bond_law);
    if (guide() && !bonds.with_guide_segments)
        throw InputError(fmt::format(
            "bond law: found {} with the DEMseg guide's segment law, expected the rounded segment law", law));
    if (bonds.sticks && (any_material([](const Material& m) { return m.shear_stiffness == 0.0; }) ||
                         any_pair([](const MaterialPair& p) { return p.shear_stiffness == 0.0; })))
        throw InputError(fmt::format(
            "shear stiffness: found 0 with {} bonds, expected a number > 0, because these bonds resist shear", law));
    for (const BondConstant& constant : all_bond_constants()) {
        if (bonds.constant(constant.key) != nullptr) continue;
        // A material always has a residual friction angle, which is 0 if not given.
        if (any_material(
                [&](const Material& m) { return !constant.is_angle && m.bond_constants().*constant.given > 0.0; }) ||
            any_pair([&](const MaterialPair& p) { return (p.bond.*constant.given).has_value(); }))
            throw InputError(fmt::format("materials: found a {} with {} bonds, expected the bond law {}",
                                         constant.spoken(), law, laws_with(&BondLawFacts::strengths_are_given)));
    }
    if (scene.units == StiffnessUnits::area) {
        if (guide())
            throw InputError(
                "units: found area units with the DEMseg guide's segment law, expected the rounded segment law");
        if (any_material([](const Material& m) {
                return !m.damping_ratio && (m.normal_damping > 0.0 || m.shear_damping > 0.0);
            }))
            throw InputError("materials: found dashpot coefficients in area units, expected a damping ratio");
    }
}

void validate_pairs(const Scene& scene) {
    std::set<std::pair<int, int>> seen;
    for (std::size_t k = 0; k < scene.material_pairs.size(); ++k) {
        const MaterialPair& pair = scene.material_pairs[k];
        const std::string name = fmt::format("material pair {}: ", k + 1);
        for (const int m : {pair.a, pair.b}) {
            if (m < 0 || static_cast<std::size_t>(m) >= scene.materials.size())
                refuse(name + "material", m + 1, fmt::format("1 to {}", scene.materials.size()));
        }
        if (!seen.insert(std::minmax(pair.a, pair.b)).second)
            throw InputError(fmt::format("{}found materials {} and {} a second time, expected one entry per pair", name,
                                         pair.a + 1, pair.b + 1));
        if (pair.normal_stiffness) require_positive(name + "normal stiffness", *pair.normal_stiffness, "N/m");
        if (pair.shear_stiffness) require_not_negative(name + "shear stiffness", *pair.shear_stiffness, "N/m");
        if (pair.friction_angle && !(*pair.friction_angle >= 0.0 && *pair.friction_angle < 90.0))
            refuse(name + "friction angle", *pair.friction_angle, "degrees in 0 <= φ < 90");
        const auto friction = [&](int m) { return scene.materials[static_cast<std::size_t>(m)].friction_angle; };
        validate_bond_constants(name, pair.bond, " of the pair",
                                pair.friction_angle.value_or(std::min(friction(pair.a), friction(pair.b))));
    }
}

/// Smallest friction angles among the materials that have faces on traces, degrees.
struct SmallestAngles {
    double bonded = 90.0, residual = 90.0;
};

/// Largest allowed aperture of a joint, m: the segment thickness in a mesh, the smallest radius among circles.
double farthest_apart(const Scene& scene) {
    if (scene.trace_pieces.empty()) return scene.thick;
    return std::ranges::min(scene.circles, {}, &CircleElement::radius).radius;
}

void validate_joint(const Scene& scene, const Joint& joint, const std::string& name, const SmallestAngles& rock) {
    const auto in_quadrant = [&](const char* what, double angle, double most) {
        if (!(angle >= 0.0 && angle <= most && angle < 90.0))
            refuse(name + what, angle, fmt::format("degrees from 0 to {:g}", std::min(most, 90.0)));
    };
    require_not_negative(name + "strength factor", joint.strength_factor, "-");
    if (joint.tensile_strength) require_not_negative(name + "tensile strength", *joint.tensile_strength, "Pa");
    if (joint.cohesion) require_not_negative(name + "cohesion", *joint.cohesion, "Pa");
    if (joint.normal_stiffness) require_positive(name + "normal stiffness", *joint.normal_stiffness, "Pa/m");
    if (joint.shear_stiffness) require_positive(name + "shear stiffness", *joint.shear_stiffness, "Pa/m");
    if (joint.friction_angle) in_quadrant("friction angle", *joint.friction_angle, 90.0);
    if (joint.residual_friction_angle)
        in_quadrant("residual friction angle", *joint.residual_friction_angle,
                    joint.friction_angle.value_or(rock.bonded));
    // With a larger dilation angle, a sliding joint would create energy.
    const double slides_at = joint.friction_angle.value_or(rock.residual);
    in_quadrant("dilation angle", joint.dilation_angle, joint.residual_friction_angle.value_or(slides_at));
    if (!(joint.dilation_slip > 0.0)) refuse(name + "dilation slip", joint.dilation_slip, "a length > 0 in m");
    require_not_negative(name + "aperture", joint.aperture, "m");
    if (joint.aperture > 0.0 && joint.bonded) refuse(name + "aperture", joint.aperture, "0 for a bonded joint");
    if (joint.aperture > farthest_apart(scene))
        refuse(name + "aperture", joint.aperture,
               scene.trace_pieces.empty()
                   ? fmt::format("at most the thickness of {} m, which is the gap between the faces", scene.thick)
                   : fmt::format("at most the radius of the smallest circle, {:.6g} m", farthest_apart(scene)));
}

/// Checks the straight parts of traces that lie between circles.
void validate_pieces(const Scene& scene) {
    if (scene.trace_pieces.empty()) return;
    const auto traces = std::ssize(scene.trace_joints);
    for (const TracePiece& piece : scene.trace_pieces) {
        const bool known = piece.trace >= 0 && piece.trace < traces;
        for (const double number : {piece.from.x, piece.from.y, piece.to.x, piece.to.y})
            require_finite("trace: place", number);
        if (!known || !(norm(piece.to - piece.from) > 0.0))
            throw InputError(
                fmt::format("traces: found a part of trace {} from ({}, {}) to ({}, {}), expected a length > 0 and a "
                            "trace number below {}",
                            piece.trace, piece.from.x, piece.from.y, piece.to.x, piece.to.y, traces));
    }
    const bool circles = std::ranges::any_of(scene.bodies, [](const Body& body) { return body.circle_count == 1; });
    const auto clump = std::ranges::find_if(scene.bodies, [](const Body& body) { return body.circle_count > 1; });
    if (clump != scene.bodies.end())
        throw InputError(fmt::format(
            "joints: found body {}, a clump, expected single circles; only these get flat faces along traces",
            clump->id));
    if (!circles) throw InputError("joints: found traces among circles but no circle, expected at least one circle");
}

void validate_joints(const Scene& scene) {
    if (scene.joints.empty() && scene.edge_sides.empty() && scene.trace_pieces.empty()) return;
    validate_pieces(scene);
    if (!scene.joints.empty() && (!facts_of(scene.bond_law).across_joints || scene.units != StiffnessUnits::area))
        throw InputError(
            fmt::format("joints: found another bond law or other units, expected the bond law {} and area units",
                        laws_with(&BondLawFacts::across_joints)));
    const auto joints = static_cast<std::int32_t>(scene.joints.size());
    if (std::ranges::any_of(scene.trace_joints, [&](std::int32_t j) { return j < -1 || j >= joints; }))
        throw InputError(
            fmt::format("traces: found a joint that does not exist, expected the index of a joint, which is below {}, "
                        "or -1 for a trace without a joint",
                        joints));
    const auto sides = 2 * static_cast<TraceSide>(scene.trace_joints.size());
    if ((!scene.edge_sides.empty() && scene.edge_sides.size() != scene.vertices.size()) ||
        std::ranges::any_of(scene.edge_sides, [&](TraceSide s) { return s < no_side || s >= sides; }))
        throw InputError(
            fmt::format("edges: found {} sides of traces for {} vertices, or a side of a trace that does not exist, "
                        "expected one existing side for each vertex",
                        scene.edge_sides.size(), scene.vertices.size()));
    SmallestAngles smallest;
    for (const Body& body : scene.bodies) {
        const bool circle = !scene.trace_pieces.empty() && body.circle_count == 1;
        const auto on_trace = [](TraceSide side) { return side != no_side; };
        const auto own_sides = [&] {
            return std::span(scene.edge_sides).subspan(body.first_vertex, body.vertex_count);
        };
        if (!circle && (scene.edge_sides.empty() || std::ranges::none_of(own_sides(), on_trace))) continue;
        const Material& rock = scene.materials[static_cast<std::size_t>(body.material)];
        smallest.bonded = std::min(smallest.bonded, rock.friction_angle);
        smallest.residual = std::min(smallest.residual, rock.residual_friction_angle);
    }
    for (std::size_t k = 0; k < scene.joints.size(); ++k)
        validate_joint(scene, scene.joints[k], fmt::format("joint {}: ", k + 1), smallest);
}

/// Reverses the order of a body's corners.
void turn_round(Scene& scene, const Body& body, std::span<Vec2> corners) {
    std::ranges::reverse(corners);
    if (scene.edge_sides.size() != scene.vertices.size()) return;  // validate_joints() refuses such a scene
    // The edge that starts at a corner is now the edge that ended there before.
    std::ranges::reverse(std::span(scene.edge_sides).subspan(body.first_vertex, corners.size() - 1));
}

void validate_chain(Scene& scene, const Body& body) {
    const std::string name = fmt::format("body {}: ", body.id);
    const std::span<Vec2> corners(scene.vertices.data() + body.first_vertex, body.vertex_count);
    if (corners.size() < (body.closed ? 3u : 2u)) {
        refuse(name + "corners", static_cast<double>(corners.size()),
               body.closed ? "at least 3 for a closed chain" : "at least 2 for an open chain");
    }
    for (const Vec2 corner : corners) {
        require_finite(name + "corner x", corner.x);
        require_finite(name + "corner y", corner.y);
    }
    const std::size_t edges = body.closed ? corners.size() : corners.size() - 1;
    for (std::size_t k = 0; k < edges; ++k) {
        if (!(norm(corners[(k + 1) % corners.size()] - corners[k]) > 0.0)) {
            throw InputError(fmt::format(
                "{}segment {}: found length 0, expected two different end points; remove the segment", name, k + 1));
        }
    }
    if (!body.closed) return;
    const double area = signed_area(corners);
    double perimeter = 0.0;
    for (std::size_t k = 0; k < edges; ++k) perimeter += norm(corners[(k + 1) % corners.size()] - corners[k]);
    // For a sliver with a smaller area, the centroid would lose half its digits.
    if (std::abs(area) < 1e-10 * perimeter * perimeter)
        refuse(name + "area of the closed chain", area, "more than 1e-10 times the square of its perimeter");
    if (area < 0.0) turn_round(scene, body, corners);
    for (std::size_t a = 0; a < edges; ++a) {
        for (std::size_t b = a + 2; b < edges; ++b) {
            if (a == 0 && b + 1 == edges) continue;
            if (segments_cross(corners[a], corners[a + 1], corners[b], corners[(b + 1) % edges])) {
                throw InputError(
                    fmt::format("{}segments {} and {} cross, expected a simple outline", name, a + 1, b + 1));
            }
        }
    }
}

/// Refuses bodies that are too far from the origin. Floating-point numbers are too widely spaced there, so that such
/// bodies would move in jerks or not at all.
void require_room_to_move(const Scene& scene, const Body& body) {
    constexpr double largest_share =
        1e-9;  // largest number spacing relative to the body's size; contact overlaps are at least 1e-6 of that size
    double farthest = 0.0, size = std::numeric_limits<double>::infinity();
    const auto visit = [&](Vec2 p) { farthest = std::max({farthest, std::abs(p.x), std::abs(p.y)}); };
    for (std::uint32_t k = 0; k < body.circle_count; ++k) {
        const CircleElement& circle = scene.circles[body.first_circle + k];
        visit(circle.centre);
        size = std::min(size, circle.radius);
    }
    if (body.vertex_count > 0) {
        size = 0.0;  // size of the whole outline, since edges in a mesh may be arbitrarily short
        for (std::uint32_t k = 0; k < body.vertex_count; ++k) {
            visit(scene.vertices[body.first_vertex + k]);
            size = std::max(size, norm(scene.vertices[body.first_vertex + k] - scene.vertices[body.first_vertex]));
        }
    }
    const double gap = std::nextafter(farthest, std::numeric_limits<double>::infinity()) - farthest;
    if (gap <= largest_share * size) return;
    throw InputError(fmt::format(
        "body {}: found coordinates up to {:.6g} m, where floating-point numbers are {:.2g} m apart, expected them to "
        "be at most {} of the body's size, {:.4g} m, apart; move the origin closer to the bodies",
        body.id, farthest, gap, largest_share, size));
}

void validate_body(Scene& scene, const Body& body) {
    const std::string name = fmt::format("body {}: ", body.id);
    if (body.material < 0 || static_cast<std::size_t>(body.material) >= scene.materials.size()) {
        refuse(name + "material", body.material + 1, fmt::format("1 to {}", scene.materials.size()));
    }
    require_finite(name + "velocity x", body.velocity.x);
    require_finite(name + "velocity y", body.velocity.y);
    require_finite(name + "spin", body.spin);
    if ((body.circle_count == 0) == (body.vertex_count == 0)) {
        throw InputError(name + "found " + (body.circle_count == 0 ? "no elements" : "circles and segments together") +
                         ", expected either circles or segments");
    }
    for (std::uint32_t k = 0; k < body.circle_count; ++k) {
        const CircleElement& circle = scene.circles[body.first_circle + k];
        require_positive(name + "radius", circle.radius, "m");
        require_finite(name + "centre x", circle.centre.x);
        require_finite(name + "centre y", circle.centre.y);
    }
    if (body.vertex_count > 0) validate_chain(scene, body);
    require_room_to_move(scene, body);
    if (body.mass) require_positive(name + "mass", *body.mass, "kg");
    const bool bare = body.vertex_count > 0 && !body.closed && scene.thick == 0.0;
    if (bare && !body.mass && !(scene.bare_segment_width > 0.0)) {
        throw InputError(name +
                         "found an open chain of thickness 0 without a mass, expected a thickness or an explicit mass");
    }
}

}  // namespace

std::uint32_t Scene::add_circle_body(int id, int material, const CircleElement& circle) {
    Body body;
    body.id = id;
    body.material = material;
    body.first_circle = static_cast<std::uint32_t>(circles.size());
    body.circle_count = 1;
    circles.push_back(circle);
    bodies.push_back(body);
    return static_cast<std::uint32_t>(bodies.size() - 1);
}

std::uint32_t Scene::add_chain_body(int id, int material, const std::vector<Vec2>& outline, bool closed) {
    Body body;
    body.id = id;
    body.material = material;
    body.first_vertex = static_cast<std::uint32_t>(vertices.size());
    body.vertex_count = static_cast<std::uint32_t>(outline.size());
    body.closed = closed;
    vertices.insert(vertices.end(), outline.begin(), outline.end());
    if (!edge_sides.empty()) edge_sides.resize(vertices.size(), no_side);
    bodies.push_back(body);
    return static_cast<std::uint32_t>(bodies.size() - 1);
}

MassProperties mass_properties(const Scene& scene, const Body& body) {
    const double density = scene.materials[static_cast<std::size_t>(body.material)].density;
    if (body.circle_count > 0) {
        return clump_properties(std::span(scene.circles).subspan(body.first_circle, body.circle_count), density);
    }
    const auto corners = std::span(scene.vertices).subspan(body.first_vertex, body.vertex_count);
    if (body.closed) return polygon_properties(corners, density);
    const double width = scene.thick > 0.0 ? 2.0 * scene.thick : scene.bare_segment_width;
    if (!body.mass) return open_chain_properties(corners, density * width);
    MassProperties result = open_chain_properties(corners, 1.0);
    const double scale = *body.mass / result.mass;
    result.mass *= scale;
    result.moment *= scale;
    return result;
}

void validate(Scene& scene) {
    if (scene.materials.empty()) throw InputError("materials: found no material, expected at least one");
    for (std::size_t k = 0; k < scene.materials.size(); ++k) validate_material(scene.materials[k], k);
    validate_pairs(scene);
    const auto by_ratio = [](const Material& m) { return m.damping_ratio && *m.damping_ratio > 0.0; };
    const auto by_value = [](const Material& m) {
        return !m.damping_ratio && (m.normal_damping > 0.0 || m.shear_damping > 0.0);
    };
    if (std::ranges::any_of(scene.materials, by_ratio) && std::ranges::any_of(scene.materials, by_value)) {
        throw InputError(
            "materials: found a damping ratio in one material and dashpot coefficients in another, expected the same "
            "kind of damping in all, since a contact cannot combine the two kinds");
    }
    validate_laws(scene);
    if (scene.bodies.empty()) throw InputError("bodies: found no body, expected at least one particle");
    require_not_negative("thick", scene.thick, "m");
    require_finite("gravity x", scene.gravity.x);
    require_finite("gravity y", scene.gravity.y);
    require_not_negative("time step", scene.time_step, "s");
    require_not_negative("skin", scene.skin, "m");
    if (!(scene.step_scale > 0.0 && scene.step_scale <= 1.0)) refuse("step scale", scene.step_scale, "0 < f <= 1");
    if (!(scene.safety_factor > 0.0 && scene.safety_factor <= 1.0))
        refuse("safety factor", scene.safety_factor, "0 < f <= 1");
    if (scene.threads < 1 || scene.threads > 1024) refuse("threads", scene.threads, "1 to 1024");
    const Domain& domain = scene.domain;
    const auto& walls = domain.wall_present;
    if (walls[0]) require_finite("domain x1", domain.x1);
    if (walls[1]) require_finite("domain x2", domain.x2);
    if (walls[2]) require_finite("domain y1", domain.y1);
    if (walls[3]) require_finite("domain y2", domain.y2);
    if (walls[0] && walls[1] && !(domain.x2 > domain.x1))
        refuse("domain x2", domain.x2, fmt::format("more than x1 = {}", domain.x1));
    if (walls[2] && walls[3] && !(domain.y2 > domain.y1))
        refuse("domain y2", domain.y2, fmt::format("more than y1 = {}", domain.y1));

    std::unordered_set<int> ids;
    ids.reserve(scene.bodies.size());
    for (const Body& body : scene.bodies) {
        if (!ids.insert(body.id).second)
            throw InputError(
                fmt::format("body {}: found two bodies with this number, expected unique numbers", body.id));
        validate_body(scene, body);
    }
    validate_joints(scene);
    for (const Control& control : scene.controls) {
        if (control.body < 0 || static_cast<std::size_t>(control.body) >= scene.bodies.size()) {
            refuse("controlled body", control.body, fmt::format("an index below {}", scene.bodies.size()));
        }
        for (const DofControl& dof : {control.x, control.y, control.rotation}) {
            require_finite("control value", dof.value);
            if (dof.drive == Drive::displacement && control.ramp_steps < 1) {
                refuse("number of steps of a displacement control", static_cast<double>(control.ramp_steps),
                       "at least 1");
            }
        }
    }
}

std::vector<std::string> scene_notices(const Scene& scene) {
    std::vector<std::string> notices;
    const auto chain = [](const Body& body) { return body.vertex_count > 0; };
    const auto open = [&](const Body& body) { return chain(body) && !body.closed; };
    const auto segment = std::ranges::find_if(scene.bodies, open);
    if (scene.thick == 0.0 && segment != scene.bodies.end() && std::ranges::count_if(scene.bodies, chain) > 1) {
        notices.push_back(
            fmt::format("thick: at a thickness of 0, open segments (body {}) and corners of other bodies never touch "
                        "each other; give a thickness > 0 if they should touch",
                        segment->id));
    }
    return notices;
}

}  // namespace crackle
