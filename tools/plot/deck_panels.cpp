// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/deck_panels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ranges>
#include <utility>

#include "solver/base/errors.hpp"
#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/plotted_curves.hpp"

namespace crackle::plot {
namespace {

struct DrawnCurve {
    std::string label;
    std::vector<double> x, y;
    Colour colour;
    bool dashed = false;
};

struct AxisTitle {
    std::string title, unit;
    bool prefixes = false;
};

Unit unit_of(const AxisTitle& axis, double largest) {
    return axis.prefixes ? unit_for(largest, axis.unit) : unit_with_power(largest, axis.unit);
}

std::vector<Legend::Entry> entries_of_curves(const std::vector<DrawnCurve>& curves) {
    std::vector<Legend::Entry> entries;
    entries.reserve(curves.size());
    for (const DrawnCurve& curve : curves) entries.push_back({curve.label, curve.colour, curve.dashed});
    return entries;
}

/// @param heading text above the legend; may be empty
Panel curves_panel(const AxisTitle& x_title, const AxisTitle& y_title, const std::string& heading,
                   const std::vector<DrawnCurve>& curves) {
    const auto heading_height = [heading](const Canvas& canvas) {
        return heading.empty() ? 0.0 : 1.25 * canvas.size_of("Xy").height;
    };
    Panel panel;
    panel.height = [=](const Canvas& measure, double width) {
        const Legend legend = legend_of(measure, entries_of_curves(curves), width);
        return 0.55 * proportional(width) + legend.more_rows() +
               (legend.height() > 0.0 ? heading_height(measure) : 0.0);
    };
    panel.draw = [=](Canvas& canvas, const Rect& whole) {
        Range x, y;
        for (const DrawnCurve& curve : curves) {
            x.include(curve.x);
            y.include(curve.y);
        }
        const Unit x_unit = unit_of(x_title, x.size()), y_unit = unit_of(y_title, y.size());
        const Legend legend = legend_of(canvas, entries_of_curves(curves), whole.width);
        const double above = legend.height() > 0.0 ? heading_height(canvas) : 0.0;
        const Rect place{whole.x, whole.y + above, whole.width, whole.height - above};
        if (!heading.empty())
            canvas.text({whole.x + beside_letter, whole.y}, escaped(heading), Across::left, Down::top, 1.0, ink);
        Axes axes;
        axes.x = scale_around(x.low / x_unit.factor, x.high / x_unit.factor, whole.width < 300.0 ? 6 : 10);
        axes.y = scale_around(y.low / y_unit.factor, y.high / y_unit.factor, 5);
        draw_legend_above(canvas, place, legend, axes);
        const Colour zero = colour("#c8ccd0");
        if (axes.y.low < 0.0 && axes.y.high > 0.0)
            canvas.line({axes.at(axes.x.low, 0.0), axes.at(axes.x.high, 0.0)}, zero, 0.4);
        if (axes.x.low < 0.0 && axes.x.high > 0.0)
            canvas.line({axes.at(0.0, axes.y.low), axes.at(0.0, axes.y.high)}, zero, 0.4);
        for (const DrawnCurve& curve : curves)
            canvas.line(curve_points(axes, curve.x, x_unit.factor, curve.y, y_unit.factor), curve.colour, curve_width,
                        curve.dashed);
        axes.draw(canvas, titled(x_title.title, x_unit.name), titled(y_title.title, y_unit.name));
    };
    return panel;
}

AxisTitle time_axis(const std::vector<PlottedDeck>& decks) {
    const bool in_time =
        std::ranges::all_of(decks, [](const PlottedDeck& deck) { return deck.recording->curves.in_time; });
    return in_time ? AxisTitle{"time <i>t</i>", "s", true} : AxisTitle{"step", "", false};
}

/// Appearance of one part of the energy balance: an energy, a loss, work done on bodies, or the closing error.
struct EnergyLook {
    DeckEnergy part;
    const char* label;
    Colour colour;
    bool dashed = false;
};

const std::vector<EnergyLook>& energy_looks() {
    static const std::vector<EnergyLook> looks{
        {DeckEnergy::potential, "potential", series_colour(0)},
        {DeckEnergy::kinetic, "kinetic", series_colour(1)},
        {DeckEnergy::strain, "strain", series_colour(2)},
        {DeckEnergy::dashpots, "lost to dashpots", series_colour(3)},
        {DeckEnergy::friction, "lost to friction", series_colour(4)},
        {DeckEnergy::broken_bonds, "lost to breaks", tension_colour},
        {DeckEnergy::displacement_work, "work of displacements", series_colour(6)},
        {DeckEnergy::force_work, "work of forces", series_colour(7)},
        {DeckEnergy::error, "closing error", shear_colour, true}};
    return looks;
}

bool all_zero(const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double value) { return value == 0.0; });
}

