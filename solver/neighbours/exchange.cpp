// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/neighbours/exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/contact/joint_law.hpp"
#include "solver/contact/pass.hpp"
#include "solver/faces/hand_over.hpp"
#include "solver/geometry/across_joint.hpp"
#include "solver/geometry/contact_share.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/world/point_order.hpp"

namespace crackle {
namespace {

constexpr PointIndex no_point = std::numeric_limits<PointIndex>::max();

/// Iterates over the points of one kind in the old list, sorted by key. Points of the kind element_outline are stored
/// in two sorted ranges.
class OldPoints {
  public:
    OldPoints(const World& world, PointKind kind) : world_(world), kind_(kind) {
        const auto number = static_cast<std::size_t>(kind);
        first_ = world.points.kind_begin[number];
        second_end_ = world.points.kind_begin[number + 1];
        first_end_ = second_ = kind == PointKind::element_outline ? world.points.fours_end : second_end_;
        look();
    }
    bool done() const { return first_ == first_end_ && second_ == second_end_; }
    PointIndex at() const { return of_first_ ? first_ : second_; }
    const PointKey& key() const { return key_; }
    void next() {
        ++(of_first_ ? first_ : second_);
        look();
    }

  private:
    void look() {
        if (done()) return;
        of_first_ = from_first();
        key_ = key_of(at());
    }
    bool from_first() const {
        if (first_ == first_end_ || second_ == second_end_) return second_ == second_end_;
        return key_of(first_) < key_of(second_);
    }
    PointKey key_of(PointIndex k) const {
        const auto [i, j] = world_.points.contact.pairs[k];
        PointParts parts{own_circle, own_circle};
        if (kind_ != PointKind::circle_circle) parts = world_.points.contact.parts[k - world_.points.kind_begin[1]];
        return crackle::key_of(kind_, {i, j, parts.element_i, parts.feature_j});
    }

