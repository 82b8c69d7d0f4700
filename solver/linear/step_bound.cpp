// SPDX-License-Identifier: GPL-3.0-or-later
// Guaranteed bound on the stable step, from one 3 by 3 matrix (block) per body.
//
// Leapfrog with the lagged dashpot is stable while 4M - 2Δt·C - Δt²·K is positive definite. Every point contributes
// ½k(a_i - a_j)² to the energy, where a is the displacement of each body's material at the point. For any α > 0, (a_i -
// a_j)² <= (1 + α)a_i² + (1 + 1/α)a_j² (<= a_i² if body j is held), so block-diagonal matrices K_b and C_b bound K and
// C. For K, α = w_j/w_i is the ratio of two weights; for C it is the square root of this ratio, since dashpots scale
// with the root of stiffness. The weights start from the bodies' own scaled stiffnesses. A light sliver is then hardly
// affected by its heavy neighbours, and equal bodies share a point equally. A few rounds that raise the weights of the
// limiting bodies bring the bound closer to the exact step. With κ and γ the largest eigenvalues of M^-½ K_b M^-½ and
// M^-½ C_b M^-½, body b is stable below (sqrt(γ² + 4κ) - γ)/κ; the bound is the smallest of these values. For one
// spring and dashpot at a wall it equals the DEMseg guide's 2 sqrt(m/k)(sqrt(h²+1) - h).
//
// Under the DEMseg guide's segment law a contact point pushes along b (the direction of the resultant at its position),
// but its overlap changes with g = ∇δ. Its stiffness k b gᵀ is therefore unsymmetric and up to four times k. Every
// eigenvalue λ of the sum of such terms satisfies |λ| <= max |u*Ku|. This is at most the largest eigenvalue of Σ ½k(s
// bbᵀ + ggᵀ/s) for any s > 0; s = |g|/|b| in the mass-scaled norm is used. In this sum every listed disc that is not
// yet in contact counts as a spring of its own. The bound therefore holds for all real eigenvalues. A complex pair
// means flutter, for which the law itself creates energy; no step is short enough for that. In the DEMseg guide's
// example rock such pairs grow at a rate of at most 40/s, whereas dashpots with a damping ratio of 0.2 damp at 9000/s.
// Slopes are taken at the current positions. Deep in case (iii), |α| < t/4, the slope of a disc may grow to 1.5 times
// that of a disc not yet in contact. The safety factor of an automatic time step covers this growth.
//
// In a bonded world the bound counts the points that carry load. When the contact pass finds that further points begin
// to carry load, only the blocks of their two bodies are updated. In a world without bonds all points within the common
// skin count, and under the DEMseg guide's segment law all listed points. A body without points is treated as if it had
// one at a wall. The geometry is that of the last evaluation, at or after the last build of the neighbour list; since
// then no surface has moved by more than its half skin.

#include "solver/linear/step_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/contact/point_motion.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/laws/dashpot.hpp"
#include "solver/linear/springs.hpp"
#include "solver/linear/symmetric_block.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

struct BodyBlocks {
    SymmetricBlock stiffness, damping;
};

/// Block that bounds the contribution of all faces of the world to any body. It is diagonal, and its diagonal elements
/// are the upper bounds on the eigenvalues of the faces' matrices.
BodyBlocks block_of_faces(const World& world) {
    const auto diagonal = [](double value) { return SymmetricBlock{value, value, value}; };
    return {diagonal(world.faces.stiffness_bound), diagonal(world.faces.damping_bound)};
}

/// Square roots of a body's inverse masses and inverse moment of inertia.
struct Roots {
    double x, y, r;
};

Roots roots_of(const BodyInertia& inertia) {
    return {std::sqrt(inertia.inverse_mass_x), std::sqrt(inertia.inverse_mass_y), std::sqrt(inertia.inverse_moment)};
}

/// Normal of a contact point, and its arms on the two bodies.
struct PointArms {
    Vec2 normal, arm_i, arm_j;
};

