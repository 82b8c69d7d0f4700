// SPDX-License-Identifier: GPL-3.0-or-later
// The bodies of a world: their state (one cache line per body, read and written in every step), their shapes in body
// frames, and the controls that drive them.
//
// Internally, bodies are numbered row by row, with rows along the shorter side of the scene (stepping/build_world.cpp).
// BodyInfo::id is the id from the input.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/base/array.hpp"
#include "solver/base/fields.hpp"
#include "solver/scene/scene.hpp"

namespace crackle {

struct World;
struct Faces;

using BodyIndex = std::uint32_t;  // index into the arrays of Bodies (internal numbering)
inline constexpr BodyIndex no_body = 0xffffffff;

/// The dynamic state of a body, which every step reads and writes.
struct alignas(64) BodyState {
    double x, y;      // centroid, m
    double vx, vy;    // m/s; leapfrog: between steps, half a step behind x
    double omega;     // rad/s
    double shape[2];  // single circle: radius, 0; otherwise cos and sin of the rotation from the body frame
    double angle;     // rad, accumulated over all turns

    CRACKLE_FIELDS(x, y, vx, vy, omega, shape, angle);
};
static_assert(sizeof(BodyState) == 64);

/// Inverse mass or moment per degree of freedom; 0 if the degree of freedom is driven, so that kernels need no branch.
struct BodyInertia {
    double inverse_mass_x, inverse_mass_y, inverse_moment;
    double mass;

    /// Whether all degrees of freedom are driven, so that no force can move the body.
    bool held() const { return inverse_mass_x == 0.0 && inverse_mass_y == 0.0 && inverse_moment == 0.0; }

    CRACKLE_FIELDS(inverse_mass_x, inverse_mass_y, inverse_moment, mass);
};
static_assert(sizeof(BodyInertia) == 32);

/// Sum of a body's contact forces (without gravity and applied loads), N and N m about its centroid.
struct alignas(32) BodyForce {
    double fx, fy, torque;
    double unused = 0.0;  // padding, so that a kernel can add all four numbers of a PointForce at once

    CRACKLE_FIELDS(fx, fy, torque, unused);
};

/// Properties of a body that do not change during a run or are read only by observers. Bodies::info() assembles them.
/// For a single circle, most of them follow from its radius and mass.
struct BodyInfo {
    int id;
    std::uint16_t material;
    bool single_circle;
    bool closed;
    double moment;  // kg m2
    double reach;   // m, bounding radius of the elements about the centroid (including circle radii, excluding `thick`)
    std::uint32_t first_element, element_count;  // range of vertices or circles, for element_of() (world.hpp)
    std::uint32_t first_piece, piece_count;      // range in Bodies::pieces; the count is 0 for a body made of circles
};

inline constexpr std::uint32_t no_shape = 0xffffffff;
/// Element index that stands for the circle of a single-circle body. It is one less than the largest integer, so that
/// first_element + element_count does not overflow.
inline constexpr std::uint32_t own_circle = 0xfffffffe;

/// The values of BodyInfo that are stored for every body.
struct BodyName {
    int id;
    std::uint16_t material;
    bool closed;
    std::uint32_t shape;  // index into Bodies::shapes; no_shape for a single circle

    CRACKLE_FIELDS(id, material, closed, shape);
};
static_assert(sizeof(BodyName) == 12);

/// The values of BodyInfo that are stored only for clumps and chains.
struct BodyShape {
    double moment, reach;
    std::uint32_t first_element, element_count;  // range in Bodies::elements
    std::uint32_t first_piece, piece_count;

    CRACKLE_FIELDS(moment, reach, first_element, element_count, first_piece, piece_count);
};
static_assert(sizeof(BodyShape) == 32);

/// A circle or vertex of a body, in the body frame.
struct Element {
    double x, y;    // m, relative to the centroid
    double radius;  // m, distance of (x, y) from the surface that touches an outline or circle; thick/2 for a vertex
    // m, added to `radius` for contact with an outline: `thick` for a circle, thick/2 for a vertex
    double target_reach;

    CRACKLE_FIELDS(x, y, radius, target_reach);
};

/// The part of a trace that is assigned to a single circle as a straight face, on one side of the trace
/// (geometry/flat_faces.hpp). It moves with the circle's centre and does not rotate.
struct FlatFace {
    BodyIndex body;
    std::uint32_t piece;  // index of the straight part of a trace, counted over all traces
    TraceSide side;       // side of the trace on which the circle lies
    double from, to;      // m, positions of the face's ends along the straight part, relative to the circle's centre
    double height;        // m, height of the circle's centre above the face
    double along_x, along_y;  // unit vector along the straight part

    CRACKLE_FIELDS(body, piece, side, from, to, height, along_x, along_y);
};

/// A convex closed outline or a single open segment, in the body frame.
struct Piece {
    std::uint32_t first_edge, edge_count;  // range in Bodies::edges
    bool closed;

    CRACKLE_FIELDS(first_edge, edge_count, closed);
};

/// One edge in the body frame: start point, unit direction and length. The outward normal is the direction turned by
/// -90 degrees.
struct Edge {
    double x, y;
    double tx, ty;
    double length;
    /// Determines whether the corner at the edge's start or end is the closest point of the outline. A point lies
    /// `across` >= 0 in front of the edge's line and `over` beyond that end (`over` is negative at the start). The
    /// corner is closest if across + over·cone >= 0. The values are cot θ at the start and -cot θ at the end, with θ
    /// the angle by which the outline turns at the corner; only for closed pieces.
    double cone[2] = {0.0, 0.0};
    BodyIndex outline_of =
        no_body;  // body whose outline is one convex piece that contains this edge; no_body otherwise

