// SPDX-License-Identifier: GPL-3.0-or-later
// Guaranteed bound on the stable step, from per-body blocks.
//
// Leapfrog with the lagged dashpot is stable while 4M - 2Δt·C - Δt²·K is positive definite. Every point contributes
// ½k(a_i - a_j)² to the energy, a the displacement of each body's material at the point, and for any α > 0
// (a_i - a_j)² <= (1 + α)a_i² + (1 + 1/α)a_j² (<= a_i² where the partner is held), so K and C are bounded by
// block-diagonal matrices K_b and C_b. α = κ_j/κ_i, the ratio of the bodies' own scaled stiffnesses, charges a light
// sliver hardly anything for its heavy neighbours; equal bodies share by halves. With κ and γ the largest eigenvalues
// of M^-½ K_b M^-½ and M^-½ C_b M^-½, body b is stable below (sqrt(γ² + 4κ) - γ)/κ; the bound is the least of these.
// One spring and dashpot against a wall gives the guide's 2 sqrt(m/k)(sqrt(h²+1) - h) exactly. All listed points count
// as if they carried load, so it holds until the list is rebuilt; a body without points counts one against a wall.
//
// Under the guide's law a point pushes along b (its resultant at its place) while its overlap answers to g = ∇δ, so its
// stiffness is k b gᵀ: unsymmetric, and up to four times k. Every eigenvalue λ of such a sum obeys
// |λ| <= max |u*Ku| <= that of Σ ½k(s bbᵀ + ggᵀ/s), any s > 0, taken as |g|/|b| in the scaled norm. That sum enters the
// bound, and every listed disc not yet in contact as a spring of its own. So the bound holds for all real eigenvalues;
// a complex pair would be flutter, energy that the law itself makes, which no step is short enough for (on the guide's
// rock such pairs grow by at most 40 a second, dashpots of ratio 0.2 take 9000). Slopes are those of the present: deep
// on (iii), |α| < t/4, a disc's may grow to 1.5 times what an idle one counts, against the share a derived step leaves.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/contact_geometry.hpp"
#include "solver/contact_law.hpp"
#include "solver/overlap_gradient.hpp"
#include "solver/world.hpp"

namespace crackle {
namespace {

/// Symmetric 3 by 3 matrix of a body's scaled degrees of freedom (x, y, rotation).
struct Block {
    double xx = 0.0, yy = 0.0, rr = 0.0, xy = 0.0, xr = 0.0, yr = 0.0;

    /// Adds s·vvᵀ.
    void add(double s, double x, double y, double r) {
        if (s == 0.0) return;  // no damping, say
        xx += s * x * x;
        yy += s * y * y;
        rr += s * r * r;
        xy += s * x * y;
        xr += s * x * r;
        yr += s * y * r;
    }
};

/// Largest eigenvalue by Cardano's formula for symmetric matrices (Smith 1961), raised by its rounding.
double largest_eigenvalue(const Block& m) {
    const double off = m.xy * m.xy + m.xr * m.xr + m.yr * m.yr;
    const double mean = (m.xx + m.yy + m.rr) / 3.0;
    const double dx = m.xx - mean, dy = m.yy - mean, dr = m.rr - mean;
    const double p = std::sqrt((dx * dx + dy * dy + dr * dr + 2.0 * off) / 6.0);
    if (p == 0.0) return mean;
    const double half_det =
        (dx * (dy * dr - m.yr * m.yr) - m.xy * (m.xy * dr - m.yr * m.xr) + m.xr * (m.xy * m.yr - dy * m.xr)) /
        (2.0 * p * p * p);
    const double angle = std::acos(std::clamp(half_det, -1.0, 1.0)) / 3.0;
    return (mean + 2.0 * p * std::cos(angle)) * (1.0 + 1e-12);
}

/// Largest eigenvalue from above, at the price of one square root: the formula's cosine is at most 1.
double eigenvalue_at_most(const Block& m) {
    const double off = m.xy * m.xy + m.xr * m.xr + m.yr * m.yr;
    const double mean = (m.xx + m.yy + m.rr) / 3.0;
    const double dx = m.xx - mean, dy = m.yy - mean, dr = m.rr - mean;
    return (mean + 2.0 * std::sqrt((dx * dx + dy * dy + dr * dr + 2.0 * off) / 6.0)) * (1.0 + 1e-11);
}

struct BodyBlocks {
    Block stiffness, damping;
};

/// Square roots of a body's inverse masses.
struct Roots {
    double x, y, r;
};

Roots roots_of(const BodyInertia& inertia) {
    return {std::sqrt(inertia.inverse_mass_x), std::sqrt(inertia.inverse_mass_y), std::sqrt(inertia.inverse_moment)};
}

/// Where a point acts.
struct PointArms {
    Vec2 normal, arm_i, arm_j;
};

/// One side of a point, scaled by the roots: rows of its normal n and of the tangent, at `arm` from the centroid.
struct Side {
    double nx, ny, nr, tx, ty, tr;
};

Side side_of(const Roots& roots, Vec2 n, Vec2 arm) {
    const Vec2 t = perpendicular(n);
    return {roots.x * n.x, roots.y * n.y, roots.r * cross(arm, n),
            roots.x * t.x, roots.y * t.y, roots.r * cross(arm, t)};
}

/// @param normal false where the normal stiffness comes by rows (the guide's law)
void add_stiffness(Block& block, const Side& side, const ContactLaw& law, double share, bool normal) {
    if (normal) block.add(share * law.normal_stiffness, side.nx, side.ny, side.nr);
    if (law.friction > 0.0) block.add(share * law.shear_stiffness, side.tx, side.ty, side.tr);
}

void add_damping(Block& block, const Side& side, const ContactLaw& law, double root_mass, double share) {
    block.add(share * normal_damping(law, root_mass), side.nx, side.ny, side.nr);
    if (law.friction > 0.0) block.add(share * shear_damping(law, root_mass), side.tx, side.ty, side.tr);
}

void add_side(BodyBlocks& blocks, const Side& side, const ContactLaw& law, double root_mass, double share,
              bool normal = true) {
    add_stiffness(blocks.stiffness, side, law, share, normal);
    add_damping(blocks.damping, side, law, root_mass, share);
}

bool held(const BodyInertia& inertia) {
    return inertia.inverse_mass_x == 0.0 && inertia.inverse_mass_y == 0.0 && inertia.inverse_moment == 0.0;
}

/// (sqrt(c² + 4k) - c)/k, written without the cancellation.
double stable_step_of(double k, double c) {
    return k > 0.0 ? 4.0 / (std::sqrt(c * c + 4.0 * k) + c) : std::numeric_limits<double>::infinity();
}

/// The least stable step so far and its body.
struct Least {
    double bound = std::numeric_limits<double>::infinity();
    BodyIndex body = 0;

