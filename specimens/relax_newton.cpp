// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method on the enthalpy of a disc assembly. A contact (or wall contact) with branch d, normal n, tangent t and force f
// adds to the Hessian
//
//   n nᵀ - (f/|d|) t tᵀ      (stiffness 1; the second term is the force turning with the contact)
//
// between its two discs, and the same block applied to (d_x, 0), (0, d_y) couples them to the box strains ε_x, ε_y. The discs'
// part is sparse and factorised (LDLᵀ); the one or two strains are eliminated by a Schur complement. Discs with fewer than three
// contacts, once those without are taken away, hold nothing: a small stiffness of their own makes the matrix regular, and lets
// their last overlaps fade.

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <vector>

#include "specimens/relaxation.hpp"

namespace crackle {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

// Own stiffness of discs that hold nothing, in units of a contact's.
constexpr double floating_stiffness = 0.05;
// Added to all diagonals when the matrix is not positive definite; grows tenfold until it is.
constexpr double first_shift = 1e-5, largest_shift = 1.0;
// A step moves no disc by more than this share of the mean radius: beyond, the contacts are others.
constexpr double largest_move = 0.1;
constexpr int halvings = 6;

struct PairContact {
    std::uint32_t i, j;
    Vec2 branch;  // from i to j, m
    double xx, xy, yy;  // stiffness block
};

struct WallContact {
    std::uint32_t i;
    bool horizontal;   // a side wall: acts along x
    double sign;       // of the disc's coordinate in the distance: +1 at left and bottom
    double distance;   // m
};

struct Network {
    std::vector<PairContact> pairs;
    std::vector<WallContact> walls;
    std::vector<bool> floating;
};

Network find_network(const DiscAssembly& assembly) {
    Network network;
    const std::size_t count = assembly.discs.size();
    std::vector<int> touching(count, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Disc& a = assembly.discs[i];
        for (const std::uint32_t* next = assembly.neighbours_begin(i); next != assembly.neighbours_end(i); ++next) {
            if (*next < i) continue;
            const Disc& b = assembly.discs[*next];
            const Vec2 branch{b.x - a.x, b.y - a.y};
            const double distance = norm(branch), overlap = a.radius + b.radius - distance;
            if (overlap <= 0.0 || distance == 0.0) continue;
            const Vec2 n = (1.0 / distance) * branch;
            const double turning = overlap / distance;
            network.pairs.push_back({i, *next, branch, n.x * n.x - turning * n.y * n.y, (1.0 + turning) * n.x * n.y,
                                     n.y * n.y - turning * n.x * n.x});
            ++touching[i];
            ++touching[*next];
        }
        const auto touch = [&](bool horizontal, double sign, double distance) {
            if (distance >= a.radius) return;
            network.walls.push_back({i, horizontal, sign, distance});
            ++touching[i];
        };
        touch(true, 1.0, a.x);
        touch(true, -1.0, assembly.width - a.x);
        touch(false, 1.0, a.y);
        touch(false, -1.0, assembly.height - a.y);
    }
    // Peel off discs with fewer than three contacts until none is left to peel.
    network.floating.assign(count, false);
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<int> held(count, 0);
        for (const PairContact& pair : network.pairs) {
            if (network.floating[pair.i] || network.floating[pair.j]) continue;
            ++held[pair.i];
            ++held[pair.j];
        }
        for (const WallContact& wall : network.walls) ++held[wall.i];
        for (std::size_t i = 0; i < count; ++i) {
            if (network.floating[i] || held[i] >= 3) continue;
            network.floating[i] = true;
            changed = true;
        }
    }
    return network;
}

/// Hessian of the discs, and its coupling to the box strains (columns 0: ε_x, 1: ε_y).
struct System {
    Matrix stiffness;
    Eigen::MatrixXd coupling;
    Eigen::Matrix2d box;
};

