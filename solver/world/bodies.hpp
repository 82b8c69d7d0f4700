// SPDX-License-Identifier: GPL-3.0-or-later
// The bodies of a world: what a step reads and writes of each in one cache line, shapes in body frames, drives.
//
// Bodies are numbered in rows along the shorter side of the scene (stepping/build_world.cpp); BodyInfo::id leads back
// to the input's numbers.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/base/array.hpp"
#include "solver/scene/scene.hpp"

namespace crackle {

using BodyIndex = std::uint32_t;  // into the arrays of Bodies (internal numbering)
inline constexpr BodyIndex no_body = 0xffffffff;

/// What a step reads and writes of one body.
struct alignas(64) BodyState {
    double x, y;    // centroid, m
    double vx, vy;  // m/s, half a step behind x between steps (leapfrog)
    double omega;   // rad/s
    double
        shape[2];  // single circle: radius, 0; clump or chain: cos and sin of the turn since the body frame was taken
    double angle;  // rad, accumulated

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("x", s.x);
        visit("y", s.y);
        visit("vx", s.vx);
        visit("vy", s.vy);
        visit("omega", s.omega);
        visit("shape", s.shape);
        visit("angle", s.angle);
    }
};
static_assert(sizeof(BodyState) == 64);

/// Per degree of freedom, so that a driven one (inverse 0) needs no branch.
struct BodyInertia {
    double inverse_mass_x, inverse_mass_y, inverse_moment;
    double mass;

    /// In every degree of freedom: no force moves it.
    bool held() const { return inverse_mass_x == 0.0 && inverse_mass_y == 0.0 && inverse_moment == 0.0; }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("inverse_mass_x", s.inverse_mass_x);
        visit("inverse_mass_y", s.inverse_mass_y);
        visit("inverse_moment", s.inverse_moment);
        visit("mass", s.mass);
    }
};
static_assert(sizeof(BodyInertia) == 32);

/// Sum of a body's contact forces (without gravity and applied loads), N and N m about its centroid.
struct alignas(32) BodyForce {
    double fx, fy, torque;
    double unused = 0.0;  // a point's record is added as a whole

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("fx", s.fx);
        visit("fy", s.fy);
        visit("torque", s.torque);
        visit("unused", s.unused);
    }
};

/// What cannot change during a run, or is read only by observers. Of a single circle most of it follows from its radius
/// and mass: Bodies::info() puts it together.
struct BodyInfo {
    int id;
    std::uint16_t material;
    bool single_circle;
    bool closed;
    double moment;  // kg m2
    double reach;   // m, bounding radius of the elements about the centroid (circle radius included, thick not)
    std::uint32_t first_element, element_count;  // vertices or circles, for element_of() (world.hpp)
    std::uint32_t first_piece, piece_count;      // into Bodies::pieces; 0 pieces: circles
};

inline constexpr std::uint32_t no_shape = 0xffffffff;
/// The element of a single circle, of whichever body; less than the largest number, so that loops over elements end.
inline constexpr std::uint32_t own_circle = 0xfffffffe;

/// What every body keeps of its info.
struct BodyName {
    int id;
    std::uint16_t material;
    bool closed;
    std::uint32_t shape;  // into Bodies::shapes; no_shape: a single circle

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("id", s.id);
        visit("material", s.material);
        visit("closed", s.closed);
        visit("shape", s.shape);
    }
};
static_assert(sizeof(BodyName) == 12);

/// What a clump or chain keeps besides, as in BodyInfo.
struct BodyShape {
    double moment, reach;
    std::uint32_t first_element, element_count;  // into Bodies::elements
    std::uint32_t first_piece, piece_count;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("moment", s.moment);
        visit("reach", s.reach);
        visit("first_element", s.first_element);
        visit("element_count", s.element_count);
        visit("first_piece", s.first_piece);
        visit("piece_count", s.piece_count);
    }
};
static_assert(sizeof(BodyShape) == 32);

/// A circle or a vertex in the body frame.
struct Element {
    double x, y;          // m, from the centroid
    double radius;        // surface radius towards an outline or circle: circle r; vertex thick/2
    double target_reach;  // what an outline adds on its side: for a circle thick, for a vertex thick/2

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("x", s.x);
        visit("y", s.y);
        visit("radius", s.radius);
        visit("target_reach", s.target_reach);
    }
};

/// The part of a trace that a single circle stands for, before one side of it (geometry/flat_faces.hpp). It moves with
/// the circle's centre and does not turn.
struct FlatFace {
    BodyIndex body;
    std::uint32_t piece;      // of the trace's straight parts, numbered over all traces
    TraceSide side;           // that the circle lies on
    double from, to;          // m, its ends along the piece, from the circle's centre
    double height;            // m, of the circle's centre above it
    double along_x, along_y;  // unit direction of the piece

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("body", s.body);
        visit("piece", s.piece);
        visit("side", s.side);
        visit("from", s.from);
        visit("to", s.to);
        visit("height", s.height);
        visit("along_x", s.along_x);
        visit("along_y", s.along_y);
    }
};

