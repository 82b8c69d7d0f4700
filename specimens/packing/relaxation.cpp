// SPDX-License-Identifier: GPL-3.0-or-later
// FIRE 2.0 (J. Guénolé et al., Comput. Mater. Sci. 175, 109584, 2020) uses semi-implicit Euler steps. While the power
// F·v is positive, the velocity is turned towards the force. Otherwise, positions move back by half a step and the
// velocity is set to zero. The drag method takes the same Euler step with the velocity multiplied by 1 - γ·step. The
// box strains are coordinates like the positions (Q = c·ε, where c² = 8 Σr² makes a unit of Q about as stiff as a
// contact). Positions move with the box.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "specimens/packing/relaxation.hpp"

namespace crackle {
namespace {

// Stiffness is 1 and masses are about 1, so time steps are in units of a contact's sqrt(m/k). A disc with six contacts
// oscillates at an angular frequency of up to about 2.4, which is stable for steps up to 0.8. A smaller step leaves a
// margin for large discs among many small ones.
constexpr double first_step = 0.1, largest_step = 0.5, smallest_step = 0.002;
constexpr double step_growth = 1.1, step_cut = 0.5;
constexpr double first_turn = 0.2, turn_decay = 0.99;  // α in the paper
constexpr int passes_before_growth = 10;
// Largest number of force computations between two progress reports, and of discs computed in them altogether. They
// take about a tenth of a second.
constexpr int most_passes_between_reports = 200;
constexpr std::size_t discs_between_reports = 1'000'000;

// Drag coefficient γ multiplied by the longer side of the box in mean diameters. Waves of that length are critically
// damped at γ = 2ω. With this value, packings of 20,000 and 50,000 discs took the fewest force computations (half as
// many as with two or three times the drag).
constexpr double drag_times_length = 2.0;
// Number of force computations after which FIRE replaces the drag method; 50,000 discs take at most 5,800.
constexpr int drag_passes = 100'000;

// Mean overlap, relative to the mean radius, below which discs in a fixed box count as separated.
constexpr double loose_overlap = 1e-9;

/// Velocity update of one step: v ← (1 - turn)(keep·v + step·a) + turn·|v|·a/|a|.
struct Kick {
    double step, turn, keep;
    double back = 0.0;  // positions first move back by this multiple of the old velocity
};

struct Dynamics {
    DiscAssembly& assembly;
    const BoxLoad& load;
    DiscMotion motion;
    Vec2 box_velocity;  // dQ/dt
    double box_scale;   // c, m

    Dynamics(DiscAssembly& discs, const BoxLoad& box_load) : assembly(discs), load(box_load) {
        double squares = 0.0;
        motion.velocity.resize(assembly.discs.size());
        // Larger discs have more neighbours. Their mass grows with the radius, which limits their frequencies.
        for (const Disc& disc : assembly.discs) {
            motion.inverse_mass.push_back(1.0 / (0.5 + 0.5 * disc.radius / assembly.mean_radius()));
            squares += disc.radius * disc.radius;
        }
        box_scale = std::sqrt(8.0 * squares);
    }

    Vec2 box_force(const AssemblySums& sums) const {
        const double hold = load.pressure * assembly.area();
        switch (load.freedom) {
            case BoxFreedom::fixed:
                return {};
            case BoxFreedom::free:
                return {(sums.virial_x - hold) / box_scale, (sums.virial_y - hold) / box_scale};
            case BoxFreedom::shape_kept:
                break;
        }
        const double both = 0.5 * (sums.virial_x + sums.virial_y - 2.0 * hold) / box_scale;
        return {both, both};
    }