    CRACKLE_FIELDS(x, y, tx, ty, length, cone, outline_of);
};
static_assert(sizeof(Edge) == 64);

/// A driven body, with the values needed to account for the work of its drive.
struct ControlState {
    BodyIndex body;
    DofControl dof[3];        // x, y, rotation
    double start[3];          // m, rad; position when the control was set
    std::int64_t first_step;  // step at which the ramp began
    std::int64_t ramp_steps;
    double last_force[3];  // N, N m; driving force in the last force pass: reaction or applied force
    double last_move[3];   // m, rad; displacement in the last step

    /// Current driving force of a Drive::force control, N or N m: the prescribed value minus stiffness times the
    /// displacement since the control was set.
    double force(int d, const BodyState& b) const {
        return dof[d].value - dof[d].stiffness * ((d == 0 ? b.x : d == 1 ? b.y : b.angle) - start[d]);
    }

    CRACKLE_FIELDS(body, dof, start, first_step, ramp_steps, last_force, last_move);
};

/// Upper bounds for a body, valid for any contact position and any normal: acceleration in the last kick, and inverse
/// mass.
struct PushBound {
    double acceleration;  // m/s2; infinite before the first kick
    double inverse_mass;  // 1/kg; includes rotation, for a contact at distance `reach`
    double reach;         // m, largest distance of a contact from the centroid

    CRACKLE_FIELDS(acceleration, inverse_mass, reach);
};

/// All bodies, with one array per quantity, indexed by body.
struct Bodies {
    Array<BodyState> state;
    Array<BodyInertia> inertia;
    /// Forces from the last force pass: for all bodies after compute_forces(), only for driven bodies after step().
    Array<BodyForce> force;
    bool forces_clear = false;    // whether the forces of all bodies, except driven bodies, are 0
    Array<BodyForce> last_force;  // forces from the previous pass; consistent integrator only
    Array<PushBound> push_bound;  // consistent integrator only
    Array<BodyName> names;
    Array<BodyShape> shapes;  // shapes of clumps and chains, in body order
    Array<Element> elements;  // elements of clumps and chains
    /// For each element: side of a trace on which the edge from this corner to the next one lies. Empty without joints.
    Array<TraceSide> element_sides;
    /// Flat faces of single circles along traces, sorted by body. `first_flat_face` holds the index of the first face
    /// of each body. Both are empty without flat faces.
    Array<FlatFace> flat_faces;
    Array<std::uint32_t> first_flat_face;
    Array<Piece> pieces;
    Array<Edge> edges;
    bool convex_outlines = true;  // whether every outline is one convex piece
    // For each element: the segment that begins at this element (length 0: no segment). Empty unless the DEMseg guide's
    // segment law is used.
    Array<Edge> segments;
    std::vector<ControlState> controls;

    /// Number of bodies.
    std::size_t size() const { return state.size(); }

    /// Flat faces of a body.
    std::span<const FlatFace> flat_faces_of(std::size_t b) const {
        if (first_flat_face.empty()) return {};
        return std::span(flat_faces).subspan(first_flat_face[b], first_flat_face[b + 1] - first_flat_face[b]);
    }

    /// Kind, elements and shape of a body, assembled from the arrays.
    BodyInfo info(std::size_t b) const {
        const BodyName& name = names[b];
        if (name.shape == no_shape) {
            const double radius = state[b].shape[0];
            return {name.id, name.material, true, name.closed, inertia[b].mass * (0.5 * radius * radius),
                    radius,  own_circle,    1,    0,           0};
        }
        const BodyShape& shape = shapes[name.shape];
        return {name.id,
                name.material,
                false,
                name.closed,
                shape.moment,
                shape.reach,
                shape.first_element,
                shape.element_count,
                shape.first_piece,
                shape.piece_count};
    }
    /// Largest distance from the centroid of a surface point that moves when the body rotates, m; 0 for single circles,
    /// which have no body frame.
    double turning_reach(std::size_t b) const {
        const std::uint32_t shape = names[b].shape;
        return shape == no_shape ? 0.0 : shapes[shape].reach;
    }
    /// Whether any body has a shape that rotates with it.
    bool some_turn() const { return !shapes.empty(); }

    CRACKLE_FIELDS(state, inertia, force, forces_clear, last_force, push_bound, names, shapes, elements, element_sides,
                   flat_faces, first_flat_face, pieces, edges, convex_outlines, segments, controls);
};

/// Inputs for the geometry of contact points: plain pointers to bodies and their shapes, either in a world (see Bodies)
/// or in the caller's own arrays. Valid until one of the arrays is resized.
struct BodyView {
    BodyView() = default;
    explicit BodyView(const World& world);  // defined in world.hpp

    const BodyState* state = nullptr;
    const BodyName* names = nullptr;
    const BodyShape* shapes = nullptr;
    const Element* elements = nullptr;
    const Piece* pieces = nullptr;
    const Edge* edges = nullptr;
    const Edge* segments = nullptr;
    const FlatFace* flat_faces = nullptr;
    const Faces* bond_faces = nullptr;
    bool convex_outlines = true;
    bool mean_of_discs = false;  // SegmentLaw::demseg_mean
    double thick = 0.0;          // m, segment thickness
    Domain domain;

    /// Shape of a body that is not a single circle.
    const BodyShape& shape_of(BodyIndex b) const { return shapes[names[b].shape]; }
};

/// A circle or vertex of a body. @param element an index as in BodyInfo::first_element or ContactPoint
inline Element element_of(const BodyView& bodies, std::size_t body, std::uint32_t element) {
    if (element == own_circle) return {0.0, 0.0, bodies.state[body].shape[0], bodies.thick};
    return bodies.elements[element];
}

}  // namespace crackle
