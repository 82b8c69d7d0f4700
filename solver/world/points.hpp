// SPDX-License-Identifier: GPL-3.0-or-later
// The contact points of a world: compact records grouped by kind, each quantity in an array of its own. The kernels
// take those of neighbouring points as they lie, and what a step does not change is not written back.
// Tested by tests/solver/base/fields_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/base/array.hpp"
#include "solver/base/fields.hpp"
#include "solver/world/bodies.hpp"

namespace crackle {

using PointIndex = std::uint32_t;  // into the arrays of Points

/// How a point's two sides look; points of one kind lie together and have a kernel of their own.
enum class PointKind : std::uint8_t {
    circle_circle = 0,    // two single circles
    element_element = 1,  // circles of which at least one belongs to a clump
    element_outline = 2,  // circle or vertex of body_i against the outline of body_j
    face_face = 3,        // flat faces element_i and feature_j of two single circles across a joint
    // The guide's law only (geometry/guide_segments.hpp); a segment goes by the element it begins at.
    disc_segment = 4,     // circle of body_i against segment feature_j of body_j
    segment_segment = 5,  // segments element_i of body_i and feature_j of body_j
    element_wall = 6,  // circle or vertex of body_i against a domain wall (body_j = Wall); feature_j = 1: a bare vertex
};
inline constexpr int point_kinds = 7;

/// Points whose force does not derive from a potential of the overlap.
constexpr bool by_guide(PointKind kind) {
    return kind == PointKind::disc_segment || kind == PointKind::segment_segment;
}

/// Points whose opening and closing the consistent integrator looks after (contact/opening.hpp): those whose force has
/// a potential of the overlap alone.
constexpr bool has_opening(PointKind kind) { return !by_guide(kind) && kind != PointKind::face_face; }

enum PointFlag : std::uint16_t {
    point_touching = 1,  // overlap > 0 or bonded, in the last force pass
    point_bonded = 2,
    point_sliding = 4,       // at the Coulomb limit in the last force pass
    point_slid = 8,          // has been at the limit since bonding (or since contact began)
    point_just_broken = 16,  // bond lost in the last force pass; cleared when its event is recorded
    point_counted = 32,      // counts in StepControl::step_bound
    point_held = 64,         // its bond cannot break
    point_had_bond = 128,    // was bonded and has properties of its own left: a rest overlap, shares
    point_slip_noted = 256,  // its first slip is in Bonds::slips
    point_unsettled = 512,   // its OpeningMemory::extra_force is not 0
    point_closed = 1024      // of an open joint whose faces touch from the start: linear solutions take it for a bond
};

/// What meets at one contact point.
struct ContactPoint {
    BodyIndex body_i;
    BodyIndex body_j;         // Wall number for element_wall
    std::uint32_t element_i;  // for element_of(); face_face: into Bodies::flat_faces
    std::uint32_t feature_j;  // circle and segment kinds: element of j; outline: edge last faced (a hint, never
                              // physics); face_face: into Bodies::flat_faces

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("body_i", s.body_i);
        visit("body_j", s.body_j);
        visit("element_i", s.element_i);
        visit("feature_j", s.feature_j);
    }
};
static_assert(sizeof(ContactPoint) == 16);

/// The bodies of a point, as in ContactPoint.
struct BodyPair {
    BodyIndex body_i, body_j;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("body_i", s.body_i);
        visit("body_j", s.body_j);
    }
};

/// The parts of its bodies that meet, as in ContactPoint.
struct PointParts {
    std::uint32_t element_i, feature_j;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("element_i", s.element_i);
        visit("feature_j", s.feature_j);
    }
};

/// Points by kind. Those of circle_circle come first and have no parts to name, which spares half of their room.
struct ContactList {
    Array<BodyPair> pairs;
    Array<PointParts> parts;  // of the other kinds

