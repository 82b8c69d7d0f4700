// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/measured_curve.hpp"

#include <fmt/format.h>

#include <cmath>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/recordings/test_results.hpp"

namespace crackle {

std::vector<std::pair<double, double>> read_measured_curve(const std::filesystem::path& file) {
    const NumberTable table = number_table(file, read_text(file));
    const std::vector<double>*strain = table.find("axial_strain"), *stress = table.find("axial_stress");
    std::vector<std::pair<double, double>> points;
    for (std::size_t k = 0; strain != nullptr && stress != nullptr && k < strain->size(); ++k)
        if (std::isfinite((*strain)[k]) && std::isfinite((*stress)[k])) points.emplace_back((*strain)[k], (*stress)[k]);
    if (points.size() < 2)
        throw InputError(
            fmt::format("{}: found no curve, expected columns axial_strain and axial_stress with two rows "
                        "or more, the first line their names",
                        file.string()));
    return points;
}

}  // namespace crackle
