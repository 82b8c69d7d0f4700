// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/point_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "solver/base/errors.hpp"
#include "specimens/results/summary.hpp"

namespace crackle {
namespace {

// Of the view `results`: what stands before the axes, between them and the figures, and of that what differs from run
// to run.
constexpr std::size_t axes_begin = 2;  // row, test
constexpr std::array<std::string_view, 5> behind_axes{"seed", "variant", "identity", "state", "processor_seconds"};

std::string cell_text(const Cell& cell) {
    if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    return "";
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char letter : text) {
        quoted += letter;
        if (letter == '"') quoted += letter;
    }
    return quoted + '"';
}

struct Columns {
    std::size_t seed, figures;

    explicit Columns(const LedgerTable& results)
        : seed(static_cast<std::size_t>(std::find(results.columns.begin(), results.columns.end(), behind_axes[0]) -
                                        results.columns.begin())),
          figures(seed + behind_axes.size()) {}
    std::size_t variant() const { return seed + 1; }
    std::size_t state() const { return seed + 3; }
    std::size_t processor_seconds() const { return seed + 4; }
};

const std::string& text_of(const Cell& cell) {
    static const std::string none;
    const auto* text = std::get_if<std::string>(&cell);
    return text != nullptr ? *text : none;
}

/// Place of a figure in summary.json by its name, or that of the table it is in.
std::size_t rank_of(const std::string& figure) {
    const auto& keys = summary_keys();
    std::string name = figure;
    if (name.ends_with(converted_suffix)) name.resize(name.size() - std::string_view(converted_suffix).size());
    for (std::size_t cut = name.size(); cut != std::string::npos; cut = name.rfind('.', cut - 1)) {
        const std::string_view part = std::string_view(name).substr(0, cut);
        const auto at = std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return part == key.what.name; });
        if (at != keys.end()) return static_cast<std::size_t>(at - keys.begin());
        if (cut == 0) break;
    }
    return keys.size();
}

/// Columns of figures in the order of summary.json, whichever test came first.
std::vector<std::size_t> ordered_figures(const LedgerTable& results) {
    std::vector<std::size_t> places;
    for (std::size_t k = Columns(results).figures; k < results.columns.size(); ++k) places.push_back(k);
    std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(rank_of(results.columns[a]), results.columns[a]) <
               std::pair(rank_of(results.columns[b]), results.columns[b]);
    });
    return places;
}

}  // namespace

std::string PointSummary::at() const {
    std::string text;
    for (const auto& [key, value] : axes)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, cell_text(value));
    return text;
}

std::vector<std::string> numeric_figures(const LedgerTable& results) {
    std::vector<std::string> names;
    for (const std::size_t k : ordered_figures(results)) {
        if (std::any_of(results.rows.begin(), results.rows.end(),
                        [&](const auto& row) { return std::holds_alternative<double>(row[k]); }))
            names.push_back(results.columns[k]);
    }
    return names;
}

std::vector<PointSummary> summarise(const LedgerTable& results, const std::vector<std::string>& figures) {
    const Columns columns(results);
    const std::vector<std::string> known = numeric_figures(results);
    std::vector<std::size_t> places;
    for (const std::string& figure : figures) {
        if (std::find(known.begin(), known.end(), figure) == known.end()) {
            throw InputError(
                fmt::format("found no figure '{:.60}', expected one of {}", figure, fmt::join(known, ", ")));
        }
        places.push_back(static_cast<std::size_t>(std::find(results.columns.begin(), results.columns.end(), figure) -
                                                  results.columns.begin()));
    }
    const auto units = std::find(results.columns.begin(), results.columns.end(), "material_units");
    const auto failed = std::find(results.columns.begin(), results.columns.end(), "failed");

    /// By figure, the packing's number and the variant.
    using Values = std::map<std::pair<std::size_t, std::string>, std::map<double, double>>;
    std::vector<PointSummary> points;
    std::vector<Values> values;
    std::map<std::string, std::size_t> place_of;
    for (const std::vector<Cell>& row : results.rows) {
        PointSummary point;
        point.test = text_of(row[1]);
        for (std::size_t k = axes_begin; k < columns.seed; ++k)
            if (!std::holds_alternative<std::monostate>(row[k])) point.axes.emplace_back(results.columns[k], row[k]);
        const auto [at, added] = place_of.emplace(point.test + '\n' + point.at(), points.size());
        if (added) {
            points.push_back(point);
            values.emplace_back();
        }
        PointSummary& own = points[at->second];
        const std::string &variant = text_of(row[columns.variant()]), &state = text_of(row[columns.state()]);
        const bool done = state == row_done, asked = variant == name_of(Variant::as_asked);
        if (asked) {
            ++own.planned;
            own.done += done ? 1 : 0;
            own.gone_wrong += !done && !state.empty() ? 1 : 0;
            if (units != results.columns.end())
                own.area_units =
                    own.area_units || text_of(row[static_cast<std::size_t>(units - results.columns.begin())]) == "area";
            if (done && failed != results.columns.end()) {
                const auto* flag =
                    std::get_if<double>(&row[static_cast<std::size_t>(failed - results.columns.begin())]);
                own.unfailed += flag != nullptr && *flag == 0.0 ? 1 : 0;
            }
        }
        const auto* seed = std::get_if<double>(&row[columns.seed]);
        for (std::size_t f = 0; f < places.size(); ++f) {
            const auto* value = std::get_if<double>(&row[places[f]]);
            if (value != nullptr && seed != nullptr) values[at->second][{f, variant}][*seed] = *value;
        }
    }
    const auto differences = [](const std::map<double, double>& asked, const std::map<double, double>& other) {
        std::vector<double> all;
        for (const auto& [seed, value] : asked)
            if (const auto pair = other.find(seed); pair != other.end()) all.push_back(value - pair->second);
        return all;
    };
    for (std::size_t p = 0; p < points.size(); ++p) {
        for (std::size_t f = 0; f < figures.size(); ++f) {
            const std::map<double, double>& asked = values[p][{f, name_of(Variant::as_asked)}];
            std::vector<double> all;
            for (const auto& [seed, value] : asked) all.push_back(value);
            points[p].figures[figures[f]] = mean_of(all);
            const auto step = differences(asked, values[p][{f, name_of(Variant::half_step)}]);
            const auto rate = differences(asked, values[p][{f, name_of(Variant::half_rate)}]);
            if (!step.empty() && !rate.empty()) points[p].biases[figures[f]] = bias_of(step, rate);
        }
    }
    return points;
}

