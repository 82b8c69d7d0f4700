// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/point_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/files/text_lines.hpp"
#include "specimens/summary/summary_keys.hpp"

namespace crackle {
namespace {

// Number of columns before the axes in the view `results`, and names of the columns between axes and figures. Some of
// the named columns differ from run to run.
constexpr std::size_t axes_begin = 2;  // the columns before the axes are row and test
constexpr std::array<std::string_view, 5> behind_axes{"seed", "variant", "identity", "state", "processor_seconds"};

std::string cell_text(const LedgerCell& cell) {
    if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    return "";
}

/// Whether a spreadsheet would evaluate the text, or remove an apostrophe at its beginning.
bool looks_like_formula(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of('\''), text.size()));
    return text.find_first_of("=+-@\t\r") == 0 && !number_of(text);
}

std::string csv_field(const std::string& text) {
    const bool formula = looks_like_formula(text);
    if (!formula && text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = formula ? "\"'" : "\"";
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

const std::string& text_of(const LedgerCell& cell) {
    static const std::string none;
    const auto* text = std::get_if<std::string>(&cell);
    return text != nullptr ? *text : none;
}

/// Index of a column; the number of columns if there is no such column.
std::size_t place_in(const LedgerTable& results, std::string_view column) {
    return static_cast<std::size_t>(std::find(results.columns.begin(), results.columns.end(), column) -
                                    results.columns.begin());
}

/// Number in a cell; NaN if the cell has no number.
double number_at(const std::vector<LedgerCell>& row, std::size_t column) {
    const auto* number = column < row.size() ? std::get_if<double>(&row[column]) : nullptr;
    return number != nullptr ? *number : std::nan("");
}

/// Position in summary.json of a figure, or of the table that contains the figure.
std::size_t rank_of(const std::string& figure) {
    const auto& keys = summary_keys();
    const std::string_view name = without_suffix(figure);
    for (std::size_t cut = name.size(); cut != std::string::npos; cut = name.rfind('.', cut - 1)) {
        const std::string_view part = name.substr(0, cut);
        const auto at = std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return part == key.name; });
        if (at != keys.end()) return static_cast<std::size_t>(at - keys.begin());
        if (cut == 0) break;
    }
    return keys.size();
}

/// Column indices of the figures, in the order of the keys in summary.json, whatever the order of the tests.
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

bool refers_to_peak(std::string_view figure) {
    constexpr auto all =
        in_order("tangent_modulus_50", "tangent_50_poissons_ratio", "initial_tangent_modulus", "initial_poissons_ratio",
                 "area_strain_peak", "bonds_broken_in_shear_to_peak", "bonds_broken_in_tension_to_peak");
    return std::ranges::find(all, without_suffix(figure)) != all.end();
}

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

std::vector<std::string> usual_figures(const LedgerTable& results) {
    const std::vector<std::string> known = numeric_figures(results);
    std::vector<std::string> usual;
    for (const char* figure : {"youngs_modulus", "poissons_ratio", "peak_stress", "peak_strain"})
        if (std::find(known.begin(), known.end(), figure) != known.end()) usual.emplace_back(figure);
    return usual;
}

namespace {

/// Values by figure and variant, then by packing number.
using Values = std::map<std::pair<std::size_t, std::string>, std::map<double, double>>;

/// Sets the means of a point's figures, and their bias where companions have run.
void take_means(PointSummary& point, const std::vector<std::string>& figures, Values& values) {
    for (std::size_t f = 0; f < figures.size(); ++f) {
        std::vector<double> all, asked, half_step, half_rate;
        const auto &steps = values[{f, name_of(Variant::half_step)}], &rates = values[{f, name_of(Variant::half_rate)}];
        for (const auto& [seed, value] : values[{f, name_of(Variant::as_asked)}]) {
            all.push_back(value);
            const auto step = steps.find(seed), rate = rates.find(seed);
            if (step == steps.end() || rate == rates.end()) continue;
            asked.push_back(value);
            half_step.push_back(step->second);
            half_rate.push_back(rate->second);
        }
        point.figures[figures[f]] = mean_of(all);
        point.values[figures[f]] = std::move(all);
        if (!asked.empty()) point.biases[figures[f]] = bias_of(asked, half_step, half_rate);
    }
}

}  // namespace

