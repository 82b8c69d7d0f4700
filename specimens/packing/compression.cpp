// SPDX-License-Identifier: GPL-3.0-or-later
// Implementation of compression.hpp. Frictionless discs jam at a well-defined density: they then fill about 0.84 of the
// plane, less beside walls. Above this density, the mean overlap grows almost in proportion to the pressure, and the
// void ratio falls linearly. These two relations give the next pressure.

#include "specimens/packing/compression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/errors.hpp"
#include "specimens/packing/isotropy.hpp"
#include "specimens/packing/relaxation.hpp"
#include "specimens/packing/size_distribution.hpp"
#include "specimens/statistics/random_numbers.hpp"

namespace crackle {
namespace {

// Limits for the imbalance of the finished packing (1e-5 is required) and for the relative error of its target (1e-3 is
// required).
constexpr double final_imbalance = 2e-7;
constexpr double final_target_error = 1e-4, accepted_target_error = 5e-4;
// Imbalances at which the pressure is corrected before the discs are brought to their final equilibrium.
constexpr double early_imbalance[] = {3e-2, 3e-3};
constexpr double working_imbalance = 1e-3;
constexpr int final_corrections = 12;

// Fraction of the box that discs fill when they are quenched; above the jamming density for all known sizes and walls.
// If the discs do not jam, or if the overlap is still below the target, the box is narrowed in steps.
constexpr double quench_fill = 0.86;
constexpr double narrowing = 0.995;
constexpr int narrowings = 200;
constexpr double quenched_overlap_share = 3e-3;  // smallest overlap, relative to the mean radius
constexpr double quench_imbalance = 0.1;
constexpr int quench_passes = 20'000, relax_passes = 400'000;

constexpr double wanted_anisotropy = 0.003;
// Anisotropy above which the shape of the box may change, if the request leaves it free.
constexpr double needed_anisotropy = 0.006;
constexpr int exchange_rounds = 12;

// Gap left between a floating disc and the discs that it touched, in mean overlaps.
constexpr double floating_gap = 1e-3;
constexpr int floating_sweeps = 2000;
// About one floating disc in 20,000 has no room for the gap. In packings with fewer discs than put_back_from, the
// attempt is discarded, as was done for the published packings. In larger packings, almost every attempt would fail, so
// the disc is put back.
constexpr std::size_t put_back_from = drag_from;

class Compressor {
  public:
    Compressor(DiscAssembly& assembly, const CompressionTarget& target, double height_to_width,
               CompressionCallback progress)
        : assembly_(assembly), target_(target), height_to_width_(height_to_width), progress_(std::move(progress)) {}

    /// Relaxes the discs in a fixed box, which is narrowed until they jam.
    /// @return false if the discs could not be made to carry load
    bool quench() {
        const double at_least =
            std::max(quenched_overlap_share * assembly_.mean_radius(), target_.mean_overlap.value_or(0.0));
        for (int k = 0; k < narrowings; ++k) {
            const RelaxationResult result =
                relax(assembly_, {}, quench_imbalance, quench_passes, reporter("quenching"));
            sums_ = result.sums;
            if (!result.loose && sums_.mean_overlap() >= at_least) {
                set_pressure((sums_.virial_x + sums_.virial_y) / (2.0 * assembly_.area()));
                return true;
            }
            assembly_.strain(narrowing, narrowing);
        }
        return false;
    }

    /// Iterates until target, isotropy and equilibrium are reached together. @return whether all three were reached
    bool finish(bool free_box) {
        load_.freedom = BoxFreedom::shape_kept;
        first_pressure();
        for (const double tolerance : early_imbalance) {
            relax_to(tolerance, "opening the box");
            correct_pressure();
        }
        relax_to(working_imbalance, "opening the box");
        make_isotropic();
        if (free_box && std::abs(stress_anisotropy(sums_)) > needed_anisotropy) load_.freedom = BoxFreedom::free;
        for (int k = 0; k < final_corrections; ++k) {
            if (!relax_to(final_imbalance, "equilibrium")) return false;
            const double error = std::abs(target_error());
            if (error <= (k + 2 < final_corrections ? final_target_error : accepted_target_error))
                return settle_floating();
            correct_pressure();
        }
        return false;
    }

    const AssemblySums& sums() const { return sums_; }
    double aspect_error() const { return assembly_.height / assembly_.width / height_to_width_ - 1.0; }

  private:
    RelaxationCallback reporter(const char* stage) const {
        return [this, stage](double imbalance_reached) {
            if (progress_) progress_(stage, imbalance_reached);
        };
    }