/// Panel of the energy balance. Parts that are always 0 are omitted, except the closing error.
Panel energy_panel(const PlottedDeck& deck, const AxisTitle& energy) {
    const DeckEnergyCurve& curve = deck.recording->curves.energy;
    std::vector<DrawnCurve> curves;
    for (const EnergyLook& look : energy_looks()) {
        const std::vector<double>& values = curve.of(look.part);
        if (look.part != DeckEnergy::error && all_zero(values)) continue;
        curves.push_back({fmt::format("{} ({})", look.label, deck_energy_names[static_cast<std::size_t>(look.part)]),
                          curve.time, values, look.colour, look.dashed});
    }
    return curves_panel(time_axis({deck}), energy, deck.label, curves);
}

std::vector<double> less_first(const std::vector<double>& values) {
    std::vector<double> differences;
    differences.reserve(values.size());
    for (const double value : values) differences.push_back(value - values.front());
    return differences;
}

/// Curves of the decks' bodies, labelled and coloured in order.
/// @param all curves of all bodies of a deck @param draw returns x and y for the curve of one body
template <class Curves, class Draw>
std::vector<DrawnCurve> body_curves(const std::vector<PlottedDeck>& decks, Curves DeckCurves::*all, const Draw& draw) {
    constexpr std::size_t colours = 8;  // number of different colours of series_colour(); further curves are dashed
    std::vector<DrawnCurve> curves;
    for (const PlottedDeck& deck : decks) {
        const Curves& of_deck = deck.recording->curves.*all;
        const auto drawn = [&](const auto& curve) {
            return std::ranges::find(deck.bodies, curve.id) != deck.bodies.end();
        };
        const bool several = std::ranges::count_if(of_deck, drawn) > 1;
        for (const auto& curve : of_deck | std::views::filter(drawn)) {
            const std::string body = fmt::format("body {}", curve.id);
            auto [x, y] = draw(curve);
            const std::size_t number = curves.size();
            curves.push_back({deck.label.empty() ? body
                              : several          ? fmt::format("{}, {}", deck.label, body)
                                                 : deck.label,
                              std::move(x), std::move(y), series_colour(number), number / colours % 2 == 1});
        }
    }
    return curves;
}

using Column = std::vector<double> DeckBodyCurve::*;

struct Direction {
    const char* index;
    Column place, force;
};
constexpr Direction horizontal{"x", &DeckBodyCurve::x, &DeckBodyCurve::force_x},
    vertical{"y", &DeckBodyCurve::y, &DeckBodyCurve::force_y};

/// Largest change of a column over all bodies that are drawn.
double change_of(const std::vector<PlottedDeck>& decks, Column column) {
    double most = 0.0;
    for (const PlottedDeck& deck : decks) {
        for (const DeckBodyCurve& body : deck.recording->curves.bodies) {
            if (std::ranges::find(deck.bodies, body.id) == deck.bodies.end()) continue;
            const auto [low, high] = std::ranges::minmax(body.*column);
            most = std::max(most, high - low);
        }
    }
    return most;
}

// Smallest change that is not round-off, relative to the change in the other direction.
constexpr double no_change = 1e-9;

/// Directions in which the values of a column change; both directions if `still` is true.
std::vector<Direction> directions_of(const std::vector<PlottedDeck>& decks, Column Direction::*column, bool still) {
    if (still) return {horizontal, vertical};
    const double x = change_of(decks, horizontal.*column), y = change_of(decks, vertical.*column);
    std::vector<Direction> worth;
    if (x > no_change * y) worth.push_back(horizontal);
    if (y > no_change * x) worth.push_back(vertical);
    return worth;
}

/// Panel of curves of bodies. The name of a single body is the heading; names of several bodies are in the legend.
Panel body_panel(const AxisTitle& x, const AxisTitle& y, const std::vector<DrawnCurve>& curves) {
    return curves_panel(x, y, curves.size() == 1 ? curves.front().label : "", curves);
}

}  // namespace

bool has_rows(const Recording& deck, DeckWord word) {
    switch (word) {
        case DeckWord::energy:
            return !deck.curves.energy.time.empty();
        case DeckWord::velocity:
            return !deck.curves.velocities.empty();
        case DeckWord::displacement:
        case DeckWord::height:
        case DeckWord::force:
        case DeckWord::curve:
            break;
    }
    return !deck.curves.bodies.empty();
}

