// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/emission/acoustic_event.hpp"

#include <fmt/format.h>

#include <cmath>

namespace crackle {
namespace {

/// Text of a number as written to files; infinite values are written as nan.
std::string written(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "nan"; }

}  // namespace

double moment_magnitude(const AcousticEvent& event, double thickness) {
    return moment_magnitude(thickness * scalar_moment(event.moment));
}

const std::vector<AcousticColumn>& acoustic_columns() {
    using Event = const AcousticEvent&;
    static const std::vector<AcousticColumn> columns{
        {{"time", "s since loading began", "", "time of the first break"},
         [](Event e, double) { return written(e.time); }},
        {{"axial_strain", "-", "axial strain at the first break, positive in the direction of loading"},
         [](Event e, double) { return written(e.axial_strain); }},
        {{"duration", "s", "time from the first break to the end of the time window that follows the last break"},
         [](Event e, double) { return written(e.duration); }},
        {{"x", "m", "mean x coordinate of the breaks"}, [](Event e, double) { return written(e.centre.x); }},
        {{"y", "m", "mean y coordinate of the breaks"}, [](Event e, double) { return written(e.centre.y); }},
        {{"radius", "m",
          "radius of the source disc, which extends a mean particle diameter beyond the outermost break"},
         [](Event e, double) { return written(e.radius); }},
        {{"breaks", "", "number of bonded contact points that broke in the event"},
         [](Event e, double) { return fmt::format("{}", e.breaks); }},
        {{"breaks_in_shear", "", "number of these breaks in shear, according to `mode` in events.csv"},
         [](Event e, double) { return fmt::format("{}", e.breaks_in_shear); }},
        {{"energy", "J", "energy released by the breaks",
          "the sum of `energy` of events.csv, not the energy that waves carry"},
         [](Event e, double) { return written(e.energy); }},
        {{"moment_xx", "N m", "positive: outward forces",
          "symmetric part of the moment tensor at the time of the largest scalar moment"},
         [](Event e, double) { return written(e.moment.xx); }},
        {{"moment_xy", "N m", "likewise"}, [](Event e, double) { return written(0.5 * (e.moment.xy + e.moment.yx)); }},
        {{"moment_yy", "N m", "likewise"}, [](Event e, double) { return written(e.moment.yy); }},
        {{"scalar_moment", "N m", "M0 = sqrt((m1² + m2²)/2), where m1 and m2 are the principal moments"},
         [](Event e, double) { return written(scalar_moment(e.moment)); }},
        {{"rise_time", "s", "time from the first break to the largest scalar moment"},
         [](Event e, double) { return written(e.rise_time); }},
        {{"moment_magnitude", "-", "Mw = 2/3 log10 M0 - 6; nan if the event has no moment",
          "in area units, M0 is multiplied by `output.out_of_plane_thickness`, which is taken as 1 m if it is not "
          "given"},
         [](Event e, double thickness) { return written(moment_magnitude(e, thickness)); }},
        {{"energy_magnitude", "-", "Me = 2/3 log10 energy - 3.2; nan if the energy is 0", "likewise"},
         [](Event e, double thickness) { return written(energy_magnitude(thickness * e.energy)); }},
        {{"isotropic", "%",
          "R = 100 tr M/(|tr M| + |m1*| + |m2*|), where m1* and m2* are the principal values of the two-dimensional "
          "deviator; nan if the event has no moment"},
         [](Event e, double) { return written(isotropic_percent(e.moment)); }},
        {{"type", "word",
          "`opening` if R is above 30, `closing` if it is below -30, otherwise `shear`; `none` if the event has no "
          "moment"},
         [](Event e, double) {
             const double percent = isotropic_percent(e.moment);
             return std::string(std::isnan(percent) ? "none" : name_of(source_type(percent)));
         }},
    };
    return columns;
}

std::string acoustic_header() {
    std::string line;
    for (const AcousticColumn& column : acoustic_columns()) {
        if (!line.empty()) line += ',';
        line += column.what.name;
    }
    return line + '\n';
}

std::string acoustic_line(const AcousticEvent& event, double thickness) {
    std::string line;
    for (const AcousticColumn& column : acoustic_columns()) {
        if (!line.empty()) line += ',';
        line += column.text(event, thickness);
    }
    return line + '\n';
}

}  // namespace crackle
