// SPDX-License-Identifier: GPL-3.0-or-later

#include "tools/commands/centre_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>

#include "solver/base/errors.hpp"
#include "solver/demseg/circle_list.hpp"
#include "solver/files/table_reader.hpp"

namespace crackle::tools {
namespace {

/// Words of the first line that contains values; empty if no line does.
std::optional<std::vector<std::string>> first_values(std::string_view text) {
    if (text.find('"') != std::string_view::npos) {  // quotes occur only in a heading, since numbers need none
        TableReader reader("", text, TableReader::Form::table);
        if (!reader.next()) return std::nullopt;
        return std::vector<std::string>(reader.values().begin(), reader.values().end());
    }
    TableReader reader("", text, TableReader::Form::list);
    if (!reader.next()) return std::nullopt;
    return std::vector<std::string>(reader.values().begin(), reader.values().end());
}

bool is_name(std::string_view word) {
    return !word.empty() && std::isalpha(static_cast<unsigned char>(word.front())) != 0 && !number_of(word);
}

double coordinate(const TableReader& reader, std::size_t place, const char* what) {
    const std::string_view word = reader.values()[place];
    const std::optional<double> value = number_of(word);
    if (!value || !std::isfinite(*value)) reader.refuse_number(word, fmt::format("a finite number for {}", what));
    return *value;
}

/// Indices of the columns of a list, and a description of their order.
struct Columns {
    std::size_t x = 0, y = 1;
    std::optional<std::size_t> z;
    std::size_t width = 2;
    std::string form = "x y";
};

Columns named_columns(TableReader& reader) {
    reader.read_heading("a heading with x and y");
    const auto x = reader.column("x"), y = reader.column("y");
    if (!x || !y) reader.refuse(fmt::format("'{:.60}'", reader.whole_line()), "a heading with x and y");
    Columns columns{*x, *y, reader.column("z"), reader.names().size(), "x y"};
    if (columns.z) columns.form += " z";
    if (reader.column("r") || reader.column("radius")) columns.form += " r";
    return columns;
}

Columns columns_of_list(std::string_view text) {
    const std::string_view form = circle_list_form(text);
    if (form == "x y r") return {0, 1, std::nullopt, 3, "x y r"};
    if (form == "x y z r") return {0, 1, 2, 4, "x y z r"};
    return {};
}

}  // namespace

bool looks_like_centre_list(std::string_view text) {
    const auto first = first_values(text);
    if (!first || first->empty()) return false;
    if (is_name(first->front())) return std::find(first->begin(), first->end(), "x") != first->end();
    return first->size() == 2 || !circle_list_form(text).empty();
}

CentreList parse_centre_list(const std::string& name, std::string_view text) {
    const auto first = first_values(text);
    const bool named = first && !first->empty() && is_name(first->front());
    TableReader reader(name, text, named ? TableReader::Form::table : TableReader::Form::list);
    const Columns columns = named ? named_columns(reader) : columns_of_list(text);
    CentreList list;
    list.form = columns.form;
    std::optional<double> plane;
    while (reader.next()) {
        const std::size_t count = reader.values().size();
        if (count != columns.width)
            reader.refuse(fmt::format("{} value{}", count, count == 1 ? "" : "s"), "two numbers x y");
        list.places.push_back({coordinate(reader, columns.x, "x"), coordinate(reader, columns.y, "y")});
        list.lines.push_back(reader.line());
        if (!columns.z) continue;
        const double z = coordinate(reader, *columns.z, "z");
        if (z != plane.value_or(z))
            reader.refuse(fmt::format("z = {} after z = {}", z, *plane),
                          "centres in one plane; give the centres of a plane section");
        plane = z;
    }
    if (list.places.empty()) throw InputError(fmt::format("{}: found no centres, expected lines of x y", name));
    return list;
}

}  // namespace crackle::tools
