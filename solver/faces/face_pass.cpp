// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/faces/face_pass.hpp"

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "solver/base/chosen_set.hpp"
#include "solver/faces/broken_face.hpp"
#include "solver/faces/face_kernels.hpp"
#include "solver/faces/hand_over.hpp"
#include "solver/geometry/event_place.hpp"
#include "solver/geometry/face_motion.hpp"

namespace crackle {
namespace {

/// Number of faces or bodies in a block. It is fixed, so that sums over blocks do not depend on the number of threads.
constexpr std::size_t block_size = 512;

/// Calls visit(block, begin, end) for all blocks of a range.
template <class Visit>
void over_blocks(const World& world, std::size_t count, Visit visit) {
    const std::size_t blocks = (count + block_size - 1) / block_size;
    const auto block = [&](std::size_t n) { visit(n, n * block_size, std::min(count, (n + 1) * block_size)); };
    if (world.workers.threads == 1 || blocks < 2) {  // starting several threads would take longer than the work
        for (std::size_t n = 0; n < blocks; ++n) block(n);
        return;
    }
#pragma omp parallel for num_threads(world.workers.threads) schedule(static)
    for (std::size_t n = 0; n < blocks; ++n) block(n);
}

template <class Visit>
void for_each(const World& world, std::size_t count, Visit visit) {
    over_blocks(world, count, [&](std::size_t /*block*/, std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) visit(n);
    });
}

class Pass {
  public:
    explicit Pass(World& world) : world_(world), faces_(world.faces), bodies_(world.bodies.state.data()) {}

    void run() {
        const MoveFaces move = of_chosen_set([]<InstructionSet S>() -> MoveFaces { return &move_faces<S>; });
        const ForceFaces force = of_chosen_set([]<InstructionSet S>() -> ForceFaces { return &force_faces<S>; });
        over_blocks(world_, faces_.size(), [&](std::size_t /*block*/, std::size_t begin, std::size_t end) {
            move(faces_, bodies_, static_cast<FaceIndex>(begin), static_cast<FaceIndex>(end));
        });
        for_each(world_, faces_.broken.size(), [&](std::size_t n) { follow_far_turn(n); });
        hand_over(world_);
        faces_.late.resize(faces_.broken.size());
        for_each(world_, faces_.late.size(), [&](std::size_t n) { move_broken(n); });
        if (faces_.has_pressure) for_each(world_, faces_.cells.size(), [&](std::size_t b) { press(b); });
        over_blocks(world_, faces_.size(), [&](std::size_t block, std::size_t begin, std::size_t end) {
            const IntactForces found = force(faces_, bodies_, world_.stepping.drift, static_cast<FaceIndex>(begin),
                                             static_cast<FaceIndex>(end));
            faces_.losses[block] = {};
            faces_.losses[block].dashpot = found.dashpot_loss;
            if (found.some_fail) {
#pragma omp atomic write
                some_fail_ = true;
            }
        });
        FaceLosses losses = sum_of_blocks(faces_.size());
        break_failing(losses);
        over_blocks(world_, faces_.late.size(), [&](std::size_t block, std::size_t begin, std::size_t end) {
            faces_.losses[block] = {};
            for (std::size_t n = begin; n < end; ++n) faces_.losses[block].add(force_broken(n));
        });
        losses.add(sum_of_blocks(faces_.late.size()));
        for_each(world_, world_.bodies.size(), [&](std::size_t b) { gather(b); });
        world_.account.friction_loss += losses.friction;
        world_.account.fracture_loss += losses.fracture;
        world_.account.dashpot_loss += losses.dashpot;
        world_.account.law_loss += losses.lag;
        faces_.lag_loss += losses.lag;
    }

  private:
    FaceLosses sum_of_blocks(std::size_t count) const {
        FaceLosses sum;
        for (std::size_t block = 0; block * block_size < count; ++block) sum.add(faces_.losses[block]);
        return sum;
    }