/// A convex closed outline, or one open segment, in the body frame.
struct Piece {
    std::uint32_t first_edge, edge_count;  // into Bodies::edges
    bool closed;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("first_edge", s.first_edge);
        visit("edge_count", s.edge_count);
        visit("closed", s.closed);
    }
};

/// One edge in the body frame: start, unit direction (outward normal = direction turned by -90 degrees), length.
struct Edge {
    double x, y;
    double tx, ty;
    double length;
    /// What the corners at its start and its end are closest to: points `across` >= 0 in front of the edge's line and
    /// `over` beyond that end (negative at the start) with across + over·cone >= 0. cot θ and -cot θ, θ the angle by
    /// which the outline turns there; closed pieces only.
    double cone[2] = {0.0, 0.0};
    BodyIndex outline_of = no_body;  // the body whose outline is the one convex piece that this edge is of

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("x", s.x);
        visit("y", s.y);
        visit("tx", s.tx);
        visit("ty", s.ty);
        visit("length", s.length);
        visit("cone", s.cone);
        visit("outline_of", s.outline_of);
    }
};
static_assert(sizeof(Edge) == 64);

/// One driven body with what is needed to account for its work.
struct ControlState {
    BodyIndex body;
    DofControl dof[3];        // x, y, rotation
    double start[3];          // position when it was entered
    std::int64_t first_step;  // step at which the ramp began
    std::int64_t ramp_steps;
    double last_force[3];  // driving force (N, N m) at the last force pass: the reaction, or the force applied
    double last_move[3];   // m, rad in the last step

    /// N, N m, of a Drive::force now: what is given, less what its spring has taken up since it was entered.
    double force(int d, const BodyState& b) const {
        return dof[d].value - dof[d].stiffness * ((d == 0 ? b.x : d == 1 ? b.y : b.angle) - start[d]);
    }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("body", s.body);
        visit("dof", s.dof);
        visit("start", s.start);
        visit("first_step", s.first_step);
        visit("ramp_steps", s.ramp_steps);
        visit("last_force", s.last_force);
        visit("last_move", s.last_move);
    }
};

/// What a body's last kick and its inertia are at most, at any of its contacts and along any normal.
struct PushBound {
    double acceleration;  // m/s2; nothing is known of it before the first kick
    double inverse_mass;  // 1/kg
    double reach;         // m, of a contact from the centroid

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("acceleration", s.acceleration);
        visit("inverse_mass", s.inverse_mass);
        visit("reach", s.reach);
    }
};

struct Bodies {
    Array<BodyState> state;
    Array<BodyInertia> inertia;
    /// Of the last force pass: after compute_forces() of all bodies, after step() of driven ones.
    Array<BodyForce> force;
    bool forces_clear = false;    // those of all but driven bodies are 0
    Array<BodyForce> last_force;  // of the pass before; consistent integrator only
    Array<PushBound> push_bound;  // consistent integrator only
    Array<BodyName> names;
    Array<BodyShape> shapes;  // of clumps and chains, in the order of the bodies
    Array<Element> elements;  // of clumps and chains
    /// By element: on which side of a trace the edge to the outline's next corner lies. Empty without joints.
    Array<TraceSide> element_sides;
    /// Of circles at traces, by body; those of a body from first_flat_face on. Both empty without such joints.
    Array<FlatFace> flat_faces;
    Array<std::uint32_t> first_flat_face;
    Array<Piece> pieces;
    Array<Edge> edges;
    bool convex_outlines = true;  // every outline is one convex piece
    Array<Edge> segments;  // by element: the segment that begins there (length 0: none); empty without guide's law
    std::vector<ControlState> controls;

    std::size_t size() const { return state.size(); }

    /// Of a body.
    std::span<const FlatFace> flat_faces_of(std::size_t b) const {
        if (first_flat_face.empty()) return {};
        return std::span(flat_faces).subspan(first_flat_face[b], first_flat_face[b + 1] - first_flat_face[b]);
    }

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
    /// How far turning moves its surface, m: 0 of single circles, which have no frame.
    double turning_reach(std::size_t b) const {
        const std::uint32_t shape = names[b].shape;
        return shape == no_shape ? 0.0 : shapes[shape].reach;
    }
    bool some_turn() const { return !shapes.empty(); }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("state", s.state);
        visit("inertia", s.inertia);
        visit("force", s.force);
        visit("forces_clear", s.forces_clear);
        visit("last_force", s.last_force);
        visit("push_bound", s.push_bound);
        visit("names", s.names);
        visit("shapes", s.shapes);
        visit("elements", s.elements);
        visit("element_sides", s.element_sides);
        visit("flat_faces", s.flat_faces);
        visit("first_flat_face", s.first_flat_face);
        visit("pieces", s.pieces);
        visit("edges", s.edges);
        visit("convex_outlines", s.convex_outlines);
        visit("segments", s.segments);
        visit("controls", s.controls);
    }
};

}  // namespace crackle