    std::size_t size() const { return pairs.size(); }
    bool empty() const { return pairs.empty(); }
    ContactPoint operator[](std::size_t k) const {
        const std::size_t circles = pairs.size() - parts.size();
        return k < circles ? of_circles(k) : of_parts(k, parts[k - circles]);
    }
    /// The same of a kind that is known.
    template <PointKind K>
    ContactPoint at(std::size_t k) const {
        if constexpr (K == PointKind::circle_circle)
            return of_circles(k);
        else
            return of_parts(k, parts_of(k));
    }
    const PointParts& parts_of(std::size_t k) const { return parts[k - (pairs.size() - parts.size())]; }
    /// Kinds in their order.
    void push_back(PointKind kind, const ContactPoint& point) {
        pairs.push_back({point.body_i, point.body_j});
        if (kind != PointKind::circle_circle) parts.push_back({point.element_i, point.feature_j});
    }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("pairs", s.pairs);
        visit("parts", s.parts);
    }

  private:
    ContactPoint of_circles(std::size_t k) const { return {pairs[k].body_i, pairs[k].body_j, own_circle, own_circle}; }
    ContactPoint of_parts(std::size_t k, const PointParts& part) const {
        return {pairs[k].body_i, pairs[k].body_j, part.element_i, part.feature_j};
    }
};

/// Whether two points that are not with walls are between the same bodies.
inline bool same_pair(const ContactPoint& p, const ContactPoint& q) {
    return (p.body_i == q.body_i && p.body_j == q.body_j) || (p.body_i == q.body_j && p.body_j == q.body_i);
}

struct PointState {
    std::uint16_t law;    // into Settings::laws
    std::uint16_t flags;  // PointFlag

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("law", s.law);
        visit("flags", s.flags);
    }
};
static_assert(sizeof(PointState) == 4);

/// Force of a point on body_i (body_j gets the opposite) and its moments about both centroids.
struct PointForce {
    double fx, fy;
    double torque_i, torque_j;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("fx", s.fx);
        visit("fy", s.fy);
        visit("torque_i", s.torque_i);
        visit("torque_j", s.torque_j);
    }
};
static_assert(sizeof(PointForce) == 32);

/// What the normal spring of a point under the guide's law has taken up. Its force is k_n(δ - δ0) at the resultant's
/// place, but δ does not change by the way of that place alone: there is no potential, so the work itself is added up,
/// by the trapezoidal rule over the drifts, which is leapfrog's own account of it.
struct SpringWork {
    PointForce last;  // N, N m, of the spring at the last force pass
    double stored;    // J

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("last", s.last);
        visit("stored", s.stored);
    }
};

/// What an unbonded point remembers under the consistent integrator (contact/opening.hpp).
struct OpeningMemory {
    double defect = 0.0;       // J: stored beyond ½kδ(n)δ(n+1)
    double extra_force = 0.0;  // N, beyond kδ in the last force pass

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("defect", s.defect);
        visit("extra_force", s.extra_force);
    }
};

/// Of an unbonded point, m, in the last force pass; unset in a new point.
struct LastOverlap {
    double value = unset;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("value", s.value);
    }
};
static_assert(sizeof(LastOverlap) == sizeof(double));  // kernels take several at once

/// Which worlds remember a quantity of every point from one neighbour list to the next; in others its array is empty.
enum class Remembered : std::uint8_t {
    always,
    since_bonding,     // all of them; bonding sets it to 0
    by_guide_law,      // the guide's law of segments
    when_consistent,   // Integrator::consistent
    by_half_strength,  // Bonds::made, of BondLaw::back_tension
    own_shares,        // Settings::own_shares()
    own_shear,         // Settings::own_shear(), of a world with bonds
    when_dilating,     // Settings::dilates()
    between_faces,     // with flat faces
};

