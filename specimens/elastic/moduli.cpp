// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/elastic/moduli.hpp"

#include <limits>

namespace crackle {

Moduli solve_moduli(const World& world, const TestSetup& setup) {
    Moduli moduli{};
    moduli.solution = solve_elastic(world, {{setup.bottom, {}}, {setup.top, {0.0, setup.height, 0.0}}});
    const std::vector<BodyMotion>& reaction = moduli.solution.reaction;
    moduli.youngs_modulus = 0.5 * (reaction[1].y - reaction[0].y) / setup.width;
    moduli.poissons_ratio = moduli.gauge_modulus = std::numeric_limits<double>::quiet_NaN();
    const auto rise = [&](const std::vector<BodyIndex>& bodies) {
        double sum = 0.0;
        for (const BodyIndex b : bodies) sum += moduli.solution.displacement[b].y;
        return sum / static_cast<double>(bodies.size());
    };
    if (setup.gauge_height > 0.0) {
        const double strain = (rise(setup.gauge_top) - rise(setup.gauge_bottom)) / setup.gauge_height;
        moduli.gauge_modulus = moduli.youngs_modulus / strain;
    }
    if (setup.gauge_length == 0.0) return moduli;
    const auto mean = [&](const std::vector<BodyIndex>& bodies) {
        double sum = 0.0;
        for (const BodyIndex b : bodies) sum += moduli.solution.displacement[b].x;
        return sum / static_cast<double>(bodies.size());
    };
    moduli.poissons_ratio = -(mean(setup.right) - mean(setup.left)) / setup.gauge_length;
    return moduli;
}

}  // namespace crackle