    const World& world_;
    PointKind kind_;
    PointIndex first_, first_end_, second_, second_end_;
    bool of_first_ = false;
    PointKey key_{};  // key of the current point
};

/// Points of the new list, with the index of each point in the old list.
struct MergedList {
    Array<ContactPoint> points;
    std::vector<PointIndex> old;  // for each point, its index in the old list; no_point if it was not listed
};

/// A point of the old list that is kept although the new list does not contain it.
struct KeptPoint {
    std::size_t place;  // index of the new point before which the kept point is inserted
    PointIndex old;
};

/// Inserts the kept points into the new list; they must be in ascending order.
void insert_kept(const World& world, const std::vector<KeptPoint>& kept, MergedList& next) {
    std::size_t from = next.points.size(), to = from + kept.size();
    next.points.resize(to);
    next.old.resize(to);
    for (auto one = kept.rbegin(); one != kept.rend(); ++one) {
        while (from > one->place) {
            --from, --to;
            next.points[to] = next.points[from];
            next.old[to] = next.old[from];
        }
        --to;
        next.points[to] = world.points.contact[one->old];
        next.old[to] = one->old;
    }
}

/// Merges the new list of a kind with the old list. A bonded point is carried over even if it is not in the new list,
/// since its bond lasts until the force pass finds it broken. Unbreakable bonds hold at any opening. A point that keeps
/// properties of an earlier bond is also carried over, since these properties must not depend on when the list was
/// built.
MergedList merge_lists(World& world, PointKind kind, Array<ContactPoint> found) {
    MergedList next{std::move(found), {}};
    next.old.resize(next.points.size());
    const bool consistent = world.settings.integrator == Integrator::consistent;
    const bool closed = world.bonds.made && world.settings.intact.no_new_contacts;
    const auto flagged = [&](PointIndex old, PointFlag flag) { return (world.points.state[old].flags & flag) != 0; };
    const auto leave_out = [&](PointIndex old) {
        if (consistent)
            world.account.opening_defects[world.points.contact[old].body_i] += world.points.opening[old].defect;
    };
    std::size_t count = 0;
    std::vector<KeptPoint> kept;
    OldPoints old(world, kind);
    const auto pass_unlisted = [&] {
        // A point that touched one step ago is kept at any opening, because its energy account is not yet complete.
        // Flat faces of circles that have rotated can touch across a gap.
        const bool settles = (consistent ? !by_guide(kind) : kind == PointKind::face_face) &&
                             flagged(old.at(), point_touching) && !closed;
        if (flagged(old.at(), point_bonded) || (flagged(old.at(), point_had_bond) && !closed) || settles) {
            kept.push_back({count, old.at()});
        } else {
            leave_out(old.at());
        }
        old.next();
    };
    for (const ContactPoint& point : next.points) {
        const PointKey key = key_of(kind, point);
        while (!old.done() && old.key() < key) pass_unlisted();
        const bool known = !old.done() && old.key() == key;
        if (!closed || (known && flagged(old.at(), point_bonded))) {
            next.old[count] = known ? old.at() : no_point;
            next.points[count] = point;
            ++count;
        } else if (known) {
            leave_out(old.at());
        }
        if (known) old.next();
    }
    while (!old.done()) pass_unlisted();
    next.points.resize(count);
    next.old.resize(count);
    insert_kept(world, kept, next);
    return next;
}

/// Moves the points of all pairs of bodies that have exactly four points to the front. @return number of these points
PointIndex put_fours_first(MergedList& next) {
    MergedList others;
    std::size_t fours = 0;
    for (std::size_t first = 0, last = 0; first < next.points.size(); first = last) {
        while (last < next.points.size() && same_pair(next.points[first], next.points[last])) ++last;
        for (std::size_t k = first; k < last; ++k) {
            if (last - first == 4) {
                next.points[fours] = next.points[k];
                next.old[fours] = next.old[k];
                ++fours;
            } else {
                others.points.push_back(next.points[k]);
                others.old.push_back(next.old[k]);
            }
        }
    }
    std::ranges::copy(others.points, next.points.begin() + static_cast<std::ptrdiff_t>(fours));
    std::ranges::copy(others.old, next.old.begin() + static_cast<std::ptrdiff_t>(fours));
    return static_cast<PointIndex>(fours);
}

/// Appends the values of the points of one kind to those of earlier kinds, reusing the memory of the larger array.
template <class Numbers>
void append(Numbers& all, Numbers more) {
    if (all.size() < more.size()) {
        more.insert(more.begin(), all.begin(), all.end());
        all = std::move(more);
    } else {
        all.insert(all.end(), more.begin(), more.end());
    }
}

/// Converts points to a ContactList. @param circles number of points of kind circle_circle
ContactList compact(Array<ContactPoint> points, PointIndex circles) {
    ContactList list;
    list.pairs.resize(points.size());
    list.parts.resize(points.size() - circles);
    for (std::size_t k = 0; k < points.size(); ++k) list.pairs[k] = {points[k].body_i, points[k].body_j};
    for (std::size_t k = circles; k < points.size(); ++k)
        list.parts[k - circles] = {points[k].element_i, points[k].feature_j};
    return list;
}

/// Reorders an array of point values to match the new list. @param old index of each new point in the old list @param
/// kept whether the world keeps this array; otherwise the result is empty
template <class T>
void carry_over(Array<T>& values, const std::vector<PointIndex>& old, bool kept = true) {
    Array<T> now(kept ? old.size() : 0, T{});
    if (!values.empty()) {
        for (std::size_t k = 0; k < now.size(); ++k) {
            if (old[k] != no_point) now[k] = values[old[k]];
        }
    }
    values = std::move(now);
}

/// For new contacts across an open joint with an aperture, sets the overlap at which their force is zero.
void open_new_contacts(World& world, const std::vector<PointIndex>& old) {
    if (std::ranges::none_of(world.settings.joints, [](const Joint& joint) { return joint.aperture > 0.0; })) return;
    const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    for (PointIndex k = 0; k < walls; ++k) {
        const auto [i, j] = world.points.contact.pairs[k];
        if (old[k] == no_point) world.points.bond_overlap[k] = rest_overlap_between(world, i, j);
    }
}

/// Transfers the energy defects of points that have left the list to other points of the same bodies. Dropping them
/// would accumulate errors, since the defects of such points are more often negative than positive.
void pass_on_defects(World& world) {
    for (std::size_t kind = 0; kind < point_kinds; ++kind) {
        if (!has_opening(static_cast<PointKind>(kind))) continue;
        for (PointIndex k = world.points.kind_begin[kind]; k < world.points.kind_begin[kind + 1]; ++k) {
            if ((world.points.state[k].flags & point_bonded) != 0) continue;
            const auto take = [&](BodyIndex b) {
                world.points.opening[k].defect += std::exchange(world.account.opening_defects[b], 0.0);
            };
            take(world.points.contact[k].body_i);
            if (static_cast<PointKind>(kind) != PointKind::element_wall) take(world.points.contact[k].body_j);
        }
    }
}

/// Square root of m_i m_j/(m_i + m_j), sqrt(kg); a body that is held in translation counts as infinitely heavy.
double root_effective_mass(const World& world, BodyIndex i, BodyIndex j) {
    const auto inverse = [&](BodyIndex b) {
        const BodyInertia& inertia = world.bodies.inertia[b];
        return inertia.inverse_mass_x > 0.0 || inertia.inverse_mass_y > 0.0 ? 1.0 / inertia.mass : 0.0;
    };
    const double sum = inverse(i) + inverse(j);
    return sum > 0.0 ? 1.0 / std::sqrt(sum) : 0.0;
}

/// Law of a point between two bodies in a world with joints. A point that is or was bonded keeps the law of its bond;
/// otherwise the joint between the bodies determines the law.
std::size_t jointed_law(const World& world, PointIndex k, BodyIndex i, BodyIndex j) {
    const PointState& state = world.points.state[k];
    const std::size_t rock = law_between(world, i, j);
    if ((state.flags & (point_bonded | point_had_bond)) != 0)
        return state.law >= world.settings.first_joint_law() ? state.law : rock;
    constexpr auto flat = static_cast<std::size_t>(PointKind::face_face);
    const bool faces = k >= world.points.kind_begin[flat] && k < world.points.kind_begin[flat + 1];
    const std::int32_t joint = faces ? joint_of_flat_faces(world, world.points.contact[k]) : joint_between(world, i, j);
    return joint == no_joint ? rock : world.settings.joint_law(rock, joint);
}

/// Sets the law and the effective mass of each point from its bodies.
void find_pairs(World& world) {
    const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    const bool jointed = !world.settings.joints.empty();
    world.points.root_mass.resize(world.points.size());
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const auto [i, j] = world.points.contact.pairs[k];
        const bool held = (world.points.state[k].flags & point_held) != 0;
        const std::size_t law = k >= walls ? law_with_wall(world, i)
                                : held     ? held_law_between(world, i, j)
                                : jointed  ? jointed_law(world, k, i, j)
                                           : law_between(world, i, j);
        world.points.state[k].law = static_cast<std::uint16_t>(law);
        world.points.root_mass[k] =
            k < walls ? root_effective_mass(world, i, j) : std::sqrt(world.bodies.inertia[i].mass);
    }
}

/// Stiffness factor of an unbonded contact for StiffnessUnits::area.
template <PointKind K>
float contact_stiffness_share(const World& world, PointIndex k) {
    const ContactShare contact = share_of_contact(world, K, world.points.contact[k]);
    return static_cast<float>(contact.stiffness() * series_shares(world, k, contact.distance).normal);
}

/// Sets Points::lap, the shared length of two flat faces, for points that are neither bonded nor in contact. Other
/// points keep the lap that was used to compute their last force.
void find_laps(World& world) {
    if (world.points.lap.empty()) return;
    const BodyView bodies(world);
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            if constexpr (K == PointKind::face_face) {
                if ((world.points.state[k].flags & (point_bonded | point_touching)) == 0)
                    world.points.lap[k] = flat_face_contact(bodies, world.points.contact[k]).lap();
            } else {
                world.points.lap[k] = 1.0;
            }
        }
    });
}

