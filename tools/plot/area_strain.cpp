// SPDX-License-Identifier: GPL-3.0-or-later
// Diagram of the change of a specimen's area during loading: the two-dimensional volumetric strain, and the part of it
// caused by cracks.
// Tested by tests/tools/commands/plot_test.cpp.

#include <algorithm>
#include <cmath>

#include "specimens/case/kinds/test_kind.hpp"
#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/panels.hpp"
#include "tools/plot/plotted_curves.hpp"

namespace crackle::plot {
namespace {

/// By row: the area strain, which is axial minus lateral strain (shortening and widening positive), and the area strain
/// minus its elastic part (1-ν)σ/E. The latter is empty if E and ν are not known.
struct AreaStrains {
    std::vector<double> all, cracks;
};

AreaStrains area_strains_of(const PlottedTest& test) {
    const TestResults& results = *test.results;
    const double sense = pulled(results) ? -1.0 : 1.0;
    const Strength& known = results.summary.strength;
    const double compliance = (1.0 - known.poissons_ratio.or_nan()) / known.youngs_modulus.or_nan();
    const double confined = results.summary.confinement.confining_pressure.value_or(0.0);
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

/// Points of the curve up to where it first leaves the frame at the bottom.
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

// After the peak, pieces separate and the lateral strain only reflects their displacement. The axis of area strain
// therefore extends down only to this multiple of the lowest area strain before the peak.
constexpr double beyond_peak = 1.5;

}  // namespace

bool pulled(const TestResults& results) {
    const Stated<LoadingKind>& kind = results.summary.about.kind;
    return kind && test_kind(*kind).pulls();
}

bool has_area_strain(const TestResults& results) {
    // In tests that are not uniaxial, the axial and lateral strains do not refer to the same uniformly strained area.
    const Stated<LoadingKind>& kind = results.summary.about.kind;
    if (!kind || !test_kind(*kind).uniaxial) return false;
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
            // NaN if the specimen has not failed; all rows are then used.
            const double peak = test.results->summary.strength.peak_strain.or_nan();
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
                       {"due to cracks: minus (1 − ν)σ/E", shear_colour, true, false}};
        draw_legend_above(canvas, place, legend_of(canvas, std::move(entries), place.width), axes);
        if (axes.y.low < 0.0)
            canvas.line({axes.at(axes.x.low, 0.0), axes.at(axes.x.high, 0.0)}, colour("#c8ccd0"), 0.4);
        for (std::size_t k = 0; k < tests.size(); ++k) {
            const std::vector<double>& axial = column(*tests[k].results, "axial_strain");
            canvas.line(within_frame(axes, axial, strains[k].all), colour_of(tests[k]), curve_width, tests[k].dashed);
            if (!strains[k].cracks.empty())
                canvas.line(within_frame(axes, axial, strains[k].cracks), shear_colour, curve_width, true);
        }
        const double damage = tests.front().results->summary.cracking.crack_damage_strain.or_nan();
        if (single && std::isfinite(damage)) {
            const std::vector<double>& axial = column(*tests.front().results, "axial_strain");
            // The first row that reaches the strain of crack damage is used, since a platen that moves back passes the
            // same strain again.
            const auto row =
                std::ranges::find_if(axial, [&](double strain) { return strain >= damage; }) - axial.begin();
            const auto at = std::min(static_cast<std::size_t>(row), axial.size() - 1);
            const Point mark = axes.at(axial[at] / strain_unit, strains.front().all[at] / strain_unit);
            const Colour white = colour("#ffffff");
            canvas.circle(mark, 1.5, &white, &colour_of(tests.front()), 0.7 * curve_width);
            canvas.text({mark.x, mark.y + 3.0}, crack_damage_sign, Across::centre, Down::top, 0.75, ink);
        }
        axes.draw(canvas, strain_title, "area strain, ‰");
    };
    return panel;
}

}  // namespace crackle::plot
