// SPDX-License-Identifier: GPL-3.0-or-later
// The contact points of a world, grouped by kind, with one array per quantity. Kernels thus load the values of
// consecutive points together and do not write back quantities that a step leaves unchanged.
// Tested by tests/solver/base/fields_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/base/array.hpp"
#include "solver/base/fields.hpp"
#include "solver/world/bodies.hpp"

namespace crackle {

using PointIndex = std::uint32_t;  // index into the arrays of Points

/// The two shapes that meet at a contact point. Points of one kind are stored together and have their own kernel. Of
/// the kinds that a world stores, circle_circle must stay first and element_wall last, since other code relies on it.
enum class PointKind : std::uint8_t {
    circle_circle = 0,    // two single circles
    element_element = 1,  // circles, at least one of which belongs to a clump
    element_outline = 2,  // circle or vertex of body_i against the outline of body_j
    face_face = 3,        // two single circles with flat faces element_i and feature_j across a joint
    // The next two occur only under the DEMseg guide's segment law (geometry/guide_segments.hpp). A segment has the
    // index of the element at which it begins.
    disc_segment = 4,     // circle of body_i against segment feature_j of body_j
    segment_segment = 5,  // segments element_i of body_i and feature_j of body_j
    // Circle or vertex of body_i against a domain wall (body_j is a Wall); feature_j is 1 for a bare vertex.
    element_wall = 6,
    /// A face between two bonded polygons (world/faces.hpp); element_i and feature_j are both its index. This kind
    /// occurs only in events and records; a world stores no points of this kind.
    bonded_face = 7,
};
inline constexpr int point_kinds = 7;
/// Number of kinds of bonds in the records of a test: all kinds of points, and PointKind::bonded_face.
inline constexpr int bond_kinds = 8;

/// Whether points of this kind follow the DEMseg guide's segment law. The force of this law has no potential that
/// depends on the overlap.
constexpr bool by_guide(PointKind kind) {
    return kind == PointKind::disc_segment || kind == PointKind::segment_segment;
}

/// Whether the consistent integrator applies to points of this kind (contact/opening.hpp). This requires a force with a
/// potential that depends only on the overlap.
constexpr bool has_opening(PointKind kind) {
    return !by_guide(kind) && kind != PointKind::face_face && kind != PointKind::bonded_face;
}

/// State of a contact point, as bits.
enum PointFlag : std::uint16_t {
    point_touching = 1,  // the point had an overlap > 0 or was bonded in the last force pass
    point_bonded = 2,
    point_sliding = 4,       // the point was at the Coulomb limit in the last force pass
    point_slid = 8,          // the point has reached the Coulomb limit since bonding, or since contact began
    point_just_broken = 16,  // the bond broke in the last force pass; cleared when the event is recorded
    point_counted = 32,      // the point is counted in StepControl::step_bound
    point_held = 64,         // the bond of the point cannot break
    point_had_bond = 128,    // rest overlap and stiffness factors are kept, for example from an earlier bond
    point_slip_noted = 256,  // the first slip of the point is listed in Bonds::slips
    point_unsettled = 512,   // OpeningMemory::extra_force of the point is not 0
    point_closed =
        1024  // the joint faces touch from the start in an open joint; linear solutions treat the point as bonded
};

/// The two bodies and elements that meet at one contact point.
struct ContactPoint {
    BodyIndex body_i;
    BodyIndex body_j;         // index of the wall for element_wall
    std::uint32_t element_i;  // element index for element_of(); face_face: index into Bodies::flat_faces
    // Circle and segment kinds: element of body_j. Outline: the edge that the point faced last, only a starting guess
    // for the search. face_face: index into Bodies::flat_faces.
    std::uint32_t feature_j;

    CRACKLE_FIELDS(body_i, body_j, element_i, feature_j);
};
static_assert(sizeof(ContactPoint) == 16);

/// The two bodies of a point, as in ContactPoint.
struct BodyPair {
    BodyIndex body_i, body_j;

