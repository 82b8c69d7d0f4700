// SPDX-License-Identifier: GPL-3.0-or-later
// A contact with branch d, normal n, tangent t and force f adds the following block to the Hessian of the enthalpy:
//
//   n nᵀ - (f/|d|) t tᵀ      (stiffness 1; the second term stems from the rotation of the force with the contact)
//
// The block couples the two discs. Applied to d, it couples the discs to the scale of the box. See isotropy.hpp.

#include "specimens/packing/isotropy.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace crackle {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

// A contact with less than this fraction of the mean overlap counts as carrying no load, because the equilibrium is
// only this accurate.
constexpr double carrying_share = 1e-4;
// Stiffness given to floating discs, relative to the stiffness of a contact. It makes the matrix regular and does not
// affect other discs.
constexpr double floating_stiffness = 0.05;
// Shift added to all diagonal entries if a disc is about to buckle (the matrix is not positive definite). It is
// increased until the matrix is positive definite.
constexpr double first_shift = 1e-5, largest_shift = 1.0, shift_growth = 10.0;
// Largest difference between swapped radii, in mean overlaps. With this limit, a few forces change by about their own
// size.
constexpr double largest_exchange = 1.5;

struct PairContact {
    std::uint32_t i, j;
    Vec2 branch;  // from i to j, m
    double distance, overlap;
};

struct WallContact {
    std::uint32_t i;
    int axis;     // axis of the contact normal; 0 is x, for contacts with side walls
    double sign;  // derivative of the wall distance with respect to the disc's coordinate: +1 at left and bottom
    double distance, overlap;
};

template <typename OnPair, typename OnWall>
void visit_contacts(const DiscAssembly& assembly, const OnPair& on_pair, const OnWall& on_wall) {
    for (std::uint32_t i = 0; i < assembly.discs.size(); ++i) {
        const Disc& a = assembly.discs[i];
        for (const std::uint32_t* next = assembly.neighbours_begin(i); next != assembly.neighbours_end(i); ++next) {
            if (*next < i) continue;
            const Disc& b = assembly.discs[*next];
            const Vec2 branch{b.x - a.x, b.y - a.y};
            const double distance = norm(branch), overlap = a.radius + b.radius - distance;
            if (overlap > 0.0 && distance > 0.0) on_pair(PairContact{i, *next, branch, distance, overlap});
        }
        const auto touch = [&](int axis, double sign, double distance) {
            if (distance < a.radius) on_wall(WallContact{i, axis, sign, distance, a.radius - distance});
        };
        touch(0, 1.0, a.x);
        touch(0, -1.0, assembly.width - a.x);
        touch(1, 1.0, a.y);
        touch(1, -1.0, assembly.height - a.y);
    }
}

/// Hessian with respect to the disc positions, their coupling to ε_x and ε_y, and Hessian with respect to these
/// strains.
struct System {
    Matrix stiffness;  // lower triangle
    Eigen::MatrixXd coupling;
    Eigen::Matrix2d box;
};