std::vector<DeckWord> words_worth_drawing(const std::vector<PlottedDeck>& decks) {
    const auto all_have = [&](DeckWord word) {
        return std::ranges::all_of(decks, [&](const PlottedDeck& deck) { return has_rows(*deck.recording, word); });
    };
    const auto is_driven = [](const PlottedDeck& deck) {
        const DeckEnergyCurve& energy = deck.recording->curves.energy;
        return !all_zero(energy.of(DeckEnergy::displacement_work)) || !all_zero(energy.of(DeckEnergy::force_work));
    };
    const auto moves = [](const PlottedDeck& deck) {
        return std::ranges::any_of(deck.recording->curves.velocities,
                                   [](const DeckVelocityCurve& body) { return !all_zero(body.vy); });
    };
    std::vector<DeckWord> words;
    if (all_have(DeckWord::energy)) words.push_back(DeckWord::energy);
    if (all_have(DeckWord::displacement)) words.push_back(DeckWord::displacement);
    if (all_have(DeckWord::velocity) && std::ranges::any_of(decks, moves)) words.push_back(DeckWord::velocity);
    if (all_have(DeckWord::curve) && std::ranges::any_of(decks, is_driven)) words.push_back(DeckWord::curve);
    return words;
}

std::vector<DeckWord> words_of_decks(const std::vector<std::string>& what, const std::vector<PlottedDeck>& decks) {
    std::vector<DeckWord> words;
    for (const std::string& word : what) {
        if (word == "all") {
            words = words_worth_drawing(decks);
            break;
        }
        const std::optional<DeckWord> found = from_name<DeckWord>(word);
        if (!found)
            throw InputError(fmt::format("plot: --what: found '{}', expected {} or all for the run of a deck", word,
                                         fmt::join(crackle::names_of<DeckWord>(), ", ")));
        words.push_back(*found);
    }
    for (const DeckWord word : words) {
        for (const PlottedDeck& deck : decks) {
            if (has_rows(*deck.recording, word)) continue;
            const char* file = word == DeckWord::energy     ? "energy.dat"
                               : word == DeckWord::velocity ? "velocity_y.dat"
                                                            : "f-d_curve.dat";
            throw InputError(fmt::format("plot: {}: found no rows in {}, expected {}", deck.recording->name, file,
                                         word == DeckWord::energy || word == DeckWord::velocity
                                             ? "the rows of a run of at least one step"
                                             : "rows of the bodies that in_bc.dat lists (npfd)"));
        }
    }
    if (words.empty())
        throw InputError(
            fmt::format("plot: {}: found no changing values, expected rows in energy.dat, f-d_curve.dat "
                        "or velocity_y.dat",
                        decks.front().recording->name));
    return words;
}

std::vector<int> watched_bodies(const Recording& deck) {
    std::vector<int> all;
    const auto id = [](const auto& curve) { return curve.id; };
    std::ranges::transform(deck.curves.bodies, std::back_inserter(all), id);
    if (all.empty()) std::ranges::transform(deck.curves.velocities, std::back_inserter(all), id);
    return all;
}

std::vector<Panel> deck_panels(DeckWord word, const std::vector<PlottedDeck>& decks,
                               const std::optional<UnitNames>& units, bool still) {
    constexpr const char* own = "deck's units";
    const UnitNames names = units.value_or(UnitNames{own, own, own, own, own, false});
    const AxisTitle time = time_axis(decks);
    const auto axis = [&](const std::string& title, const std::string& unit) {
        return AxisTitle{title, unit, names.prefixes};
    };
    const auto moved = [&](const Direction& d) { return axis("displacement " + indexed("u", d.index), names.length); };
    const auto forced = [&](const Direction& d) { return axis("force " + indexed("F", d.index), names.force); };
    const auto over_time = [&](Column column, bool from_start) {
        return body_curves(decks, &DeckCurves::bodies, [&](const DeckBodyCurve& body) {
            return std::pair(body.time, from_start ? less_first(body.*column) : body.*column);
        });
    };
    std::vector<Panel> panels;
    switch (word) {
        case DeckWord::energy:
            for (const PlottedDeck& deck : decks)
                panels.push_back(energy_panel(deck, axis("energy <i>E</i>", names.energy)));
            break;
        case DeckWord::displacement:
            for (const Direction& d : directions_of(decks, &Direction::place, still))
                panels.push_back(body_panel(time, moved(d), over_time(d.place, true)));
            break;
        case DeckWord::height:
            panels.push_back(body_panel(time, axis("height <i>y</i>", names.length), over_time(vertical.place, false)));
            break;
        case DeckWord::velocity:
            panels.push_back(body_panel(time, axis("velocity " + indexed("v", "y"), names.velocity),
                                        body_curves(decks, &DeckCurves::velocities, [](const DeckVelocityCurve& body) {
                                            return std::pair(body.time, body.vy);
                                        })));
            break;
        case DeckWord::force:
            for (const Direction& d : directions_of(decks, &Direction::force, still))
                panels.push_back(body_panel(time, forced(d), over_time(d.force, false)));
            break;
        case DeckWord::curve:
            for (const Direction& d : directions_of(decks, &Direction::place, still)) {
                panels.push_back(body_panel(moved(d), forced(d),
                                            body_curves(decks, &DeckCurves::bodies, [&](const DeckBodyCurve& body) {
                                                return std::pair(less_first(body.*d.place), body.*d.force);
                                            })));
            }
            break;
    }
    return panels;
}

}  // namespace crackle::plot
