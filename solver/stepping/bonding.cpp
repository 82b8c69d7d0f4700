// SPDX-License-Identifier: GPL-3.0-or-later
// Bonding. A back-tension bond gives every contact with an overlap δ0 > 0 the force f_b = -k_n δ0, so that a packing
// under pressure becomes a stress-free solid without additional springs. The stiffness is the same before and after
// breakage, and the tensile strength is k_n δ0. Source: DEMseg guide. Coulomb bonds also start without force; they can
// bridge gaps, and their strengths are given.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/geometry/contact_share.hpp"

#include "solver/contact/joint_law.hpp"
#include "solver/contact/pass.hpp"
#include "solver/geometry/across_joint.hpp"
#include "solver/linear/absolute_bound.hpp"
#include "solver/linear/critical_step.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/neighbours/exchange.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/time_step.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

// Number of events for which memory is reserved in advance; only further events allocate memory within a step.
constexpr std::int64_t events_at_once = 1024;

std::int64_t count_interfaces(const World& world) {
    std::vector<std::uint64_t> pairs;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points.state[k].flags & point_bonded) == 0) continue;
        const ContactPoint point = world.points.contact[k];
        const std::uint64_t low = std::min(point.body_i, point.body_j), high = std::max(point.body_i, point.body_j);
        pairs.push_back((low << 32) | high);
    }
    std::sort(pairs.begin(), pairs.end());
    return std::distance(pairs.begin(), std::unique(pairs.begin(), pairs.end()));
}

/// Adds the intact faces of a world to its counts of bonds.
void count_faces(World& world) {
    const Faces& faces = world.faces;
    const auto intact = static_cast<std::int64_t>(faces.size() - faces.broken.size());
    world.bonds.initial += intact;
    world.bonds.interfaces_initial += intact;
    for (FaceIndex k = 0; k < faces.size(); ++k)
        if (faces.broken_at[k] == no_face && !faces.law_of(k).can_break()) ++world.bonds.held;
}

/// Limits for bonding the flat faces of two circles. flush_share is the largest gap between the faces, relative to the
/// sum of the two circles' radii; it only allows for round-off, since the faces are flush. least_lap_share is the
/// smallest lap (shared length of the two faces), relative to the mean radius of the circles; slight sliding would
/// separate faces with a smaller lap.
constexpr double flush_share = 1e-9, least_lap_share = 0.01;

/// Largest gap at which a point is bonded, m.
double largest_gap(const World& world, PointIndex k, const PointView& view, const Bonding& bonding) {
    if (view.kind == PointKind::face_face) {
        const double radii = world.bodies.state[view.body_i].shape[0] + world.bodies.state[view.body_j].shape[0];
        return world.points.lap[k] > least_lap_share * 0.5 * radii ? flush_share * radii : -radii;
    }
    if (view.kind != PointKind::circle_circle) return bonding.gap;
    const double radii = world.bodies.state[view.body_i].shape[0] + world.bodies.state[view.body_j].shape[0];
    return bonding.range * 0.5 * radii;
}

/// Widens the skin so that the neighbour list includes all pairs that may be bonded.
void widen_skin(World& world, const Bonding& bonding) {
    double reach = bonding.gap;
    if (bonding.range > 0.0)
        for (std::size_t b = 0; b < world.bodies.size(); ++b)
            if (const BodyInfo info = world.bodies.info(b); info.single_circle)
                reach = std::max(reach, bonding.range * info.reach);
    if (reach == 0.0 || world.list.skin > 1.01 * reach) return;
    world.list.skin = 1.01 * reach;  // slightly wider, since lists omit pairs whose gap is just above the skin
    world.list.valid = false;
}

/// Whether bonding itself sets the values of an array, so that they must not be cleared afterwards.
bool of_shares(Remembered remembered) {
    return remembered == Remembered::own_shares || remembered == Remembered::own_shear ||
           remembered == Remembered::between_faces;
}

bool bonded(const World& world, PointIndex k) { return (world.points.state[k].flags & point_bonded) != 0; }
/// Whether a point is bonded, was left unbonded, or had a bond that has broken.
bool of_face(const World& world, PointIndex k) {
    return (world.points.state[k].flags & (point_bonded | point_had_bond)) != 0;
}