    CRACKLE_FIELDS(body_i, body_j);
};

/// The elements that meet at a point, as in ContactPoint.
struct PointParts {
    std::uint32_t element_i, feature_j;

    CRACKLE_FIELDS(element_i, feature_j);
};

/// Contact points, grouped by kind. circle_circle points come first and store no PointParts, which halves their memory.
struct ContactList {
    Array<BodyPair> pairs;
    Array<PointParts> parts;  // for all points except circle_circle

    /// Number of points.
    std::size_t size() const { return pairs.size(); }
    /// Whether the list has no points.
    bool empty() const { return pairs.empty(); }
    /// The point with index k.
    ContactPoint operator[](std::size_t k) const {
        const std::size_t circles = pairs.size() - parts.size();
        return k < circles ? of_circles(k) : of_parts(k, parts[k - circles]);
    }
    /// A contact point of a kind known at compile time.
    template <PointKind K>
    ContactPoint at(std::size_t k) const {
        if constexpr (K == PointKind::circle_circle)
            return of_circles(k);
        else
            return of_parts(k, parts_of(k));
    }
    /// Elements of a point whose kind is not circle_circle.
    const PointParts& parts_of(std::size_t k) const { return parts[k - (pairs.size() - parts.size())]; }
    /// Appends a point. Points must be added kind by kind, in the order of the enumerators of PointKind.
    void push_back(PointKind kind, const ContactPoint& point) {
        pairs.push_back({point.body_i, point.body_j});
        if (kind != PointKind::circle_circle) parts.push_back({point.element_i, point.feature_j});
    }

    CRACKLE_FIELDS(pairs, parts);

  private:
    ContactPoint of_circles(std::size_t k) const { return {pairs[k].body_i, pairs[k].body_j, own_circle, own_circle}; }
    ContactPoint of_parts(std::size_t k, const PointParts& part) const {
        return {pairs[k].body_i, pairs[k].body_j, part.element_i, part.feature_j};
    }
};

/// Whether two points are between the same two bodies; neither point may be at a wall.
inline bool same_pair(const ContactPoint& p, const ContactPoint& q) {
    return (p.body_i == q.body_i && p.body_j == q.body_j) || (p.body_i == q.body_j && p.body_j == q.body_i);
}

/// Contact law and flags of a contact point.
struct PointState {
    std::uint16_t law;    // index into Settings::laws
    std::uint16_t flags;  // combination of PointFlag values

    CRACKLE_FIELDS(law, flags);
};
static_assert(sizeof(PointState) == 4);

/// Force of a point on body_i (body_j receives the opposite force) and its moments about both centroids.
struct PointForce {
    double fx, fy;
    double torque_i, torque_j;

    CRACKLE_FIELDS(fx, fy, torque_i, torque_j);
};
static_assert(sizeof(PointForce) == 32);

/// Work stored in the normal spring of a point under the DEMseg guide's segment law. The force k_n(δ - δ0) acts where
/// the resultant acts, but the motion there does not determine δ alone, so there is no potential. Instead, the work is
/// summed over the drifts by the trapezoidal rule, as under the leapfrog integrator.
struct SpringWork {
    PointForce last;  // N, N m; spring force in the last force pass
    double stored;    // J

    CRACKLE_FIELDS(last, stored);
};

/// State of an unbonded contact point between steps, under the consistent integrator (contact/opening.hpp).
struct OpeningMemory {
    double defect = 0.0;       // J, stored energy in excess of ½kδ(n)δ(n+1)
    double extra_force = 0.0;  // N, force in excess of kδ in the last force pass

    CRACKLE_FIELDS(defect, extra_force);
};

/// Overlap of an unbonded point in the last force pass, m; unset for a new point.
struct LastOverlap {
    double value = unset;

