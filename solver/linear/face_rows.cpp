// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/linear/face_rows.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "solver/geometry/face_motion.hpp"

namespace crackle {
namespace {

/// Derivatives of the motion of a face with respect to x, y and rotation of body i, then of body j.
struct MotionGradients {
    std::array<double, 6> opening, sliding, turn;
};

MotionGradients gradients_of(const World& world, FaceIndex k) {
    const Faces& faces = world.faces;
    const BodyState &i = world.bodies.state[faces.bodies[k].body_i], &j = world.bodies.state[faces.bodies[k].body_j];
    const FacePlace& place = faces.place[k];
    const BondFaceMotion m = motion_of(place, i, j);
    const Vec2 arm_i = turned_by(i, place.arm_i), arm_j = turned_by(j, place.arm_j);
    const Vec2 n = m.normal, t = perpendicular(n);
    // The normal rotates by half the rotation of each body.
    return {{-n.x, -n.y, -cross(arm_i, n) + 0.5 * m.sliding, n.x, n.y, cross(arm_j, n) + 0.5 * m.sliding},
            {-t.x, -t.y, -cross(arm_i, t) - 0.5 * m.opening, t.x, t.y, cross(arm_j, t) - 0.5 * m.opening},
            {0.0, 0.0, -1.0, 0.0, 0.0, 1.0}};
}

bool has_rows(const Faces& faces, FaceIndex k, FacesWithRows which) {
    const FaceIndex broken = faces.broken_at[k];
    return which == FacesWithRows::all || broken == no_face || faces.broken[broken].closed_joint;
}

/// Pressure per unit of A e of a cell, whose faces without rows are free to move.
double per_area_of(const Faces& faces, BodyIndex b, FacesWithRows which) {
    const double own = faces.cells[b].per_area;
    double yields = 0.0;  // Σ s² L²/k_n
    for (std::uint32_t n = faces.first_face[b]; n < faces.first_face[b + 1]; ++n) {
        const FaceIndex k = faces.face_ends[n] / 2;
        if (has_rows(faces, k, which)) continue;
        const FaceSprings& s = faces.springs[k];
        const double share = s.length * ((faces.face_ends[n] & 1) != 0 ? s.share_j : s.share_i);
        yields += share * share / s.normal;
    }
    return own / (1.0 + own * yields);
}

}  // namespace

LinearRows face_rows(const World& world, FacesWithRows which) {
    const Faces& faces = world.faces;
    LinearRows result;
    std::vector<MotionGradients> gradients;
    gradients.reserve(faces.size());
    for (FaceIndex k = 0; k < faces.size(); ++k) gradients.push_back(gradients_of(world, k));
    const auto add_entries = [&](FaceIndex k, const std::array<double, 6>& row, double factor) {
        for (std::size_t a = 0; a < 6; ++a)
            if (row[a] != 0.0)
                result.entries.push_back({a < 3 ? faces.bodies[k].body_i : faces.bodies[k].body_j,
                                          static_cast<int>(a % 3), factor * row[a]});
    };
    const auto end_row = [&](std::size_t first, double stiffness, double damping) {
        // Combines the entries for the same degree of freedom, which occur because a cell has several faces.
        const auto begin = result.entries.begin() + static_cast<std::ptrdiff_t>(first);
        std::stable_sort(begin, result.entries.end(), [](const RowEntry& a, const RowEntry& b) {
            return std::pair(a.body, a.freedom) < std::pair(b.body, b.freedom);
        });
        auto last = begin;
        for (auto entry = begin; entry != result.entries.end(); ++entry) {
            if (entry != begin && entry->body == last->body && entry->freedom == last->freedom)
                last->value += entry->value;
            else if (entry != begin)
                *++last = *entry;
        }
        result.entries.erase(last + 1, result.entries.end());
        result.rows.push_back({stiffness, damping, static_cast<std::uint32_t>(first),
                               static_cast<std::uint32_t>(result.entries.size() - first)});
    };
    for (FaceIndex k = 0; k < faces.size(); ++k) {
        if (!has_rows(faces, k, which)) continue;
        const FaceSprings& s = faces.springs[k];
        const FaceDashpots c = faces.damped() ? faces.dashpots[k] : FaceDashpots{};
        const auto add = [&](const std::array<double, 6>& row, double stiffness, double damping) {
            const std::size_t first = result.entries.size();
            add_entries(k, row, 1.0);
            end_row(first, stiffness, damping);
        };
        add(gradients[k].opening, s.normal, c.normal);
        add(gradients[k].sliding, s.shear, c.shear);
        add(gradients[k].turn, s.moment(), c.moment);
    }
    for (BodyIndex b = 0; b < faces.cells.size(); ++b) {
        if (faces.cells[b].per_area == 0.0) continue;
        const std::size_t first = result.entries.size();
        for (std::uint32_t n = faces.first_face[b]; n < faces.first_face[b + 1]; ++n) {
            const FaceIndex k = faces.face_ends[n] / 2;
            if (!has_rows(faces, k, which)) continue;
            const bool is_j = (faces.face_ends[n] & 1) != 0;
            const FaceSprings& s = faces.springs[k];
            add_entries(k, gradients[k].opening, s.length * (is_j ? s.share_j : s.share_i));
            add_entries(k, gradients[k].sliding, s.length * (is_j ? -s.skew_j : s.skew_i));
        }
        if (result.entries.size() > first) end_row(first, per_area_of(faces, b, which), 0.0);
    }
    return result;
}

std::vector<FaceForces> face_force_rates(const World& world, const std::vector<BodyMotion>& motion) {
    const Faces& faces = world.faces;
    std::vector<BondFaceMotion> of_face(faces.size());
    std::vector<double> dilation(faces.cells.size(), 0.0);
    for (FaceIndex k = 0; k < faces.size(); ++k) {
        const BodyIndex i = faces.bodies[k].body_i, j = faces.bodies[k].body_j;
        const MotionGradients gradients = gradients_of(world, k);
        const auto times = [&](const std::array<double, 6>& row) {
            double sum = 0.0;
            for (std::size_t a = 0; a < 6; ++a)
                sum += row[a] * component(motion[a < 3 ? i : j], static_cast<int>(a % 3));
            return sum;
        };
        if (!has_rows(faces, k, FacesWithRows::intact)) continue;
        of_face[k] = {{}, times(gradients.opening), times(gradients.sliding), times(gradients.turn)};
        const FaceSprings s = faces.springs[k];
        dilation[i] += s.length * (s.share_i * of_face[k].opening + s.skew_i * of_face[k].sliding);
        dilation[j] += s.length * (s.share_j * of_face[k].opening - s.skew_j * of_face[k].sliding);
    }
    std::vector<FaceForces> forces;
    forces.reserve(faces.size());
    for (FaceIndex k = 0; k < faces.size(); ++k) {
        const auto [i, j] = faces.bodies[k];
        const FaceSprings s = faces.springs[k];
        const auto pressure = [&](BodyIndex b) { return per_area_of(faces, b, FacesWithRows::intact) * dilation[b]; };
        const double p_i = pressure(i), p_j = pressure(j);
        if (has_rows(faces, k, FacesWithRows::intact))
            forces.push_back(
                intact_forces(s, of_face[k], s.share_i * p_i + s.share_j * p_j, s.skew_i * p_i - s.skew_j * p_j));
        else
            forces.push_back({});
    }
    return forces;
}

}  // namespace crackle
