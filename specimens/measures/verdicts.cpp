// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "specimens/measures/parting.hpp"
#include "specimens/statistics/spoken.hpp"

namespace crackle {
namespace {

constexpr double fewest_across = 20.0;
// Smallest stress drop that counts as the first drop, relative to the largest stress before it.
constexpr double first_drop = 0.01;
constexpr double centre_share = 0.5, jaw_share = 0.8,
                 jaw_energy = 0.25;  // limits: two distances relative to the radius, and a fraction of the energy
// Limits for the largest crack: slant in degrees; extent relative to the diameter or height.
constexpr double largest_slant = 20.0, split_share = 0.5;
constexpr double midspan_share = 0.25;  // largest distance of a crack from midspan, relative to the height

// Limits of a claim on shear boxes: distance from the gap over the height, and share of the energy of breaks within it.
constexpr double gap_share = 0.25, gap_energy = 2.0 / 3.0;

/// A condition, and the sentence that reports its violation; {} stands for the value found.
struct Claim {
    const char *holds, *broken;
};
constexpr Claim wide_enough{"the specimen is at least 20 particles wide",
                            "the specimen is {} wide; at least 20 are needed"};
constexpr Claim away_from_platens{"the largest crack does not run along a platen",
                                  "the largest crack runs along a platen, not within the specimen: {}"};
constexpr Claim between_grips{"the specimen broke between its grips",
                              "the specimen did not break between its grips: {}"};
constexpr Claim from_the_middle{
    "before the stress first drops by 1 %, the mean distance of bond breaks from the centre along the load axis, "
    "weighted by energy, is less than 0.5 R",
    "before the stress first drops by 1 %, bond breaks lie too far from the centre along the load axis: their "
    "energy-weighted mean distance is {}; less than 0.5 R is needed"};
constexpr Claim not_at_the_jaws{
    "before the stress first drops by 1 %, bond breaks beyond 0.8 R from the centre release less than a quarter of the "
    "energy of all breaks",
    "before the stress first drops by 1 %, bond breaks beyond 0.8 R from the centre, near the jaws, release {} of the "
    "energy of all breaks; less than a quarter is needed"};
constexpr Claim split_disc{
    "the largest crack deviates by at most 20 degrees from the load axis and spans at least half the diameter",
    "the largest crack does not split the disc: {}; it must deviate by at most 20 degrees from the load axis and span "
    "at least half the diameter"};
constexpr Claim crack_at_midspan{
    "the largest crack lies within a quarter of the height, or two particles, of midspan and spans at least half of "
    "the height above any notch",
    "the largest crack does not run up from midspan: {}; it must lie within a quarter of the height, or two particles, "
    "of midspan and span at least half of the height above any notch"};
constexpr Claim sheared_gap{
    "bond breaks within a quarter of the height from the gap release at least two thirds of the energy of all breaks",
    "bond breaks within a quarter of the height from the gap release only {} of the energy of all breaks; at least two "
    "thirds are needed"};

struct BreakPlace {
    double x = 0.0, y = 0.0, energy = 0.0, time = 0.0;
    std::size_t crack = 0;  // index of the crack
};

/// Breakages within the specimen, at the positions where the bodies were bonded, each with the index of its crack. A
/// crack consists of breakages within one mean particle size of each other.
std::vector<BreakPlace> places_of(const TestSetup& setup, const ContactHistory& history) {
    std::vector<BreakPlace> places;
    for (const Crack& crack : history.cracks) {
        const ContactPoint point = setup.bonds.points[crack.bond];
        if (setup.apparatus.is_platen(point.body_i) || setup.apparatus.is_platen(point.body_j)) continue;
        const StartPlace &a = setup.bonds.start[point.body_i], &b = setup.bonds.start[point.body_j];
        places.push_back({0.5 * (a.x + b.x), 0.5 * (a.y + b.y), crack.energy, crack.time, 0});
    }
    std::ranges::stable_sort(places, {}, &BreakPlace::x);
    const double size = std::sqrt(setup.specimen.area / static_cast<double>(setup.specimen.particles));
    boost::disjoint_sets_with_storage<> joined(places.size());
    for (std::size_t k = 0; k < places.size(); ++k)
        for (std::size_t n = k + 1; n < places.size() && places[n].x - places[k].x <= size; ++n)
            if (std::hypot(places[n].x - places[k].x, places[n].y - places[k].y) <= size) joined.union_set(k, n);
    for (std::size_t k = 0; k < places.size(); ++k) places[k].crack = joined.find_set(k);
    return places;
}

/// The crack with the most breaks.
struct LargestCrack {
    std::size_t breaks = 0;
    double slant = 0.0;                                                 // angle between the longest axis and y, degrees
    double low = std::numeric_limits<double>::infinity(), high = -low;  // m, extent along y
    double middle = 0.0;                                                // m, mean x
};

LargestCrack largest_of(const std::vector<BreakPlace>& places) {
    std::map<std::size_t, std::size_t> counts;
    for (const BreakPlace& place : places) ++counts[place.crack];
    LargestCrack largest;
    std::size_t root = 0;
    for (const auto& [crack, count] : counts) {
        if (count <= largest.breaks) continue;
        largest.breaks = count;
        root = crack;
    }
    double x = 0.0, y = 0.0;
    const auto n = static_cast<double>(largest.breaks);
    for (const BreakPlace& place : places) {
        if (place.crack != root) continue;
        x += place.x / n;
        y += place.y / n;
        largest.low = std::min(largest.low, place.y);
        largest.high = std::max(largest.high, place.y);
    }
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const BreakPlace& place : places) {
        if (place.crack != root) continue;
        xx += (place.x - x) * (place.x - x);
        xy += (place.x - x) * (place.y - y);
        yy += (place.y - y) * (place.y - y);
    }
    largest.middle = x;
    largest.slant = std::abs(0.5 * std::atan2(2.0 * xy, yy - xx)) * 180.0 / std::numbers::pi;
    return largest;
}

/// Time of the first row in which the stress is below its largest value by more than the fraction first_drop, s;
/// infinite if there is no such row.
double time_of_first_drop(std::span<const CurveRow> rows) {
    double largest = 0.0;
    for (const CurveRow& row : rows) {
        largest = std::max(largest, row.axial_stress);
        if (row.axial_stress < (1.0 - first_drop) * largest) return row.time;
    }
    return std::numeric_limits<double>::infinity();
}

std::string spoken_across(double across) {
    return (across < fewest_across ? spoken_below(across, fewest_across) : fmt::format("{:.3g}", across)) +
           " particles";
}

std::vector<Verdict> on_platens(const TestSetup& setup, const ContactHistory& history) {
    const double across = setup.specimen.width / std::sqrt(setup.specimen.width * setup.specimen.height /
                                                           static_cast<double>(setup.specimen.particles));
    std::vector<Verdict> verdicts{{wide_enough.holds, across >= fewest_across, spoken_across(across)}};
    Verdict place{setup.apparatus.compression ? away_from_platens.holds : between_grips.holds, std::nullopt,
                  "no bond has broken"};
    if (const auto parting = find_parting(setup, history)) {
        const bool in_gauge = parting->place == PartingPlace::gauge;
        place.holds = setup.apparatus.compression ? parting->place != PartingPlace::platen : in_gauge;
        place.found = counted(parting->bonds, "bond") +
                      (in_gauge ? " within the gauge length" : fmt::format(" at a {}", name_of(parting->place)));
    }
    verdicts.push_back(place);
    return verdicts;
}

std::vector<Verdict> on_disc(const TestedSpecimen& specimen, std::span<const CurveRow> rows,
                             const std::vector<BreakPlace>& places) {
    const double radius = 0.5 * specimen.width, centre = specimen.middle_height;
    const double until = time_of_first_drop(rows);
    double energy = 0.0, moment = 0.0, of_jaws = 0.0;
    std::size_t before = 0;
    for (const BreakPlace& place : places) {
        if (place.time > until) continue;
        const double away = std::abs(place.y - centre) / radius;
        ++before;
        energy += place.energy;
        moment += place.energy * away;
        if (away > jaw_share) of_jaws += place.energy;
    }
    Verdict middle{from_the_middle.holds, std::nullopt, "no bond broke before the stress dropped by 1 %"};
    Verdict jaws{not_at_the_jaws.holds, std::nullopt, "no bond broke before the stress dropped by 1 %"};
    if (energy > 0.0) {
        middle.holds = moment / energy < centre_share;
        middle.found = fmt::format("{:.2f} R for {} breaks", moment / energy, before);
        jaws.holds = of_jaws / energy < jaw_energy;
        jaws.found = fmt::format("{:.0f} %", 100.0 * of_jaws / energy);
    }
    return {middle, jaws};
}

Verdict splits(const TestedSpecimen& specimen, const LargestCrack& crack) {
    const double spans = (crack.high - crack.low) / specimen.width;
    return {split_disc.holds, crack.slant <= largest_slant && spans >= split_share,
            fmt::format("{:.0f} degrees from the load axis, {:.2f} of the diameter, {} breaks", crack.slant, spans,
                        crack.breaks)};
}

Verdict from_midspan(const TestedSpecimen& specimen, const LargestCrack& crack) {
    const double size = std::sqrt(specimen.area / static_cast<double>(specimen.particles));
    const double away = std::abs(crack.middle - specimen.middle);
    const double spans = (crack.high - crack.low) / (specimen.height - specimen.notch);
    return {crack_at_midspan.holds,
            away <= std::max(midspan_share * specimen.height, 2.0 * size) && spans >= split_share,
            fmt::format("{:.3g} m from midspan, {:.2f} of the height above any notch, {} breaks", away, spans,
                        crack.breaks)};
}

Verdict along_gap(const TestedSpecimen& specimen, const std::vector<BreakPlace>& places) {
    double energy = 0.0, near = 0.0;
    for (const BreakPlace& place : places) {
        energy += place.energy;
        if (std::abs(place.y - specimen.middle_height) <= gap_share * specimen.height) near += place.energy;
    }
    Verdict verdict{sheared_gap.holds, std::nullopt, "no bond has broken"};
    if (energy > 0.0) {
        verdict.holds = near >= gap_energy * energy;
        verdict.found = fmt::format("{:.0f} %", 100.0 * near / energy);
    }
    return verdict;
}

}  // namespace