System assemble(const DiscAssembly& assembly, const BoxLoad& load, const Network& network) {
    const auto unknowns = static_cast<Eigen::Index>(2 * assembly.discs.size());
    System system{Matrix(unknowns, unknowns), Eigen::MatrixXd::Zero(unknowns, 2), Eigen::Matrix2d::Zero()};
    std::vector<Eigen::Triplet<double, int>> entries;  // lower triangle
    entries.reserve(7 * network.pairs.size() + 3 * assembly.discs.size());
    std::vector<double> own(3 * assembly.discs.size(), 0.0);  // xx, xy, yy of each disc's diagonal block
    for (const PairContact& pair : network.pairs) {
        const int a = 2 * static_cast<int>(pair.i), b = 2 * static_cast<int>(pair.j);  // a < b
        for (const std::uint32_t disc : {pair.i, pair.j}) {
            own[3 * disc] += pair.xx;
            own[3 * disc + 1] += pair.xy;
            own[3 * disc + 2] += pair.yy;
        }
        entries.emplace_back(b, a, -pair.xx);
        entries.emplace_back(b + 1, a, -pair.xy);
        entries.emplace_back(b, a + 1, -pair.xy);
        entries.emplace_back(b + 1, a + 1, -pair.yy);
        const Vec2 by_x{pair.xx * pair.branch.x, pair.xy * pair.branch.x};
        const Vec2 by_y{pair.xy * pair.branch.y, pair.yy * pair.branch.y};
        system.coupling(a, 0) -= by_x.x;
        system.coupling(a + 1, 0) -= by_x.y;
        system.coupling(b, 0) += by_x.x;
        system.coupling(b + 1, 0) += by_x.y;
        system.coupling(a, 1) -= by_y.x;
        system.coupling(a + 1, 1) -= by_y.y;
        system.coupling(b, 1) += by_y.x;
        system.coupling(b + 1, 1) += by_y.y;
        system.box(0, 0) += pair.branch.x * by_x.x;
        system.box(1, 1) += pair.branch.y * by_y.y;
        system.box(0, 1) += pair.branch.x * by_y.x;
    }
    for (const WallContact& wall : network.walls) {
        const int axis = wall.horizontal ? 0 : 1;
        own[3 * wall.i + (wall.horizontal ? 0 : 2)] += 1.0;
        system.coupling(2 * static_cast<int>(wall.i) + axis, axis) += wall.sign * wall.distance;
        system.box(axis, axis) += wall.distance * wall.distance;
    }
    system.box(0, 1) += load.pressure * assembly.area();
    system.box(1, 0) = system.box(0, 1);
    for (std::size_t i = 0; i < assembly.discs.size(); ++i) {
        const int at = 2 * static_cast<int>(i);
        const double extra = network.floating[i] ? floating_stiffness : 0.0;
        entries.emplace_back(at, at, own[3 * i] + extra);
        entries.emplace_back(at + 1, at, own[3 * i + 1]);
        entries.emplace_back(at + 1, at + 1, own[3 * i + 2] + extra);
    }
    system.stiffness.setFromTriplets(entries.begin(), entries.end());
    return system;
}

struct NewtonStep {
    Eigen::VectorXd move;  // of the discs beyond what they do with the box, m
    Vec2 strain;
    bool found = false;
};