/// One body's side of a contact point, scaled by Roots: rows for the normal n and for the tangent t.
struct Side {
    double nx, ny, nr, tx, ty, tr;
};

Side side_of(const Roots& roots, Vec2 n, Vec2 arm) {
    const Vec2 t = perpendicular(n);
    return {roots.x * n.x, roots.y * n.y, roots.r * cross(arm, n),
            roots.x * t.x, roots.y * t.y, roots.r * cross(arm, t)};
}

/// Adds one side of a contact point to a body's stiffness. @param normal false if the normal stiffness is added
/// separately (guide_rows())
void add_stiffness(SymmetricBlock& block, const Side& side, const ContactLaw& law, double share, bool normal) {
    if (normal) block.add(share * law.normal_stiffness, side.nx, side.ny, side.nr);
    if (law.friction > 0.0) block.add(share * law.shear_stiffness, side.tx, side.ty, side.tr);
}

void add_damping(SymmetricBlock& block, const Side& side, const ContactLaw& law, double root_mass, double share) {
    block.add(share * normal_damping(law, root_mass), side.nx, side.ny, side.nr);
    if (law.friction > 0.0) block.add(share * shear_damping(law, root_mass), side.tx, side.ty, side.tr);
}

void add_side(BodyBlocks& blocks, const Side& side, const ContactLaw& law, double root_mass, double share,
              bool normal = true) {
    add_stiffness(blocks.stiffness, side, law, share, normal);
    add_damping(blocks.damping, side, law, root_mass, 1.0 + std::sqrt(share - 1.0));
}

/// Stable step (sqrt(c² + 4k) - c)/k, written without cancellation; infinite without stiffness.
double stable_step_of(double k, double c) {
    return k > 0.0 ? 4.0 / (std::sqrt(c * c + 4.0 * k) + c) : std::numeric_limits<double>::infinity();
}

/// The smallest stable step so far, and the body that determines it.
struct Least {
    double bound = std::numeric_limits<double>::infinity();
    BodyIndex body = 0;

    /// Lowers the bound if body b requires it. In most cases a simple estimate shows that it does not.
    void lower_to(const BodyBlocks& blocks, BodyIndex b) {
        if (stable_step_of(eigenvalue_at_most(blocks.stiffness), eigenvalue_at_most(blocks.damping)) >= bound) return;
        const double exact = stable_step_of(largest_eigenvalue(blocks.stiffness), largest_eigenvalue(blocks.damping));
        if (exact < bound) *this = {exact, b};
    }
};

/// 1 + α for a body of weight `own`, where `partner` is the weight of the other body (0 if held). The result is 1 for a
/// body of weight 0.
double share_of(double own, double partner) { return own > 0.0 ? 1.0 + partner / own : 1.0; }

bool with_wall(const World& world, PointIndex k) {
    return k >= world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
}

PointArms arms_of(const ContactGeometry& g) { return {{g.nx, g.ny}, {g.aix, g.aiy}, {g.ajx, g.ajy}}; }

bool has_rows(const World& world, PointIndex k) {
    return k >= world.points.kind_begin[static_cast<std::size_t>(PointKind::disc_segment)] && !with_wall(world, k);
}

/// Springs that represent the normal stiffness of points under the DEMseg guide's segment law.
std::vector<Spring> guide_rows(const World& world) {
    std::vector<Spring> touching;
    std::vector<Spring> rows;
    const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    for (PointIndex k = world.points.kind_begin[static_cast<std::size_t>(PointKind::disc_segment)]; k < walls; ++k) {
        const PointView v = view_point(world, k);
        if (v.touching) {
            touching.push_back({v.body_i, v.body_j, k, false, v.normal_stiffness, 0.0,
                                closing_gradient(v.normal, v.arm_i, v.arm_j), v.overlap_gradient});
        }
        for (const OverlapGradient& row : idle_discs(world, v.kind, world.points.contact[k]))
            rows.push_back({v.body_i, v.body_j, k, false, v.normal_stiffness, 0.0, row, row});
    }
    for (const Spring& row : symmetric_majorant(world, touching)) rows.push_back(row);
    return rows;
}