/// Aperture of an unbonded point across a joint, m: the overlap at which its force is zero, minus its overlap at
/// bonding. It is 0 for all other points.
double aperture_of(const World& world, PointIndex k) {
    const std::size_t law = world.points.state[k].law;
    return bonded(world, k) || law < world.settings.first_joint_law() ? 0.0 : world.settings.joint_of_law(law).aperture;
}

/// Stiffness and strength factors of one bonded point between two bodies. The factors of a face are divided equally
/// among its points. All factors are 1 for StiffnessUnits::point.
struct PointShare {
    double stiffness = 1.0;
    double length = 1.0;      // m
    double shear_root = 1.0;  // Points::shear_root
};

/// Stiffness and strength factors of point k. @param face the face between the point's two bodies, if they are polygons
/// that face each other @param count the number of bonded points between the two bodies
PointShare share_of_point(const World& world, PointIndex k, const std::optional<ContactShare>& face,
                          std::int64_t count) {
    if (world.settings.units == StiffnessUnits::point) return {};
    const double points = face ? static_cast<double>(count) : 1.0;
    const ContactShare share =
        face ? *face : share_of_contact(world, view_point(world, k).kind, world.points.contact[k]);
    const SeriesShares left = series_shares(world, k, share.distance);
    const double lap = world.points.lap.empty() ? 1.0 : world.points.lap[k];
    return {share.stiffness() / points * left.normal, share.length * lap / points, left.root_of_shear()};
}

/// Allocates Points::shear_root when the world gets its first bonds.
void begin_shear_roots(World& world) {
    if (world.settings.own_shear() && world.points.shear_root.empty())
        world.points.shear_root.assign(world.points.size(), 0.0F);
}

/// Sets the stiffness and strength factors of a pair's bonded points. The points from `begin` up to, but not including,
/// `end` are those of the pair. The strength factor includes the pair's random factor.
void share_pair(World& world, const Bonding& bonding, PointIndex begin, PointIndex end) {
    const auto is_chain = [&](BodyIndex b) { return world.bodies.info(b).piece_count > 0; };
    std::int64_t count = 0;
    // The smallest gap of the pair's points, m, is used, since a corner beyond the end of the facing edge has a larger
    // gap.
    double gap = std::numeric_limits<double>::infinity();
    for (PointIndex k = begin; k < end; ++k) {
        if (!of_face(world, k)) continue;
        ++count;
        gap = std::min(gap, world.settings.thick - (world.points.bond_overlap[k] - aperture_of(world, k)));
    }
    const ContactPoint pair = world.points.contact[begin];
    std::optional<ContactShare> face;
    if (count > 0 && world.settings.units == StiffnessUnits::area && is_chain(pair.body_i) && is_chain(pair.body_j))
        face = share_of_face(world, pair.body_i, pair.body_j, gap);
    const double factor = bonding.factors.between(world.bodies.info(pair.body_i).id, world.bodies.info(pair.body_j).id);
    for (PointIndex k = begin; k < end; ++k) {
        if (!of_face(world, k)) continue;
        const PointShare share = share_of_point(world, k, face, count);
        world.points.stiffness_share[k] = static_cast<float>(share.stiffness);
        world.points.strength_share[k] = static_cast<float>(share.length * factor);
        if (!world.points.shear_root.empty()) world.points.shear_root[k] = static_cast<float>(share.shear_root);
    }
}

/// Sets the factors of the bonded points for all pairs of bodies.
void share_faces(World& world, const Bonding& bonding) {
    const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    for (PointIndex begin = 0; begin < walls;) {
        const PointIndex end = points_between(world, begin).second;
        share_pair(world, bonding, begin, end);
        begin = end;
    }
}