std::string unit_of_figure(const std::string& figure, bool area_units) {
    if (figure.ends_with(converted_suffix)) return "Pa";
    for (const SummaryKey& key : summary_keys()) {
        if (figure != key.what.name) continue;
        const std::string unit = key.what.unit;
        if (unit == "-") return "";
        return area_units && unit == "N/m" ? "Pa" : unit;
    }
    return "";
}

std::string verdict_on(const MeanFigure& mean, const MeanBias& bias) {
    const double size = std::abs(mean.mean), chance = mean.standard_error, wrong = std::abs(bias.value());
    if (!std::isfinite(chance) || !std::isfinite(bias.standard_error()) || size == 0.0)
        return "too few packings to tell its bias";
    const double share = wrong / size, sure = bias.standard_error() / size;
    const double root = std::sqrt(static_cast<double>(bias.pairs));
    if (!bias.known()) {
        constexpr double goal = 0.01;
        return fmt::format("step and rate: none seen, {:+.2g} ± {:.2g} %; {}", 100.0 * bias.value() / size,
                           100.0 * sure,
                           sure > goal ? fmt::format("{:.0f} packings in pairs would show 1 %",
                                                     packings_for(bias.standard_error() * root, goal * size))
                                       : std::string("the scatter of packings is the error that counts"));
    }
    if (wrong > chance)
        return fmt::format(
            "step and rate dominate: {:+.2g} ± {:.2g} % against ± {:.2g} % of the packings; halve the rate "
            "or its tolerance, more packings change nothing",
            100.0 * bias.value() / size, 100.0 * sure, 100.0 * chance / size);
    return fmt::format(
        "the packings dominate: ± {:.2g} % against {:.2g} % of step and rate; {:.0f} packings would bring "
        "them level",
        100.0 * chance / size, 100.0 * share, packings_for(mean.deviation, wrong));
}

std::string points_csv(const std::vector<PointSummary>& points, const std::vector<std::string>& figures) {
    std::vector<std::string> keys;
    for (const PointSummary& point : points)
        for (const auto& [key, value] : point.axes)
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    std::string text = "test";
    for (const std::string& key : keys) (text += ',') += csv_field(key);
    text += ",figure,unit,packings,mean,standard_deviation,standard_error,low_95,high_95,bias,bias_standard_error\n";
    for (const PointSummary& point : points) {
        std::string head = csv_field(point.test);
        for (const std::string& key : keys) {
            const auto at =
                std::find_if(point.axes.begin(), point.axes.end(), [&](const auto& axis) { return axis.first == key; });
            (head += ',') += at == point.axes.end() ? std::string() : csv_field(cell_text(at->second));
        }
        for (const std::string& figure : figures) {
            const MeanFigure& mean = point.figures.at(figure);
            const auto bias = point.biases.find(figure);
            const auto shown = [](double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; };
            text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", head, csv_field(figure),
                                unit_of_figure(figure, point.area_units), mean.count, shown(mean.mean),
                                shown(mean.deviation), shown(mean.standard_error), shown(mean.low), shown(mean.high),
                                bias == point.biases.end() ? "" : shown(bias->second.value()),
                                bias == point.biases.end() ? "" : shown(bias->second.standard_error()));
        }
    }
    return text;
}

std::string tests_csv(const LedgerTable& results) {
    const Columns columns(results);
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < columns.figures; ++k)
        if (k != columns.processor_seconds()) places.push_back(k);
    for (const std::size_t k : ordered_figures(results)) places.push_back(k);
    std::string text;
    const auto line = [&](const auto& field) {
        for (std::size_t k = 0; k < places.size(); ++k) (text += k > 0 ? "," : "") += csv_field(field(places[k]));
        text += '\n';
    };
    line([&](std::size_t k) { return results.columns[k]; });
    for (const std::vector<Cell>& row : results.rows) line([&](std::size_t k) { return cell_text(row[k]); });
    return text;
}

}  // namespace crackle
