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
constexpr double first_drop = 0.01;                                       // of the largest stress so far
constexpr double centre_share = 0.5, jaw_share = 0.8, jaw_energy = 0.25;  // of the radius; of the energy
constexpr double largest_slant = 20.0, split_share = 0.5;                 // degrees; of the diameter, or the ligament
constexpr double midspan_share = 0.25;                                    // of the height
constexpr double gap_share = 0.25, gap_energy = 2.0 / 3.0;                // of the height; of the energy

/// What must hold, and the sentence of one that does not, {} what was found.
struct Claim {
    const char *holds, *broken;
};
constexpr Claim wide_enough{"the specimen is at least 20 particles wide",
                            "the specimen is {} wide; at least 20 are needed"};
constexpr Claim away_from_platens{"the largest crack is not a platen's",
                                  "the largest crack is a platen's, not the specimen's: {}"};
constexpr Claim between_grips{"the specimen parted between its grips",
                              "the specimen did not part between its grips: {}"};
constexpr Claim from_the_middle{
    "before the first drop of 1 % the breaks' energy lies at less than 0.5 R from the centre along the load",
    "before the first drop of 1 % the breaks lie too far from the centre along the load: {}; less than 0.5 R is "
    "needed"};
constexpr Claim not_at_the_jaws{"breaks beyond 0.8 R have less than a quarter of that energy",
                                "breaks beyond 0.8 R, at the jaws, have {} of the energy before the first drop of 1 %; "
                                "less than a quarter is needed"};
constexpr Claim split_disc{
    "the largest crack lies within 20 degrees of the load axis and spans half the diameter",
    "the largest crack does not split the disc: {}; at most 20 degrees from the load axis and half the diameter are "
    "needed"};
constexpr Claim crack_at_midspan{
    "the largest crack lies at midspan, within a quarter of the height or two particles, and spans half of what is "
    "left above the notch",
    "the largest crack does not run from midspan: {}; within a quarter of the height or two particles of it and half "
    "of the height left are needed"};
constexpr Claim sheared_gap{"two thirds of the breaks' energy come from within a quarter of the height of the gap",
                            "only {} of the breaks' energy come from within a quarter of the height of the gap; two "
                            "thirds are needed"};

struct BreakPlace {
    double x = 0.0, y = 0.0, energy = 0.0, time = 0.0;
    std::size_t crack = 0;  // which it is of
};

/// Breaks within the specimen, where its bodies were bonded, and of which crack each is: breaks that lie within a mean
/// particle of each other.
std::vector<BreakPlace> places_of(const TestSetup& setup, const ContactHistory& history) {
    std::vector<BreakPlace> places;
    for (const Crack& crack : history.cracks) {
        const ContactPoint point = setup.bonds[crack.bond];
        if (setup.is_platen(point.body_i) || setup.is_platen(point.body_j)) continue;
        const StartPlace &a = setup.start[point.body_i], &b = setup.start[point.body_j];
        places.push_back({0.5 * (a.x + b.x), 0.5 * (a.y + b.y), crack.energy, crack.time, 0});
    }
    std::ranges::stable_sort(places, {}, &BreakPlace::x);
    const double size = std::sqrt(setup.area / static_cast<double>(setup.particles));
    boost::disjoint_sets_with_storage<> joined(places.size());
    for (std::size_t k = 0; k < places.size(); ++k)
        for (std::size_t n = k + 1; n < places.size() && places[n].x - places[k].x <= size; ++n)
            if (std::hypot(places[n].x - places[k].x, places[n].y - places[k].y) <= size) joined.union_set(k, n);
    for (std::size_t k = 0; k < places.size(); ++k) places[k].crack = joined.find_set(k);
    return places;
}

/// Of the crack with most breaks.
struct LargestCrack {
    std::size_t breaks = 0;
    double slant = 0.0;                                                 // degrees, of its longest axis from y
    double low = std::numeric_limits<double>::infinity(), high = -low;  // m, its extent along y
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

/// s, of the row where the stress first lies below its largest by more than a share; infinite: never.
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
    const double across = setup.width / std::sqrt(setup.width * setup.height / static_cast<double>(setup.particles));
    std::vector<Verdict> verdicts{{wide_enough.holds, across >= fewest_across, spoken_across(across)}};
    Verdict place{setup.compression ? away_from_platens.holds : between_grips.holds, std::nullopt,
                  "no bond has broken"};
    if (const auto parting = find_parting(setup, history)) {
        place.holds = setup.compression ? parting->place != "platen" : parting->place == "gauge";
        place.found = fmt::format("{} at a {}", counted(parting->bonds, "bond"), parting->place);
        if (parting->place == "gauge")
            place.found = fmt::format("{} within the gauge length", counted(parting->bonds, "bond"));
    }
    verdicts.push_back(place);
    return verdicts;
}

std::vector<Verdict> on_disc(const TestSetup& setup, std::span<const CurveRow> rows,
                             const std::vector<BreakPlace>& places) {
    const double radius = 0.5 * setup.width, centre = setup.middle_height;
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
    Verdict middle{from_the_middle.holds, std::nullopt, "no bond broke before it"};
    Verdict jaws{not_at_the_jaws.holds, std::nullopt, "no bond broke before it"};
    if (energy > 0.0) {
        middle.holds = moment / energy < centre_share;
        middle.found = fmt::format("{:.2f} R, of {} breaks", moment / energy, before);
        jaws.holds = of_jaws / energy < jaw_energy;
        jaws.found = fmt::format("{:.0f} %", 100.0 * of_jaws / energy);
    }
    return {middle, jaws};
}

Verdict splits(const TestSetup& setup, const LargestCrack& crack) {
    const double spans = (crack.high - crack.low) / setup.width;
    return {split_disc.holds, crack.slant <= largest_slant && spans >= split_share,
            fmt::format("{:.0f} degrees, {:.2f} of the diameter, {} breaks", crack.slant, spans, crack.breaks)};
}

Verdict from_midspan(const TestSetup& setup, const LargestCrack& crack) {
    const double size = std::sqrt(setup.area / static_cast<double>(setup.particles));
    const double away = std::abs(crack.middle - setup.middle);
    const double spans = (crack.high - crack.low) / (setup.height - setup.notch);
    return {crack_at_midspan.holds, away <= std::max(midspan_share * setup.height, 2.0 * size) && spans >= split_share,
            fmt::format("{:.3g} m from midspan, {:.2f} of the height left, {} breaks", away, spans, crack.breaks)};
}

Verdict along_gap(const TestSetup& setup, const std::vector<BreakPlace>& places) {
    double energy = 0.0, near = 0.0;
    for (const BreakPlace& place : places) {
        energy += place.energy;
        if (std::abs(place.y - setup.middle_height) <= gap_share * setup.height) near += place.energy;
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
    return fmt::format("it does not hold that {}: {}", claim, found);
}

std::vector<Verdict> verdicts_on(const TestSetup& setup, std::span<const CurveRow> rows, const ContactHistory& history,
                                 bool failed) {
    if (setup.uniaxial) return on_platens(setup, history);
    const std::vector<BreakPlace> places = places_of(setup, history);
    if (setup.kind == "direct_shear") return {along_gap(setup, places)};
    std::vector<Verdict> verdicts;
    if (setup.kind == "brazilian") verdicts = on_disc(setup, rows, places);
    Verdict last =
        setup.kind == "brazilian" ? splits(setup, largest_of(places)) : from_midspan(setup, largest_of(places));
    if (!failed) {
        last.holds.reset();
        last.found = "the specimen has not failed";
    }
    verdicts.push_back(last);
    return verdicts;
}

}  // namespace crackle
