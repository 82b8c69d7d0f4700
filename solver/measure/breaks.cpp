// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/measure/breaks.hpp"

#include <fmt/format.h>

namespace crackle {

const std::vector<BreakColumn>& break_columns() {
    using Event = const BreakEvent&;
    static const auto written = [](const auto& value) { return fmt::format("{}", value); };
    static const std::vector<BreakColumn> columns{
        {{"time", "s since loading began", "", "when the break was found"}, [](Event e) { return written(e.time); }},
        {{"step", "steps since loading began", "", "likewise"}, [](Event e) { return written(e.step); }},
        {{"x", "m", "of the contact point, rightwards"}, [](Event e) { return written(e.position.x); }},
        {{"y", "m", "of the contact point, upwards"}, [](Event e) { return written(e.position.y); }},
        {{"body_i", "", "id of one body"}, [](Event e) { return written(e.body_i); }},
        {{"body_j", "", "id of the other"}, [](Event e) { return written(e.body_j); }},
        {{"orientation", "rad", "direction of the contact normal, counter-clockwise from x, in (-π/2, π/2]"},
         [](Event e) { return written(e.orientation); }},
        {{"energy", "J", "taken by the break",
          "½k_n(δ-δ0)'(δ-δ0) + ½f_t'f_t/k_s, primed one step before the break was found (solver/MODEL.md 5)"},
         [](Event e) { return written(e.energy); }},
        {{"strength", "N",
          "tensile strength k_n δ0 that the point had; of a coulomb bond the limit that it met: T, or C + μ f_n"},
         [](Event e) { return written(e.strength); }},
        {{"normal_force", "N",
          "elastic, positive pushes apart; in the last step in which the point carried at least half its strength; of "
          "a coulomb bond when it failed"},
         [](Event e) { return written(e.normal_force); }},
        {{"shear_force", "N", "elastic, on body_i along the normal from i to j turned by +90°; in the same step"},
         [](Event e) { return written(e.shear_force); }},
        {{"slid", "0 or 1", "1 if the point had reached the Coulomb limit since bonding; a coulomb bond sticks, 0"},
         [](Event e) { return written(e.slid ? 1 : 0); }},
        {{"mode", "word",
          "`shear` if it had slid and shear outweighed the normal force then, else `tension`; of a coulomb bond by the "
          "limit that it met first",
          "by back-tension nearly all are `tension`: a bond breaks where its overlap is used up, and its Coulomb limit "
          "with it; whether it failed by sliding first is in `slid`"},
         [](Event e) { return std::string(e.shear_mode ? "shear" : "tension"); }},
        {{"last_of_interface", "0 or 1", "1 if no bond is left between the two bodies"},
         [](Event e) { return written(e.last_of_interface ? 1 : 0); }},
    };
    return columns;
}

namespace {

const auto every_column = [](const BreakColumn&) { return true; };

}  // namespace

std::string breaks_header() {
    return table_line(break_columns(), every_column, [](const BreakColumn& column) { return column.what.name; });
}

std::string break_line(const BreakEvent& event) {
    return table_line(break_columns(), every_column, [&](const BreakColumn& column) { return column.text(event); });
}

}  // namespace crackle
