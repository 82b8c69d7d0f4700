// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/linear/mass_scaled.hpp"

#include <algorithm>
#include <cmath>

#include "solver/linear/face_rows.hpp"

namespace crackle {

MassScaled::MassScaled(const World& world, ClosedPoints which)
    : while_solving_(world.workers.while_solving),
      springs_(symmetric_majorant(world, springs_of(world, which))),
      rows_(face_rows(world, FacesWithRows::all)) {
    number_.resize(3 * world.bodies.size(), -1);
    const auto take = [&](std::size_t dof, double inverse) {
        if (inverse == 0.0) return;
        number_[dof] = static_cast<int>(root_.size());
        root_.push_back(std::sqrt(inverse));
    };
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        take(3 * b, world.bodies.inertia[b].inverse_mass_x);
        take(3 * b + 1, world.bodies.inertia[b].inverse_mass_y);
        take(3 * b + 2, world.bodies.inertia[b].inverse_moment);
    }
    // Rows are stored in mass-scaled coordinates.
    for (RowEntry& entry : rows_.entries) {
        const int n = number_of(entry);
        entry.value *= n < 0 ? 0.0 : root_[static_cast<std::size_t>(n)];
    }
}

bool MassScaled::damped() const {
    const auto has_dashpot = [](const auto& spring) { return spring.damping > 0.0; };
    return std::ranges::any_of(springs_, has_dashpot) || std::ranges::any_of(rows_.rows, has_dashpot);
}

MassScaled::Row MassScaled::row_of(const Spring& s) const {
    Row row{};
    for (int a = 0; a < 6; ++a) {
        const BodyIndex body = a < 3 ? s.i : s.j;
        row.number[a] = body == no_body ? -1 : number_[3 * std::size_t{body} + static_cast<std::size_t>(a % 3)];
        if (row.number[a] >= 0)
            row.value[a] = s.push[static_cast<std::size_t>(a)] * root_[static_cast<std::size_t>(row.number[a])];
    }
    return row;
}

MassScaled::Matrix MassScaled::matrix(double damping_share, double stiffness_share) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(springs_.size() * 21);
    for (const Spring& s : springs_) {
        const Row row = row_of(s);
        const double weight = damping_share * s.damping + stiffness_share * s.stiffness;
        for (int a = 0; a < 6; ++a) {
            for (int b = 0; b < 6; ++b) {
                if (row.number[a] < 0 || row.number[b] < 0 || row.number[b] > row.number[a]) continue;
                entries.emplace_back(row.number[a], row.number[b], weight * row.value[a] * row.value[b]);
            }
        }
    }
    for (const LinearRow& row : rows_.rows) {
        const double weight = damping_share * row.damping + stiffness_share * row.stiffness;
        for (const RowEntry& a : rows_.of(row)) {
            const int n = number_of(a);
            for (const RowEntry& b : rows_.of(row)) {
                const int m = number_of(b);
                if (n >= 0 && m >= 0 && m <= n) entries.emplace_back(n, m, weight * a.value * b.value);
            }
        }
    }
    Matrix matrix(size(), size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

double MassScaled::Row::times(const Vector& x) const {
    double stretch = 0.0;
    for (int a = 0; a < 6; ++a) stretch += number[a] < 0 ? 0.0 : value[a] * x[number[a]];
    return stretch;
}

double MassScaled::times_row(const LinearRow& row, const Vector& x) const {
    double sum = 0.0;
    for (const RowEntry& entry : rows_.of(row))
        if (const int n = number_of(entry); n >= 0) sum += entry.value * x[n];
    return sum;
}

MassScaled::Vector MassScaled::times(double damping_share, double stiffness_share, const Vector& x) const {
    Vector result = Vector::Zero(size());
    for (const Spring& s : springs_) {
        const Row row = row_of(s);
        const double force = (damping_share * s.damping + stiffness_share * s.stiffness) * row.times(x);
        for (int a = 0; a < 6; ++a)
            if (row.number[a] >= 0) result[row.number[a]] += force * row.value[a];
    }
    for (const LinearRow& row : rows_.rows) {
        const double force = (damping_share * row.damping + stiffness_share * row.stiffness) * times_row(row, x);
        for (const RowEntry& entry : rows_.of(row))
            if (const int n = number_of(entry); n >= 0) result[n] += force * entry.value;
    }
    return result;
}

MassScaled::Quotient MassScaled::quotient(const Vector& x) const {
    Quotient q{0.0, 0.0};
    for (const Spring& s : springs_) {
        const double stretch = row_of(s).times(x);
        q.damping += s.damping * stretch * stretch;
        q.stiffness += s.stiffness * stretch * stretch;
    }
    for (const LinearRow& row : rows_.rows) {
        const double stretch = times_row(row, x);
        q.damping += row.damping * stretch * stretch;
        q.stiffness += row.stiffness * stretch * stretch;
    }
    const double length = x.squaredNorm();
    return {q.damping / length, q.stiffness / length};
}

std::vector<BodyMotion> MassScaled::motion(const Vector& x) const {
    std::vector<BodyMotion> motions(number_.size() / 3);
    const double largest = x.cwiseAbs().maxCoeff();
    const auto component = [&](std::size_t dof) {
        const int n = number_[dof];
        return n < 0 ? 0.0 : x[n] * root_[static_cast<std::size_t>(n)] / largest;
    };
    for (std::size_t b = 0; b < motions.size(); ++b)
        motions[b] = {component(3 * b), component(3 * b + 1), component(3 * b + 2)};
    return motions;
}

}  // namespace crackle