    /// Computes the motion of a broken face again if its two bodies have rotated far relative to each other.
    void follow_far_turn(std::size_t n) {
        const FaceIndex k = faces_.broken[n].face;
        if (std::abs(faces_.motion[k].turn) <= last_bisected_turn) return;
        const BodyPair& pair = faces_.bodies[k];
        faces_.motion.set(k, motion_of(faces_.place[k], bodies_[pair.body_i], bodies_[pair.body_j]));
    }

    /// Computes the contact of a broken face at its late pressure, and its contribution to the dilation of its cells.
    void move_broken(std::size_t n) {
        BrokenFace& face = faces_.broken[n];
        const FaceIndex k = face.face;
        const FaceSprings s = faces_.springs[k];
        const BondFaceMotion m = faces_.motion[k];
        faces_.late[n] = late_contact(face, s, faces_.law_of(k), faces_.strength_share[k], m);
        if (!faces_.has_pressure) return;
        const double normal = faces_.late[n].stretch, shear = m.sliding - face.slip;
        faces_.dilation_i[k] = s.length * (s.share_i * normal + s.skew_i * shear);
        faces_.dilation_j[k] = s.length * (s.share_j * normal - s.skew_j * shear);
    }

    /// Computes the pressure of a cell from the motion of its faces.
    void press(std::size_t b) {
        CellPressure& cell = faces_.cells[b];
        if (cell.per_area == 0.0) return;
        double sum = 0.0;
        for (std::uint32_t n = faces_.first_face[b]; n < faces_.first_face[b + 1]; ++n) {
            const std::uint32_t end = faces_.face_ends[n];
            sum += (end & 1) != 0 ? faces_.dilation_j[end / 2] : faces_.dilation_i[end / 2];
        }
        const double pressure = cell.per_area * sum;
        cell.rise = pressure - cell.pressure;
        cell.pressure = pressure;
    }

    FaceForces elastic_forces(FaceIndex k) const {
        return intact_forces(faces_.springs[k], faces_.motion[k], faces_.pressure_at(k), faces_.skewing_at(k));
    }

    /// Adds dashpot forces to the elastic forces of a face. @param share closed fraction of the length @return losses
    /// of the dashpots
    FaceLosses damp(FaceIndex k, FaceForces& forces, double share, bool slides) {
        const BodyPair& pair = faces_.bodies[k];
        const FaceRates<double> rate =
            rates_of(faces_.place[k], faces_.motion[k], bodies_[pair.body_i], bodies_[pair.body_j]);
        const FaceDashpots c = faces_.dashpots[k];
        const FaceDashpots now{share * c.normal * rate.opening, slides ? 0.0 : share * c.shear * rate.sliding,
                               share * c.moment * rate.turn};
        const FaceDashpots last = faces_.dashpot_force[k];
        FaceLosses losses;
        losses.dashpot = 0.5 * world_.stepping.drift *
                         ((last.normal + now.normal) * rate.opening + (last.shear + now.shear) * rate.sliding +
                          (last.moment + now.moment) * rate.turn);
        faces_.dashpot_force.set(k, now);
        forces.normal += now.normal;
        forces.shear += now.shear;
        forces.moment += now.moment;
        return losses;
    }

    void store(FaceIndex k, const FaceForces& forces) {
        const BodyPair& pair = faces_.bodies[k];
        faces_.force[k] =
            forces_on_bodies(faces_.place[k], faces_.motion[k], bodies_[pair.body_i], bodies_[pair.body_j], forces);
    }

