// SPDX-License-Identifier: GPL-3.0-or-later
// Energies of broken faces: a break never sets energy free, and over any cycle the work is what is stored and lost.

#include "solver/faces/broken_face.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/claim.hpp"

namespace crackle::face_test {
namespace {

using testing::agrees;
using testing::within;

FaceSprings springs() { return {40.0, 25.0, 0.5, 0.55, 0.45, 0.1, 0.2}; }

FaceLaw rubbing() {
    FaceLaw law;
    law.tensile_strength = 1.0;
    law.cohesion = 2.0;
    law.friction = law.residual_friction = 0.4;
    law.residual_cohesion = 0.5;
    law.softening_slip = 0.2;
    law.residual_tensile_strength = 0.8;
    law.softening_opening = 0.03;
    return law;
}

TEST(BrokenFace, ABreakNeverSetsEnergyFree) {
    std::mt19937 random(3);
    const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
    double least = 0.0;
    for (int n = 0; n < 20'000; ++n) {
        BondFaceMotion m{{1.0, 0.0}, 0.1 * number(), 0.1 * number(), 0.3 * number()};
        // Stiff cells: λ/A L² s² is up to a hundred times k_n, as of slender triangles.
        const double stiff = n % 2 == 0 ? 60.0 : 2e4;
        const CellPressure i{stiff * std::abs(number()), 20.0 * number()},
            j{stiff * std::abs(number()), 20.0 * number()};
        for (const bool in_shear : {false, true}) {
            // A failure in shear has a shear force beyond the strength that is left.
            FaceLaw law = rubbing();
            law.softening_slip = 0.0;
            const BreakResult result = break_face(0, springs(), law, 1.0, m, i, j, in_shear);
            least = std::min(least, result.energy);
        }
    }
    EXPECT_TRUE(within("least energy of 40,000 breaks, J", least, 0.0, 1e-15));
}

// A face that opens, beside a cell whose other faces give it the dilation e0 = 0.1. Before the break p = P (e0 + s L
// δ). After it the open face moves by q with k q + L s p = 0, so p = P e0 k/(k + P s² L²).
TEST(BrokenFace, ABreakReleasesWhatTheCellsPressureLoses) {
    const FaceSprings s{2.0, 1.0, 1.5, 0.4, 0.6, 0.0, 0.0};
    const double per_area = 3.0, others = 0.1, opening = 0.2;
    const double before = per_area * (others + s.share_i * s.length * opening);
    const double stiffening = per_area * s.share_i * s.share_i * s.length * s.length;
    const double after = per_area * others * s.normal / (s.normal + stiffening);
    const BreakResult result = break_face(0, s, rubbing(), 1.0, {{1.0, 0.0}, opening, 0.0, 0.0},
                                          {.per_area = per_area, .pressure = before}, {}, false);
    EXPECT_TRUE(agrees("pressure after the break", result.pressure_i, after, 1e-12));
    const double stored = 0.5 * s.normal * opening * opening + 0.5 * before * before / per_area;
    const double face = 0.5 * s.length * s.length / s.normal * s.share_i * s.share_i * after * after;
    EXPECT_TRUE(agrees("energy released", result.energy, stored - face - 0.5 * after * after / per_area, 1e-12));
}

/// A cycle of openings, slides and turns, in `steps` steps. @return work less energy and losses, J
double unaccounted(int steps, double turn) {
    const FaceSprings s = springs();
    const FaceLaw law = rubbing();
    const auto motion_at = [&](double phase) {
        const double p = 2.0 * 3.14159265358979323846 * phase;
        return BondFaceMotion{{1.0, 0.0},
                              -0.02 + 0.04 * std::sin(p) - 0.01 * std::sin(2.0 * p),
                              0.15 * std::sin(p + 0.3),
                              turn * std::sin(3.0 * p)};
    };
    const BondFaceMotion first = motion_at(0.0);
    const BreakResult broken = break_face(0, s, law, 1.0, first, {}, {}, true);
    BrokenFace face = broken.face;
    const double before = face.energy;
    FaceForces last = broken.forces;
    BondFaceMotion from = first;
    double work = 0.0, lost = 0.0;
    for (int n = 1; n <= steps; ++n) {
        const BondFaceMotion to = motion_at(static_cast<double>(n) / steps);
        const BrokenStep step = step_broken(face, s, law, 1.0, {}, to, late_contact(face, s, law, 1.0, to), 0.0, 0.0);
        work += 0.5 * ((last.normal + step.forces.normal) * (to.opening - from.opening) +
                       (last.shear + step.forces.shear) * (to.sliding - from.sliding) +
                       (last.moment + step.forces.moment) * (to.turn - from.turn));
        lost += step.losses.friction + step.losses.fracture + step.losses.lag;
        last = step.forces;
        from = to;
    }
    EXPECT_GT(lost, 0.01 * std::abs(work));
    return work - (face.energy - before) - lost;
}

TEST(BrokenFace, ClosesItsEnergyAccountOverACycleToSecondOrder) {
    for (const double turn : {0.0, 0.2}) {
        const double coarse = unaccounted(2'000, turn), fine = unaccounted(20'000, turn);
        EXPECT_TRUE(within("work less energy and losses, J", fine, 0.0, 2e-7));
        EXPECT_LT(std::abs(fine), 0.05 * std::abs(coarse) + 1e-12);
    }
}

TEST(BrokenFace, TearsOverItsSofteningOpening) {
    const FaceSprings s = springs();
    FaceLaw law = rubbing();
    law.residual_friction = 0.0;
    BondFaceMotion m{{1.0, 0.0}, 0.0, 0.0, 0.0};
    BrokenFace face = break_face(0, s, law, 1.0, m, {}, {}, true).face;
    EXPECT_EQ(face.held, 1.0);
    const double stiffness = s.normal / s.length, lap = s.length - m.sliding;
    double torn = 0.0, worst = 0.0;
    FaceForces last{};
    constexpr double stride = 1e-5;
    for (int n = 0; n < 4000; ++n) {
        m.opening += stride;
        const BrokenStep step = step_broken(face, s, law, 1.0, {}, m, late_contact(face, s, law, 1.0, m), 0.0, 0.0);
        // The tension against the opening less its elastic part.
        const double stress = step.forces.normal / lap, inelastic = m.opening - stress / stiffness;
        const double expected = std::max(0.0, 0.8 * (1.0 - inelastic / law.softening_opening));
        if (inelastic > 1e-9) worst = std::max(worst, std::abs(stress - expected));
        torn += step.losses.fracture;
        last = step.forces;
    }
    EXPECT_EQ(last.normal, 0.0);
    EXPECT_TRUE(within("tension less the softening line, Pa", worst, 0.0, 1e-12));
    EXPECT_TRUE(agrees("energy of tearing, half strength times opening", torn, 0.5 * 0.8 * 0.03 * lap, 1e-5));
}

TEST(BrokenFace, LosesNothingToTheLagWhileItIsClosed) {
    const FaceSprings s = springs();
    FaceLaw law;
    law.tensile_strength = law.cohesion = 0.0;
    law.residual_friction = law.friction = 100.0;  // sticks
    BrokenFace face = break_face(0, s, law, 1.0, {{1.0, 0.0}, -0.1, 0.0, 0.01}, {}, {}, true).face;
    double lag = 0.0, scale = 0.0;
    for (int n = 1; n < 100; ++n) {
        const BondFaceMotion m{{1.0, 0.0}, -0.1 + 0.02 * std::sin(0.3 * n), 0.0, 0.01};
        const double pressure = 0.3 * std::sin(0.5 * n);
        const BrokenStep step =
            step_broken(face, s, law, 1.0, {}, m, late_contact(face, s, law, 1.0, m), pressure, 0.0);
        lag += std::abs(step.losses.lag);
        scale += std::abs(step.forces.normal) * 0.01;
    }
    EXPECT_TRUE(within("lag of a closed face, of its work", lag / scale, 0.0, 1e-14));
}

TEST(BrokenFace, KeepsItsResidualCohesionOnceItHasSlidFarEnough) {
    const FaceSprings s = springs();
    const FaceLaw law = rubbing();
    BondFaceMotion m{{1.0, 0.0}, -0.05, 0.05, 0.0};
    BrokenFace face = break_face(0, s, law, 1.0, m, {}, {}, true).face;
    double shear = 0.0, normal = 0.0;
    for (int n = 0; n < 300; ++n) {
        m.sliding += 0.001;
        const BrokenStep step = step_broken(face, s, law, 1.0, {}, m, late_contact(face, s, law, 1.0, m), 0.0, 0.0);
        shear = step.forces.shear, normal = step.forces.normal;
    }
    EXPECT_TRUE(agrees("c_r b_c + N tan phi_r", shear, 0.5 * (0.5 - m.sliding) - 0.4 * normal, 1e-12));
}

}  // namespace
}  // namespace crackle::face_test