    /// Most bodies are let off after the cheap estimate.
    void lower_to(const BodyBlocks& blocks, BodyIndex b) {
        if (stable_step_of(eigenvalue_at_most(blocks.stiffness), eigenvalue_at_most(blocks.damping)) >= bound) return;
        const double exact = stable_step_of(largest_eigenvalue(blocks.stiffness), largest_eigenvalue(blocks.damping));
        if (exact < bound) *this = {exact, b};
    }
};

/// 1 + α for a side of own stiffness κ against κ of its partner (0: held); a side that cannot move along the point adds
/// nothing.
double share_of(double own, double partner) { return own > 0.0 ? 1.0 + partner / own : 1.0; }

/// The geometry of all points, found once.
std::vector<PointArms> arms_of(const World& world) {
    std::vector<PointArms> arms(world.points.size());
    const auto count = static_cast<std::int64_t>(arms.size());
#pragma omp parallel for num_threads(world.threads) if (world.threads > 1) schedule(static)
    for (std::int64_t k = 0; k < count; ++k) {
        const PointView view = view_point(world, static_cast<PointIndex>(k));
        arms[static_cast<std::size_t>(k)] = {view.normal, view.arm_i, view.arm_j};
    }
    return arms;
}

bool with_wall(const World& world, PointIndex k) {
    return k >= world.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
}

/// Normal stiffness of a point under the guide's law: ½stiffness·(row·u)² of energy at most.
struct NormalRow {
    BodyIndex i, j;
    double stiffness;  // N/m
    OverlapGradient row;
};

double scaled_square(const OverlapGradient& row, const Roots& i, const Roots& j) {
    const double scaled[6] = {row[0] * i.x, row[1] * i.y, row[2] * i.r, row[3] * j.x, row[4] * j.y, row[5] * j.r};
    double sum = 0.0;
    for (const double s : scaled) sum += s * s;
    return sum;
}

std::vector<NormalRow> normal_rows(const World& world, const std::vector<Roots>& roots) {
    std::vector<NormalRow> rows;
    const auto begin = world.kind_begin[static_cast<std::size_t>(PointKind::disc_segment)],
               end = world.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    for (PointIndex k = begin; k < end; ++k) {
        const PointView view = view_point(world, k);
        const BodyIndex i = view.body_i, j = view.body_j;
        const double stiffness = view.normal_stiffness;
        if (view.touching) {
            const OverlapGradient push = approach(view.normal, view.arm_i, view.arm_j);
            const double squared_push = scaled_square(push, roots[i], roots[j]),
                         squared_gradient = scaled_square(view.overlap_gradient, roots[i], roots[j]);
            if (squared_push > 0.0 && squared_gradient > 0.0) {
                const double s = std::sqrt(squared_gradient / squared_push);
                rows.push_back({i, j, 0.5 * stiffness * s, push});
                rows.push_back({i, j, 0.5 * stiffness / s, view.overlap_gradient});
            }
        }
        for (const OverlapGradient& row : idle_discs(world, view.kind, world.points[k]))
            rows.push_back({i, j, stiffness, row});
    }
    return rows;
}

void add_row(Block& block, const Roots& roots, const NormalRow& row, bool second, double share) {
    const std::size_t d = second ? 3 : 0;
    block.add(share * row.stiffness, roots.x * row.row[d], roots.y * row.row[d + 1], roots.r * row.row[d + 2]);
}

bool has_rows(const World& world, PointIndex k) {
    return k >= world.kind_begin[static_cast<std::size_t>(PointKind::disc_segment)] && !with_wall(world, k);
}

/// Largest scaled stiffness of every body's own points, held bodies 0.
std::vector<double> own_stiffness(const World& world, const std::vector<PointArms>& arms,
                                  const std::vector<NormalRow>& rows, const std::vector<Roots>& roots) {
    std::vector<Block> blocks(world.bodies.size());
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint& point = world.points[k];
        const ContactLaw& law = world.laws[point.law];
        const auto add = [&](BodyIndex b, Vec2 arm) {
            if (!held(world.inertia[b]))
                add_stiffness(blocks[b], side_of(roots[b], arms[k].normal, arm), law, 1.0, !has_rows(world, k));
        };
        add(point.body_i, arms[k].arm_i);
        if (!with_wall(world, k)) add(point.body_j, arms[k].arm_j);
    }
    for (const NormalRow& row : rows) {
        if (!held(world.inertia[row.i])) add_row(blocks[row.i], roots[row.i], row, false, 1.0);
        if (!held(world.inertia[row.j])) add_row(blocks[row.j], roots[row.j], row, true, 1.0);
    }
    std::vector<double> stiffness;
    stiffness.reserve(blocks.size());
    for (const Block& block : blocks) stiffness.push_back(largest_eigenvalue(block));
    return stiffness;
}

}  // namespace