/// Sets Points::shear_root of points that have none yet; these are unbonded contacts.
void find_shear_roots(World& world) {
    if (world.points.shear_root.empty()) return;
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            float& root = world.points.shear_root[k];
            if (root != 0.0F) continue;
            root = 1.0F;
            if (world.points.state[k].law < world.settings.first_joint_law()) continue;
            const double distance = share_of_contact(world, K, world.points.contact[k]).distance;
            root = static_cast<float>(series_shares(world, k, distance).root_of_shear());
        }
    });
}

/// Sets the stiffness and strength factors of new points, which have no factors yet, to the values for unbonded
/// contacts. Multiplies the root mass of each point by the root of its stiffness factor.
void find_shares(World& world) {
    if (!world.settings.own_shares()) return;
    const bool by_area = world.settings.units == StiffnessUnits::area;
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            float& share = world.points.stiffness_share[k];
            if (share == 0.0F) share = by_area ? contact_stiffness_share<K>(world, k) : 1.0F;
            world.points.root_mass[k] *= std::sqrt(static_cast<double>(share));
        }
    });
}

void refuse_more_than_countable(std::size_t points) {
    constexpr std::size_t most = no_point - 1;
    if (points > most)
        throw InputError(
            fmt::format("found {} contact points, expected at most {}; use a smaller scene", points, most));
}

}  // namespace

void find_point_properties(World& world) {
    find_pairs(world);
    find_laps(world);
    find_shares(world);
    find_shear_roots(world);
}

void exchange_points(World& world, PointLists& lists) {
    MergedList next;
    std::array<PointIndex, point_kinds + 1> kind_begin{};
    PointIndex fours_end = 0;
    for (std::size_t number = 0; number < point_kinds; ++number) {
        const auto kind = static_cast<PointKind>(number);
        MergedList of_kind = merge_lists(world, kind, std::move(lists[number]));
        if (kind == PointKind::element_outline) fours_end = kind_begin[number] + put_fours_first(of_kind);
        refuse_more_than_countable(next.points.size() + of_kind.points.size());
        append(next.points, std::move(of_kind.points));
        append(next.old, std::move(of_kind.old));
        kind_begin[number + 1] = static_cast<PointIndex>(next.points.size());
    }
    const bool consistent = world.settings.integrator == Integrator::consistent;
    world.points.contact = {};  // frees memory for the new list
    world.points.contact = compact(std::move(next.points), kind_begin[1]);
    visit_remembered(world.points, [&](auto& values, Remembered remembered) {
        carry_over(values, next.old, keeps(world, remembered));
    });
    world.points.kind_begin = kind_begin;
    world.points.fours_end = fours_end;
    open_new_contacts(world, next.old);
    if (world.faces.size() > 0) rest_new_points(world, [&](PointIndex k) { return next.old[k] == no_point; });
    find_point_properties(world);
    if (consistent) pass_on_defects(world);
    world.points.force.assign(world.points.keep_forces ? world.points.size() : 0, PointForce{});
    world.account.blocks.assign(block_count(world), LossBlock{});
}

}  // namespace crackle
