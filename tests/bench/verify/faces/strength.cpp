// SPDX-License-Identifier: GPL-3.0-or-later
// The load at which a face breaks, compared with its envelope.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/bench/verify/faces/two_cells.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"

namespace crackle::verification {
namespace face_strength {
namespace {

constexpr double tensile = 1e-4, cohesion = 3e-4, knee = 2e-4;         // Pa, of a rock of E = 1 Pa
constexpr double slope = 1.0, slope_beyond = 0.4, moment_share = 0.6;  // tan φ, tan φ₂, β

/// Forces F_n and F_t in N, and moment M in N m. A multiple of all three acts on the face.
struct Load {
    double normal, shear, moment;
};

/// Multiples of a load at which the tension limit and the shear limit of the envelope are reached.
struct Limits {
    double tension, shear;
};

Limits limits_of(const Load& load) {
    constexpr double never = std::numeric_limits<double>::infinity();
    Limits limits{never, never};
    const double tension = load.normal + 6.0 * moment_share * load.moment;
    if (tension > 0.0) limits.tension = tensile / tension;
    const double rise = load.shear + slope * load.normal, rise_beyond = load.shear + slope_beyond * load.normal;
    if (rise > 0.0 && -load.normal * cohesion / rise <= knee) {
        limits.shear = cohesion / rise;
    } else if (rise_beyond > 0.0) {
        limits.shear = (cohesion + (slope - slope_beyond) * knee) / rise_beyond;
    }
    return limits;
}

TwoCells intact_cells() {
    FaceLaw law;
    law.tensile_strength = tensile;
    law.cohesion = cohesion;
    law.friction = slope;
    law.knee = knee;
    law.friction_beyond = slope_beyond;
    law.moment_share = moment_share;
    return two_cells(law, 0.26, 1.0 / 1.6);
}

/// Places intact cells so that a multiple of a load acts on their face.
TwoCells loaded(TwoCells cells, const Load& load, double by) {
    const double contact = cells.moduli.contact;
    cells.place(by * load.normal / (contact + cells.pressure_rate()),
                by * load.shear / (cells.moduli.shear_ratio * contact), by * load.moment / (contact / 12.0));
    return cells;
}

void add_rows(Rows& rows, const std::string& name, const Load& load) {
    const TwoCells intact = intact_cells();
    const Limits limits = limits_of(load);
    const double expected = std::min(limits.tension, limits.shear);
    const FaceForces f = loaded(intact, load, 0.5 * expected).forces();
    rows.absolute(name + ": forces at half the load, error over the load",
                  std::hypot(f.normal / expected - 0.5 * load.normal, f.shear / expected - 0.5 * load.shear,
                             f.moment / expected - 0.5 * load.moment),
                  0.0, 1e-10, "rounding");
    double holds = 0.0, breaks = 2.0 * expected;
    for (int n = 0; n < 60; ++n) {
        const double middle = 0.5 * (holds + breaks);
        (loaded(intact, load, middle).broken() ? breaks : holds) = middle;
    }
    rows.relative(name + ": multiple of the load at failure", breaks, expected, 1e-10, "rounding");
    const TwoCells after = loaded(intact, load, breaks);
    rows.exactly(name + ": fails in shear", after.broken() && after.world.faces.broken[0].in_shear ? 1.0 : 0.0,
                 limits.shear < limits.tension ? 1.0 : 0.0);
}

std::vector<ClaimRow> face_breaks_on_its_envelope() {
    Rows rows;
    for (const double angle : {0.0, 30.0, 60.0, 90.0, 110.0, 130.0, 155.0}) {
        const double a = angle * std::numbers::pi / 180.0;
        add_rows(rows, fmt::format("{:.0f} degrees from tension", angle), {std::cos(a), std::sin(a), 0.0});
    }
    add_rows(rows, "bent", {0.0, 0.0, 1.0});
    add_rows(rows, "pulled and bent", {1.0, 0.0, 0.2});
    add_rows(rows, "sheared and bent", {0.0, 1.0, 0.2});
    add_rows(rows, "pressed and bent", {-1.0, 0.0, 0.5});
    add_rows(rows, "pressed, sheared and bent", {-0.5, 1.0, 0.05});
    return rows.take();
}

}  // namespace
}  // namespace face_strength

std::vector<Claim> face_strength_claims() {
    return {{.name = "face_breaks_on_its_envelope",
             .group = "Faces",
             .statement =
                 "a face between two cells fails where F_n/L + 6β|M|/L² = T, or where |F_t|/L = C + s tan φ up "
                 "to s = s_b and rises with tan φ₂ beyond, at the smaller load",
             .check = face_strength::face_breaks_on_its_envelope,
             .note = "Two squares with pressures, κ = 1/1.6, ν = 0.26. The load is found by bisection of the motion. "
                     "A motion of 1e-4 of the cells' coordinates has 12 digits."}};
}

}  // namespace crackle::verification
