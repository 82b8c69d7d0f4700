// SPDX-License-Identifier: GPL-3.0-or-later
// Smooth elastic discs between four smooth walls: the mechanics under the packer, and nothing more.
//
//   discs   δ = r_i + r_j - |x_j - x_i|,   walls   δ = r - distance,   f = δ (stiffness 1, so forces are lengths)
//
// The box spans 0..width × 0..height. Each disc adds up its own forces over a full neighbour list (every pair is seen
// from both sides): twice the arithmetic of a half list, but no scatter, so the result is the same bytes for any number
// of threads. A disc's neighbours are measured side by side (solver/base/lanes.hpp) and added one by one, in their
// order: the same bytes for any number of lanes, too.
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "solver/base/instruction_set.hpp"
#include "solver/base/vec2.hpp"

namespace crackle {

struct alignas(32) Disc {
    double x, y;    // m
    double radius;  // m
};

/// What a relaxation by damped dynamics adds to the discs.
struct DiscMotion {
    std::vector<Vec2> velocity;
    std::vector<double> inverse_mass;
};

/// Sums over all contacts at the present positions. Forces in units of length (stiffness 1).
struct AssemblySums {
    double virial_x = 0.0, virial_y = 0.0;                      // -dU/dε: Σ f·|n_x|·|branch_x|, walls included
    double overlap = 0.0;                                       // m, Σ δ over all contacts
    double contacts = 0.0;                                      // number of contacts, walls included
    double platen_overlap = 0.0;                                // Σ δ without the side walls
    double platen_contacts = 0.0;                               // contacts without those with the side walls
    double largest_force = 0.0;                                 // largest unbalanced force on a disc
    double power = 0.0, speed_square = 0.0, pull_square = 0.0;  // Σ F·v, Σ v², Σ (F/m)²; 0 without a motion
    double speed_pull = 0.0;                                    // Σ v·F/m

    double mean_overlap() const { return contacts > 0.0 ? overlap / contacts : 0.0; }
    double mean_platen_overlap() const { return platen_contacts > 0.0 ? platen_overlap / platen_contacts : 0.0; }
    /// Largest unbalanced force / mean contact force; 0 where nothing touches.
    double residual() const { return contacts > 0.0 ? largest_force / mean_overlap() : 0.0; }
};

class DiscAssembly {
  public:
    /// @param skin m, Verlet skin: discs nearer than that are in each other's list.
    DiscAssembly(double width, double height, std::vector<Disc> discs, int threads);

    double width, height;  // m
    std::vector<Disc> discs;
    std::vector<Vec2> forces;  // of the last compute_forces()
    int threads;

    double mean_radius() const { return mean_radius_; }
    double disc_area() const { return disc_area_; }
    double area() const { return width * height; }

    /// Refreshes the neighbour list where needed, fills `forces`.
    /// @param moved_square  m², what move() returned, if nothing has moved since; spares a pass over the discs.
    AssemblySums compute_forces(const DiscMotion* motion = nullptr, std::optional<double> moved_square = {});

    /// Places the discs again, in a box that has its new size already.
    /// @param place  places discs begin..end, a block at a time; called from several threads.
    /// @return square of the largest displacement since the list was built, m² (without what a strain of the box
    /// explains); infinite without a list.
    double move(const std::function<void(std::size_t begin, std::size_t end)>& place);

    /// Scales the box, the discs' centres with it.
    void strain(double factor_x, double factor_y);

    /// Numbers the discs along the box's height, in rows: neighbours lie near each other in memory.
    void sort_spatially();

    /// Neighbours of disc i in the list of the last compute_forces(); a superset of its contacts.
    const std::uint32_t* neighbours_begin(std::size_t i) const { return neighbours_.data() + list_begin_[i]; }
    const std::uint32_t* neighbours_end(std::size_t i) const { return neighbours_.data() + list_begin_[i + 1]; }

    /// Skin of the next list, m.
    double skin;

  private:
    /// What a neighbour does to a disc.
    struct PairPush {
        double x, y;                // m, towards the neighbour
        double virial_x, virial_y;  // m2
    };
    struct PairSums;

    bool list_outdated(double moved_square) const;
    void build_list();
    // By the kernels (disc_kernels.cpp).
    /// Pushes and sums of the listed pairs begin..end; pushes[0] is that of pair `begin`.
    template <InstructionSet>
    void measure_pairs(std::size_t begin, std::size_t end, PairPush* pushes, PairSums& sums) const;
    template <InstructionSet>
    AssemblySums compute_block(std::size_t begin, std::size_t end, const DiscMotion* motion, PairPush* pushes);

    double mean_radius_ = 0.0, largest_radius_ = 0.0, disc_area_ = 0.0;
    std::vector<std::uint32_t> list_begin_, neighbours_, owners_;  // owners_: the disc whose neighbour it is
    std::size_t largest_chunk_ = 0;                                // of listed pairs measured at a time
    std::vector<std::vector<std::uint32_t>> found_;                // scratch of build_list()
    std::vector<AssemblySums> partial_;                            // a block's sums
    std::vector<Vec2> listed_at_;  // positions when the list was built, as shares of the box
    double listed_width_ = 0.0, listed_height_ = 0.0;
};

/// Discs handed to a thread at a time, and the unit in which sums are taken: fixed, so that sums do not depend on the
/// threads.
inline constexpr std::size_t assembly_block = 256;

/// Discs whose pairs are measured before their forces are summed: what is kept of them, some 10 kB, stays in the L1
/// cache. Divides assembly_block.
inline constexpr std::size_t assembly_chunk = 64;

/// Below this many discs a parallel region costs more than it saves.
inline constexpr std::size_t assembly_parallel_from = 4096;

}  // namespace crackle
