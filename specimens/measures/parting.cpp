// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/parting.hpp"

#include <boost/pending/disjoint_sets.hpp>
#include <map>

namespace crackle {
namespace {

struct CrackSum {
    std::int64_t bonds = 0, of_platen = 0;
    double height = 0.0;  // sum of the heights of the crack's bonds, m
};

}  // namespace

std::optional<Parting> find_parting(const TestSetup& setup, const ContactHistory& history) {
    if (history.cracks.empty()) return std::nullopt;
    boost::disjoint_sets_with_storage<> cracked(setup.bonds.start.size());
    const auto point_of = [&](const Crack& crack) { return setup.bonds.points[crack.bond]; };
    for (const Crack& crack : history.cracks) cracked.union_set(point_of(crack).body_i, point_of(crack).body_j);
    std::map<std::size_t, CrackSum> sums;  // ordered, so that ties are resolved reproducibly
    for (const Crack& crack : history.cracks) {
        const ContactPoint point = point_of(crack);
        CrackSum& sum = sums[cracked.find_set(point.body_i)];
        ++sum.bonds;
        const bool platen_i = setup.apparatus.is_platen(point.body_i),
                   platen_j = setup.apparatus.is_platen(point.body_j);
        sum.of_platen += platen_i || platen_j ? 1 : 0;
        const double y_i = setup.bonds.start[point.body_i].y, y_j = setup.bonds.start[point.body_j].y;
        sum.height += platen_i ? y_j : platen_j ? y_i : 0.5 * (y_i + y_j);
    }
    const CrackSum* largest = nullptr;
    for (const auto& [root, sum] : sums)
        if (largest == nullptr || sum.bonds > largest->bonds) largest = &sum;
    Parting parting;
    parting.bonds = largest->bonds;
    parting.of_platen = largest->of_platen;
    parting.height = largest->height / static_cast<double>(largest->bonds) - setup.specimen.low_end;
    const bool in_grip = parting.height < setup.bonds.grip || parting.height > setup.specimen.height - setup.bonds.grip;
    parting.place = 2 * parting.of_platen >= parting.bonds ? PartingPlace::platen
                    : in_grip                              ? PartingPlace::grip
                                                           : PartingPlace::gauge;
    return parting;
}

}  // namespace crackle
