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
    EventColumn strain{{"axial_strain", "-", "axial strain at the break, positive in the direction of loading"},
                       [](Event, double value, std::int32_t) { return fmt::format("{}", value); }};
    columns.insert(columns.begin() + columns_before_strain, std::move(strain));
    columns.push_back({{"trace", "",
                        "zero-based index, in `traces` of summary.json, of the joint trace on which the bond broke; -1 "
                        "if it broke in the rock. Only for jointed specimens"},
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
        {{"time", "s since loading began", "", "time at which the bond first reached its Coulomb limit"},
         [](Event s, double) { return written(s.time); }},
        {{"step", "steps since loading began", "", "time step in which the bond first reached its Coulomb limit"},
         [](Event s, double) { return written(s.step); }},
        {{"axial_strain", "-", "axial strain at that step, positive in the direction of loading"},
         [](Event, double strain) { return written(strain); }},
        {{"x", "m", "x coordinate of the contact point, positive to the right"},
         [](Event s, double) { return written(s.position.x); }},
        {{"y", "m", "y coordinate of the contact point, positive upwards"},
         [](Event s, double) { return written(s.position.y); }},
        {{"body_i", "", "id of one body"}, [](Event s, double) { return written(s.body_i); }},
        {{"body_j", "", "id of the other body"}, [](Event s, double) { return written(s.body_j); }},
        {{"orientation", "rad", "direction of the contact normal, counter-clockwise from the x axis, in (-π/2, π/2]"},
         [](Event s, double) { return written(s.orientation); }},
        {{"normal_force", "N",
          "elastic normal force relative to the bonded state, positive if it pushes the bodies apart"},
         [](Event s, double) { return written(s.normal_force); }},
        {{"shear_force", "N",
          "elastic shear force on body_i, equal in magnitude to the Coulomb limit; positive along the normal from "
          "body_i to body_j turned by +90°"},
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
