// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/events.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

#include "solver/measure/breaks.hpp"

namespace crackle {

namespace {

constexpr std::ptrdiff_t columns_before_strain = 2;  // time and step

std::vector<EventColumn> columns_of_tests() {
    using Event = const BreakEvent&;
    std::vector<EventColumn> columns;
    for (const BreakColumn& column : break_columns())
        columns.push_back({column.what, [&column](Event e, double, std::int32_t) { return column.text(e); }});
    EventColumn strain{{"axial_strain", "-", "positive in the sense of the test"},
                       [](Event, double value, std::int32_t) { return fmt::format("{}", value); }};
    columns.insert(columns.begin() + columns_before_strain, std::move(strain));
    columns.push_back({{"trace", "",
                        "number of the trace of joints on which it broke, in `traces` of summary.json, from 0; -1 "
                        "through the rock; of jointed specimens"},
                       [](Event, double, std::int32_t trace) { return fmt::format("{}", trace); },
                       true});
    return columns;
}

}  // namespace

const std::vector<EventColumn>& event_columns() {
    static const std::vector<EventColumn> columns = columns_of_tests();
    return columns;
}

const std::vector<SlipColumn>& slip_columns() {
    using Event = const SlipEvent&;
    static const auto written = [](const auto& value) { return fmt::format("{}", value); };
    static const std::vector<SlipColumn> columns{
        {{"time", "s since loading began", "", "when the limit was first reached"},
         [](Event s, double) { return written(s.time); }},
        {{"step", "steps since loading began", "", "likewise"}, [](Event s, double) { return written(s.step); }},
        {{"axial_strain", "-", "positive in the sense of the test"},
         [](Event, double strain) { return written(strain); }},
        {{"x", "m", "of the contact point, rightwards"}, [](Event s, double) { return written(s.position.x); }},
        {{"y", "m", "of the contact point, upwards"}, [](Event s, double) { return written(s.position.y); }},
        {{"body_i", "", "id of one body"}, [](Event s, double) { return written(s.body_i); }},
        {{"body_j", "", "id of the other"}, [](Event s, double) { return written(s.body_j); }},
        {{"orientation", "rad", "direction of the contact normal, counter-clockwise from x, in (-π/2, π/2]"},
         [](Event s, double) { return written(s.orientation); }},
        {{"normal_force", "N", "elastic, positive pushes apart, from the bonded state"},
         [](Event s, double) { return written(s.normal_force); }},
        {{"shear_force", "N", "elastic, on body_i along the normal from i to j turned by +90°: the limit, signed"},
         [](Event s, double) { return written(s.shear_force); }},
    };
    return columns;
}

namespace {

const auto every_column = [](const auto&) { return true; };
const auto column_name = [](const auto& column) { return column.what.name; };
auto of_event(bool jointed) {
    return [jointed](const EventColumn& column) { return jointed || !column.jointed; };
}

}  // namespace

std::string events_header(bool jointed) { return table_line(event_columns(), of_event(jointed), column_name); }
std::string event_line(const BreakEvent& event, double axial_strain, std::optional<std::int32_t> trace) {
    return table_line(event_columns(), of_event(trace.has_value()),
                      [&](const EventColumn& column) { return column.text(event, axial_strain, trace.value_or(-1)); });
}
std::string slips_header() { return table_line(slip_columns(), every_column, column_name); }
std::string slip_line(const SlipEvent& event, double axial_strain) {
    return table_line(slip_columns(), every_column,
                      [&](const SlipColumn& column) { return column.text(event, axial_strain); });
}

}  // namespace crackle