System assemble(const DiscAssembly& assembly, const BoxLoad& load, const std::vector<bool>& floating) {
    const auto unknowns = static_cast<Eigen::Index>(2 * assembly.discs.size());
    System system{Matrix(unknowns, unknowns), Eigen::MatrixXd::Zero(unknowns, 2), Eigen::Matrix2d::Zero()};
    std::vector<Eigen::Triplet<double, int>> entries;
    std::vector<Eigen::Matrix2d> own(assembly.discs.size(), Eigen::Matrix2d::Zero());
    visit_contacts(
        assembly,
        [&](const PairContact& contact) {
            const Eigen::Vector2d branch(contact.branch.x, contact.branch.y), normal = branch / contact.distance;
            const Eigen::Vector2d tangent(-normal.y(), normal.x());
            const Eigen::Matrix2d block =
                normal * normal.transpose() - contact.overlap / contact.distance * tangent * tangent.transpose();
            const Eigen::Matrix2d by_strain = block * branch.asDiagonal();
            const int a = 2 * static_cast<int>(contact.i), b = 2 * static_cast<int>(contact.j);  // a < b
            own[contact.i] += block;
            own[contact.j] += block;
            for (int row = 0; row < 2; ++row) {
                for (int column = 0; column < 2; ++column)
                    entries.emplace_back(b + row, a + column, -block(row, column));
            }
            system.coupling.block<2, 2>(a, 0) -= by_strain;
            system.coupling.block<2, 2>(b, 0) += by_strain;
            system.box += branch.asDiagonal() * by_strain;
        },
        [&](const WallContact& contact) {
            own[contact.i](contact.axis, contact.axis) += 1.0;
            system.coupling(2 * static_cast<int>(contact.i) + contact.axis, contact.axis) +=
                contact.sign * contact.distance;
            system.box(contact.axis, contact.axis) += contact.distance * contact.distance;
        });
    system.box(0, 1) += load.pressure * assembly.area();
    system.box(1, 0) += load.pressure * assembly.area();
    for (std::size_t i = 0; i < assembly.discs.size(); ++i) {
        const int at = 2 * static_cast<int>(i);
        const double extra = floating[i] ? floating_stiffness : 0.0;
        entries.emplace_back(at, at, own[i](0, 0) + extra);
        entries.emplace_back(at + 1, at, own[i](1, 0));
        entries.emplace_back(at + 1, at + 1, own[i](1, 1) + extra);
    }
    system.stiffness.setFromTriplets(entries.begin(), entries.end());
    return system;
}

/// H⁻¹ applied to (of_discs, of_scale). The box adds a single row and column to H, for its scale; this unknown is
/// eliminated.
struct Response {
    Eigen::VectorXd of_discs;
    double of_scale = 0.0;
    bool found = false;
};

Response respond(const System& system, const Eigen::VectorXd& of_discs, double of_scale) {
    Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factors;
    factors.analyzePattern(system.stiffness);
    Response response;
    for (double shift = 0.0; shift <= largest_shift && !response.found;
         shift = shift == 0.0 ? first_shift : shift_growth * shift) {
        factors.setShift(shift);
        factors.factorize(system.stiffness);
        response.found = factors.info() == Eigen::Success && factors.vectorD().minCoeff() > 0.0;
    }
    if (!response.found) return response;
    const Eigen::VectorXd border = system.coupling.rowwise().sum();
    const Eigen::VectorXd of_border = factors.solve(border);
    response.of_discs = factors.solve(of_discs);
    response.of_scale = (of_scale - border.dot(response.of_discs)) / (system.box.sum() - border.dot(of_border));
    response.of_discs -= response.of_scale * of_border;
    response.found = response.of_discs.allFinite() && std::isfinite(response.of_scale);
    return response;
}

}  // namespace

double stress_anisotropy(const AssemblySums& sums) {
    return (sums.virial_x - sums.virial_y) / (sums.virial_x + sums.virial_y);
}

std::vector<bool> find_floating(const DiscAssembly& assembly, const AssemblySums& sums) {
    const double carrying = carrying_share * sums.mean_overlap();
    std::vector<bool> floating(assembly.discs.size(), false);
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<int> held(assembly.discs.size(), 0);
        visit_contacts(
            assembly,
            [&](const PairContact& contact) {
                if (contact.overlap < carrying || floating[contact.i] || floating[contact.j]) return;
                ++held[contact.i];
                ++held[contact.j];
            },
            [&](const WallContact& contact) { held[contact.i] += contact.overlap >= carrying ? 1 : 0; });
        for (std::size_t i = 0; i < floating.size(); ++i) {
            if (floating[i] || held[i] >= 3) continue;
            floating[i] = true;
            changed = true;
        }
    }
    return floating;
}

