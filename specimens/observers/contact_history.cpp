// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/contact_history.hpp"

#include <algorithm>
#include <boost/iterator/counting_iterator.hpp>
#include <stdexcept>
#include <utility>

#include "solver/geometry/geometry.hpp"
#include "solver/world/point_order.hpp"
#include "solver/world/world.hpp"

namespace crackle {

PointIndex bond_of(const BondRecord& bonds, PointKind kind, const ContactPoint& point) {
    const auto number = static_cast<std::size_t>(kind);
    const boost::counting_iterator<PointIndex> begin(bonds.kind_begin[number]);
    const boost::counting_iterator<PointIndex> end(bonds.kind_begin[number + 1]);
    const auto before = [&](PointIndex bond, const PointKey& key) { return key_of(kind, bonds.points[bond]) < key; };
    const auto found = std::lower_bound(begin, end, key_of(kind, point), before);
    const bool is_bond = found != end && same_point(kind, bonds.points[*found], point);
    return is_bond ? *found : static_cast<PointIndex>(bonds.points.size());
}

void note_break(const BondRecord& bonds, const BreakEvent& event, ContactHistory& history) {
    const PointIndex bond = bond_of(bonds, event.kind, event.point);
    if (bond == bonds.points.size()) throw std::logic_error("a point broke that was not bonded when loading began");
    history.cracks.push_back({event.time, event.energy, event.strength, event.orientation, bond, event.shear_mode});
}

namespace {

/// Computes LooseContact::joint_force for a point.
template <PointKind K>
double joint_force(const World& world, PointIndex k) {
    if (world.points.state[k].law < world.settings.first_joint_law() && world.faces.size() == 0)
        return std::numeric_limits<double>::quiet_NaN();
    const double overlap = overlap_at<K>(BodyView(world), world.points.contact[k]);
    return law_of(world, k).normal_stiffness * std::max(0.0, overlap - world.points.bond_overlap[k]);
}

}  // namespace

void look_at_contacts(const World& world, ContactHistory& history) {
    LooseContacts now;
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        const auto number = static_cast<std::size_t>(K);
        const auto less = [](const LooseContact& a, const LooseContact& b) {
            return key_of(K, a.point) < key_of(K, b.point);
        };
        const std::size_t first = now.contacts.size();
        for (PointIndex k = begin; k < end && K != PointKind::element_wall; ++k) {
            if ((world.points.state[k].flags & (point_touching | point_bonded)) == point_touching)
                now.contacts.push_back({world.points.contact[k], world.points.shear_force[k], world.stepping.time,
                                        joint_force<K>(world, k)});
        }
        const auto found = now.contacts.begin() + static_cast<std::ptrdiff_t>(first);
        if (K == PointKind::element_outline)
            std::sort(found, now.contacts.end(), less);  // points of this kind come from two sorted lists
        auto known = history.loose.contacts.cbegin() + history.loose.kind_begin[number];
        const auto known_end = history.loose.contacts.cbegin() + history.loose.kind_begin[number + 1];
        for (auto contact = found; contact != now.contacts.end(); ++contact) {
            while (known != known_end && less(*known, *contact)) ++known;
            if (known != known_end && same_point(K, known->point, contact->point)) contact->since = known->since;
        }
        now.kind_begin[number + 1] = static_cast<PointIndex>(now.contacts.size());
    });
    history.loose = std::move(now);
}

}  // namespace crackle