double derived_step_share(const World& world) {
    const bool bonded = world.has_bonds && world.bonds_initial > 0;
    return bonded ? world.safety_factor : std::min(world.safety_factor, loose_step_share);
}

double stable_step_bound(const World& world, BodyIndex* limiting) {
    const std::vector<PointArms> arms = arms_of(world);
    std::vector<Roots> roots;
    roots.reserve(world.bodies.size());
    for (const BodyInertia& inertia : world.inertia) roots.push_back(roots_of(inertia));
    const std::vector<NormalRow> rows = normal_rows(world, roots);
    const std::vector<double> own = own_stiffness(world, arms, rows, roots);
    std::vector<BodyBlocks> blocks(world.bodies.size());
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint& point = world.points[k];
        const ContactLaw& law = world.laws[point.law];
        const BodyIndex i = point.body_i, j = point.body_j;
        const bool wall = with_wall(world, k);
        const bool i_held = held(world.inertia[i]), j_held = wall || held(world.inertia[j]);
        const double share_i = share_of(own[i], j_held ? 0.0 : own[j]),
                     share_j = share_of(j_held ? 0.0 : own[j], i_held ? 0.0 : own[i]);
        const double root_mass = point.root_effective_mass;
        const bool normal = !has_rows(world, k);
        if (!i_held)
            add_side(blocks[i], side_of(roots[i], arms[k].normal, arms[k].arm_i), law, root_mass, share_i, normal);
        if (!j_held)
            add_side(blocks[j], side_of(roots[j], arms[k].normal, arms[k].arm_j), law, root_mass, share_j, normal);
    }
    for (const NormalRow& row : rows) {
        const bool i_held = held(world.inertia[row.i]), j_held = held(world.inertia[row.j]);
        if (!i_held)
            add_row(blocks[row.i].stiffness, roots[row.i], row, false, share_of(own[row.i], j_held ? 0.0 : own[row.j]));
        if (!j_held)
            add_row(blocks[row.j].stiffness, roots[row.j], row, true, share_of(own[row.j], i_held ? 0.0 : own[row.i]));
    }
    Least least;
    const std::size_t wall_laws = world.materials.size() * world.materials.size();
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyInertia& inertia = world.inertia[b];
        const BodyInfo& info = world.info[b];
        if (held(inertia)) continue;
        if (world.body_begin[b] == world.body_begin[b + 1]) {
            // Nothing near: the first thing it meets, a circle head-on or a corner at the longest lever it has.
            const ContactLaw& law = world.laws[wall_laws + static_cast<std::size_t>(info.material)];
            const Vec2 along{info.reach, 0.0};
            const double root_mass = std::sqrt(inertia.mass);
            add_side(blocks[b], side_of(roots[b], {1.0, 0.0}, along), law, root_mass, 1.0);
            if (!info.single_circle) {
                BodyBlocks corner;
                add_side(corner, side_of(roots[b], {0.0, 1.0}, along), law, root_mass, 1.0);
                least.lower_to(corner, static_cast<BodyIndex>(b));
            }
        }
        least.lower_to(blocks[b], static_cast<BodyIndex>(b));
    }
    if (limiting != nullptr && std::isfinite(least.bound)) *limiting = least.body;
    return least.bound;
}

}  // namespace crackle
