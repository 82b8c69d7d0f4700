// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/measured_curve.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include "solver/base/errors.hpp"
#include "solver/files/file_kind.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/table_reader.hpp"

namespace crackle {
namespace {

struct NamedUnit {
    const char* name;
    double factor;  // size of the unit in SI units; for strains, as a fraction
};
constexpr NamedUnit strain_units[]{{"-", 1.0},     {"%", 1e-2},    {"‰", 1e-3},
                                   {"mm/m", 1e-3}, {"µm/m", 1e-6}, {"1e-6", 1e-6}};
constexpr NamedUnit stress_units[]{{"Pa", 1.0},  {"kPa", 1e3},  {"MPa", 1e6}, {"GPa", 1e9},
                                   {"N/m", 1.0}, {"kN/m", 1e3}, {"MN/m", 1e6}};
constexpr NamedUnit length_units[]{{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"µm", 1e-6}};
constexpr NamedUnit force_units[]{{"N", 1.0}, {"kN", 1e3}, {"MN", 1e6}};
constexpr NamedUnit area_units[]{{"m2", 1.0}, {"cm2", 1e-4}, {"mm2", 1e-6}};

/// A column of numbers, and the factor that converts them.
struct Column {
    const char* name;
    std::size_t place;
    double factor;
};

/// Whether a heading begins with a name, in capital or small letters, and with spaces or underscores between words.
bool begins_with(std::string_view heading, std::string_view name) {
    const auto same = [](char in_heading, char in_name) {
        return in_heading == in_name || (in_heading == ' ' && in_name == '_') ||
               (in_heading >= 'A' && in_heading <= 'Z' && in_heading - 'A' + 'a' == in_name);
    };
    return heading.size() >= name.size() && std::ranges::equal(heading.substr(0, name.size()), name, same);
}

/// Finds the unit in the heading of a column: "MPa" in "Axial stress (MPa)". It is empty if the heading has no unit.
/// @return nullopt if the column has another name
std::optional<std::string_view> unit_after(std::string_view name, std::string_view heading) {
    if (!begins_with(heading, name)) return std::nullopt;
    heading.remove_prefix(name.size());
    heading.remove_prefix(std::min(heading.find_first_not_of(' '), heading.size()));
    if (heading.empty()) return heading;
    const bool brackets = heading.size() > 2 && ((heading.front() == '(' && heading.back() == ')') ||
                                                 (heading.front() == '[' && heading.back() == ']'));
    if (!brackets) return std::nullopt;
    return heading.substr(1, heading.size() - 2);
}

std::optional<Column> column_of(const TableReader& reader, const char* name, std::span<const NamedUnit> units) {
    std::optional<Column> found;
    for (std::size_t k = 0; k < reader.names().size(); ++k) {
        const std::optional<std::string_view> unit = unit_after(name, reader.names()[k]);
        if (!unit) continue;
        if (found) reader.refuse(fmt::format("two columns {}", name), "one");
        const auto known = std::ranges::find(units, *unit, &NamedUnit::name);
        if (!unit->empty() && known == units.end()) {
            std::vector<const char*> names;
            for (const NamedUnit& one : units) names.push_back(one.name);
            reader.refuse(fmt::format("the unit '{:.20}' of {}", *unit, name),
                          fmt::format("one of {}", fmt::join(names, ", ")));
        }
        found = {name, k, unit->empty() ? 1.0 : known->factor};
    }
    return found;
}

/// A quantity that is a column, or the quotient of two columns.
struct Quantity {
    Column value;
    std::optional<Column> divisor = {};

    std::optional<double> in_row(const TableReader& reader) const {
        const std::optional<double> above = number(reader, value);
        const std::optional<double> below = divisor ? number(reader, *divisor) : 1.0;
        if (!above || !below) return std::nullopt;
        if (!(*below > 0.0)) reader.refuse(fmt::format("{} = {}", divisor->name, *below), "a number > 0");
        return *above / *below;
    }