/// Computes strengths from the strength factors, and checks that no tensile strength is beyond the apex of its failure
/// envelope.
void set_strengths(World& world, const Bonding& bonding) {
    const std::size_t pairs = world.settings.pair_count();
    if ((bonding.tensile_factor || bonding.cohesion_factor) && !world.settings.intact.no_breaking) {
        double sum = 0.0;
        std::int64_t count = 0;
        for (PointIndex k = 0; k < world.points.size(); ++k) {
            if (!bonded(world, k)) continue;
            sum += law_of(world, k).normal_stiffness * world.points.bond_overlap[k];
            ++count;
        }
        const double mean = count > 0 ? sum / static_cast<double>(count) : 0.0;
        if (count > 0 && !(mean > 0.0)) {
            throw InputError(fmt::format(
                "strength factors: found a mean back-tension of {:.6g} N, expected a value > 0 for the factors to "
                "multiply; cells bond without overlap, so give tensile_strength and cohesion instead",
                mean));
        }
        for (std::size_t number = 0; number < pairs; ++number) {
            ContactLaw& law = world.settings.laws[number];
            if (bonding.tensile_factor) law.tensile_strength = *bonding.tensile_factor * mean;
            if (bonding.cohesion_factor) law.cohesion = *bonding.cohesion_factor * mean;
        }
    }
    derive_joint_laws(world.settings);
    for (std::size_t number = 0; number < world.settings.laws.size(); ++number) {
        if (number >= pairs && number < world.settings.first_joint_law()) continue;
        check_strengths(world.settings.laws[number], "strengths");
    }
}

/// Sets Points::lap of flat faces at the current positions.
void take_laps(World& world) {
    constexpr auto kind = static_cast<std::size_t>(PointKind::face_face);
    const BodyView bodies(world);
    for (PointIndex k = world.points.kind_begin[kind]; k < world.points.kind_begin[kind + 1]; ++k)
        world.points.lap[k] = flat_face_contact(bodies, world.points.contact[k]).lap();
}

/// For each point between bodies: index of the joint across which the point would be bonded, or no_joint. Empty without
/// joints.
std::vector<std::int32_t> joints_of_points(const World& world, const Bonding& bonding) {
    std::vector<std::int32_t> joints;
    if (world.settings.joints.empty()) return joints;
    joints.resize(world.points.size(), no_joint);
    const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    for (PointIndex begin = 0, end = 0; begin < walls; begin = end) {
        end = points_between(world, begin).second;
        double gap = std::numeric_limits<double>::infinity();
        for (PointIndex k = begin; k < end; ++k) {
            const PointView view = view_point(world, k);
            if (view.overlap + largest_gap(world, k, view, bonding) > 0.0)
                gap = std::min(gap, world.settings.thick - view.overlap);
        }
        if (!std::isfinite(gap)) continue;
        const ContactPoint pair = world.points.contact[begin];
        const bool flat = view_point(world, begin).kind == PointKind::face_face;
        const std::int32_t joint = flat ? no_joint : joint_of_face(world, pair.body_i, pair.body_j, gap);
        for (PointIndex k = begin; k < end; ++k)
            joints[k] = flat ? joint_of_flat_faces(world, world.points.contact[k]) : joint;
    }
    return joints;
}

/// Round-off allowed in the gap of a point, relative to the segment thickness. Corners beyond the end of the facing
/// edge have a larger gap and would push at an angle.
constexpr double facing_share = 1e-6;

/// Leaves a point of an open joint unbonded, and stores the overlap at which the faces of the joint touch. A corner
/// beyond the end of the facing edge is left as it is, like a contact that forms later.
void open_point(World& world, PointIndex k, const Joint& joint, const PointView& view, bool pressed) {
    const double overlap = view.overlap;
    if (view.kind != PointKind::face_face && overlap < -facing_share * world.settings.thick) return;
    world.points.bond_overlap[k] = overlap + joint.aperture;
    const bool closed = pressed && joint.aperture == 0.0;
    world.points.state[k].flags = static_cast<std::uint16_t>(point_had_bond | (closed ? point_closed : 0));
}

using BodyIndices = std::pair<BodyIndex, BodyIndex>;

BodyIndices ordered(const BodyPair& pair) {
    return {std::min(pair.body_i, pair.body_j), std::max(pair.body_i, pair.body_j)};
}

/// A point to be bonded.
struct FreshBond {
    PointIndex point, begin, end;  // the point, and the range of points between its two bodies
    bool alone;                    // whether no point between the two bodies is bonded yet
    double overlap;
};

