// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/envelope_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"

namespace crackle::plot {
namespace {

constexpr int points_of_curve = 200;
constexpr double beyond_last = 1.08;  // laws are drawn up to this multiple of the largest confinement

const Colour& line_colour() { return series_colour(1); }
const Colour& hoek_brown_colour() { return series_colour(2); }
const Colour& measured_colour() { return series_colour(3); }

double largest_confinement(const EnvelopeFigure& figure) {
    double largest = figure.laws.strengths.back().confinement;
    for (const StrengthOfCores& cores : figure.measured) largest = std::max(largest, cores.confinement);
    return largest;
}

double largest_strength(const EnvelopeFigure& figure) {
    double largest = 0.0;
    for (const StrengthPoint& test : figure.tests.compressions) largest = std::max(largest, test.strength);
    for (const StrengthOfCores& cores : figure.measured) largest = std::max(largest, cores.strength + cores.error);
    return largest;
}

/// Unit that suits the smallest strength. Confining pressures, which are a small fraction of it, then have short
/// numbers.
Unit stress_unit(const EnvelopeFigure& figure) {
    return unit_for(figure.laws.strengths.front().mean, figure.tests.unit);
}

/// Legend entries of both laws with their fitted parameters, and of measured strengths.
std::vector<Legend::Entry> fitted_entries(const EnvelopeFigure& figure) {
    const StrengthEnvelope& laws = figure.laws;
    const Unit unit = stress_unit(figure);
    const auto stress = [&](const FittedNumber& number) {
        return fmt::format("{:.3g} {}", number.value / unit.factor, unit.name);
    };
    std::vector<Legend::Entry> entries{
        {fmt::format("Mohr-Coulomb: φ = {:.1f}°, c = {}", laws.friction_angle.value, stress(laws.cohesion)),
         line_colour(), true, false},
        {fmt::format("Hoek-Brown: m = {:.3g}, C = {}", laws.hoek_brown_m.value, stress(laws.hoek_brown_strength)),
         hoek_brown_colour(), false, false}};
    if (!figure.measured.empty()) entries.push_back({figure.measured_label, measured_colour(), false, true});
    return entries;
}

std::vector<Legend::Entry> circle_entries(const EnvelopeFigure& figure) {
    std::vector<Legend::Entry> entries{{"Mohr-Coulomb", line_colour(), true, false},
                                       {"Hoek-Brown", hoek_brown_colour(), false, false},
                                       {"means", ink, false, false}};
    if (figure.tension.count > 0) entries.push_back({"tension", tension_colour, false, false});
    return entries;
}

/// Points of a law at equally spaced stresses between two ends.
template <class Law>
std::vector<Point> curve_of(const Axes& axes, double factor, double from, double to, const Law& law) {
    std::vector<Point> points;
    for (int k = 0; k <= points_of_curve; ++k) {
        const double at = std::lerp(from, to, static_cast<double>(k) / points_of_curve);
        const Point stress = law(at);
        points.push_back(axes.at(stress.x / factor, stress.y / factor));
    }
    return points;
}

/// Axes with the same scale for σn and τ.
struct MohrAxes {
    Unit unit;
    double width;  ///< pt, width of the frame
    Scale x, y;