  private:
    /// Converted value of a column in the current row; empty if the row lacks it.
    static std::optional<double> number(const TableReader& reader, const Column& column) {
        const std::string_view word = reader.values()[column.place];
        const std::optional<double> found = number_of(word);
        if (word.empty() || (found && std::isnan(*found))) return std::nullopt;
        return column.factor * reader.number(column.place, column.name);
    }
};

std::optional<Quantity> quantity_of(const std::optional<Column>& itself, const std::optional<Column>& value,
                                    const std::optional<Column>& divisor) {
    if (itself) return Quantity{*itself};
    if (value && divisor) return Quantity{*value, divisor};
    return std::nullopt;
}

}  // namespace

StrainsAndStresses read_measured_curve(const std::filesystem::path& file) {
    constexpr const char* expected =
        "columns axial_strain and axial_stress, with their names in the first line and their units in parentheses, "
        "such as axial_stress (MPa), or displacement, length, force and area in their place";
    const std::string text = read_text(file, most_bytes_of_table);
    refuse_foreign(file.string(), text, fmt::format("a table with {}", expected));
    TableReader reader(file.string(), text, TableReader::Form::table);
    reader.read_heading(expected);
    const auto column = [&](const char* name, std::span<const NamedUnit> units) {
        return column_of(reader, name, units);
    };
    const std::optional<Quantity> strain = quantity_of(
        column("axial_strain", strain_units), column("displacement", length_units), column("length", length_units));
    const std::optional<Quantity> stress =
        quantity_of(column("axial_stress", stress_units), column("force", force_units), column("area", area_units));
    if (!strain || !stress) reader.refuse(fmt::format("'{:.60}'", reader.whole_line()), expected);
    StrainsAndStresses points;
    while (reader.next()) {
        const std::optional<double> x = strain->in_row(reader), y = stress->in_row(reader);
        if (x && y) points.emplace_back(*x, *y);
    }
    if (points.size() < 2) {
        throw InputError(fmt::format("{}: found {} row{} with strain and stress, expected two or more", file.string(),
                                     points.size(), points.size() == 1 ? "" : "s"));
    }
    const auto stress_of = [](const auto& point) { return point.second; };
    const auto [lowest, highest] = std::ranges::minmax(points, {}, stress_of);
    if (-lowest.second > highest.second) {
        throw InputError(
            fmt::format("{}: found stresses down to {:.4g} Pa, expected stresses that are positive in the direction of "
                        "loading, compression in a compression test; change their signs",
                        file.string(), lowest.second));
    }
    return points;
}

std::vector<StrengthOfCores> read_measured_strengths(const std::filesystem::path& file) {
    constexpr const char* expected =
        "columns confining_pressure and strength, and error if there is one, with their names in the first line and "
        "their units in parentheses, such as strength (MPa)";
    const std::string text = read_text(file, most_bytes_of_table);
    refuse_foreign(file.string(), text, fmt::format("a table with {}", expected));
    TableReader reader(file.string(), text, TableReader::Form::table);
    reader.read_heading(expected);
    const std::optional<Column> pressure = column_of(reader, "confining_pressure", stress_units),
                                strength = column_of(reader, "strength", stress_units),
                                error = column_of(reader, "error", stress_units);
    if (!pressure || !strength) reader.refuse(fmt::format("'{:.60}'", reader.whole_line()), expected);
    std::vector<StrengthOfCores> all;
    while (reader.next()) {
        const std::optional<double> at = Quantity{*pressure}.in_row(reader), found = Quantity{*strength}.in_row(reader);
        if (!at || !found) continue;
        const double off = error ? Quantity{*error}.in_row(reader).value_or(0.0) : 0.0;
        if (*at < 0.0 || !(*found > *at) || off < 0.0)
            reader.refuse(
                fmt::format("confining_pressure = {:g} Pa, strength = {:g} Pa, error = {:g} Pa", *at, *found, off),
                "a pressure >= 0, a larger strength, and an error >= 0");
        all.push_back({*at, *found, off});
    }
    if (all.empty())
        throw InputError(
            fmt::format("{}: found no row with pressure and strength, expected at least one", file.string()));
    return all;
}

LabelledCurve labelled_curve(const std::filesystem::path& file) {
    return {"measured (" + file.filename().string() + ")", read_measured_curve(file)};
}

LabelledCurve measured_beside(const std::vector<Recording>& tests, const std::filesystem::path& file) {
    LabelledCurve curve = labelled_curve(file);
    double strain = 0.0, stress = 0.0;
    for (const Recording& test : tests) {
        const auto &kind = test.results.summary.about.kind, &first = tests.front().results.summary.about.kind;
        if (kind.name() != first.name())
            throw InputError(
                fmt::format("{}: found tests of the kinds {} and {}, expected a single kind to compare with "
                            "the measured curve",
                            file.string(), first.name(), kind.name()));
        strain = std::max(strain, std::ranges::max(*test.results.curve.find("axial_strain")));
        stress = std::max(stress, std::ranges::max(*test.results.curve.find("axial_stress")));
    }
    const bool area = tests.front().results.summary.about.material_units == StiffnessUnits::area;
    require_like_scale(file.string(), curve.points, strain, stress, area ? "Pa" : "N/m");
    return curve;
}

void require_like_scale(const std::string& file, const char* column, double found, double computed,
                        const std::string& unit, const char* example) {
    constexpr double most_times = 50.0;  // a missing % or SI prefix causes a larger factor
    if (!(found > 0.0) || !(computed > 0.0)) return;
    if (found <= most_times * computed && computed <= most_times * found) return;
    throw InputError(
        fmt::format("{}: {}: found values up to {:.3g}{}, expected the scale of the tests, {:.3g}{}; state the unit in "
                    "the heading, for "
                    "example {}",
                    file, column, found, unit, computed, unit, example));
}

void require_like_scale(const std::string& file, const StrainsAndStresses& measured, double strain, double stress,
                        const std::string& unit) {
    double largest_strain = 0.0, largest_stress = 0.0;
    for (const auto& [x, y] : measured) {
        largest_strain = std::max(largest_strain, std::abs(x));
        largest_stress = std::max(largest_stress, std::abs(y));
    }
    require_like_scale(file, "axial_strain", largest_strain, strain, "", "axial_strain (%)");
    require_like_scale(file, "axial_stress", largest_stress, stress, " " + unit, "axial_stress (MPa)");
}

}  // namespace crackle
