// SPDX-License-Identifier: GPL-3.0-or-later
// The contact kernels. Each is a loop over a block of points, compiled for one kind of point and one set of features,
// and selected once per force pass. This file is compiled once for each instruction set.

#include "solver/contact/kernels.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "solver/contact/batch.hpp"
#include "solver/contact/flat_face_motion.hpp"
#include "solver/contact/force.hpp"
#include "solver/contact/opening_points.hpp"
#include "solver/contact/point_law.hpp"
#include "solver/contact/point_motion.hpp"
#include "solver/laws/bond_laws.hpp"
#include "solver/laws/dashpot.hpp"
#include "solver/laws/friction.hpp"

namespace crackle {
namespace {

/// Ends the contact at a point: its force becomes 0, and the energy left in the shear spring is counted as friction
/// loss.
template <PointKind K, class Features>
inline void leave_contact(const Features& has, const PassView& view, PointIndex k, PointIndex place,
                          const Law<double>& law, const RelativeMotion<double>& motion, BlockLosses& loss) {
    const double dt = view.drift;
    if (has.consistent) view.last_normal[k] = 0.0;
    if (has.damping) {
        loss.add_dashpots(place, dashpot_loss<double>(dt, view.normal_dashpot[k], motion.closing, view.shear_dashpot[k],
                                                      motion.slipping));
        view.normal_dashpot[k] = view.shear_dashpot[k] = 0.0F;
    }
    if constexpr (by_guide(K)) {
        SpringWork& work = view.spring_work[k];
        store_work(work, view, point_of<K>(view, k), 0.0, motion.closing);
        loss.law += work.stored;
        work = {};
    }
    if (has.friction) {
        const ShearTrial<double> trial = try_shear(law, view.shear_force[k], motion.slipping * dt, 0.0);
        if (trial.slides) loss.friction += slider_loss(law, trial, shear_force(trial));
    }
    view.shear_force[k] = 0.0;
    std::uint16_t& flags = view.state[k].flags;
    flags = static_cast<std::uint16_t>(flags & ~(point_touching | point_sliding | point_slid));
}

/// Breaks a bond. The forces that remain after the break act in this step; record_breaks() later stores the new state
/// in the point, and needs the spring forces from before the break.
template <PointKind K, class Features>
inline PointForce break_point(const Features& has, const PassView& view, PointIndex k, PointIndex place,
                              const Law<double>& law, const ContactGeometry& g, const BondedPoint<double>& point,
                              BlockLosses& loss) {
    using Bond = typename Features::Bond;
    const BrokenBond broken = Bond::break_bond(law, point);
    std::uint16_t& flags = view.state[k].flags;
    flags = static_cast<std::uint16_t>((flags & ~point_bonded) | point_just_broken);
    ++loss.broken;
    double normal = broken.normal;
    if (has.damping) {
        const bool touches = normal > 0.0;
        const double damper = touches ? normal_damping(law, root_masses<K, double>(view, k)) * point.closing : 0.0;
        loss.add_dashpots(place, dashpot_loss<double>(view.drift, view.normal_dashpot[k] + damper, point.closing,
                                                      view.shear_dashpot[k], point.slipping));
        view.normal_dashpot[k] = static_cast<float>(damper);
        view.shear_dashpot[k] = 0.0F;
        normal += damper;
    }
    if constexpr (by_guide(K)) {
        SpringWork& work = view.spring_work[k];
        store_work(work, view, point_of<K>(view, k), 0.0, point.closing);
        work.last = {0.0, 0.0, 0.0, 0.0};
    }
    const ForceOnBodies<double> force = force_on_bodies(g, normal, broken.shear);
    return {force.fx, force.fy, force.torque_i, force.torque_j};
}

/// Computes the force of one point, including bonding, breaking and friction, and writes it to `out`. Flat faces must
/// already have been updated by follow_faces() or follow_batch().
/// @param place the point's position in its block
template <PointKind K, class Features>
[[gnu::noinline]] void force_point(const Features& has, const PassView& view, PointIndex k, PointIndex place,
                                   PointForce& out, BlockLosses& loss) {
    using Bond = typename Features::Bond;
    const ContactPoint point = point_of<K>(view, k);
    PointState& state = view.state[k];
    const auto g = geometry_of_point<K>(view, k);
    bool bonded = false;
    if (has.bonds) bonded = (state.flags & point_bonded) != 0;
    Law<double> room, law(view.laws[state.law]);
    law = own_law<K>(has, view, k, law, room);
    if constexpr (K == PointKind::face_face)  // there is no shear spring if the faces no longer lie opposite each other
        law.has_shear_spring = law.shear_stiffness > 0.0;
    const double overlap = beyond_rest<K>(has, view, k, g.overlap);
    const auto rest = [&] {
        if constexpr (K == PointKind::face_face) part_faces(view, k, g.closed);
        out = {0.0, 0.0, 0.0, 0.0};
    };
    if (!bonded && (state.flags & point_touching) == 0 && overlap <= 0.0) {
        if (has.consistent) view.last_overlap[k].value = overlap;
        return rest();
    }
    const RelativeMotion<double> motion = motion_of_point<K>(view, point, g);
    if (bonded) {
        const BondedPoint<double> bond = bonded_point<Bond>(view, k, overlap, motion);
        if (Bond::fails(law, bond)) {
            out = break_point<K>(has, view, k, place, law, with_arms(g), bond, loss);
            return;
        }
    }
    [[maybe_unused]] OpeningPoint opening{};
    if (has.consistent && !bonded) opening = settle_point(view, k, law.normal_stiffness, overlap, motion.closing);
    if (!bonded && !(overlap > 0.0)) {
        leave_contact<K>(has, view, k, place, law, motion, loss);
        return rest();
    }
    ContactSpring<double> spring = contact_spring(law, overlap);
    if (has.consistent && !bonded) spring = opening_spring<K>(has, view, k, point, g, law, opening);
    const HeldPoints<double> held{&state, state_bits<double>(&state), bonded, true, overlap};
    force_of_held<false, K, Features, double>(has, view, k, place, g, motion, law, held, spring, &out, loss);
}

/// Whether the kernels of a kind process several points at once.
template <PointKind K>
inline constexpr bool in_batches =
    K == PointKind::circle_circle || K == PointKind::element_outline || K == PointKind::face_face;

/// Features as compile-time constants of a kernel.
template <ContactFeatures F>
struct CompiledFeatures {
    /// The argument is ignored, since the constants already equal the scene's features.
    explicit CompiledFeatures(const ContactFeatures&) {}
    using Bond = BondLawType<F.bond_law>;
    static constexpr bool friction = F.friction, damping = F.damping, bonds = F.bonds, consistent = F.consistent,
                          own_shares = F.own_shares, own_shear = F.own_shear;
};

/// Bond law for which the kernels of a kind are compiled, given the scene's bond law. Call it only in constant
/// expressions, so that kernels do not contain the table of bond-law facts.
constexpr BondLaw law_for(PointKind kind, BondLaw law) {
    if (by_guide(kind))
        return known_facts(law).with_guide_segments ? law : first_law_with(&BondLawFacts::with_guide_segments);
    // Flat faces occur only in joints.
    const bool other = kind == PointKind::face_face && !known_facts(law).across_joints;
    return other ? first_law_with(&BondLawFacts::across_joints) : law;
}

/// Restricts features to those that a kind supports.
constexpr ContactFeatures features_for(PointKind kind, ContactFeatures f) {
    if (by_guide(kind)) f.consistent = f.own_shares = false;
    // Only outlines and flat faces occur at joints; for all other kinds the shear stiffness factor is 1.
    if (kind != PointKind::element_outline && kind != PointKind::face_face) f.own_shear = false;
    // Flat faces are always compiled with bonds; before bonding, their kernel finds no bonded points.
    if (kind == PointKind::face_face) {
        f.friction = f.bonds = f.own_shares = true;
        f.consistent = false;
    }
    return f;
}

/// Features of a kind of point; all except the bond law are tested at run time.
template <PointKind K, BondLaw L>
struct FeaturesOf : ContactFeatures {
    explicit FeaturesOf(const ContactFeatures& features) : ContactFeatures(features_for(K, features)) {}
    using Bond = BondLawType<L>;
};

/// The set of features for which a kernel of this kind is compiled.
template <PointKind K>
constexpr ContactFeatures compiled_for(ContactFeatures f) {
    f = features_for(K, f);
    f.bond_law = law_for(K, f.bond_law);
    return f;
}

/// Computes the points of a block in batches that fill all lanes, and the remaining points one by one. __restrict: the
/// arrays that are written do not contain the view itself, so its pointers need not be read again after each store.
template <PointKind K, class Features>
void force_block(const PassView& __restrict view, const PointBlock& block) {
    const Features has(view.features);
    BlockLosses loss;
    PointIndex k = block.begin;
    if constexpr (in_batches<K>) {
        BatchOf<K> geometry[batches_ahead];
        BatchLaw batch_law(view, view.state[k].law);
        const PointIndex end = view.one_by_one ? k : block.end;
        const PointIndex fours_end = K == PointKind::element_outline ? std::min(end, view.fours_end) : 0;
        while (k + lane_count <= end) {
            const PointIndex batches = geometry_ahead<K>(view, k, fours_end, end, geometry);
            for (PointIndex b = 0; b < batches; ++b, k += lane_count) {
                const PointIndex place = k - block.begin;
                PointForce* const out = block.forces + place;
                const BatchOf<K>& g = geometry[b];
                if constexpr (K == PointKind::face_face) follow_batch(has, view, k, g, batch_law, loss);
                const BatchState batch = look_at_batch<K>(has, view, k, g, batch_law);
                Law<Lanes> room;
                const Law<Lanes>& law = own_law<K>(has, view, k, batch_law.law, room);
                switch (batch.what) {
                    case BatchCase::all_hold:
                        force_of_held<true, K>(has, view, k, place, g.contact, g.motion, law, batch,
                                               contact_spring(law, batch.overlap), out, loss);
                        break;
                    case BatchCase::some_hold:
                        force_of_held<false, K>(has, view, k, place, g.contact, g.motion, law, batch,
                                                contact_spring(law, batch.overlap), out, loss);
                        if constexpr (K == PointKind::face_face) part_batch(view, k, g, batch);
                        break;
                    case BatchCase::none_holds:
                        if (has.consistent) remember_overlaps<Lanes>(view, k, batch.bonded, batch.overlap);
                        if constexpr (K == PointKind::face_face) part_batch(view, k, g, batch);
                        store_quads(out, Lanes{}, Lanes{}, Lanes{}, Lanes{});
                        break;
                    case BatchCase::one_by_one:
                        for (PointIndex l = 0; l < lane_count; ++l)
                            force_point<K>(has, view, k + l, place + l, out[l], loss);
                        break;
                }
            }
        }
    }
    for (; k < block.end; ++k) {
        const PointIndex place = k - block.begin;
        if constexpr (K == PointKind::face_face) follow_faces(view, k, loss);
        force_point<K>(has, view, k, place, block.forces[place], loss);
    }
    view.losses[block.number] = loss.total();
}

/// Kernel compiled for the member of `Sets` that equals `features`; null if no member does.
template <PointKind K, ContactFeatures... Sets>
ForceKernel compiled_kernel(const ContactFeatures& features) {
    ForceKernel kernel = nullptr;
    static_cast<void>(
        ((features == Sets && (kernel = &force_block<K, CompiledFeatures<compiled_for<K>(Sets)>>) != nullptr) || ...));
    return kernel;
}

/// Features of the shipped cases with bonds. @param own_shear whether joints have their own stiffnesses
template <class Bond>
constexpr ContactFeatures with_bonds(bool own_shear) {
    return {.friction = true,
            .damping = true,
            .bonds = true,
            .own_shares = Bond::facts.own_shares,
            .own_shear = own_shear,
            .bond_law = Bond::law};
}

/// Kernels are compiled for the feature sets of the shipped cases and decks, and for the empty set. With any other set,
/// the features are tested at run time, once per batch. `crackle-bench features` measures the cost of both.
template <PointKind K>
ForceKernel kernel_of(const ContactFeatures& features) {
    return with_law(features.bond_law, [&]<class Bond>() -> ForceKernel {
        constexpr ContactFeatures loose{.bond_law = Bond::law};
        if constexpr (loose == ContactFeatures{}) {
            constexpr ContactFeatures rough{.friction = true}, damped{.friction = true, .damping = true};
            if (const ForceKernel kernel = compiled_kernel<K, loose, rough, damped>(features)) return kernel;
        }
        constexpr ContactFeatures bonded = with_bonds<Bond>(false),
                                  jointed = with_bonds<Bond>(Bond::facts.across_joints);
        if (const ForceKernel kernel = compiled_kernel<K, bonded, jointed>(features)) return kernel;
        return &force_block<K, FeaturesOf<K, law_for(K, Bond::law)>>;
    });
}

/// Computes only the geometry of a block, for profiling.
template <PointKind K>
void geometry_block(const PassView& view, const PointBlock& block) {
    PointIndex k = block.begin;
    if constexpr (in_batches<K>) {
        for (; k + lane_count <= block.end; k += lane_count) {
            BatchOf<K> g[1];
            geometry_batches<K, false>(view, k, 1, g);
            asm volatile("" : : "m"(g));
        }
    }
    for (; k < block.end; ++k) {
        const auto g = geometry_of_point<K>(view, k);
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
        case PointKind::bonded_face:
            break;  // bonded faces are not contact points, so they have no kernel
    }
    return nullptr;
}

template <>
GeometryKernel geometry_kernel_of<InstructionSet::CRACKLE_SET>(std::size_t kind) {
    return geometry_kernels[kind];
}

}  // namespace crackle
