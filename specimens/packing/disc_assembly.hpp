// SPDX-License-Identifier: GPL-3.0-or-later
// Smooth elastic discs between four smooth walls: the mechanical model of the packer.
//
//   discs   δ = r_i + r_j - |x_j - x_i|,   walls   δ = r - distance,   f = δ (stiffness 1, so forces are lengths)
//
// The box spans 0..width × 0..height. Each disc sums its own forces over a full neighbour list (every pair is computed
// from both sides). This takes twice the arithmetic of a half list but needs no scatter, so the result is bit-identical
// for any number of threads. The forces of a disc's neighbours are computed in SIMD lanes (solver/base/lanes.hpp) but
// added one by one in list order. The result therefore does not depend on the number of lanes either.
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "solver/base/instruction_set.hpp"
#include "solver/base/vec2.hpp"

namespace crackle {

/// A disc of a packing.
struct alignas(32) Disc {
    double x, y;    // m
    double radius;  // m
};

/// Velocities and inverse masses of the discs, for relaxation by damped dynamics.
struct DiscMotion {
    std::vector<Vec2> velocity;
    std::vector<double> inverse_mass;
};

/// Sums over all contacts at the current positions. Forces are in units of length (stiffness 1).
struct AssemblySums {
    double virial_x = 0.0, virial_y = 0.0;                      // -dU/dε: Σ f·|n_x|·|branch_x|, including walls
    double overlap = 0.0;                                       // m, Σ δ over all contacts
    double contacts = 0.0;                                      // number of contacts, including walls
    double platen_overlap = 0.0;                                // m, Σ δ, excluding contacts with side walls
    double platen_contacts = 0.0;                               // number of contacts, except with side walls
    double largest_force = 0.0;                                 // m, largest unbalanced force on a disc
    double power = 0.0, speed_square = 0.0, pull_square = 0.0;  // Σ F·v, Σ v², Σ (F/m)²; 0 without DiscMotion
    double speed_pull = 0.0;                                    // Σ v·F/m

    /// Mean over all contacts, m; 0 without contacts.
    double mean_overlap() const { return contacts > 0.0 ? overlap / contacts : 0.0; }
    /// Mean over all contacts except contacts with side walls, m; 0 without contacts.
    double mean_platen_overlap() const { return platen_contacts > 0.0 ? platen_overlap / platen_contacts : 0.0; }
    /// Largest unbalanced force divided by the mean contact force; 0 without contacts.
    double residual() const { return contacts > 0.0 ? largest_force / mean_overlap() : 0.0; }
};

/// Discs in a box with smooth walls, and their contacts.
class DiscAssembly {
  public:
    /// Discs in a box of the given width and height, m.
    DiscAssembly(double width, double height, std::vector<Disc> discs, int threads);

    double width, height;  // m
    std::vector<Disc> discs;
    std::vector<Vec2> forces;  // unbalanced forces on the discs at the last compute_forces()
    int threads;

    /// Mean radius of the discs, m.
    double mean_radius() const { return mean_radius_; }
    /// Sum of the discs' areas, m2; overlaps count twice.
    double disc_area() const { return disc_area_; }
    /// Area of the box, m2.
    double area() const { return width * height; }

    /// Rebuilds the neighbour list if needed, computes `forces` and returns the sums.
    /// @param moved_square  m², return value of move() if nothing has moved since then; saves a pass over the discs
    AssemblySums compute_forces(const DiscMotion* motion = nullptr, std::optional<double> moved_square = {});

    /// Moves the discs in a box that already has its new size.
    /// @param place  sets the positions of the discs from `begin` up to, but not including, `end`; called once for each
    /// block of discs, from several threads
    /// @return square of the largest displacement since the list was built, m², relative to a uniform strain of the
    /// box; infinite if there is no list
    double move(const std::function<void(std::size_t begin, std::size_t end)>& place);

    /// Strains the box; the centres of the discs move with it.
    void strain(double factor_x, double factor_y);

    /// Sorts the discs into rows along the box's height, so that neighbours are close to each other in memory.
    void sort_spatially();

    /// Neighbours of disc i in the list used by the last compute_forces(), including all its contacts.
    const std::uint32_t* neighbours_begin(std::size_t i) const { return neighbours_.data() + list_begin_[i]; }
    /// End of the neighbours of disc i.
    const std::uint32_t* neighbours_end(std::size_t i) const { return neighbours_.data() + list_begin_[i + 1]; }

    /// Verlet skin of the next neighbour list, m: pairs of discs with a smaller distance between their surfaces are
    /// listed.
    double skin;

  private:
    /// Contribution of one neighbour to a disc's sums.
    struct PairPush {
        double x, y;                // m, force on the neighbour
        double virial_x, virial_y;  // m2
    };
    struct PairSums;

    bool list_outdated(double moved_square) const;
    void build_list();
    // The templates are compiled with the kernels (disc_kernels.cpp).
    /// Computes forces and sums of the listed pairs begin..end; pushes[0] belongs to pair `begin`.
    template <InstructionSet>
    void measure_pairs(std::size_t begin, std::size_t end, PairPush* pushes, PairSums& sums) const;
    template <InstructionSet>
    AssemblySums compute_block(std::size_t begin, std::size_t end, const DiscMotion* motion, PairPush* pushes);

    double mean_radius_ = 0.0, largest_radius_ = 0.0, disc_area_ = 0.0;
    // For each entry of neighbours_, owners_ has the disc to whose list the entry belongs.
    std::vector<std::uint32_t> list_begin_, neighbours_, owners_;
    std::size_t largest_chunk_ = 0;                  // largest number of listed pairs computed at a time
    std::vector<std::vector<std::uint32_t>> found_;  // scratch of build_list()
    std::vector<AssemblySums> partial_;              // sums over each block
    std::vector<Vec2> listed_at_;                    // positions when the list was built, relative to the box
    double listed_width_ = 0.0, listed_height_ = 0.0;
};

/// Number of discs in a block. A thread processes one block at a time, and sums are first taken over each block. The
/// number is constant, so sums do not depend on the number of threads.
inline constexpr std::size_t assembly_block = 256;

/// Number of discs whose pairs are computed before their forces are summed. The intermediate data, about 10 kB, then
/// fit into the L1 cache. Must be a divisor of assembly_block.
inline constexpr std::size_t assembly_chunk = 64;

/// Smallest number of discs for which a parallel region is worthwhile.
inline constexpr std::size_t assembly_parallel_from = 4096;

}  // namespace crackle