    MohrAxes(const EnvelopeFigure& figure, const Canvas& canvas, double panel_width) : unit(stress_unit(figure)) {
        double right = 0.0, radius = 0.0;
        for (const StrengthAt& at : figure.laws.strengths) {
            right = std::max(right, at.mean);
            radius = std::max(radius, 0.5 * (at.mean - at.confinement));
        }
        const double left = figure.tension.count > 0 ? -figure.tension.mean : 0.0;
        x = scale_for(left / unit.factor, right / unit.factor, panel_width < 300.0 ? 7 : 10);
        const double top = 1.12 * radius / unit.factor;
        y = {0.0, top, scale_for(0.0, top, 4).step};
        const double left_room = Axes::room_left(canvas, y);
        width = panel_width - left_room - Axes::room_right(canvas, x, panel_width - left_room);
    }
    double points_of_unit() const { return width / (x.high - x.low); }
    double height() const { return y.high * points_of_unit(); }
};

void draw_circle(Canvas& canvas, const Axes& axes, double factor, double smallest, double largest,
                 const Colour& colour) {
    const double centre = 0.5 * (smallest + largest), radius = 0.5 * (largest - smallest);
    canvas.line(curve_of(axes, factor, 0.0, std::numbers::pi,
                         [&](double angle) {
                             return Point{centre + radius * std::cos(angle), radius * std::sin(angle)};
                         }),
                colour, 0.7 * curve_width);
}

/// Draws measured strengths as open circles with their errors. @param at  maps pressure and strength to a point
void draw_measured(Canvas& canvas, const std::vector<StrengthOfCores>& measured, const auto& at) {
    const Colour white = colour("#ffffff");
    constexpr double radius = 2.2;  // pt
    for (const StrengthOfCores& cores : measured) {
        if (cores.error > 0.0)
            canvas.line({at(cores.confinement, cores.strength - cores.error),
                         at(cores.confinement, cores.strength + cores.error)},
                        measured_colour(), curve_width);
        canvas.circle(at(cores.confinement, cores.strength), radius, &white, &measured_colour(), curve_width);
    }
}

}  // namespace

Panel strengths_over_confinement(const EnvelopeFigure& figure) {
    Panel panel;
    panel.height = [figure](const Canvas& measure, double width) {
        return 0.55 * proportional(width) + legend_of(measure, fitted_entries(figure), width).more_rows();
    };
    panel.draw = [figure](Canvas& canvas, const Rect& place) {
        const StrengthEnvelope& laws = figure.laws;
        const Unit unit = stress_unit(figure);
        const double last = beyond_last * largest_confinement(figure);
        double highest = std::max({largest_strength(figure), laws.mohr_coulomb(last), laws.hoek_brown(last)});
        // The interval from only two tests may be many times larger than the rest of the diagram; it then extends
        // beyond the frame.
        const double room_for_intervals = 1.2 * highest;
        for (const StrengthAt& one : laws.strengths)
            if (one.high > highest) highest = std::min(one.high, room_for_intervals);
        Axes axes;
        axes.x = scale_for(figure.tension.count > 0 ? -figure.tension.mean / unit.factor : 0.0, last / unit.factor,
                           place.width < 300.0 ? 5 : 8);
        axes.y = scale_for(0.0, highest / unit.factor, 5);
        draw_legend_above(canvas, place, legend_of(canvas, fitted_entries(figure), place.width), axes);
        const auto curve = [&](double from, auto strength) {
            return curve_of(axes, unit.factor, from, last, [&](double s3) { return Point{s3, (laws.*strength)(s3)}; });
        };
        canvas.clip(axes.frame);
        canvas.line(curve(laws.mohr_coulomb_tension(), &StrengthEnvelope::mohr_coulomb), line_colour(), curve_width,
                    true);
        canvas.line(curve(laws.hoek_brown_tension(), &StrengthEnvelope::hoek_brown), hoek_brown_colour(), curve_width);
        canvas.unclip();
        const auto at = [&](double s3, double s1) { return axes.at(s3 / unit.factor, s1 / unit.factor); };
        const Colour pale = tinted(ink, 0.45);
        constexpr double beside = 4.5;  // pt, distance between a mean and its interval
        for (const StrengthPoint& test : figure.tests.compressions) {
            const Point place_of_test = at(test.confinement, test.strength);
            canvas.circle({place_of_test.x + beside, place_of_test.y}, 1.0, &pale, nullptr, 0.0);
        }
        for (const double tension : figure.tests.tensions) {
            const Point place_of_test = at(-tension, 0.0);
            canvas.circle({place_of_test.x, place_of_test.y - beside}, 1.0, &pale, nullptr, 0.0);
        }
        axes.draw(canvas, titled("confining pressure " + indexed("σ", "3"), unit.name),
                  titled(figure.tests.measure.spoken_one() + " " + indexed("σ", "1"), unit.name));
        constexpr double mark = 5.0;  // pt, half the height of a mark on the axis
        canvas.clip({axes.frame.x - mark, axes.frame.y, axes.frame.width + 2.0 * mark, axes.frame.height});
        for (const StrengthAt& one : laws.strengths) {
            draw_mean(canvas, at(one.confinement, one.mean), at(one.confinement, one.low),
                      at(one.confinement, one.high), ink, false);
        }
        draw_measured(canvas, figure.measured, at);
        canvas.unclip();
        if (figure.tension.count > 0) {
            draw_mean(canvas, at(-figure.tension.mean, 0.0), at(-figure.tension.high, 0.0),
                      at(-figure.tension.low, 0.0), tension_colour, true);
        }
    };
    return panel;
}

Panel mohr_circles(const EnvelopeFigure& figure) {
    Panel panel;
    panel.height = [figure](const Canvas& measure, double width) {
        const Legend legend = legend_of(measure, circle_entries(figure), width);
        return room_above(measure, legend) + MohrAxes(figure, measure, width).height() + Axes::room_below(measure);
    };
    panel.draw = [figure](Canvas& canvas, const Rect& place) {
        const StrengthEnvelope& laws = figure.laws;
        const MohrAxes scales(figure, canvas, place.width);
        Axes axes;
        axes.x = scales.x;
        axes.y = scales.y;
        draw_legend_above(canvas, place, legend_of(canvas, circle_entries(figure), place.width), axes);
        // A row may be taller than this panel needs; more of the τ axis is then shown at the same scale.
        axes.y.high = axes.frame.height / (axes.frame.width / (axes.x.high - axes.x.low));
        const double factor = scales.unit.factor, last = beyond_last * largest_confinement(figure);
        const double last_deviator = laws.hoek_brown(last) - last;
        const double last_normal = laws.hoek_brown_on_plane(last_deviator).normal;
        canvas.clip(axes.frame);
        for (const StrengthAt& at : laws.strengths) draw_circle(canvas, axes, factor, at.confinement, at.mean, ink);
        if (figure.tension.count > 0) draw_circle(canvas, axes, factor, -figure.tension.mean, 0.0, tension_colour);
        const double apex = -laws.cohesion.value / (laws.mohr_coulomb_on_plane(1.0) - laws.cohesion.value);
        canvas.line(curve_of(axes, factor, apex, last_normal,
                             [&](double normal) {
                                 return Point{normal, laws.mohr_coulomb_on_plane(normal)};
                             }),
                    line_colour(), curve_width, true);
        canvas.line(curve_of(axes, factor, 0.0, last_deviator,
                             [&](double deviator) {
                                 const PlaneStress on = laws.hoek_brown_on_plane(deviator);
                                 return Point{on.normal, on.shear};
                             }),
                    hoek_brown_colour(), curve_width);
        canvas.unclip();
        axes.draw(canvas, titled("normal stress " + indexed("σ", "n"), scales.unit.name),
                  titled("shear stress <i>τ</i>", scales.unit.name));
    };
    return panel;
}

}  // namespace crackle::plot