void add_row(SymmetricBlock& block, const Roots& roots, const Spring& row, bool second, double share) {
    const std::size_t d = second ? 3 : 0;
    block.add(share * row.stiffness, roots.x * row.push[d], roots.y * row.push[d + 1], roots.r * row.push[d + 2]);
}

/// Law and root mass of a contact point at the largest stiffness that it can have before the list is rebuilt. Sliding
/// flat faces then have their largest lap (shared length), and points that replace a broken face have full stiffness.
struct StiffestPoint {
    ContactLaw law;
    double root_mass;  // sqrt(kg)
};

StiffestPoint stiffest(const World& world, PointIndex k) {
    constexpr auto kind = static_cast<std::size_t>(PointKind::face_face);
    if (const Array<float>& whole = world.faces.whole_share; !whole.empty() && whole[k] > 0.0F) {
        const double grown = static_cast<double>(whole[k]) / static_cast<double>(world.points.stiffness_share[k]);
        return {law_with(world, k, whole[k]), world.points.root_mass[k] * std::sqrt(grown)};
    }
    const bool faces = k >= world.points.kind_begin[kind] && k < world.points.kind_begin[kind + 1];
    if (!faces || (world.points.state[k].flags & point_bonded) != 0) return {law_of(world, k), root_mass_of(world, k)};
    const ContactPoint point = world.points.contact[k];
    const FlatFace &i = world.bodies.flat_faces[point.element_i], &j = world.bodies.flat_faces[point.feature_j];
    const double skin = world.list.half_skin_of(point.body_i) + world.list.half_skin_of(point.body_j);
    const double now = std::max(world.points.lap[k], flat_face_contact(BodyView(world), point).lap());
    const double lap = std::min({now + skin, i.to - i.from, j.to - j.from});
    return {law_with(world, k, world.points.stiffness_share[k] * lap), world.points.root_mass[k] * std::sqrt(lap)};
}

/// Adds a point's contribution to the block of body b, one of its two bodies.
void add_point(BodyBlocks& blocks, const World& world, const std::vector<double>& weights, PointIndex k, BodyIndex b,
               const Roots& roots, const PointArms& arms) {
    const BodyPair& point = world.points.contact.pairs[k];
    const bool first = b == point.body_i;
    const double partner = first && with_wall(world, k) ? 0.0 : weights[first ? point.body_j : point.body_i];
    const StiffestPoint most = stiffest(world, k);
    add_side(blocks, side_of(roots, arms.normal, first ? arms.arm_i : arms.arm_j), most.law, most.root_mass,
             share_of(weights[b], partner), !has_rows(world, k));
}

/// Lowers the bound so that a body without contact points is stable in its first contact. For a circle the contact is
/// central; for other bodies it may also be at the longest lever arm.
void lower_to_first_meeting(Least& least, const World& world, BodyIndex b) {
    const BodyInfo info = world.bodies.info(b);
    const Roots roots = roots_of(world.bodies.inertia[b]);
    ContactLaw law = world.settings.laws[law_with_wall(world, b)];
    const Vec2 along{info.reach, 0.0};
    double root_mass = std::sqrt(world.bodies.inertia[b].mass);
    if (world.settings.units == StiffnessUnits::area) {
        // Upper bound on the stiffness factor, from a face as long as the body is wide, at a distance equal to the
        // body's equivalent radius.
        const double area = world.bodies.inertia[b].mass / world.settings.materials[info.material].density;
        const double share = 2.0 * info.reach / std::sqrt(area / std::numbers::pi);
        law.normal_stiffness *= share;
        law.shear_stiffness *= share;
        root_mass *= std::sqrt(share);
    }
    BodyBlocks head_on;
    add_side(head_on, side_of(roots, {1.0, 0.0}, along), law, root_mass, 1.0);
    least.lower_to(head_on, b);
    if (info.single_circle) return;
    BodyBlocks corner;
    add_side(corner, side_of(roots, {0.0, 1.0}, along), law, root_mass, 1.0);
    least.lower_to(corner, b);
}