    CRACKLE_FIELDS(value);
};
static_assert(sizeof(LastOverlap) == sizeof(double));  // kernels load several values at once

/// Condition under which an array of Points exists and is carried over from one neighbour list to the next. The array
/// is empty in a world that does not meet its condition.
enum class Remembered : std::uint8_t {
    always,
    since_bonding,     // in all worlds; bonding resets the values to 0
    by_guide_law,      // under the DEMseg guide's segment law
    when_consistent,   // with Integrator::consistent
    by_half_strength,  // if Bonds::made and BondLawFacts::remembers_strong_forces are true
    own_shares,        // if Settings::own_shares() is true
    own_shear,         // if the world has bonds and Settings::own_shear() is true
    when_dilating,     // if Settings::dilates() is true
    between_faces,     // if the world has flat faces (PointKind::face_face)
};

/// All contact points, with one array per quantity, indexed by point.
struct Points {
    // The points, grouped by kind. Within a kind, they are sorted by (i, j, element), except for points before
    // fours_end.
    ContactList contact;
    std::array<PointIndex, point_kinds + 1> kind_begin{};
    /// element_outline points before this index are stored in groups of four between the same two bodies, as at the
    /// interfaces of a mesh. The other points of that kind follow.
    PointIndex fours_end = 0;
    Array<double> root_mass;  // square root of the effective mass times stiffness_share, sqrt(kg)
    Array<PointState> state;
    Array<double>
        shear_force;  // N, elastic shear force on body_i, along the normal (from i to j) turned by +90 degrees
    /// Overlap δ0 at bonding, m; the back-tension is f_b = -k_n δ0. After a coulomb bond has broken: the overlap at
    /// which the force is zero, max(δ0, 0).
    Array<double> bond_overlap;
    /// Factors on the law's stiffness and strength for each point; the strength factor includes the bond's random
    /// factor. For a face, the stiffness factor is the face's length divided by the distance between the centroids, and
    /// the strength factor is its length (geometry/contact_share.hpp). Single precision is enough for rock properties.
    /// Empty if all are 1.
    Array<float> stiffness_share, strength_share;
    /// Square root of an additional factor on the point's shear stiffness, on top of stiffness_share. It differs from 1
    /// only across joints with their own stiffnesses. Empty if all are 1.
    Array<float> shear_root;
    /// Slip distance accumulated by a contact across a joint while it dilates, m. The contact's bond_overlap is reduced
    /// by tan ψ times this distance.
    Array<double> slip;
    /// Lap of a face_face point, m: length over which its two flat faces lie opposite each other, in the last force
    /// pass or at bonding. The stiffness_share of such a point refers to a lap of one metre. Points of other kinds have
    /// a lap of 1.
    Array<double> lap;
    // Dashpot forces in the last force pass, N, for computing their work by the trapezoidal rule. They enter only
    // reports and do not affect the motion, so single precision is used to save memory traffic. The same applies to
    // strong_normal and strong_shear.
    Array<float> normal_dashpot, shear_dashpot;
    Array<SpringWork> spring_work;
    Array<OpeningMemory> opening;
    Array<LastOverlap> last_overlap;  // carried over under the same condition as `opening`
    Array<double> last_normal;        // N, spring and dashpot force in the last force pass; carried over like `opening`
    // Elastic normal force (compression positive) and shear force of a back-tension bond, N, in the last step in which
    // it carried at least half its strength.
    Array<float> strong_normal, strong_shear;
    Array<PointForce> force;  // forces from the last force pass; empty unless keep_forces is set
    bool keep_forces = true;  // whether forces are stored; takes effect when the list is rebuilt

    /// Number of points.
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

/// Calls visit(values, remembered) for every array that is carried over from one neighbour list to the next.
template <HasFields AnyPoints, class Visit>
void visit_remembered(AnyPoints& points, Visit&& visit) {
    AnyPoints::fields(points, [&](const char* /*name*/, auto& values, auto... remembered) {
        if constexpr (sizeof...(remembered) == 1) visit(values, remembered...);
    });
}

}  // namespace crackle