std::vector<double> anisotropy_gradient(const DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums) {
    const std::vector<bool> floating = find_floating(assembly, sums);
    const System system = assemble(assembly, load, floating);
    // A virial is minus the derivative of U with respect to its strain. Its derivatives are therefore minus the entries
    // of the Hessian.
    const Response response =
        respond(system, system.coupling.col(1) - system.coupling.col(0), system.box(1, 1) - system.box(0, 0));
    if (!response.found) return {};
    const auto moved = [&](std::uint32_t i) {
        const auto at = 2 * static_cast<Eigen::Index>(i);
        return Vec2{response.of_discs[at], response.of_discs[at + 1]};
    };
    std::vector<double> gradient(assembly.discs.size(), 0.0);
    visit_contacts(
        assembly,
        [&](const PairContact& contact) {
            const Vec2 d = contact.branch;
            const double direct = (d.x * d.x - d.y * d.y) / contact.distance;
            const double through_discs = dot(moved(contact.j) - moved(contact.i), d) / contact.distance;
            const double share = direct + through_discs + response.of_scale * contact.distance;
            gradient[contact.i] += share;
            gradient[contact.j] += share;
        },
        [&](const WallContact& contact) {
            const Vec2 move = moved(contact.i);
            gradient[contact.i] += (contact.axis == 0 ? contact.distance : -contact.distance) +
                                   contact.sign * (contact.axis == 0 ? move.x : move.y) +
                                   response.of_scale * contact.distance;
        });
    for (std::size_t i = 0; i < gradient.size(); ++i) {
        if (floating[i]) gradient[i] = 0.0;
    }
    return gradient;
}

int exchange_radii(DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums) {
    const std::vector<double> gradient = anisotropy_gradient(assembly, load, sums);
    std::vector<std::uint32_t> by_size;
    for (std::uint32_t i = 0; i < gradient.size(); ++i) {
        if (gradient[i] != 0.0) by_size.push_back(i);
    }
    const auto radius = [&](std::uint32_t i) { return assembly.discs[i].radius; };
    std::sort(by_size.begin(), by_size.end(),
              [&](std::uint32_t a, std::uint32_t b) { return radius(a) != radius(b) ? radius(a) < radius(b) : a < b; });

    struct Exchange {
        std::uint32_t small, large;
        double change;  // resulting change of T
    };
    std::vector<Exchange> exchanges;
    const double wanted = sums.virial_y - sums.virial_x, limit = largest_exchange * sums.mean_overlap();
    // Forms disjoint pairs: within each run of similar sizes, a disc of the lower half is paired with a disc of the
    // upper half.
    for (std::size_t first = 0; first < by_size.size();) {
        std::size_t end = first + 1;
        while (end < by_size.size() && radius(by_size[end]) - radius(by_size[first]) <= limit) ++end;
        const std::size_t half = (end - first) / 2;
        for (std::size_t k = first; k < first + half; ++k) {
            const std::uint32_t small = by_size[k], large = by_size[k + half];
            const double change = (radius(large) - radius(small)) * (gradient[small] - gradient[large]);
            if (change * wanted > 0.0) exchanges.push_back({small, large, change});
        }
        first = end;
    }
    // The most effective swaps come first, so that as few circles as possible are disturbed. Swaps that would overshoot
    // by more than they help are skipped.
    std::sort(exchanges.begin(), exchanges.end(), [](const Exchange& a, const Exchange& b) {
        return std::abs(a.change) != std::abs(b.change) ? std::abs(a.change) > std::abs(b.change) : a.small < b.small;
    });
    double left = wanted;
    int made = 0;
    for (const Exchange& exchange : exchanges) {
        if (std::abs(left - exchange.change) >= std::abs(left)) continue;
        std::swap(assembly.discs[exchange.small].radius, assembly.discs[exchange.large].radius);
        left -= exchange.change;
        ++made;
    }
    return made;
}

}  // namespace crackle