    bool relax_to(double tolerance, const char* stage) {
        const RelaxationResult result = relax(assembly_, load_, tolerance, relax_passes, reporter(stage));
        sums_ = result.sums;
        return result.converged;
    }

    double void_ratio() const { return assembly_.area() / assembly_.disc_area() - 1.0; }
    double scale() const { return target_.final_width > 0.0 ? target_.final_width / assembly_.width : 1.0; }
    double smallest_overlap() const { return smallest_overlap_share * assembly_.mean_radius(); }
    double largest_overlap() const { return largest_overlap_share * assembly_.mean_radius(); }

    /// Relative deviation from the target.
    double target_error() const {
        if (target_.mean_overlap) return scale() * sums_.mean_platen_overlap() / *target_.mean_overlap - 1.0;
        return void_ratio() / *target_.void_ratio - 1.0;
    }

    void set_pressure(double pressure) { load_.pressure = pressure; }

    void first_pressure() {
        if (target_.mean_overlap) {
            correct_pressure();
            return;
        }
        correct_by_void_ratio();
    }

    void correct_pressure() {
        if (!target_.mean_overlap) {
            correct_by_void_ratio();
            return;
        }
        set_pressure(load_.pressure / (1.0 + target_error()));
    }

    /// Newton's method for the void ratio. The slope comes from the last two states, or is estimated from the first
    /// one. The estimate takes the mean overlap, divided by the centre distance, as the strain of the box.
    void correct_by_void_ratio() {
        const double overlap = sums_.mean_overlap(), pressure = load_.pressure, now = void_ratio();
        const double guess = -(1.0 + now) * overlap / assembly_.mean_radius() / pressure;
        double slope = guess;
        if (last_pressure_ > 0.0 && last_pressure_ != pressure) {
            slope = std::clamp((now - last_void_ratio_) / (pressure - last_pressure_), 3.0 * guess, guess / 3.0);
        }
        last_pressure_ = pressure;
        last_void_ratio_ = now;
        const double lowest = pressure * smallest_overlap() / overlap, highest = pressure * largest_overlap() / overlap;
        const double next = pressure + (*target_.void_ratio - now) / slope;
        // In two successive corrections, a pressure outside the possible range is clamped; in the third, the target
        // counts as unreachable.
        beyond_range_ = next < lowest || next > highest ? beyond_range_ + 1 : 0;
        if (beyond_range_ > 2) refuse_void_ratio(lowest, highest);
        set_pressure(std::clamp(next, lowest, highest));
    }

    [[noreturn]] void refuse_void_ratio(double lowest, double highest) {
        const auto reached = [&](double pressure) {
            set_pressure(pressure);
            relax_to(working_imbalance, "determining the possible void ratios");
            return void_ratio();
        };
        const double loosest = reached(lowest), densest = reached(highest);
        throw PackingError(PackingInput::void_ratio, "void_ratio",
                           fmt::format(": found {}, expected {:.4f} to {:.4f}, the range that these sizes reach with "
                                       "this seed. Looser packings carry no load without friction; in denser ones, "
                                       "circles overlap by more than a tenth of the mean radius",
                                       *target_.void_ratio, densest, loosest));
    }

    void make_isotropic() {
        for (int round = 0; round < exchange_rounds && std::abs(stress_anisotropy(sums_)) > wanted_anisotropy;
             ++round) {
            if (exchange_radii(assembly_, load_, sums_) == 0) return;
            relax_to(working_imbalance, "making the stress isotropic");
            correct_pressure();
            relax_to(working_imbalance, "making the stress isotropic");
        }
    }

    /// Moves discs that carry no load away from discs that do. Their remaining overlaps result only from the tolerance
    /// of the equilibrium, but they would be bonded later.
    bool settle_floating() {
        const std::vector<Disc> in_equilibrium = assembly_.discs;
        std::vector<bool> floating = find_floating(assembly_, sums_);
        const double gap = floating_gap * sums_.mean_overlap();
        for (;;) {
            for (int sweep = 0; sweep < floating_sweeps; ++sweep) {
                if (progress_) progress_("moving circles that carry no load", sums_.residual());
                bool moved = false;
                for (std::uint32_t i = 0; i < floating.size(); ++i) {
                    if (floating[i]) moved |= push_away(i, gap);
                }
                if (!moved) break;
            }
            sums_ = assembly_.compute_forces();
            if (sums_.residual() <= 10.0 * final_imbalance) return std::abs(target_error()) <= accepted_target_error;
            if (assembly_.discs.size() < put_back_from || !put_back_caged(floating, in_equilibrium)) return false;
        }
    }