NewtonStep solve(const DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums, const System& system) {
    NewtonStep step;
    const Eigen::Index unknowns = system.stiffness.rows();
    Eigen::VectorXd force(unknowns);
    for (std::size_t i = 0; i < assembly.discs.size(); ++i) {
        force[static_cast<Eigen::Index>(2 * i)] = assembly.forces[i].x;
        force[static_cast<Eigen::Index>(2 * i + 1)] = assembly.forces[i].y;
    }
    Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factors;
    factors.analyzePattern(system.stiffness);
    for (double shift = 0.0; shift <= largest_shift; shift = shift == 0.0 ? first_shift : 10.0 * shift) {
        factors.setShift(shift);
        factors.factorize(system.stiffness);
        if (factors.info() == Eigen::Success && factors.vectorD().minCoeff() > 0.0) {
            step.found = true;
            break;
        }
    }
    if (!step.found) return step;
    step.move = factors.solve(force);
    if (load.freedom == BoxFreedom::fixed) return step;

    const double hold = load.pressure * assembly.area();
    const Eigen::Vector2d box_force(sums.virial_x - hold, sums.virial_y - hold);
    // One strain for both directions, or one each.
    const Eigen::MatrixXd freedom =
        load.freedom == BoxFreedom::free ? Eigen::MatrixXd(Eigen::Matrix2d::Identity()) : Eigen::MatrixXd(Eigen::Vector2d(1.0, 1.0));
    const Eigen::MatrixXd coupling = system.coupling * freedom;
    const Eigen::MatrixXd response = factors.solve(coupling);
    const Eigen::MatrixXd schur = freedom.transpose() * system.box * freedom - coupling.transpose() * response;
    const Eigen::VectorXd out_of_balance = freedom.transpose() * box_force - coupling.transpose() * step.move;
    const Eigen::VectorXd strain = schur.ldlt().solve(out_of_balance);
    step.move -= response * strain;
    const Eigen::Vector2d both = freedom * strain;
    step.strain = {both[0], both[1]};
    step.found = step.move.allFinite() && both.allFinite();
    return step;
}

void apply(DiscAssembly& assembly, const NewtonStep& step, double share) {
    for (std::size_t i = 0; i < assembly.discs.size(); ++i) {
        assembly.discs[i].x += share * step.move[static_cast<Eigen::Index>(2 * i)];
        assembly.discs[i].y += share * step.move[static_cast<Eigen::Index>(2 * i + 1)];
    }
    assembly.strain(1.0 + share * step.strain.x, 1.0 + share * step.strain.y);
}

double enthalpy(const DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums) {
    return sums.energy + (load.freedom == BoxFreedom::fixed ? 0.0 : load.pressure * assembly.area());
}

}  // namespace

RelaxationResult relax_newton(DiscAssembly& assembly, const BoxLoad& load, double tolerance, int max_iterations,
                              const RelaxationCallback& progress) {
    RelaxationResult result;
    result.sums = assembly.compute_forces();
    result.imbalance = imbalance(assembly, load, result.sums);
    int without_gain = 0;
    double best = result.imbalance;
    for (int iteration = 0; iteration < max_iterations; ++iteration) {
        result.converged = result.imbalance <= tolerance;
        if (result.converged) return result;
        if (progress) progress(result.imbalance);
        const NewtonStep step = solve(assembly, load, result.sums, assemble(assembly, load, find_network(assembly)));
        if (!step.found) return result;

        const double reach = step.move.size() > 0 ? step.move.cwiseAbs().maxCoeff() : 0.0;
        const double span = std::max(std::abs(step.strain.x) * assembly.width, std::abs(step.strain.y) * assembly.height);
        double share = std::min(1.0, largest_move * assembly.mean_radius() / std::max({reach, span, 1e-300}));
        const double before = enthalpy(assembly, load, result.sums);
        const std::vector<Disc> start = assembly.discs;
        const double start_width = assembly.width, start_height = assembly.height;
        // Near the minimum the enthalpy no longer resolves a gain, the imbalance still does.
        bool gained = false;
        for (int halving = 0; halving <= halvings && !gained; ++halving, share *= 0.5) {
            assembly.discs = start;
            assembly.width = start_width;
            assembly.height = start_height;
            apply(assembly, step, share);
            const AssemblySums sums = assembly.compute_forces();
            const double after = imbalance(assembly, load, sums);
            gained = after < result.imbalance || enthalpy(assembly, load, sums) < before;
            if (gained) {
                result.sums = sums;
                result.imbalance = after;
            }
        }
        if (!gained) {
            assembly.discs = start;
            assembly.width = start_width;
            assembly.height = start_height;
            result.sums = assembly.compute_forces();
            result.imbalance = imbalance(assembly, load, result.sums);
            return result;
        }
        without_gain = result.imbalance < 0.7 * best ? 0 : without_gain + 1;
        best = std::min(best, result.imbalance);
        if (without_gain > 8) return result;
    }
    result.converged = result.imbalance <= tolerance;
    return result;
}

}  // namespace crackle