/// Data that stay the same in all rounds of raised().
struct Surroundings {
    std::vector<Spring> rows;
    std::vector<bool> met;  // for each body, whether it has a listed point
};

Surroundings surroundings_of(const World& world) {
    Surroundings all{guide_rows(world), std::vector<bool>(world.bodies.size())};
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        all.met[world.points.contact.pairs[k].body_i] = true;
        if (!with_wall(world, k)) all.met[world.points.contact.pairs[k].body_j] = true;
    }
    for (const BodyPair& face : world.faces.bodies) all.met[face.body_i] = all.met[face.body_j] = true;
    return all;
}

/// Blocks of all bodies, from the points for which `counts` returns true. The geometry is computed again in each round,
/// since storing it would take as much memory as the complete state of the points. @param counts function called with
/// each point and its overlap, m
template <class Counts>
std::vector<BodyBlocks> blocks_of(const World& world, const std::vector<double>& weights,
                                  const std::vector<Spring>& rows, Counts counts) {
    std::vector<BodyBlocks> blocks(world.bodies.size(), block_of_faces(world));
    const BodyView bodies(world);
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            const ContactPoint point = world.points.contact.at<K>(k);
            std::uint32_t feature = point.feature_j;
            const ContactGeometry g = contact_geometry<K>(bodies, point, feature);
            if (!counts(k, g.overlap)) continue;
            const auto add = [&](BodyIndex b) {
                if (world.bodies.inertia[b].held()) return;
                add_point(blocks[b], world, weights, k, b, roots_of(world.bodies.inertia[b]), arms_of(g));
            };
            add(point.body_i);
            if constexpr (K != PointKind::element_wall) add(point.body_j);
        }
    });
    for (const Spring& row : rows) {
        const auto add = [&](BodyIndex b, BodyIndex partner, bool second) {
            if (world.bodies.inertia[b].held()) return;
            add_row(blocks[b].stiffness, roots_of(world.bodies.inertia[b]), row, second,
                    share_of(weights[b], weights[partner]));
        };
        add(row.i, row.j, false);
        add(row.j, row.i, true);
    }
    return blocks;
}

constexpr auto every_point = [](PointIndex, double) { return true; };

/// Scaled stiffness of each body from all listed points; 0 for held bodies.
std::vector<double> first_weights(const World& world, const std::vector<Spring>& rows) {
    const std::vector<double> alone(world.bodies.size(), 0.0);  // with weights of 0, share_of() returns 1
    std::vector<double> weights;
    weights.reserve(alone.size());
    for (const BodyBlocks& block : blocks_of(world, alone, rows, every_point))
        weights.push_back(largest_eigenvalue(block.stiffness));
    return weights;
}

Least least_of(const World& world, const std::vector<BodyBlocks>& blocks, const std::vector<bool>& met) {
    Least least;
    for (BodyIndex b = 0; b < blocks.size(); ++b) {
        if (world.bodies.inertia[b].held()) continue;
        least.lower_to(blocks[b], b);
        if (!met[b]) lower_to_first_meeting(least, world, b);
    }
    return least;
}

// Largest number of rounds. For the three specimens of the DEMseg guide, more rounds raise the bound by less than 1 %.
constexpr int weight_rounds = 12;
// Rounds continue as long as the last three together raised the bound by at least this fraction.
constexpr double worth_three_rounds = 5e-4;
// A bound counts as unchanged if it differs from the bound of the last search by less than this fraction.
constexpr double unchanged = 2e-3;
// Lower limit of a weight, relative to its initial value. A point may later begin to carry load between a body with a
// low weight and one of normal weight. A very low weight would then reduce the bound for the second body too much.
constexpr double lowest_weight_share = 0.125;
// Weights are reused as long as the length of the neighbour list differs by at most this fraction from that of the list
// for which they were computed.
constexpr double like_list = 0.01;

