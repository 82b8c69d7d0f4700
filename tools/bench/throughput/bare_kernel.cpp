// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/bench/throughput/bare_kernel.hpp"

#include "solver/base/errors.hpp"
#include "solver/base/lanes.hpp"
#include "solver/contact/dashpot.hpp"
#include "solver/contact/friction.hpp"
#include "solver/contact/law.hpp"
#include "solver/geometry/circle_geometry.hpp"
#include "solver/geometry/relative_motion.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"

namespace crackle::throughput {

BareKernel::BareKernel(const World& world) : time_step_(world.stepping.time_step) {
    const std::size_t begin = world.points.kind_begin[static_cast<std::size_t>(PointKind::circle_circle)];
    const std::size_t end = world.points.kind_begin[static_cast<std::size_t>(PointKind::circle_circle) + 1];
    std::vector<std::uint32_t> own(world.bodies.size(), no_body);
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        if (!world.bodies.info[b].single_circle) continue;
        const BodyState& state = world.bodies.state[b];
        own[b] = static_cast<std::uint32_t>(bodies_.size());
        world_body_.push_back(b);
        bodies_.push_back({state.x, state.y, state.vx, state.vy, state.omega, state.angle, state.shape[0], 0.0});
        inertia_.push_back({world.bodies.inertia[b].inverse_mass_x, world.bodies.inertia[b].inverse_moment});
    }
    for (std::size_t k = begin; k < end; ++k) {
        const ContactPoint& point = world.points.contact[k];
        if (overlap_of(world, static_cast<PointIndex>(k)) > 0.0)
            points_.push_back({own[point.body_i], own[point.body_j], world.points.shear_force[k]});
    }
    if (points_.empty()) throw InputError("bare kernel: found no touching circles, expected a packing");
    law_ = world.settings.laws[world.points.state[begin].law];
    root_mass_ = world.points.root_mass[begin];

    real_points_ = points_.size();
    const auto lone = static_cast<std::uint32_t>(bodies_.size());
    while (points_.size() % lane_count != 0) points_.push_back({lone, lone + 1, 0.0});
    if (points_.size() > real_points_) {
        for (const double x : {0.0, 10.0}) {
            bodies_.push_back({x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0});
            inertia_.push_back({0.0, 0.0});
        }
    }
    forces_.resize(points_.size());
    begin_.assign(bodies_.size() + 1, 0);
    for (const Point& point : points_) {
        ++begin_[point.i + 1];
        ++begin_[point.j + 1];
    }
    for (std::size_t b = 1; b < begin_.size(); ++b) begin_[b] += begin_[b - 1];
    slots_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t k = 0; k < points_.size(); ++k) {
        slots_[next[points_[k].i]++] = 2 * k;
        slots_[next[points_[k].j]++] = 2 * k + 1;
    }
}

void BareKernel::compute_forces() {
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

void BareKernel::move_bodies() {
    static constexpr Pair senses[2] = {{1.0, 1.0}, {-1.0, -1.0}};  // on i, on j
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

void BareKernel::step() {
    compute_forces();
    move_bodies();
}

std::vector<BareKernel::Contact> BareKernel::contacts() const {
    std::vector<Contact> all;
    for (std::size_t k = 0; k < real_points_; ++k)
        all.push_back({world_body_[points_[k].i], world_body_[points_[k].j], forces_[k]});
    return all;
}

}  // namespace crackle::throughput