    /// Breaks the faces whose strength is exceeded, in index order.
    void break_failing(FaceLosses& losses) {
        if (!some_fail_) return;
        std::vector<FaceIndex> failing;
        std::vector<FaceForces> at;
        for (FaceIndex k = 0; k < faces_.size(); ++k) {
            if (faces_.broken_at[k] != no_face) continue;
            const FaceForces forces = elastic_forces(k);
            if (face_failure(faces_.law_of(k), faces_.springs[k].length, faces_.strength_share[k], forces) ==
                FaceFailure::none)
                continue;
            failing.push_back(k);
            at.push_back(forces);
        }
        for (std::size_t n = 0; n < failing.size(); ++n) losses.add(break_one(failing[n], at[n]));
        // The breaks have changed the pressures of the cells, and with them the forces of other faces.
        for (const FaceIndex k : failing) {
            for (const BodyIndex b : {faces_.bodies[k].body_i, faces_.bodies[k].body_j}) {
                for (std::uint32_t e = faces_.first_face[b]; e < faces_.first_face[b + 1]; ++e)
                    force_again(faces_.face_ends[e] / 2);
            }
        }
    }

    /// Breaks one face. @param forces elastic forces at which the face fails @return its energy losses
    FaceLosses break_one(FaceIndex k, const FaceForces& forces) {
        const BodyPair& pair = faces_.bodies[k];
        CellPressure &cell_i = faces_.cells[pair.body_i], &cell_j = faces_.cells[pair.body_j];
        const FaceSprings& s = faces_.springs[k];
        const FaceLaw& law = faces_.law_of(k);
        const double share = faces_.strength_share[k];
        const bool in_shear = face_failure(law, s.length, share, forces) == FaceFailure::shear;
        const FaceForces before = elastic_forces(k);
        const BreakResult result = break_face(k, s, law, share, faces_.motion[k], cell_i, cell_j, in_shear,
                                              share_of_points(s, faces_.motion[k], world_.settings.thick));
        const FaceRates<double> rate =
            rates_of(faces_.place[k], faces_.motion[k], bodies_[pair.body_i], bodies_[pair.body_j]);
        const double half_drift = 0.5 * world_.stepping.drift;
        FaceLosses losses;
        losses.fracture = result.energy;
        losses.lag = -half_drift * ((before.normal - result.forces.normal) * rate.opening +
                                    (before.shear - result.forces.shear) * rate.sliding +
                                    (before.moment - result.forces.moment) * rate.turn);
        // Half of the work that the lost part of a cell's pressure has done on the cell's other faces in this step.
        const auto others = [&](const CellPressure& cell, double left, double own_rise) {
            if (cell.per_area == 0.0) return 0.0;
            return 0.5 * (cell.pressure - left) * (cell.rise / cell.per_area - own_rise * world_.stepping.drift);
        };
        losses.lag -=
            others(cell_i, result.pressure_i, s.length * (s.share_i * rate.opening + s.skew_i * rate.sliding)) +
            others(cell_j, result.pressure_j, s.length * (s.share_j * rate.opening - s.skew_j * rate.sliding));
        if (faces_.damped()) {
            // The present dashpot forces cease to act, so the half of the work that the trapezoidal rule assigns to
            // them is subtracted.
            FaceDashpots damper = faces_.dashpot_force[k];
            losses.dashpot =
                -half_drift * (damper.normal * rate.opening + damper.shear * rate.sliding + damper.moment * rate.turn);
            faces_.dashpot_force.set(k, {});
        }
        cell_i.pressure = result.pressure_i;
        cell_j.pressure = result.pressure_j;
        faces_.broken_at[k] = static_cast<FaceIndex>(faces_.broken.size());
        faces_.broken.push_back(result.face);
        record(k, in_shear, forces, result.energy);
        store(k, result.forces);
        return losses;
    }

