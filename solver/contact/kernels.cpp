// SPDX-License-Identifier: GPL-3.0-or-later
// The contact kernels: one loop over a block of points, compiled for each kind and set of features, picked once a pass,
// and all of this once for each instruction set.

#include "solver/contact/kernels.hpp"

#include <algorithm>
#include <array>

#include "solver/contact/batch.hpp"
#include "solver/contact/coulomb_bond.hpp"
#include "solver/contact/dashpot.hpp"
#include "solver/contact/flat_face_motion.hpp"
#include "solver/contact/friction.hpp"
#include "solver/contact/law.hpp"
#include "solver/contact/opening.hpp"
#include "solver/contact/point_motion.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/geometry/relative_motion.hpp"

namespace crackle {
namespace {

/// Work of the drift that ended here, by the spring's force before it and after it (`now` along the normal, N).
inline void store_work(SpringWork& work, const World& world, const ContactPoint& point, double now, double closing) {
    const BodyState &i = world.bodies.state[point.body_i], &j = world.bodies.state[point.body_j];
    const double given_back = work.last.fx * (i.vx - j.vx) + work.last.fy * (i.vy - j.vy) +
                              work.last.torque_i * i.omega + work.last.torque_j * j.omega;
    work.stored += 0.5 * world.stepping.drift * (now * closing - given_back);
}

/// Out of contact: no force; what the shear spring still held is lost to the slider.
template <class Features>
inline void release(const Features& has, World& world, PointIndex k, const Law<double>& law, BlockLosses& loss,
                    double slip) {
    PointState& state = world.points.state[k];
    if (has.friction) {
        const ShearTrial<double> trial = try_shear(law, world.points.shear_force[k], slip, 0.0);
        if (trial.slides) loss.friction += slider_loss(law, trial, shear_force(trial));
    }
    world.points.shear_force[k] = 0.0;
    state.flags = static_cast<std::uint16_t>(state.flags & ~(point_touching | point_sliding | point_slid));
}

/// Inverse mass along the normal at the contact position, 1/kg, and the acceleration there in the last kick (closing,
/// m/s2). A driving force is no part of it: what that costs is in the point's defect.
template <PointKind K>
inline void feel_bodies(const World& world, const ContactPoint& point, const ContactGeometry& g,
                        ClosingPoint& closing) {
    const auto add = [&](BodyIndex b, double arm_x, double arm_y, double sense) {
        const BodyInertia& inertia = world.bodies.inertia[b];
        const BodyForce& force = world.bodies.last_force[b];
        const double turn = arm_x * g.ny - arm_y * g.nx;
        closing.inverse_mass += inertia.inverse_mass_x * g.nx * g.nx + inertia.inverse_mass_y * g.ny * g.ny +
                                inertia.inverse_moment * turn * turn;
        closing.acceleration +=
            sense * ((force.fx + inertia.mass * world.settings.gravity.x) * inertia.inverse_mass_x * g.nx +
                     (force.fy + inertia.mass * world.settings.gravity.y) * inertia.inverse_mass_y * g.ny +
                     force.torque * inertia.inverse_moment * turn);
    };
    add(point.body_i, g.aix, g.aiy, 1.0);
    if constexpr (K != PointKind::element_wall) add(point.body_j, g.ajx, g.ajy, -1.0);
}

/// Of the bodies of a point.
template <PointKind K>
inline PushBounds<double> push_bounds(const World& world, const ContactPoint& point) {
    const PushBound& i = world.bodies.push_bound[point.body_i];
    if constexpr (K == PointKind::element_wall) return {i.acceleration, i.inverse_mass};
    const PushBound& j = world.bodies.push_bound[point.body_j];
    return {i.acceleration + j.acceleration, i.inverse_mass + j.inverse_mass};
}

/// Law of a point, with its share where it has one.
template <PointKind K, class Features>
inline Law<double> law_for(const Features& has, const World& world, PointIndex k) {
    const Law<double> law(world.settings.laws[world.points.state[k].law]);
    [[maybe_unused]] const auto share = [&]() -> double {
        if constexpr (K == PointKind::face_face) return share_of_stiffness(world, k);
        return world.points.stiffness_share[k];
    };
    const auto own = [&] {
        if (has.own_shear)
            return law.with_shares(share(), world.points.shear_root[k]);
        else if (has.own_shares)
            return law.with_share(share());
        else
            return law;
    };
    Law<double> found = own();
    if constexpr (K == PointKind::face_face)  // none where they lap no more
        found.has_shear_spring = found.shear_stiffness > 0.0;
    return found;
}

template <PointKind K>
inline double root_mass_for(const World& world, PointIndex k) {
    if constexpr (K == PointKind::face_face) return root_mass_of(world, k);
    return world.points.root_mass[k];
}

/// A coulomb bond breaks: what is left of its forces acts. record_breaks() writes that into the point.
template <PointKind K, class Features>
inline PointForce break_point(const Features& has, World& world, PointIndex k, PointIndex place, const Law<double>& law,
                              const ContactGeometry& g, const PointMotion& motion, BlockLosses& loss) {
    const double dt = world.stepping.drift;
    const BrokenBond broken = broken_bond(world, k, law, motion);
    PointState& state = world.points.state[k];
    state.flags = static_cast<std::uint16_t>((state.flags & ~point_bonded) | point_just_broken);
    ++loss.broken;
    double normal = broken.normal;
    if (has.damping) {
        const bool touches = normal > 0.0;
        const double damper = touches ? normal_damping(law, root_mass_for<K>(world, k)) * motion.closing : 0.0;
        loss.dashpot[place % BlockLosses::places] +=
            dashpot_loss<double>(dt, world.points.normal_dashpot[k] + damper, motion.closing,
                                 world.points.shear_dashpot[k], motion.slipping);
        world.points.normal_dashpot[k] = static_cast<float>(damper);
        world.points.shear_dashpot[k] = 0.0F;
        normal += damper;
    }
    const ForceOnBodies<double> force = force_on_bodies(g, normal, broken.shear);
    return {force.fx, force.fy, force.torque_i, force.torque_j};
}

/// Force of one point into `out`, with all that can happen to it; faces have been followed. @param place in its block
template <PointKind K, class Features>
[[gnu::noinline]] void force_point(const Features& has, World& world, PointIndex k, PointIndex place, PointForce& out,
                                   BlockLosses& loss) {
    const double dt = world.stepping.drift;
    [[maybe_unused]] const double kick = kick_before(world.stepping) + 0.5 * world.stepping.time_step;
    const ContactPoint point = point_of<K>(world, k);
    PointState& state = world.points.state[k];
    const auto g = geometry_of_point<K>(world, k);
    bool bonded = false;
    if (has.bonds) bonded = (state.flags & point_bonded) != 0;
    const Law<double> law = law_for<K>(has, world, k);
    double overlap = g.overlap;  // m, of a point without a bond beyond the one without force
    if (has.coulomb) overlap -= world.points.bond_overlap[k];
    if constexpr (K == PointKind::face_face)
        if (world.points.lap[k] == 0.0) overlap = std::min(overlap, 0.0);

    const bool held_before = bonded || (state.flags & point_touching) != 0;
    if (!held_before && overlap <= 0.0) {
        if (has.consistent) world.points.last_overlap[k].value = overlap;
        if constexpr (K == PointKind::face_face) part_faces(world, k, g.closed);
        out = {0.0, 0.0, 0.0, 0.0};
        return;
    }

    const auto [closing, slipping] = motion_of_point<K>(world, point, g);
    if (has.coulomb) {
        const PointMotion motion{overlap, closing, slipping};
        if (bonded && bond_fails(world, k, law, motion)) {
            out = break_point<K>(has, world, k, place, law, with_arms(g), motion, loss);
            return;
        }
    }
    const bool holds = bonded ? has.coulomb || bond_holds(law, g.overlap) : overlap > 0.0;

    [[maybe_unused]] ClosingPoint coming{};
    [[maybe_unused]] double before = 0.0;
    // A point that overlaps before anything has moved has not been seen to close.
    [[maybe_unused]] const bool touched = (state.flags & point_touching) != 0 || dt == 0.0;
    if (has.consistent) {
        coming = {overlap, closing, 0.0, 0.0, law.normal_stiffness, 0.0, dt, kick, world.stepping.time_step};
        if (!bonded) {
            before = settle_opening(world.points.opening[k], world.points.last_overlap[k].value, touched, coming);
            world.points.last_overlap[k].value = overlap;
            state.flags = static_cast<std::uint16_t>(state.flags & ~point_unsettled);
        }
    }

    if (!holds) {
        if (has.consistent) world.points.last_normal[k] = 0.0;
        if (has.damping) {
            loss.dashpot[place % BlockLosses::places] += dashpot_loss<double>(
                dt, world.points.normal_dashpot[k], closing, world.points.shear_dashpot[k], slipping);
            world.points.normal_dashpot[k] = world.points.shear_dashpot[k] = 0.0F;
        }
        if constexpr (by_guide(K)) {
            SpringWork& work = world.points.spring_work[k];
            store_work(work, world, point, 0.0, closing);
            work.last = {0.0, 0.0, 0.0, 0.0};
            if (!bonded) {
                loss.law += work.stored;
                work.stored = 0.0;
            }
        }
        if (bonded) {
            state.flags = static_cast<std::uint16_t>((state.flags & ~point_bonded) | point_just_broken);
            ++loss.broken;
            // The event needs the springs as they were; record_breaks() releases the point.
        } else {
            release(has, world, k, law, loss, slipping * dt);
            if constexpr (K == PointKind::face_face) part_faces(world, k, g.closed);
        }
        out = {0.0, 0.0, 0.0, 0.0};
        return;
    }

    double normal = spring_force(law, overlap);
    double compression = overlap;  // m, what Coulomb's limit goes by
    if (has.consistent) {
        if (!bonded) {
            if (has.damping) coming.dashpot = normal_damping(law, root_mass_for<K>(world, k)) * closing;
            double& last = world.points.last_normal[k];
            if (!touched || !stays_closed(law.normal_stiffness, overlap, closing, last, coming.dashpot,
                                          push_bounds<K>(world, point), kick, world.stepping.time_step)) {
                feel_bodies<K>(world, point, with_arms(g), coming);
                OpeningMemory& memory = world.points.opening[k];
                normal = opening_force(memory, last, touched, before, coming);
                compression = normal / law.normal_stiffness;
                if (memory.extra_force != 0.0) state.flags |= point_unsettled;
            }
            last = normal + coming.dashpot;
        }
    }
    if (has.bonds && !has.coulomb) normal -= spring_force(law, world.points.bond_overlap[k]);
    if constexpr (by_guide(K)) {
        SpringWork& work = world.points.spring_work[k];
        if (world.account.begun) {
            store_work(work, world, point, normal, closing);
        } else {
            work.stored = 0.5 * normal * normal / law.normal_stiffness;  // the account begins
        }
        const double fx = -normal * g.nx, fy = -normal * g.ny;
        work.last = {fx, fy, g.aix * fy - g.aiy * fx, g.ajy * fx - g.ajx * fy};
    }
    double shear = 0.0;
    std::uint16_t flags = static_cast<std::uint16_t>((state.flags | point_touching) & ~point_sliding);
    bool sliding = !has.friction;
    if (has.friction) {
        const double limit =
            has.coulomb ? (bonded ? infinite_limit : law.friction * normal) : coulomb_limit(law, compression);
        const ShearTrial<double> trial = try_shear_within(law, world.points.shear_force[k], slipping * dt, limit);
        shear = shear_force(trial);
        sliding = trial.slides;
        if (sliding) {
            flags |= point_sliding | point_slid;
            loss.friction += slider_loss(law, trial, shear);
        }
        world.points.shear_force[k] = shear;
    }
    state.flags = flags;
    if (has.bonds) loss.gained += (flags & point_counted) == 0 ? 1u : 0u;
    if (has.bonds && !has.coulomb) {
        if (bonded && carries_half_strength(law, normal, shear, world.points.bond_overlap[k])) {
            world.points.strong_normal[k] = static_cast<float>(normal);
            world.points.strong_shear[k] = static_cast<float>(shear);
        }
    }
    if (has.damping) {
        const double normal_damper = normal_damping(law, root_mass_for<K>(world, k)) * closing;
        const double shear_damper = shear_dashpot(law, root_mass_for<K>(world, k), slipping, compression, sliding);
        loss.dashpot[place % BlockLosses::places] +=
            dashpot_loss(dt, world.points.normal_dashpot[k] + normal_damper, closing,
                         world.points.shear_dashpot[k] + shear_damper, slipping);
        world.points.normal_dashpot[k] = static_cast<float>(normal_damper);
        world.points.shear_dashpot[k] = static_cast<float>(shear_damper);
        normal += normal_damper;
        shear -= shear_damper;
    }
    const ForceOnBodies<double> force = force_on_bodies(g, normal, shear);
    out = {force.fx, force.fy, force.torque_i, force.torque_j};
}

/// Whether kernels look at several points of a kind at once.
template <PointKind K>
inline constexpr bool in_batches =
    K == PointKind::circle_circle || K == PointKind::element_outline || K == PointKind::face_face;

/// Points of a block from k on, one after the other.
template <PointKind K, class Features>
inline void force_points(const Features& has, World& world, const PointBlock& block, PointIndex k, BlockLosses& loss) {
    for (; k < block.end; ++k) {
        const PointIndex place = k - block.begin;
        if constexpr (K == PointKind::face_face) follow_faces(world, k, loss);
        force_point<K>(has, world, k, place, block.forces[place], loss);
    }
}

/// Points of a block in batches, as far as these fill their lanes. @return the first point behind them
template <PointKind K, class Features>
CRACKLE_INLINE PointIndex force_batches(const Features& has, World& world, const PointBlock& block, BlockLosses& loss) {
    // Geometry first: its roots and divisions then overlap those of the next batches.
    constexpr PointIndex ahead = 64 / lane_count;
    BatchOf<K> geometry[ahead];
    BatchLaw law(world, world.points.state[block.begin].law);
    const PointIndex fours_end = K == PointKind::element_outline ? std::min(block.end, world.points.fours_end) : 0;
    [[maybe_unused]] const bool in_memory = world.points.size() > points_in_cache;
    PointIndex k = block.begin;
    while (k + lane_count <= block.end && !world.workers.one_by_one) {
        const bool fours = k + lane_count <= fours_end;
        const PointIndex batches = std::min<PointIndex>(ahead, ((fours ? fours_end : block.end) - k) / lane_count);
        if constexpr (K == PointKind::circle_circle)
            if (in_memory) prefetch_circles(world, k, batches * lane_count);
        if (fours)
            geometry_batches<K, true>(world, k, batches, geometry);
        else
            geometry_batches<K, false>(world, k, batches, geometry);
        for (PointIndex b = 0; b < batches; ++b, k += lane_count) {
            const PointIndex place = k - block.begin;
            PointForce* const out = block.forces + place;
            const BatchOf<K>& g = geometry[b];
            if constexpr (K == PointKind::face_face) follow_batch(has, world, k, g, law, loss);
            const BatchState batch = look_at_batch(has, world, k, g, law);
            switch (batch.what) {
                case BatchCase::all_hold:
                    force_lanes<true>(has, world, k, place, g, law_of_batch(has, world, k, g, law), batch, out, loss);
                    break;
                case BatchCase::some_hold:
                    force_lanes<false>(has, world, k, place, g, law_of_batch(has, world, k, g, law), batch, out, loss);
                    if constexpr (K == PointKind::face_face) part_batch(world, k, g, batch);
                    break;
                case BatchCase::none_holds:
                    if (has.consistent) remember_overlaps(world, k, batch);
                    if constexpr (K == PointKind::face_face) part_batch(world, k, g, batch);
                    store_quads(out, Lanes{}, Lanes{}, Lanes{}, Lanes{});
                    break;
                case BatchCase::one_by_one:
                    for (PointIndex l = 0; l < lane_count; ++l)
                        force_point<K>(has, world, k + l, place + l, out[l], loss);
                    break;
            }
        }
    }
    return k;
}

/// What a kind can have: the guide's segments know of no others.
constexpr ContactFeatures features_for(PointKind kind, ContactFeatures f) {
    if (by_guide(kind)) f.consistent = f.own_shares = f.coulomb = f.own_shear = false;
    // Only outlines and flat faces have joints: others' shares of shear stiffness are 1.
    if (kind != PointKind::element_outline && kind != PointKind::face_face) f.own_shear = false;
    // Joints are of coulomb bonds; before there are any, nothing of a bond is found.
    if (kind == PointKind::face_face) return {true, f.damping, true, false, true, true, f.own_shear};
    return f;
}

/// Features of a kind that are known as the kernel runs.
template <PointKind K>
struct FeaturesOf : ContactFeatures {
    explicit FeaturesOf(const ContactFeatures& features) : ContactFeatures(features_for(K, features)) {}
};

/// Sets of features that have kernels of their own: those of the shipped cases and decks, and the smallest. Any other
/// set is asked for its features as the kernel runs, once a batch. What either costs: `crackle-bench features`.
constexpr std::array compiled_sets{
    ContactFeatures{},
    ContactFeatures{.friction = true},
    ContactFeatures{.friction = true, .damping = true},
    ContactFeatures{.friction = true, .damping = true, .bonds = true},
    ContactFeatures{.friction = true, .damping = true, .bonds = true, .own_shares = true, .coulomb = true},
    ContactFeatures{
        .friction = true, .damping = true, .bonds = true, .own_shares = true, .coulomb = true, .own_shear = true},
};

template <PointKind K, class Features>
void force_block(World& world, const ContactFeatures& features, const PointBlock& block) {
    const Features has(features);
    BlockLosses loss;
    PointIndex k = block.begin;
    if constexpr (in_batches<K>) k = force_batches<K>(has, world, block, loss);
    force_points<K>(has, world, block, k, loss);
    world.account.blocks[block.number] = loss.total();
}

/// The kernel of a compiled set from number N on, else the one of any set.
template <PointKind K, std::size_t N = 0>
ForceKernel kernel_of(const ContactFeatures& features) {
    if constexpr (N == compiled_sets.size()) {
        return &force_block<K, FeaturesOf<K>>;
    } else {
        if (features == compiled_sets[N]) return &force_block<K, CompiledFeatures<features_for(K, compiled_sets[N])>>;
        return kernel_of<K, N + 1>(features);
    }
}

/// Geometry alone, for profiles.
template <PointKind K>
void geometry_block(World& world, const PointBlock& block) {
    PointIndex k = block.begin;
    if constexpr (in_batches<K>) {
        for (; k + lane_count <= block.end; k += lane_count) {
            BatchOf<K> g[1];
            geometry_batches<K, false>(world, k, 1, g);
            asm volatile("" : : "m"(g));
        }
    }
    for (; k < block.end; ++k) {
        const auto g = geometry_of_point<K>(world, k);
        asm volatile("" : : "m"(g));
    }
}

constexpr std::array<GeometryKernel, point_kinds> geometry_kernels{
    &geometry_block<PointKind::circle_circle>,   &geometry_block<PointKind::element_element>,
    &geometry_block<PointKind::element_outline>, &geometry_block<PointKind::face_face>,
    &geometry_block<PointKind::disc_segment>,    &geometry_block<PointKind::segment_segment>,
    &geometry_block<PointKind::element_wall>,
};

}  // namespace

template <>
ForceKernel force_kernel_of<InstructionSet::CRACKLE_SET>(const ContactFeatures& features, std::size_t kind) {
    switch (static_cast<PointKind>(kind)) {
        case PointKind::circle_circle:
            return kernel_of<PointKind::circle_circle>(features);
        case PointKind::element_element:
            return kernel_of<PointKind::element_element>(features);
        case PointKind::element_outline:
            return kernel_of<PointKind::element_outline>(features);
        case PointKind::face_face:
            return kernel_of<PointKind::face_face>(features);
        case PointKind::disc_segment:
            return kernel_of<PointKind::disc_segment>(features);
        case PointKind::segment_segment:
            return kernel_of<PointKind::segment_segment>(features);
        case PointKind::element_wall:
            return kernel_of<PointKind::element_wall>(features);
    }
    return nullptr;
}

template <>
GeometryKernel geometry_kernel_of<InstructionSet::CRACKLE_SET>(std::size_t kind) {
    return geometry_kernels[kind];
}

}  // namespace crackle
