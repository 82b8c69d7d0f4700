// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/events.hpp"

#include <fmt/format.h>

namespace crackle {

const std::vector<EventColumn>& event_columns() {
    using Event = const BreakEvent&;
    static const auto written = [](const auto& value) { return fmt::format("{}", value); };
    static const std::vector<EventColumn> columns{
        {{"time", "s since loading began", "", "when the break was found"},
         [](Event e, double, std::int32_t) { return written(e.time); }},
        {{"step", "steps since loading began", "", "likewise"},
         [](Event e, double, std::int32_t) { return written(e.step); }},
        {{"axial_strain", "-", "positive in the sense of the test"},
         [](Event, double strain, std::int32_t) { return written(strain); }},
        {{"x", "m", "of the contact point, rightwards"},
         [](Event e, double, std::int32_t) { return written(e.position.x); }},
        {{"y", "m", "of the contact point, upwards"},
         [](Event e, double, std::int32_t) { return written(e.position.y); }},
        {{"body_i", "", "id of one body"}, [](Event e, double, std::int32_t) { return written(e.body_i); }},
        {{"body_j", "", "id of the other"}, [](Event e, double, std::int32_t) { return written(e.body_j); }},
        {{"orientation", "rad", "direction of the contact normal, counter-clockwise from x, in (-π/2, π/2]"},
         [](Event e, double, std::int32_t) { return written(e.orientation); }},
        {{"energy", "J", "taken by the break",
          "½k_n(δ-δ0)'(δ-δ0) + ½f_t'f_t/k_s, primed one step before the break was found (solver/MODEL.md 5)"},
         [](Event e, double, std::int32_t) { return written(e.energy); }},
        {{"strength", "N",
          "tensile strength k_n δ0 that the point had; of a coulomb bond the limit that it met: T, or C + μ f_n"},
         [](Event e, double, std::int32_t) { return written(e.strength); }},
        {{"normal_force", "N",
          "elastic, positive pushes apart; in the last step in which the point carried at least half its strength; of "
          "a coulomb bond when it failed"},
         [](Event e, double, std::int32_t) { return written(e.normal_force); }},
        {{"shear_force", "N", "elastic, on body_i along the normal from i to j turned by +90°; in the same step"},
         [](Event e, double, std::int32_t) { return written(e.shear_force); }},
        {{"slid", "0 or 1", "1 if the point had reached the Coulomb limit since bonding; a coulomb bond sticks, 0"},
         [](Event e, double, std::int32_t) { return written(e.slid ? 1 : 0); }},
        {{"mode", "word",
          "`shear` if it had slid and shear outweighed the normal force then, else `tension`; of a coulomb bond by the "
          "limit that it met first",
          "by back-tension nearly all are `tension`: a bond breaks where its overlap is used up, and its Coulomb limit "
          "with it; whether it failed by sliding first is in `slid`"},
         [](Event e, double, std::int32_t) { return std::string(e.shear_mode ? "shear" : "tension"); }},
        {{"last_of_interface", "0 or 1", "1 if no bond is left between the two bodies"},
         [](Event e, double, std::int32_t) { return written(e.last_of_interface ? 1 : 0); }},
        {{"trace", "",
          "number of the trace of joints on which it broke, in `traces` of summary.json, from 0; -1 "
          "through the rock; of jointed specimens"},
         [](Event, double, std::int32_t trace) { return written(trace); },
         true},
    };
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

/// Of the columns that are wanted.
std::string joined(const auto& columns, const auto& wanted, const auto& text_of) {
    std::string line;
    for (const auto& column : columns) {
        if (!wanted(column)) continue;
        if (!line.empty()) line += ',';
        line += text_of(column);
    }
    return line + '\n';
}

const auto every_column = [](const auto&) { return true; };
const auto column_name = [](const auto& column) { return column.what.name; };
auto of_event(bool jointed) {
    return [jointed](const EventColumn& column) { return jointed || !column.jointed; };
}

}  // namespace

std::string events_header(bool jointed) { return joined(event_columns(), of_event(jointed), column_name); }
std::string event_line(const BreakEvent& event, double axial_strain, std::optional<std::int32_t> trace) {
    return joined(event_columns(), of_event(trace.has_value()),
                  [&](const EventColumn& column) { return column.text(event, axial_strain, trace.value_or(-1)); });
}
std::string slips_header() { return joined(slip_columns(), every_column, column_name); }
std::string slip_line(const SlipEvent& event, double axial_strain) {
    return joined(slip_columns(), every_column,
                  [&](const SlipColumn& column) { return column.text(event, axial_strain); });
}

}  // namespace crackle
