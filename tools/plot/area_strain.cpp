// SPDX-License-Identifier: GPL-3.0-or-later
// How a specimen's area changes while it is loaded: the two-dimensional volume strain, and what of it is cracks.
// Tested by tests/tools/commands/plot_test.cpp.

#include <algorithm>
#include <cmath>

#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/panels.hpp"
#include "tools/plot/plotted_curves.hpp"

namespace crackle::plot {
namespace {

/// By row: axial less lateral strain, shortening and widening positive, and the same without its elastic part
/// (1-ν)σ/E; empty where the solve gave no E and ν.
struct AreaStrains {
    std::vector<double> all, cracks;
};

AreaStrains area_strains_of(const PlottedTest& test) {
    const TestResults& results = *test.results;
    const double sense = results.summary.word("kind") == "tension" ? -1.0 : 1.0;
    const double compliance = (1.0 - number_of(test, "poissons_ratio")) / number_of(test, "youngs_modulus");
    const double pressure = number_of(test, "confining_pressure"), confined = std::isnan(pressure) ? 0.0 : pressure;
    const std::vector<double>&axial = column(results, "axial_strain"), &lateral = column(results, "lateral_strain"),
          &stress = column(results, "axial_stress");
    AreaStrains strains;
    for (std::size_t k = 0; k < axial.size(); ++k) {
        strains.all.push_back(sense * axial[k] - lateral[k]);
        if (std::isfinite(compliance))
            strains.cracks.push_back(strains.all[k] - sense * compliance * (stress[k] - confined));
    }
    return strains;
}

/// Rows up to where it falls out of the frame, to the last point within it.
std::vector<Point> within_frame(const Axes& axes, const std::vector<double>& axial,
                                const std::vector<double>& strains) {
    std::vector<Point> points = curve_points(axes, axial, strain_unit, strains, strain_unit);
    const double floor = axes.frame.bottom();
    const auto out = std::ranges::find_if(points, [&](const Point& p) { return p.y > floor; });
    if (out == points.end() || out == points.begin()) return points;
    const Point before = *(out - 1);
    const double share = (floor - before.y) / (out->y - before.y);
    *out = {before.x + share * (out->x - before.x), floor};
    points.erase(out + 1, points.end());
    return points;
}

// Beyond the peak pieces part, and the strain of the sides is their way: axes reach to so much of what there was.
constexpr double beyond_peak = 1.5;

}  // namespace

bool has_area_strain(const TestResults& results) {
    // Of other kinds the two strains are not of one stretched area.
    const std::string kind = results.summary.word("kind");
    if (kind != "compression" && kind != "tension" && kind != "biaxial") return false;
    const std::vector<double>& lateral = column(results, "lateral_strain");
    return !lateral.empty() && std::ranges::none_of(lateral, [](double strain) { return std::isnan(strain); });
}

Panel area_strain(const std::vector<PlottedTest>& tests) {
    Panel panel;
    panel.height = [tests](const Canvas& measure, double width) {
        return 0.55 * proportional(width) + legend_of(measure, entries_of(tests), width).more_rows();
    };
    panel.draw = [tests](Canvas& canvas, const Rect& place) {
        const bool single = tests.size() == 1;
        std::vector<AreaStrains> strains;
        double low = 0.0, high = 0.0;  // strain
        for (const PlottedTest& test : tests) {
            strains.push_back(area_strains_of(test));
            if (!single) strains.back().cracks.clear();
            const double peak = number_of(test, "peak_strain");  // not a number of one that has not failed: all rows
            const std::vector<double>& axial = column(*test.results, "axial_strain");
            for (const std::vector<double>* values : {&strains.back().all, &strains.back().cracks}) {
                for (std::size_t k = 0; k < values->size() && !(axial[k] > peak); ++k) {
                    low = std::min(low, beyond_peak * (*values)[k]);
                    high = std::max(high, (*values)[k]);
                }
            }
        }
        Axes axes;
        axes.x = strain_scale(tests, place.width);
        axes.y = scale_for(low / strain_unit, high / strain_unit, 6);
        std::vector<Legend::Entry> entries = entries_of(tests);
        if (single)
            entries = {{"area strain", colour_of(tests.front()), false, false},
                       {"of cracks: less (1 − ν)σ/E", shear_colour, true, false}};
        const Legend legend = legend_of(canvas, std::move(entries), place.width);
        axes.frame = frame_below(canvas, place, legend, axes.x, axes.y);
        legend.draw(canvas, {place.x + beside_letter, place.y});
        if (axes.y.low < 0.0)
            canvas.line({axes.at(axes.x.low, 0.0), axes.at(axes.x.high, 0.0)}, colour("#c8ccd0"), 0.4);
        for (std::size_t k = 0; k < tests.size(); ++k) {
            const std::vector<double>& axial = column(*tests[k].results, "axial_strain");
            canvas.line(within_frame(axes, axial, strains[k].all), colour_of(tests[k]), curve_width, tests[k].dashed);
            if (!strains[k].cracks.empty())
                canvas.line(within_frame(axes, axial, strains[k].cracks), shear_colour, curve_width, true);
        }
        const double damage = number_of(tests.front(), "crack_damage_strain");
        if (single && std::isfinite(damage)) {
            const std::vector<double>& axial = column(*tests.front().results, "axial_strain");
            // The first row there: a platen that goes back brings the strain again.
            const auto row =
                std::ranges::find_if(axial, [&](double strain) { return strain >= damage; }) - axial.begin();
            const auto at = std::min(static_cast<std::size_t>(row), axial.size() - 1);
            const Point mark = axes.at(axial[at] / strain_unit, strains.front().all[at] / strain_unit);
            const Colour white = colour("#ffffff");
            canvas.circle(mark, 1.5, &white, &colour_of(tests.front()), 0.7 * curve_width);
            canvas.text({mark.x, mark.y + 3.0}, crack_damage_sign, Across::centre, Down::top, 0.75, ink);
        }
        axes.draw(canvas, strain_title, "area strain, 10⁻³");
    };
    return panel;
}

}  // namespace crackle::plot