std::vector<PointSummary> summarise(const LedgerTable& results, const std::vector<std::string>& figures) {
    const Columns columns(results);
    const std::vector<std::string> known = numeric_figures(results);
    std::vector<std::size_t> places;
    for (const std::string& figure : figures) {
        if (std::find(known.begin(), known.end(), figure) == known.end()) {
            throw InputError(fmt::format(
                "found no figure '{:.60}', expected a numeric key of summary.json, such as {}; `crackle campaign show "
                "DIR --all` prints all {}",
                figure, fmt::join(std::span(known).first(std::min<std::size_t>(known.size(), 4)), ", "), known.size()));
        }
        places.push_back(place_in(results, figure));
    }
    const std::size_t units = place_in(results, "material_units"), failed = place_in(results, "failed"),
                      valid = place_in(results, "valid");

    std::vector<PointSummary> points;
    std::vector<Values> values;
    std::map<std::string, std::size_t> place_of;
    for (std::size_t number = 0; number < results.rows.size(); ++number) {
        const std::vector<LedgerCell>& row = results.rows[number];
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
        const bool held = done && number_at(row, failed) == 0.0;
        if (asked) {
            own.rows.push_back(number);
            ++own.planned;
            own.done += done ? 1 : 0;
            own.gone_wrong += !done && !state.empty() ? 1 : 0;
            own.failures += !state.empty() && kind_of_row(state) == RowKind::failure ? 1 : 0;
            own.area_units =
                own.area_units || (units < row.size() && text_of(row[units]) == name_of(StiffnessUnits::area));
            own.unfailed += held ? 1 : 0;
            own.invalid += done && valid < row.size() && number_at(row, valid) == 0.0 ? 1 : 0;
        }
        const auto* seed = std::get_if<double>(&row[columns.seed]);
        for (std::size_t f = 0; f < places.size(); ++f) {
            const auto* value = std::get_if<double>(&row[places[f]]);
            if (value == nullptr || seed == nullptr || (held && refers_to_peak(figures[f]))) continue;
            values[at->second][{f, variant}][*seed] = *value;
        }
    }
    for (std::size_t p = 0; p < points.size(); ++p) take_means(points[p], figures, values[p]);
    return points;
}

std::string unit_of_figure(const std::string& column, bool area_units) {
    std::string figure = column;  // as in summary_keys(): without the index of a list element
    for (std::size_t at = figure.find('['); at != std::string::npos; at = figure.find('[', at + 1)) {
        const std::size_t end = figure.find(']', at);
        if (end != std::string::npos) figure.erase(at + 1, end - at - 1);
    }
    if (figure.ends_with(converted_suffix)) return "Pa";
    const auto key = std::ranges::find(summary_keys(), figure, &SummaryKey::name);
    if (key == summary_keys().end() || key->unit == "-") return "";
    return area_units && key->unit == "N/m" ? "Pa" : key->unit;
}

std::string verdict_on(const MeanFigure& mean, const MeanBias& bias) {
    const double size = std::abs(mean.mean), chance = mean.standard_error, wrong = std::abs(bias.value);
    if (!std::isfinite(chance) || !std::isfinite(bias.standard_error) || size == 0.0)
        return "too few packings to estimate a bias";
    const auto percent = [&](double value, double error) {
        return fmt::format("{:+.2g} ± {:.2g} %", 100.0 * value / size, 100.0 * error / size);
    };
    const std::string parts = fmt::format("bias {} (due to the time step {}, due to the rate {}; {} packings)",
                                          percent(bias.value, bias.standard_error), percent(bias.step, bias.step_error),
                                          percent(bias.rate, bias.rate_error), bias.packings);
    constexpr std::size_t fewest = 4;  // packings; with fewer, the errors of a bias are too uncertain for advice
    if (bias.packings < fewest)
        return fmt::format("{}: too few for a judgement, which needs at least {} packings", parts, fewest);
    if (!bias.known()) {
        constexpr double goal = 0.01;
        const double deviation = bias.standard_error * std::sqrt(static_cast<double>(bias.packings));
        const bool unsure = bias.standard_error > goal * size;
        return parts + (unsure ? fmt::format(": not significant; {:.0f} packings would reveal a bias of 1 %",
                                             packings_for(deviation, goal * size))
                               : std::string(": not significant; the scatter of packings is the main error"));
    }
    if (wrong > chance) {
        return fmt::format(
            "{}: it exceeds the error of ± {:.2g} % due to the scatter of packings; {} reduces it, "
            "more packings do not",
            parts, 100.0 * chance / size,
            std::abs(bias.step) > std::abs(bias.rate) ? "a smaller safety_factor" : "a lower rate or rate_tolerance");
    }
    return fmt::format(
        "{}: the scatter of the packings is larger, ± {:.2g} %; with {:.0f} packings both would be equal", parts,
        100.0 * chance / size, packings_for(mean.deviation, wrong));
}

std::string points_csv(const std::vector<PointSummary>& points, const std::vector<std::string>& figures) {
    std::vector<std::string> keys;
    for (const PointSummary& point : points)
        for (const auto& [key, value] : point.axes)
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    std::string text = "test";
    for (const std::string& key : keys) (text += ',') += csv_field(key);
    text +=
        ",planned,done,gone_wrong,failed_by_system,not_failed,figure,unit,packings,mean,standard_deviation,standard_"
        "error,low_95,high_"
        "95,"
        "bias,bias_standard_error,bias_step,bias_rate,bias_packings\n";
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
            const MeanBias none, &own = bias == point.biases.end() ? none : bias->second;
            text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", head, point.planned,
                                point.done, point.gone_wrong, point.failures, point.unfailed, csv_field(figure),
                                unit_of_figure(figure, point.area_units), mean.count, shown(mean.mean),
                                shown(mean.deviation), shown(mean.standard_error), shown(mean.low), shown(mean.high),
                                shown(own.value), shown(own.standard_error), shown(own.step), shown(own.rate),
                                bias == point.biases.end() ? "" : fmt::format("{}", own.packings));
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
    for (const std::vector<LedgerCell>& row : results.rows) line([&](std::size_t k) { return cell_text(row[k]); });
    return text;
}

}  // namespace crackle
