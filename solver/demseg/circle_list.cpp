// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/demseg/circle_list.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

#include "solver/files/table_reader.hpp"

namespace crackle {

std::string_view circle_list_form(std::string_view text) {
    if (text.find('"') != std::string_view::npos) return {};
    TableReader reader("", text, TableReader::Form::list);
    std::size_t width = 0;
    while (reader.next()) {
        const auto& values = reader.values();
        if (width == 0) width = values.size();
        if (values.size() != width || width < 2 || width > 4) return {};
        for (const std::string_view value : values) {
            const std::optional<double> number = number_of(value);
            if (!number || !std::isfinite(*number)) return {};
        }
        if (width > 2 && !(*number_of(values.back()) > 0.0)) return {};
    }
    return width == 2 ? "x y" : width == 3 ? "x y r" : width == 4 ? "x y z r" : "";
}

}  // namespace crackle