    /// Records the break of a face. @param forces the elastic forces at which it failed @param energy energy released,
    /// J
    void record(FaceIndex k, bool in_shear, const FaceForces& forces, double energy) {
        const auto [i, j] = faces_.bodies[k];
        const BondFaceMotion m = faces_.motion[k];
        const Vec2 arm = turned_by(bodies_[i], faces_.place[k].arm_i) + (0.5 * m.opening) * m.normal +
                         (0.5 * m.sliding) * perpendicular(m.normal);
        auto event = event_at<BreakEvent>(world_, i, j, Vec2{bodies_[i].x, bodies_[i].y} + arm, m.normal);
        const FaceStrength<double> strength(faces_.law_of(k), faces_.strength_share[k]);
        const double length = faces_.springs[k].length;
        const FaceStress<double> stress(strength, length, forces.normal, forces.shear, forces.moment);
        event.energy = energy;
        event.strength = length * (in_shear ? stress.shear_strength : strength.tensile);
        event.normal_force = -forces.normal;
        event.shear_force = forces.shear;
        event.shear_mode = in_shear;
        event.last_of_interface = true;  // convex cells share at most one face
        event.kind = PointKind::bonded_face;
        event.point = {i, j, k, k};
        world_.bonds.broken += 1;
        world_.bonds.interfaces_lost += 1;
        world_.bonds.events.push_back(event);
    }

    /// Computes the forces of an intact face again, at the present pressures. Dashpot forces are not changed.
    void force_again(FaceIndex k) {
        if (faces_.broken_at[k] != no_face) return;
        FaceForces forces = elastic_forces(k);
        if (faces_.damped()) {
            const FaceDashpots damper = faces_.dashpot_force[k];
            forces = {forces.normal + damper.normal, forces.shear + damper.shear, forces.moment + damper.moment};
        }
        store(k, forces);
    }

    /// Computes the forces of a face that was broken before this step. @return its energy losses
    FaceLosses force_broken(std::size_t n) {
        BrokenFace& face = faces_.broken[n];
        const FaceIndex k = face.face;
        BrokenStep step =
            step_broken(face, faces_.springs[k], faces_.law_of(k), faces_.strength_share[k], lag_of(faces_, k),
                        faces_.motion[k], faces_.late[n], faces_.pressure_at(k), faces_.skewing_at(k));
        if (faces_.damped())
            step.losses.add(damp(k, step.forces, step.closed / faces_.springs[k].length, face.last.slip != 0.0));
        store(k, step.forces);
        return step.losses;
    }

    void gather(std::size_t b) {
        BodyForce& sum = world_.bodies.force[b];
        for (std::uint32_t n = faces_.first_face[b]; n < faces_.first_face[b + 1]; ++n) {
            const PointForce& force = faces_.force[faces_.face_ends[n] / 2];
            const bool is_j = (faces_.face_ends[n] & 1) != 0;
            sum.fx += is_j ? -force.fx : force.fx;
            sum.fy += is_j ? -force.fy : force.fy;
            sum.torque += is_j ? force.torque_j : force.torque_i;
        }
    }

    World& world_;
    Faces& faces_;
    const BodyState* bodies_;
    bool some_fail_ = false;
};

}  // namespace

void add_face_forces(World& world) {
    world.faces.losses.resize((world.faces.size() + block_size - 1) / block_size);
    Pass(world).run();
}

FaceForces forces_of_face(const Faces& faces, FaceIndex k) {
    if (faces.broken_at[k] == no_face)
        return intact_forces(faces.springs[k], faces.motion[k], faces.pressure_at(k), faces.skewing_at(k));
    const BrokenFace& face = faces.broken[faces.broken_at[k]];
    const LapPressure lap =
        contact_of(faces.springs[k], faces.motion[k], faces.pressure_at(k), face.held, face.taken).lap;
    return {lap.force, face.last.shear, lap.moment};
}

double face_energy(const Faces& faces) {
    double sum = 0.0;
    for (FaceIndex k = 0; k < faces.size(); ++k) {
        if (faces.broken_at[k] != no_face) continue;
        const FaceSprings& s = faces.springs[k];
        const BondFaceMotion& m = faces.motion[k];
        sum +=
            0.5 * (s.normal * m.opening * m.opening + s.shear * m.sliding * m.sliding + s.moment() * m.turn * m.turn);
    }
    for (const BrokenFace& face : faces.broken) sum += face.energy;
    for (const CellPressure& cell : faces.cells)
        if (cell.per_area > 0.0) sum += 0.5 * cell.pressure * cell.pressure / cell.per_area;
    return sum;
}

}  // namespace crackle
