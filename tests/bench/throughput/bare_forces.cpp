// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of the bare kernel, compiled once for each instruction set.
// Tested by tests/bench_tests/throughput/bare_kernel_test.cpp.
#include "solver/base/instruction_set.hpp"
#include "solver/base/lanes.hpp"
#include "solver/geometry/circle_geometry.hpp"
#include "solver/geometry/relative_motion.hpp"
#include "solver/laws/dashpot.hpp"
#include "solver/laws/friction.hpp"
#include "solver/laws/law.hpp"
#include "tests/bench/throughput/bare_kernel.hpp"

namespace crackle::throughput {

template <>
void BareKernel::compute_forces_of<InstructionSet::CRACKLE_SET>() {
    clear_upper_halves();
    const Body* const bodies = bodies_.data();
    const Law<Lanes> law(law_);
    const Lanes root_mass = all_of<Lanes>(root_mass_), zero{};
    for (std::size_t k = 0; k < points_.size(); k += lane_count) {
        Point* const points = points_.data() + k;
        const double *place_i[lane_count], *place_j[lane_count], *velocity_i[lane_count], *velocity_j[lane_count];
        const double *spin_i[lane_count], *spin_j[lane_count], *size_i[lane_count], *size_j[lane_count];
        for (int l = 0; l < lane_count; ++l) {
            const Body &i = bodies[points[l].i], &j = bodies[points[l].j];
            place_i[l] = &i.x, place_j[l] = &j.x;
            velocity_i[l] = &i.vx, velocity_j[l] = &j.vx;
            spin_i[l] = &i.omega, spin_j[l] = &j.omega;
            size_i[l] = &i.radius, size_j[l] = &j.radius;
        }
        Lanes xi, yi, xj, yj, vxi, vyi, vxj, vyj, omega_i, omega_j, ri, rj, unused, shear{};
        gather_pairs(place_i, xi, yi);
        gather_pairs(place_j, xj, yj);
        gather_pairs(velocity_i, vxi, vyi);
        gather_pairs(velocity_j, vxj, vyj);
        gather_pairs(spin_i, omega_i, unused);
        gather_pairs(spin_j, omega_j, unused);
        gather_pairs(size_i, ri, unused);
        gather_pairs(size_j, rj, unused);
        for (int l = 0; l < lane_count; ++l) shear[l] = points[l].shear_force;

        const auto contact = circle_contact<Lanes>(xj - xi, yj - yi, ri, rj);
        const auto motion = relative_motion<Lanes>(contact, {vxi - vxj, vyi - vyj, omega_i, omega_j});
        const LaneBits touches = contact.overlap > 0.0;
        const auto trial = try_shear<Lanes>(law, shear, motion.slipping * time_step_, contact.overlap);
        const Lanes spring = select(touches, shear_force(trial), zero);
        const Lanes normal_damper = normal_damping(law, root_mass) * motion.closing;
        const Lanes shear_damper = shear_dashpot<Lanes>(law, root_mass, motion.slipping, contact.overlap, trial.slides);
        const Lanes normal = select(touches, spring_force(law, contact.overlap) + normal_damper, zero);
        const Lanes tangential = spring - select(touches, shear_damper, zero);
        for (int l = 0; l < lane_count; ++l) points[l].shear_force = spring[l];
        const ForceOnBodies<Lanes> force = force_on_bodies(contact, normal, tangential);
        store_quads(&forces_[k], force.fx, force.fy, force.torque_i, force.torque_j);
    }
}

template <>
void BareKernel::move_bodies_of<InstructionSet::CRACKLE_SET>() {
    static constexpr Pair senses[2] = {{1.0, 1.0}, {-1.0, -1.0}};  // signs of the force on bodies i and j
    const double dt = time_step_;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        Pair force{};
        double torque = 0.0;
        for (std::uint32_t s = begin_[b]; s < begin_[b + 1]; ++s) {
            const std::uint32_t side = slots_[s] & 1;
            const double* const slot = &forces_[slots_[s] >> 1].fx;
            force += senses[side] * load_as<Pair>(slot);
            torque += slot[2 + side];
        }
        Body& body = bodies_[b];
        const Inertia& inertia = inertia_[b];
        body.vx += dt * force[0] * inertia.inverse_mass;
        body.vy += dt * force[1] * inertia.inverse_mass;
        body.omega += dt * torque * inertia.inverse_moment;
        body.x += dt * body.vx;
        body.y += dt * body.vy;
        body.angle += dt * body.omega;
    }
}

}  // namespace crackle::throughput
