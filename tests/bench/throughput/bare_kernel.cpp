// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/throughput/bare_kernel.hpp"

#include "solver/base/chosen_set.hpp"
#include "solver/base/errors.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"

namespace crackle::throughput {

BareKernel::BareKernel(const World& world) : time_step_(world.stepping.time_step) {
    const std::size_t begin = world.points.kind_begin[static_cast<std::size_t>(PointKind::circle_circle)];
    const std::size_t end = world.points.kind_begin[static_cast<std::size_t>(PointKind::circle_circle) + 1];
    std::vector<std::uint32_t> own(world.bodies.size(), no_body);
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        if (!world.bodies.info(b).single_circle) continue;
        const BodyState& state = world.bodies.state[b];
        own[b] = static_cast<std::uint32_t>(bodies_.size());
        world_body_.push_back(b);
        bodies_.push_back({state.x, state.y, state.vx, state.vy, state.omega, state.angle, state.shape[0], 0.0});
        inertia_.push_back({world.bodies.inertia[b].inverse_mass_x, world.bodies.inertia[b].inverse_moment});
    }
    for (std::size_t k = begin; k < end; ++k) {
        const ContactPoint point = world.points.contact[k];
        if (overlap_of(world, static_cast<PointIndex>(k)) > 0.0)
            points_.push_back({own[point.body_i], own[point.body_j], world.points.shear_force[k]});
    }
    if (points_.empty()) throw InputError("bare kernel: found no touching circles, expected a packing");
    law_ = world.settings.laws[world.points.state[begin].law];
    root_mass_ = world.points.root_mass[begin];

    real_points_ = points_.size();
    const auto lone = static_cast<std::uint32_t>(bodies_.size());
    while (points_.size() % most_lanes != 0) points_.push_back({lone, lone + 1, 0.0});
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
    of_chosen_set([&]<InstructionSet S>() { compute_forces_of<S>(); });
}

void BareKernel::move_bodies() {
    of_chosen_set([&]<InstructionSet S>() { move_bodies_of<S>(); });
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