    /// Handles floating discs that still touch others because they have no room to move. Such a disc returns to its
    /// position in equilibrium with its small load, and no longer counts as floating.
    /// @return whether any disc was put back
    bool put_back_caged(std::vector<bool>& floating, const std::vector<Disc>& in_equilibrium) {
        std::vector<std::uint32_t> caged;
        for (std::uint32_t i = 0; i < floating.size(); ++i) {
            if (floating[i] && touches(i)) caged.push_back(i);
        }
        for (const std::uint32_t i : caged) {
            assembly_.discs[i] = in_equilibrium[i];
            floating[i] = false;
        }
        return !caged.empty();
    }

    bool touches(std::uint32_t i) const {
        const Disc& disc = assembly_.discs[i];
        const double to_wall = std::min({disc.x, assembly_.width - disc.x, disc.y, assembly_.height - disc.y});
        return to_wall < disc.radius ||
               std::any_of(assembly_.neighbours_begin(i), assembly_.neighbours_end(i), [&](std::uint32_t j) {
                   const Disc& other = assembly_.discs[j];
                   return norm({disc.x - other.x, disc.y - other.y}) < disc.radius + other.radius;
               });
    }

    bool push_away(std::uint32_t i, double gap) {
        Disc& disc = assembly_.discs[i];
        bool moved = false;
        for (const std::uint32_t* j = assembly_.neighbours_begin(i); j != assembly_.neighbours_end(i); ++j) {
            const Disc& other = assembly_.discs[*j];
            const double dx = disc.x - other.x, dy = disc.y - other.y, distance = std::sqrt(dx * dx + dy * dy);
            const double apart = disc.radius + other.radius;
            if (distance == 0.0 || distance >= apart + 0.5 * gap) continue;
            const double move = (apart + gap - distance) / distance;
            disc.x += move * dx;
            disc.y += move * dy;
            moved = true;
        }
        const auto keep_off = [&](double distance, double& coordinate, double sign) {
            if (distance >= disc.radius + 0.5 * gap) return;
            coordinate += sign * (disc.radius + gap - distance);
            moved = true;
        };
        keep_off(disc.x, disc.x, 1.0);
        keep_off(assembly_.width - disc.x, disc.x, -1.0);
        keep_off(disc.y, disc.y, 1.0);
        keep_off(assembly_.height - disc.y, disc.y, -1.0);
        return moved;
    }

    DiscAssembly& assembly_;
    const CompressionTarget& target_;
    double height_to_width_;
    CompressionCallback progress_;
    AssemblySums sums_;
    BoxLoad load_;
    double last_pressure_ = 0.0, last_void_ratio_ = 0.0;
    int beyond_range_ = 0;
};

DiscAssembly scatter(const std::vector<double>& radii, double height_to_width, int threads,
                     std::mt19937_64& generator) {
    double squares = 0.0;
    for (const double radius : radii) squares += radius * radius;
    const double width = std::sqrt(std::numbers::pi * squares / quench_fill / height_to_width),
                 height = height_to_width * width;
    std::vector<Disc> discs;
    discs.reserve(radii.size());
    for (const double radius : radii) {
        // In a box narrower than a circle, only the middle is possible.
        const double free_x = std::max(0.0, width - 2.0 * radius), free_y = std::max(0.0, height - 2.0 * radius);
        const double x = 0.5 * width + (uniform_number(generator) - 0.5) * free_x;
        const double y = 0.5 * height + (uniform_number(generator) - 0.5) * free_y;
        discs.push_back({x, y, radius});
    }
    return {width, height, std::move(discs), threads};
}

}  // namespace

Compression compress(const std::vector<double>& radii, double height_to_width, const CompressionTarget& target,
                     bool free_box, int threads, std::mt19937_64& generator, const CompressionCallback& progress) {
    Compression result{scatter(radii, height_to_width, threads, generator), {}, 0.0, false};
    DiscAssembly& assembly = result.assembly;
    assembly.sort_spatially();
    Compressor compressor(assembly, target, height_to_width, progress);
    if (!compressor.quench()) return result;
    // The discs are near their final positions, so they are sorted, and the list keeps only close neighbours.
    assembly.sort_spatially();
    assembly.skin = 0.1 * assembly.mean_radius();
    result.converged = compressor.finish(free_box);
    result.sums = compressor.sums();
    result.aspect_error = compressor.aspect_error();
    return result;
}

}  // namespace crackle