struct Points {
    ContactList contact;  // grouped by kind, ordered by (i, j, element) within (but for fours_end)
    std::array<PointIndex, point_kinds + 1> kind_begin{};
    /// Points of element_outline up to here lie in fours, each four between the same two bodies: the interfaces of a
    /// mesh. The others of that kind follow.
    PointIndex fours_end = 0;
    Array<double> root_mass;  // square root of the effective mass times stiffness_share, sqrt(kg)
    Array<PointState> state;
    Array<double> shear_force;  // elastic, N on body_i along the normal (i to j) turned by +90 degrees
    /// δ0, m; back-tension f_b = -k_n δ0. Of a coulomb bond that broke the overlap without force, max(δ0, 0).
    Array<double> bond_overlap;
    /// What a point has of the law's stiffness, and of its strength, the bond's random factor included: of a face its
    /// length over the distance of centroids, and its length (geometry/contact_share.hpp). Floats: no digit is lost
    /// that a rock would have. Empty where all are 1.
    Array<float> stiffness_share, strength_share;
    /// Root of what a point has of the law's shear stiffness beyond its stiffness_share: 1 but across a joint with
    /// stiffnesses. Empty where all are 1.
    Array<float> shear_root;
    /// m, that a contact across a joint has slid, added up while it dilates; its bond_overlap is less by tan ψ of that.
    Array<double> slip;
    /// m, over which the flat faces of a point of face_face lapped in the last force pass, of a bonded one when it was
    /// bonded: its stiffness_share is that of a metre. 1 of other kinds.
    Array<double> lap;
    // Dashpot forces of the last force pass, N: their work is taken by the trapezoidal rule. Floats, like strong
    // forces: they are reported, no motion follows from them, and they are much of what is moved.
    Array<float> normal_dashpot, shear_dashpot;
    Array<SpringWork> spring_work;
    Array<OpeningMemory> opening;
    Array<LastOverlap> last_overlap;  // beside `opening`
    Array<double> last_normal;        // N, spring and dashpot in the last force pass; beside `opening`
    // Elastic forces of a back-tension bond in the last step in which it carried at least half its strength, N: normal,
    // compression positive, and shear.
    Array<float> strong_normal, strong_shear;
    Array<PointForce> force;  // of the last force pass; empty unless kept
    bool keep_forces = true;  // looked at when the list is rebuilt

    std::size_t size() const { return contact.size(); }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("contact", s.contact);
        visit("kind_begin", s.kind_begin);
        visit("fours_end", s.fours_end);
        visit("root_mass", s.root_mass);
        visit("state", s.state, Remembered::always);
        visit("shear_force", s.shear_force, Remembered::always);
        visit("bond_overlap", s.bond_overlap, Remembered::always);
        visit("stiffness_share", s.stiffness_share, Remembered::own_shares);
        visit("strength_share", s.strength_share, Remembered::own_shares);
        visit("shear_root", s.shear_root, Remembered::own_shear);
        visit("slip", s.slip, Remembered::when_dilating);
        visit("lap", s.lap, Remembered::between_faces);
        visit("normal_dashpot", s.normal_dashpot, Remembered::since_bonding);
        visit("shear_dashpot", s.shear_dashpot, Remembered::since_bonding);
        visit("spring_work", s.spring_work, Remembered::by_guide_law);
        visit("opening", s.opening, Remembered::when_consistent);
        visit("last_overlap", s.last_overlap, Remembered::when_consistent);
        visit("last_normal", s.last_normal, Remembered::when_consistent);
        visit("strong_normal", s.strong_normal, Remembered::by_half_strength);
        visit("strong_shear", s.strong_shear, Remembered::by_half_strength);
        visit("force", s.force);
        visit("keep_forces", s.keep_forces);
    }
};

/// Calls visit(values, remembered) with every array that is carried from one neighbour list to the next.
template <HasFields AnyPoints, class Visit>
void visit_remembered(AnyPoints& points, Visit&& visit) {
    AnyPoints::fields(points, [&](const char* /*name*/, auto& values, auto... remembered) {
        if constexpr (sizeof...(remembered) == 1) visit(values, remembered...);
    });
}

}  // namespace crackle
