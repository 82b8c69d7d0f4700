// SPDX-License-Identifier: GPL-3.0-or-later
// Plane P and S waves in free motion along a bond row of the triangular lattice. The lattice is wide enough that its
// edges do not influence the middle within a quarter of the period.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace lattice_waves_scenes {
namespace {

constexpr double radius = 0.02, overlap = 8e-5, spacing = 2.0 * radius - overlap, kn = 1e7;

/// Exact plane wave of the infinite lattice with q along x: u = (P cos qx, 0) or (0, S cos qx), rotation -turn·sin qx.
struct PlaneWave {
    double omega;  // 1/s
    double turn;   // rotation divided by displacement, 1/m
};

/// P wave: discs do not rotate, by mirror symmetry about the row. ω²m = 2k_n(1-cos qd) + (k_n+3k_s)(1-cos(qd/2)).
PlaneWave p_wave(double q, double share, double mass) {
    const double qd = q * spacing;
    const double stiffness = kn * (2.0 * (1.0 - std::cos(qd)) + (1.0 + 3.0 * share) * (1.0 - std::cos(0.5 * qd)));
    return {std::sqrt(stiffness / mass), 0.0};
}

/// S wave: the lower branch of coupled displacement and rotation. For u = (0, U) and θ = iΨ, a bond of direction n
/// (tangent t, phase φ = qd n_x) stores
PlaneWave s_wave(double q, double share, double mass) {
    const double ks = share * kn, moment = 0.5 * mass * radius * radius;
    double uu = 0.0, ut = 0.0, tt = 0.0;
    for (const double angle : {0.0, std::numbers::pi / 3.0, 2.0 * std::numbers::pi / 3.0}) {
        const double ny = std::sin(angle), ty = std::cos(angle), half = 0.5 * q * spacing * std::cos(angle);
        const double s = std::sin(half), c = 0.5 * spacing * std::cos(half);
        uu += 4.0 * (kn * ny * ny + ks * ty * ty) * s * s;
        ut -= 4.0 * ks * ty * s * c;
        tt += 4.0 * ks * c * c;
    }
    const double a = uu / mass, b = ut / std::sqrt(mass * moment), d = tt / moment;
    // The lower eigenvalue, in a form that avoids cancellation.
    const double squared = 2.0 * (a * d - b * b) / (a + d + std::sqrt((a - d) * (a - d) + 4.0 * b * b));
    return {std::sqrt(squared), -ut / (tt - moment * squared)};
}

/// ω of the wave, from the first zero crossing of the middle disc, a quarter of the period after the start.
/// @param wavelength in spacings  @param step_share step relative to √(m/k)
double measured_omega(bool shear, double share, int wavelength, double step_share) {
    const double q = 2.0 * std::numbers::pi / (wavelength * spacing);
    // Reflections from the edges arrive after half the width divided by c_p. A quarter of the period of the S wave is
    // λ/4c_s, and c_p/c_s < 1.74.
    const int columns = wavelength + 4, count_rows = static_cast<int>(columns / std::sqrt(0.75)) | 1;
    Scene scene = triangular_lattice(columns, count_rows, radius, overlap, rock(45.0, share));
    const double mass = mass_properties(scene, scene.bodies[0]).mass;
    scene.time_step = step_share * std::sqrt(mass / kn);
    scene.intact = {true, true, true};
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    const Vec2 middle{0.5 * spacing * (columns - 1), 0.25 * std::sqrt(3.0) * spacing * (count_rows - 1)};
    BodyIndex watched = 0;
    const auto far = [&](BodyIndex b) { return norm(Vec2{world.bodies.state[b].x, world.bodies.state[b].y} - middle); };
    for (BodyIndex b = 1; b < world.bodies.size(); ++b) watched = far(b) < far(watched) ? b : watched;
    const BodyState rest = world.bodies.state[watched];
    const PlaneWave wave = shear ? s_wave(q, share, mass) : p_wave(q, share, mass);
    // The wave starts at zero displacement and largest velocity, so springs are unstrained. A quarter of a period
    // later, the velocity of the watched disc crosses zero.
    const double speed = 1e-7 * wave.omega;
    for (BodyState& body : world.bodies.state) {
        const double phase = q * (body.x - rest.x);
        (shear ? body.vy : body.vx) = speed * std::cos(phase);
        body.omega = -speed * wave.turn * std::sin(phase);
    }
    double before = speed;
    const auto velocity = [&] { return shear ? world.bodies.state[watched].vy : world.bodies.state[watched].vx; };
    while (true) {
        step(world);
        const double now = velocity();
        if (now <= 0.0) {
            // Velocities are those of half a step before the time of the positions.
            const double time = world.stepping.time - world.stepping.time_step * (0.5 + now / (now - before));
            return 0.5 * std::numbers::pi / time;
        }
        before = now;
    }
}

void check(Rows& rows, bool shear, double share) {
    const double mass = 2500.0 * std::numbers::pi * radius * radius;
    const std::string label = fmt::format("k_s/k_n {}: ", share);
    double speeds[2] = {};
    const int wavelengths[2] = {16, 32};
    for (int k = 0; k < 2; ++k) {
        const double q = 2.0 * std::numbers::pi / (wavelengths[k] * spacing);
        const double expected = (shear ? s_wave(q, share, mass) : p_wave(q, share, mass)).omega;
        const double coarse = measured_omega(shear, share, wavelengths[k], 0.2);
        const double fine = measured_omega(shear, share, wavelengths[k], 0.05);
        // The error of leapfrog is (ω dt)²/24; linear interpolation of the crossing adds less.
        const double turn = 0.05 * std::sqrt(mass / kn) * expected;
        rows.relative(label + fmt::format("ω of {} spacings against the lattice's dispersion, 1/s", wavelengths[k]),
                      fine, expected, turn * turn / 8.0, "(ω dt)²/8");
        rows.converging({std::abs(coarse - expected), std::abs(fine - expected), 4.0, 2.0});
        speeds[k] = fine / q;
    }
    // Dispersion: c(q) = c₀(1 - β(qd)²). Combining both wavelengths leaves an error of O((qd)⁴), (2π/16)⁴/4/100.
    const double speed = (4.0 * speeds[1] - speeds[0]) / 3.0;
    const double modulus = std::sqrt(3.0) / 4.0 * kn * (shear ? 1.0 + share : 3.0 + share);
    const double density = 2500.0 * std::numbers::pi / (2.0 * std::sqrt(3.0));
    const double packed = density * (2.0 * radius) * (2.0 * radius) / (spacing * spacing);  // the discs overlap
    rows.relative(label + fmt::format("speed of long waves √({}/ρ_b), m/s", shear ? "C33" : "C11"), speed,
                  std::sqrt(modulus / packed), 1e-4, "(qd)⁴");
}

std::vector<ClaimRow> p_waves_of_the_triangular_lattice() {
    Rows rows;
    for (const double share : {0.0, 0.25, 1.0}) check(rows, false, share);
    return rows.take();
}

std::vector<ClaimRow> s_waves_of_the_triangular_lattice() {
    Rows rows;
    for (const double share : {0.25, 1.0}) check(rows, true, share);
    return rows.take();
}

}  // namespace
}  // namespace lattice_waves_scenes

std::vector<Claim> lattice_wave_claims() {
    using namespace lattice_waves_scenes;
    constexpr const char* group = "Chains and lattices";
    return {
        {.name = "p_waves_of_the_triangular_lattice",
         .group = group,
         .statement = "c_p² = C11/ρ_b, C11 = (√3/4)(3k_n+k_s), ρ_b = ρπ/(2√3)",
         .check = p_waves_of_the_triangular_lattice,
         .note = "ρ_b is the density for touching discs; the expected value includes its increase by (2R/d)² because "
                 "of the overlap δ0."},
        {.name = "s_waves_of_the_triangular_lattice",
         .group = group,
         .statement = "c_s² = C33/ρ_b, C33 = (√3/4)(k_n+k_s)",
         .check = s_waves_of_the_triangular_lattice,
         .note = "Discs rotate, for long waves by half the rotation of the wave."},
    };
}

}  // namespace crackle::verification