    /// Takes one step. @return the result of DiscAssembly::move()
    double advance(const AssemblySums& sums, const Vec2& on_box, const Kick& kick) {
        const double step = kick.step, turn = kick.turn, keep = kick.keep, back = kick.back;
        const double pull_square = sums.pull_square + dot(on_box, on_box);
        const double speed_square = keep * keep * (sums.speed_square + dot(box_velocity, box_velocity)) +
                                    2.0 * step * keep * (sums.speed_pull + dot(box_velocity, on_box)) +
                                    step * step * pull_square;
        const double along = pull_square > 0.0 ? turn * std::sqrt(std::max(0.0, speed_square) / pull_square) : 0.0;
        const Vec2 box_before = box_velocity;
        box_velocity = (1.0 - turn) * (keep * box_velocity + step * on_box) + along * on_box;
        const bool box_moves = load.freedom != BoxFreedom::fixed;
        const double factor_x = box_moves ? 1.0 + (step * box_velocity.x - back * box_before.x) / box_scale : 1.0;
        const double factor_y = box_moves ? 1.0 + (step * box_velocity.y - back * box_before.y) / box_scale : 1.0;
        assembly.width *= factor_x;
        assembly.height *= factor_y;
        return assembly.move([&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Vec2 before = motion.velocity[i], pull = motion.inverse_mass[i] * assembly.forces[i];
                const Vec2 after = (1.0 - turn) * (keep * before + step * pull) + along * pull;
                motion.velocity[i] = after;
                Disc& disc = assembly.discs[i];
                disc.x = (disc.x + step * after.x - back * before.x) * factor_x;
                disc.y = (disc.y + step * after.y - back * before.y) * factor_y;
            }
        });
    }
};

/// Adapts the time step and the turning factor of FIRE to the power F·v.
struct Fire {
    double step = first_step, turn = first_turn;
    int downhill = 0;

    Kick next(double power) {
        const double last_step = step;
        if (power > 0.0) {
            if (++downhill > passes_before_growth) {
                step = std::min(step * step_growth, largest_step);
                turn *= turn_decay;
            }
            return {.step = step, .turn = turn, .keep = 1.0};
        }
        if (downhill > 0) step = std::max(step * step_cut, smallest_step);
        downhill = 0;
        turn = first_turn;
        return {.step = step, .turn = turn, .keep = 0.0, .back = 0.5 * last_step};
    }
};

}  // namespace

double imbalance(const DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums) {
    const double hold = load.pressure * assembly.area();
    switch (load.freedom) {
        case BoxFreedom::fixed:
            return sums.residual();
        case BoxFreedom::free:
            return std::max(
                {sums.residual(), std::abs(sums.virial_x - hold) / hold, std::abs(sums.virial_y - hold) / hold});
        case BoxFreedom::shape_kept:
            break;
    }
    return std::max(sums.residual(), std::abs(0.5 * (sums.virial_x + sums.virial_y) - hold) / hold);
}

RelaxationResult relax(DiscAssembly& assembly, const BoxLoad& load, double tolerance, int max_passes,
                       const RelaxationCallback& progress) {
    Dynamics dynamics(assembly, load);
    Fire fire;
    const double drag = drag_times_length * 2.0 * assembly.mean_radius() / std::max(assembly.width, assembly.height);
    const bool drags = assembly.discs.size() >= drag_from && load.freedom != BoxFreedom::fixed;
    const int passes_between_reports =
        std::clamp(static_cast<int>(discs_between_reports / assembly.discs.size()), 1, most_passes_between_reports);
    RelaxationResult result;
    std::optional<double> moved_square;
    for (int pass = 0; pass < max_passes; ++pass) {
        result.sums = assembly.compute_forces(&dynamics.motion, moved_square);
        result.imbalance = imbalance(assembly, load, result.sums);
        result.loose =
            load.freedom == BoxFreedom::fixed && result.sums.mean_overlap() < loose_overlap * assembly.mean_radius();
        result.converged = !result.loose && result.sums.contacts > 0.0 && result.imbalance <= tolerance;
        if (result.converged || result.loose) return result;
        if (progress && pass % passes_between_reports == 0) progress(result.imbalance);

        const Vec2 on_box = dynamics.box_force(result.sums);
        const Kick kick = drags && pass < drag_passes
                              ? Kick{.step = largest_step, .turn = 0.0, .keep = 1.0 - drag * largest_step}
                              : fire.next(result.sums.power + dot(on_box, dynamics.box_velocity));
        moved_square = dynamics.advance(result.sums, on_box, kick);
    }
    return result;
}

}  // namespace crackle
