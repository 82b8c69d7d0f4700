// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/measured_curve.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/files/file_kind.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/table_reader.hpp"

namespace crackle {

std::vector<std::pair<double, double>> read_measured_curve(const std::filesystem::path& file) {
    constexpr const char* expected = "columns axial_strain and axial_stress, with their names in the first line";
    const std::string text = read_text(file, most_bytes_of_table);
    refuse_foreign(file.string(), text, fmt::format("a table with {}", expected));
    TableReader reader(file.string(), text, TableReader::Form::table);
    reader.read_heading(expected);
    const auto strain = reader.column("axial_strain"), stress = reader.column("axial_stress");
    if (!strain || !stress) reader.refuse(fmt::format("'{:.60}'", reader.whole_line()), expected);
    const auto lacks = [&](std::size_t column) {
        const std::string_view value = reader.values()[column];
        const std::optional<double> number = number_of(value);
        return value.empty() || (number && std::isnan(*number));
    };
    std::vector<std::pair<double, double>> points;
    while (reader.next()) {
        if (lacks(*strain) || lacks(*stress)) continue;
        points.emplace_back(reader.number(*strain, "axial_strain"), reader.number(*stress, "axial_stress"));
    }
    if (points.size() < 2) {
        throw InputError(fmt::format("{}: found {} row{} with strain and stress, expected two or more", file.string(),
                                     points.size(), points.size() == 1 ? "" : "s"));
    }
    return points;
}

}  // namespace crackle