/// Unbonded points with gaps of less than `gap`, m, between the pairs of bodies in `asked`, a sorted list.
std::vector<FreshBond> fresh_bonds(const World& world, const std::vector<BodyIndices>& asked, double gap) {
    std::vector<FreshBond> fresh;
    const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    for (PointIndex begin = 0, end = 0; begin < walls; begin = end) {
        end = points_between(world, begin).second;
        const BodyPair& pair = world.points.contact.pairs[begin];
        if (!std::ranges::binary_search(asked, ordered(pair))) continue;
        bool alone = true;
        for (PointIndex k = begin; k < end; ++k) alone = alone && !bonded(world, k);
        for (PointIndex k = begin; k < end; ++k) {
            const double overlap = overlap_of(world, k);
            if (bonded(world, k) || overlap + gap <= 0.0) continue;
            if (!alone && world.settings.own_shares()) {
                throw InputError(
                    fmt::format("bond: found intact bonds on the face between bodies {} and {}, expected a pair "
                                "that has no bonds, or whose bonds have all broken",
                                world.bodies.info(pair.body_i).id, world.bodies.info(pair.body_j).id));
            }
            fresh.push_back({k, begin, end, alone, overlap});
        }
    }
    return fresh;
}

}  // namespace

void set_thickness(World& world, double thick) {
    world.settings.thick = thick;
    for (const BodyShape& shape : world.bodies.shapes) {
        for (std::uint32_t e = shape.first_element; e < shape.first_element + shape.element_count; ++e) {
            Element& element = world.bodies.elements[e];
            if (shape.piece_count > 0) element.radius = 0.5 * thick;
            element.target_reach = shape.piece_count > 0 ? 0.5 * thick : thick;
        }
    }
    bodies_moved(world);
}

std::int64_t bond_all(World& world, double thick) {
    Bonding bonding;
    bonding.thick = thick;
    return bond_all(world, bonding);
}

std::int64_t bond_all(World& world, const Bonding& bonding) {
    if (bonding.thick != world.settings.thick) set_thickness(world, bonding.thick);
    const double skin = world.list.skin;
    widen_skin(world, bonding);
    refresh_neighbours(world);
    take_laps(world);
    const std::vector<std::int32_t> joints = joints_of_points(world, bonding);
    begin_shear_roots(world);
    std::int64_t bonds = 0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        world.points.shear_force[k] = 0.0;
        world.points.state[k].flags = 0;
        world.points.bond_overlap[k] = 0.0;
        if (k >= world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)]) continue;
        const PointView view = view_point(world, k);
        if (!joints.empty()) world.points.bond_overlap[k] = rest_overlap_between(world, view.body_i, view.body_j);
        if (view.overlap + largest_gap(world, k, view, bonding) <= 0.0) continue;
        if (!joints.empty()) {
            const std::size_t rock = law_between(world, view.body_i, view.body_j);
            const bool of_joint = joints[k] != no_joint;
            world.points.state[k].law =
                static_cast<std::uint16_t>(of_joint ? world.settings.joint_law(rock, joints[k]) : rock);
            if (of_joint && !world.settings.joint_of_law(world.points.state[k].law).bonded) {
                open_point(world, k, world.settings.joint_of_law(world.points.state[k].law), view, bonding.pressed);
                continue;
            }
        }
        if (bonding.leaves && bonding.leaves(view.body_i, view.body_j)) {
            // The point is left in the state of a point whose bond has broken: it has no force at its current position,
            // and can transmit pressure and friction.
            world.points.bond_overlap[k] = std::max(view.overlap, 0.0);
            world.points.state[k].flags = point_had_bond;
            continue;
        }
        world.points.bond_overlap[k] = view.overlap;
        world.points.state[k].flags = point_bonded | point_touching;
        if (bonding.holds && bonding.holds(view.position, view.body_i, view.body_j))
            world.points.state[k].flags |= point_held;
        ++bonds;
    }
    if (world.settings.own_shares()) share_faces(world, bonding);
    find_point_properties(world);
    if (facts_of(world.settings.bond_law).strengths_are_given) set_strengths(world, bonding);
    if (world.list.skin != skin) {
        world.list.skin = skin;
        world.list.valid = false;
    }
    finish_bonding(world);
    if (!world.list.valid) refresh_neighbours(world);
    return bonds;
}

