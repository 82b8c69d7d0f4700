// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/measure/breaks.hpp"

#include <fmt/format.h>

namespace crackle {

const std::vector<BreakColumn>& break_columns() {
    using Event = const BreakEvent&;
    static const auto written = [](const auto& value) { return fmt::format("{}", value); };
    static const std::vector<BreakColumn> columns{
        {{"time", "s since loading began", "", "time at which the break was detected"},
         [](Event e) { return written(e.time); }},
        {{"step", "steps since loading began", "", "time step in which the break was detected"},
         [](Event e) { return written(e.step); }},
        {{"x", "m", "x coordinate of the contact point, positive to the right"},
         [](Event e) { return written(e.position.x); }},
        {{"y", "m", "y coordinate of the contact point, positive upwards"},
         [](Event e) { return written(e.position.y); }},
        {{"body_i", "", "id of one of the two bodies"}, [](Event e) { return written(e.body_i); }},
        {{"body_j", "", "id of the other body"}, [](Event e) { return written(e.body_j); }},
        {{"orientation", "rad", "direction of the contact normal, counter-clockwise from the x axis, in (-π/2, π/2]"},
         [](Event e) { return written(e.orientation); }},
        {{"energy", "J", "energy dissipated by the break",
          "½k_n(δ-δ0)'(δ-δ0) + ½f_t'f_t/k_s, where primed values are those one step before the break was detected "
          "(solver/MODEL.md 5)"},
         [](Event e) { return written(e.energy); }},
        {{"strength", "N",
          "strength of the bond: k_n δ0 of a back-tension bond; for a coulomb bond, the limit that was reached, T or "
          "C + μ f_n; for a face, the stress limit times its length"},
         [](Event e) { return written(e.strength); }},
        {{"normal_force", "N",
          "elastic normal force, positive if it pushes, in the last step in which the bond carried at least half its "
          "strength; for a coulomb bond or a face, at failure"},
         [](Event e) { return written(e.normal_force); }},
        {{"shear_force", "N",
          "elastic shear force on body_i in the same step as normal_force, positive along the normal from body_i to "
          "body_j turned by +90°"},
         [](Event e) { return written(e.shear_force); }},
        {{"slid", "0 or 1",
          "1 if the bond had reached its Coulomb limit before it broke, otherwise 0; coulomb bonds and faces do not "
          "slide while bonded and always have 0"},
         [](Event e) { return written(e.slid ? 1 : 0); }},
        {{"mode", "word",
          "`shear` if the bond had slid and shear_force exceeds normal_force in magnitude, otherwise `tension`; for a "
          "coulomb bond or a face, the kind of limit that was reached first",
          "nearly all back-tension bonds break in `tension`: such a bond breaks when its overlap vanishes, and its "
          "Coulomb limit vanishes with the overlap. `slid` shows whether it slid first"},
         [](Event e) { return std::string(e.shear_mode ? "shear" : "tension"); }},
        {{"last_of_interface", "0 or 1", "1 if this was the last bond between the two bodies, otherwise 0"},
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
