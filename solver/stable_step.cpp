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

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/contact_geometry.hpp"
#include "solver/contact_law.hpp"
#include "solver/world.hpp"

namespace crackle {
namespace {

/// Symmetric 3 by 3 matrix of a body's scaled degrees of freedom (x, y, rotation).
struct Block {
    double xx = 0.0, yy = 0.0, rr = 0.0, xy = 0.0, xr = 0.0, yr = 0.0;

    /// Adds s·vvᵀ.
    void add(double s, double x, double y, double r) {
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

struct BodyBlocks {
    Block stiffness, damping;
};

/// Adds one side of a point: normal n and tangent at `arm` from the centroid, scaled by the square roots of inverse
/// masses.
void add_side(BodyBlocks& blocks, const BodyInertia& inertia, const ContactLaw& law, double root_mass, double share,
              Vec2 n, Vec2 arm) {
    const double sx = std::sqrt(inertia.inverse_mass_x), sy = std::sqrt(inertia.inverse_mass_y),
                 sr = std::sqrt(inertia.inverse_moment);
    const Vec2 t = perpendicular(n);
    const double nr = sr * cross(arm, n), tr = sr * cross(arm, t);
    blocks.stiffness.add(share * law.normal_stiffness, sx * n.x, sy * n.y, nr);
    blocks.damping.add(share * normal_damping(law, root_mass), sx * n.x, sy * n.y, nr);
    if (law.friction <= 0.0) return;
    blocks.stiffness.add(share * law.shear_stiffness, sx * t.x, sy * t.y, tr);
    blocks.damping.add(share * shear_damping(law, root_mass), sx * t.x, sy * t.y, tr);
}

bool held(const BodyInertia& inertia) {
    return inertia.inverse_mass_x == 0.0 && inertia.inverse_mass_y == 0.0 && inertia.inverse_moment == 0.0;
}

double stable_step_of(const BodyBlocks& blocks) {
    const double k = largest_eigenvalue(blocks.stiffness), c = largest_eigenvalue(blocks.damping);
    if (k <= 0.0) return std::numeric_limits<double>::infinity();
    // (sqrt(c² + 4k) - c)/k, written without the cancellation.
    return 4.0 / (std::sqrt(c * c + 4.0 * k) + c);
}

/// 1 + α for a side of own stiffness κ against κ of its partner (0: held); a side that cannot move along the point adds
/// nothing.
double share_of(double own, double partner) { return own > 0.0 ? 1.0 + partner / own : 1.0; }

/// Largest scaled stiffness of every body's own points, held bodies 0.
std::vector<double> own_stiffness(const World& world) {
    std::vector<BodyBlocks> blocks(world.bodies.size());
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint& point = world.points[k];
        const PointView view = view_point(world, k);
        const ContactLaw& law = world.laws[point.law];
        const auto add = [&](BodyIndex b, Vec2 arm) {
            if (!held(world.inertia[b]))
                add_side(blocks[b], world.inertia[b], law, point.root_effective_mass, 1.0, view.normal, arm);
        };
        add(point.body_i, view.arm_i);
        if (view.kind != PointKind::element_wall) add(point.body_j, view.arm_j);
    }
    std::vector<double> stiffness;
    stiffness.reserve(blocks.size());
    for (const BodyBlocks& block : blocks) stiffness.push_back(largest_eigenvalue(block.stiffness));
    return stiffness;
}

}  // namespace

double stable_step_bound(const World& world) {
    const std::vector<double> own = own_stiffness(world);
    std::vector<BodyBlocks> blocks(world.bodies.size());
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint& point = world.points[k];
        const PointView view = view_point(world, k);
        const ContactLaw& law = world.laws[point.law];
        const BodyIndex i = point.body_i, j = point.body_j;
        const bool wall = view.kind == PointKind::element_wall;
        const bool i_held = held(world.inertia[i]), j_held = wall || held(world.inertia[j]);
        const double share_i = share_of(own[i], j_held ? 0.0 : own[j]),
                     share_j = share_of(own[j], i_held ? 0.0 : own[i]);
        if (!i_held)
            add_side(blocks[i], world.inertia[i], law, point.root_effective_mass, share_i, view.normal, view.arm_i);
        if (!j_held)
            add_side(blocks[j], world.inertia[j], law, point.root_effective_mass, share_j, view.normal, view.arm_j);
    }
    double bound = std::numeric_limits<double>::infinity();
    const std::size_t wall_laws = world.materials.size() * world.materials.size();
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyInertia& inertia = world.inertia[b];
        const BodyInfo& info = world.info[b];
        if (held(inertia)) continue;
        if (world.body_begin[b] == world.body_begin[b + 1]) {
            // Nothing near: the first thing it meets, a circle head-on or a corner at the longest lever it has.
            const ContactLaw& law = world.laws[wall_laws + static_cast<std::size_t>(info.material)];
            const Vec2 along{info.reach, 0.0};
            add_side(blocks[b], inertia, law, std::sqrt(inertia.mass), 1.0, {1.0, 0.0}, along);
            if (!info.single_circle) {
                BodyBlocks corner;
                add_side(corner, inertia, law, std::sqrt(inertia.mass), 1.0, {0.0, 1.0}, along);
                bound = std::min(bound, stable_step_of(corner));
            }
        }
        bound = std::min(bound, stable_step_of(blocks[b]));
    }
    return bound;
}

}  // namespace crackle