std::string broken_claim(const std::string& claim, const std::string& found) {
    for (const Claim& one : {wide_enough, away_from_platens, between_grips, from_the_middle, not_at_the_jaws,
                             split_disc, crack_at_midspan, sheared_gap})
        if (claim == one.holds) return fmt::format(fmt::runtime(one.broken), found);
    return fmt::format("condition not met: {}: {}", claim, found);
}

std::vector<Verdict> verdicts_on(const TestSetup& setup, std::span<const CurveRow> rows, const ContactHistory& history,
                                 bool failed) {
    const ValidFailure asked = test_kind(setup.apparatus.kind).valid_failure;
    if (asked == ValidFailure::between_platens) return on_platens(setup, history);
    const std::vector<BreakPlace> places = places_of(setup, history);
    if (asked == ValidFailure::along_gap) return {along_gap(setup.specimen, places)};
    const bool disc = asked == ValidFailure::splits_disc;
    std::vector<Verdict> verdicts;
    if (disc) verdicts = on_disc(setup.specimen, rows, places);
    Verdict last = disc ? splits(setup.specimen, largest_of(places)) : from_midspan(setup.specimen, largest_of(places));
    if (!failed) {
        last.holds.reset();
        last.found = "the specimen has not failed";
    }
    verdicts.push_back(last);
    return verdicts;
}

}  // namespace crackle
