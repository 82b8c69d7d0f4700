// SPDX-License-Identifier: GPL-3.0-or-later
// A curve whose peak, failure and moduli are known.
#pragma once

#include <vector>

#include "specimens/observers/curve.hpp"

namespace crackle::testing {

/// σ = E ε up to the peak, then a drop to the fraction `share_after` of it; lateral strain = ν ε.
inline std::vector<CurveRow> straight_curve(double modulus, double peak_strain, double share_after,
                                            double poissons_ratio, int rows) {
    std::vector<CurveRow> curve;
    for (int k = 0; k <= 2 * rows; ++k) {
        CurveRow row;
        row.axial_strain = peak_strain * k / rows;
        row.axial_stress = k <= rows ? modulus * row.axial_strain : share_after * modulus * peak_strain;
        row.stress_top = row.axial_stress + 2.0;
        row.stress_bottom = row.axial_stress - 2.0;
        row.lateral_strain = poissons_ratio * row.axial_strain;
        row.bonds_broken = k / 10;
        curve.push_back(row);
    }
    return curve;
}

}  // namespace crackle::testing