std::int64_t bond_by_faces(World& world, const FaceBonding& bonding, FaceQuality* quality) {
    if (bonding.gap != world.settings.thick) set_thickness(world, bonding.gap);
    world.settings.bond_law = BondLaw::face;
    world.faces = bond_faces(world, bonding, quality);
    begin_shear_roots(world);
    derive_joint_laws(world.settings);
    for (PointState& point : world.points.state) point.flags = 0;
    world.bonds.made = true;
    bound_faces(world);
    world.list.valid = false;
    refresh_neighbours(world);
    finish_bonding(world);
    return world.bonds.initial;
}

std::int64_t bond_pairs(World& world, std::span<const BodyPair> pairs, double gap) {
    if (gap > 0.0 && !facts_of(world.settings.bond_law).bonds_across_gaps)
        throw InputError(
            fmt::format("gap: found {:g} m with {} bonds, expected 0, since the strength of such a bond follows from "
                        "its overlap; to bond across gaps, use bond.law = {}",
                        gap, name_of(world.settings.bond_law), laws_with(&BondLawFacts::bonds_across_gaps)));
    std::vector<BodyIndices> asked;
    for (const BodyPair& pair : pairs) {
        if (pair.body_i == pair.body_j)
            throw InputError(
                fmt::format("bond: found body {} twice, expected two bodies", world.bodies.info(pair.body_i).id));
        asked.push_back(ordered(pair));
    }
    std::ranges::sort(asked);
    refresh_neighbours(world);
    const std::vector<FreshBond> fresh = fresh_bonds(world, asked, gap);
    if (fresh.empty()) return 0;
    begin_shear_roots(world);
    std::int64_t interfaces = 0;
    for (const FreshBond& one : fresh) {
        world.points.shear_force[one.point] = 0.0;
        world.points.bond_overlap[one.point] = one.overlap;
        world.points.state[one.point].flags = point_bonded | point_touching;
    }
    const FreshBond* last = nullptr;
    for (const FreshBond& one : fresh) {
        if (last != nullptr && last->begin == one.begin) continue;  // the pair has already been counted
        last = &one;
        interfaces += one.alone ? 1 : 0;
        if (world.settings.own_shares()) share_pair(world, {}, one.begin, one.end);
    }
    find_point_properties(world);
    world.bonds.made = true;
    world.bonds.initial += static_cast<std::int64_t>(fresh.size());
    world.bonds.interfaces_initial += interfaces;
    visit_remembered(world.points, [&]<class T>(Array<T>& values, Remembered remembered) {
        if (remembered == Remembered::always || of_shares(remembered) || !keeps(world, remembered)) return;
        values.resize(world.points.size());  // some arrays are empty until the first bonds are made
        for (const FreshBond& one : fresh) values[one.point] = T{};
    });
    restart_account(world);
    velocities_changed(world);
    find_exact_step(world);
    evaluate_step_bound(world);
    return static_cast<std::int64_t>(fresh.size());
}

void finish_bonding(World& world) {
    world.bonds.made = true;
    world.bonds.initial = std::count_if(world.points.state.begin(), world.points.state.end(),
                                        [](const PointState& p) { return (p.flags & point_bonded) != 0; });
    world.bonds.held = std::count_if(world.points.state.begin(), world.points.state.end(), [](const PointState& p) {
        return (p.flags & point_held) != 0 && (p.flags & point_bonded) != 0;
    });
    world.bonds.interfaces_initial = count_interfaces(world);
    count_faces(world);
    find_exact_step(world);
    evaluate_step_bound(world);
    world.bonds.broken = world.bonds.broken_after_sliding = 0;
    world.bonds.interfaces_lost = 0;
    visit_remembered(world.points, [&]<class T>(Array<T>& values, Remembered remembered) {
        if (remembered != Remembered::always && !of_shares(remembered))
            values.assign(keeps(world, remembered) ? world.points.size() : 0, T{});
    });
    world.bonds.events.clear();
    world.bonds.slips.clear();
    world.bonds.events.reserve(static_cast<std::size_t>(std::min<std::int64_t>(world.bonds.initial, events_at_once)));
    restart_account(world);
    world.stepping.drift = 0.0;  // nothing has moved since bonding
    world.stepping.forces_current = false;
    if (world.settings.intact.no_new_contacts) {
        world.list.valid = false;
        refresh_neighbours(world);
    }
}

}  // namespace crackle