/// Whether weights from an earlier search exist for all bodies that can move and have points; without a weight a body
/// would count as held.
bool weighed_before(const World& world, const std::vector<bool>& met) {
    if (world.stepping.step_weights.size() != met.size()) return false;
    for (std::size_t b = 0; b < met.size(); ++b)
        if (met[b] && !world.bodies.inertia[b].held() && !(world.stepping.step_weights[b] > 0.0)) return false;
    return true;
}

/// Bound on the time step that is sufficient for the automatic or given time step, s.
double enough_for(const World& world) {
    if (!world.stepping.automatic_step) return world.stepping.time_step;
    return world.bonds.made ? world.stepping.step_goal
                            : world.stepping.time_step * world.stepping.safety_factor / derived_step_share(world);
}

/// Whether the last search for weights, with a list of similar length, did not reach a sufficient bound. Another search
/// is then worthwhile only if the bound has changed.
bool search_was_useless(const World& world, double enough) {
    const auto listed = static_cast<double>(world.points.size()),
               then = static_cast<double>(world.stepping.weighed_points);
    return world.stepping.weighed_bound < enough && std::abs(listed - then) <= like_list * then;
}

/// Raises the weights of limiting bodies relative to the others until the bound is sufficient, and stores the weights
/// of the best round in StepControl::step_weights. The first round uses the weights of the last search, which are
/// usually sufficient.
template <class Counts>
Least raised(World& world, const Surroundings& all, Counts counts) {
    const double enough = enough_for(world);
    const bool warm = enough > 0.0 && weighed_before(world, all.met);
    const bool in_vain = warm && search_was_useless(world, enough);
    std::vector<double> first;
    if (!warm) first = first_weights(world, all.rows);
    std::vector<double> trial = warm ? world.stepping.step_weights : first;
    Least best;
    best.bound = 0.0;
    std::array<double, weight_rounds> reached{};
    for (int round = 0; round < weight_rounds; ++round) {
        const std::vector<BodyBlocks> blocks = blocks_of(world, trial, all.rows, counts);
        const Least least = least_of(world, blocks, all.met);
        if (least.bound > best.bound) {
            best = least;
            world.stepping.step_weights = trial;
        }
        const auto now = static_cast<std::size_t>(round);
        reached[now] = best.bound;
        if (best.bound >= enough) break;
        // Without bonds only a small fraction of the bound is used, so the initial weights are good enough.
        if (!world.bonds.made) {
            if (round > 0 || !warm) break;
            trial = first = first_weights(world, all.rows);
            continue;
        }
        if (in_vain && round == 0 && std::abs(best.bound - world.stepping.weighed_bound) <= unchanged * best.bound)
            return best;
        if (round >= 3 && best.bound < (1.0 + worth_three_rounds) * reached[now - 3]) break;
        if (first.empty()) first = first_weights(world, all.rows);
        for (std::size_t b = 0; b < trial.size(); ++b) {
            const double step =
                stable_step_of(eigenvalue_at_most(blocks[b].stiffness), eigenvalue_at_most(blocks[b].damping));
            trial[b] = std::max(trial[b] * least.bound / step, lowest_weight_share * first[b]);
        }
    }
    world.stepping.weighed_bound = best.bound;
    world.stepping.weighed_points = world.bonds.made ? world.points.size() : 0;
    return best;
}

}  // namespace

/// Counterpart of loose_step_share for the consistent integrator. With this value, the energy account of ten discs
/// between walls has a largest closing error of 1.9 %. Most of the error comes from the mean velocities that the
/// account uses in closed contacts, and is temporary. The integrator is stable up to the bound.
constexpr double consistent_step_share = 0.2;

