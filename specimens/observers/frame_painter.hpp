// SPDX-License-Identifier: GPL-3.0-or-later
// Frames as files for ParaView and the report: particles_NNNNN.vtp and bonds_NNNNN.vtp, NNNNN the row of curve.csv
// (from 0) in which they were taken, and frames.pvd over all of them.
//
// Particles: platens as lines, polygons by their corners, circles as regular polygons of the circle's own area: 24
// corners up to 2,000 particles, 12 beyond, where they are looked at from farther away (outlines share 0.98 of what
// they cover together; 0.996 with 24). True circles are drawn about the mean of the corners with `radius`.
// Cell data: id, radius [m, 0 for polygons], material, angle [rad, turned since loading began], displacement [m],
// velocity [m/s].
// Bonds: all that loading began with, as lines centre-point-centre between circles and point-point between polygons.
// Cell data: body_i, body_j, normal_force [N, elastic, compression positive], shear_force [N], broken [0/1].
//
// Points are Float32 (a hundred-millionth of the specimen), what was computed Float64, ids and indices Int32 (indices
// Int64 beyond 2³¹), broken UInt8. What never changes is packed once and put into every file again, up to 2,000
// particles; beyond it would be a quarter of all memory, and packing it is little beside the steps between two frames.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "solver/vec2.hpp"
#include "specimens/observers/frames.hpp"
#include "specimens/observers/vtk_polydata.hpp"

namespace crackle {

/// Corners of a circle drawn among so many particles.
int circle_corners(std::int64_t particles);
/// Corners of the regular polygon with the area of the unit circle, the first to the right.
std::vector<Vec2> unit_circle_outline(int corners);

/// Draws the frames of one test.
class FramePainter {
  public:
    /// Both must outlive the painter.
    FramePainter(const World& world, const TestSetup& setup);
    bool paints(const World& world, const TestSetup& setup) const { return &world == &world_ && &setup == &setup_; }

    void write_particles(std::ostream& out, const Frame& frame) const;
    void write_bonds(std::ostream& out, const Frame& frame) const;

  private:
    template <class Visit>
    void visit_cells(const Visit& visit) const;
    void write_particle_cells(std::ostream& out) const;
    void write_bond_cells(std::ostream& out) const;

    const World& world_;
    const TestSetup& setup_;
    std::vector<BodyIndex> order_;  // in which bodies are drawn
    std::vector<Vec2> outline_;     // of a circle
    VtpCounts particle_counts_, bond_counts_;
    std::string particle_cells_, bond_cells_;  // what write_..._cells() write, where it is kept
};

}  // namespace crackle
