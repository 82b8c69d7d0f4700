// SPDX-License-Identifier: GPL-3.0-or-later
// Conserved quantities of a whole world, and functions that prepare a world.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "solver/world/world.hpp"
#include "specimens/making/materials.hpp"
#include "specimens/statistics/random_numbers.hpp"

namespace crackle::verification {

/// The shipped rock's stiffness: k_n 1e7 N/m, k_s = k_n/4, density 2500 kg/m2; frictional, undamped.
inline Material rock(double friction_angle = 27.0, double shear_share = 0.25) {
    return undamped_rock(1e7, friction_angle, shear_share);
}

struct Momentum {
    double x = 0.0, y = 0.0;     // N s
    double angular = 0.0;        // N m s, angular momentum about the origin
    double scale = 0.0;          // N s, sum of the magnitudes of the bodies' momenta
    double angular_scale = 0.0;  // N m s, sum of the magnitudes of the angular momenta
};

inline Momentum momentum_of(const World& world) {
    Momentum sum;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies.state[b];
        const double mass = world.bodies.inertia[b].mass, spin = world.bodies.info(b).moment * body.omega;
        sum.x += mass * body.vx;
        sum.y += mass * body.vy;
        sum.angular += mass * (body.x * body.vy - body.y * body.vx) + spin;
        sum.scale += mass * std::hypot(body.vx, body.vy);
        sum.angular_scale += mass * std::hypot(body.x, body.y) * std::hypot(body.vx, body.vy) + std::abs(spin);
    }
    return sum;
}

/// Largest change of any of the three components, relative to their initial scales.
inline double momentum_error(const Momentum& start, const Momentum& now) {
    return std::max({std::abs(now.x - start.x) / start.scale, std::abs(now.y - start.y) / start.scale,
                     std::abs(now.angular - start.angular) / start.angular_scale});
}

/// Energy needed to break every bond, J: the sum of ½ k_n δ0².
inline double breaking_energy(const World& world) {
    double sum = 0.0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const PointState& p = world.points.state[k];
        if ((p.flags & point_bonded) != 0)
            sum += 0.5 * world.settings.laws[p.law].normal_stiffness * world.points.bond_overlap[k] *
                   world.points.bond_overlap[k];
    }
    return sum;
}

/// Gives random velocities and spins to free bodies, scaled to a total kinetic energy of `energy` (J).
inline void shake(World& world, double energy, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    double sum = 0.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        BodyState& body = world.bodies.state[b];
        const double gyration = std::sqrt(world.bodies.info(b).moment / world.bodies.inertia[b].mass);
        body.vx = 2.0 * uniform_number(generator) - 1.0;
        body.vy = 2.0 * uniform_number(generator) - 1.0;
        body.omega = (2.0 * uniform_number(generator) - 1.0) / gyration;
        sum += 0.5 * world.bodies.inertia[b].mass * (body.vx * body.vx + body.vy * body.vy) +
               0.5 * world.bodies.info(b).moment * body.omega * body.omega;
    }
    const double scale = std::sqrt(energy / sum);
    for (BodyState& body : world.bodies.state) {
        body.vx *= scale;
        body.vy *= scale;
        body.omega *= scale;
    }
}

/// Sets the rotation of a body, including the body frame of clumps and chains.
inline void turn_body(World& world, std::size_t b, double angle) {
    BodyState& body = world.bodies.state[b];
    if (!world.bodies.info(b).single_circle) {
        const double c = std::cos(angle), s = std::sin(angle);
        const double cosine = body.shape[0] * c - body.shape[1] * s;
        body.shape[1] = body.shape[1] * c + body.shape[0] * s;
        body.shape[0] = cosine;
    }
    body.angle += angle;
}

/// FNV-1a hash of a string's bytes.
inline std::uint64_t hash_of(const std::string& bytes) {
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    return hash;
}

}  // namespace crackle::verification