double derived_step_share(const World& world) {
    const bool bonded = world.bonds.made && world.bonds.initial > 0;
    const double loose = world.settings.integrator == Integrator::consistent ? consistent_step_share : loose_step_share;
    return world.stepping.step_scale *
           (bonded ? world.stepping.safety_factor : std::min(world.stepping.safety_factor, loose));
}

double stable_step_bound(const World& world, BodyIndex* limiting) {
    const Surroundings all = surroundings_of(world);
    const std::vector<double> weights = first_weights(world, all.rows);
    const Least least = least_of(world, blocks_of(world, weights, all.rows, every_point), all.met);
    if (limiting != nullptr && std::isfinite(least.bound)) *limiting = least.body;
    return least.bound;
}

void find_step_bound(World& world) {
    // In a world without bonds, points are counted only within the common skin. The wider skin of a fast body is no
    // reason for a smaller time step.
    const bool by_guide = world.settings.segment_law != SegmentLaw::rounded;
    const double least_overlap = by_guide || (!world.bonds.made && world.list.widest_skin == 0.0)
                                     ? -std::numeric_limits<double>::infinity()
                                 : world.bonds.made ? 0.0
                                                    : -world.list.widest_skin;
    const auto counts = [&](PointIndex k, double overlap) {
        std::uint16_t& flags = world.points.state[k].flags;
        // Faces of open and of dilating joints can touch across gaps.
        const bool counted =
            (flags & point_bonded) != 0 || overlap > std::min(least_overlap, world.points.bond_overlap[k]);
        flags = static_cast<std::uint16_t>(counted ? flags | point_counted : flags & ~point_counted);
        return counted;
    };
    const Least least = raised(world, surroundings_of(world), counts);
    world.stepping.step_bound = least.bound;
    world.stepping.limiting_body = least.body;
}

bool lower_step_bound(World& world) {
    constexpr std::size_t most = 64;
    static_assert(most < std::numeric_limits<decltype(world.workers.marks)::value_type>::max());
    // Bodies that gained points. Workers::marks is k + 1 for the body at index k of this array.
    std::array<BodyIndex, most> gaining{};
    std::size_t count = 0, uncounted = 0;
    const auto gains = [&](BodyIndex b) {
        if (world.bodies.inertia[b].held() || world.workers.marks[b] != 0) return;
        if (count == most) {
            ++uncounted;
            return;
        }
        gaining[count++] = b;
        world.workers.marks[b] = static_cast<std::uint8_t>(count);
    };
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        std::uint16_t& flags = world.points.state[k].flags;
        if ((flags & (point_touching | point_counted)) != point_touching) continue;
        flags = static_cast<std::uint16_t>(flags | point_counted);
        gains(world.points.contact[k].body_i);
        if (!with_wall(world, k)) gains(world.points.contact[k].body_j);
    }

    // Blocks of the bodies that gained points, from all their counted points.
    std::array<BodyBlocks, most> blocks{};
    blocks.fill(block_of_faces(world));
    const auto add = [&](PointIndex k, BodyIndex b) {
        if (world.workers.marks[b] == 0) return;
        add_point(blocks[world.workers.marks[b] - std::size_t{1}], world, world.stepping.step_weights, k, b,
                  roots_of(world.bodies.inertia[b]), arms_of(geometry_at(world, k)));
    };
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points.state[k].flags & point_counted) == 0) continue;
        add(k, world.points.contact[k].body_i);
        if (!with_wall(world, k)) add(k, world.points.contact[k].body_j);
    }
    Least least{world.stepping.step_bound, world.stepping.limiting_body};
    for (std::size_t n = 0; n < count; ++n) {
        least.lower_to(blocks[n], gaining[n]);
        world.workers.marks[gaining[n]] = 0;
    }
    if (uncounted > 0) return false;
    if (least.bound >= world.stepping.step_bound) return true;
    if (world.stepping.step_scale * least.bound < world.stepping.time_step)
        return false;  // new weights suited to the new points may raise the bound
    world.stepping.step_bound = least.bound;
    world.stepping.limiting_body = least.body;
    return true;
}

}  // namespace crackle
