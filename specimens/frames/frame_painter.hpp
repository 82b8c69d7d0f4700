// SPDX-License-Identifier: GPL-3.0-or-later
// Frames as files for ParaView and the report: particles_, contacts_ and cracks_NNNNN.vtp, of jointed specimens
// joints_, too, NNNNN the row of the curve (from 0) in which they were taken, and frames.pvd over all of them (parts 0
// to 3).
//
// Particles: platens as lines, polygons by their corners, circles as regular polygons of the circle's own area: 24
// corners up to 2,000 particles, 12 beyond, where they are looked at from farther away (outlines share 0.98 of what
// they cover together; 0.996 with 24). True circles are drawn about the mean of the corners with `radius`. All circles
// of a clump have the values of the clump.
// Contacts: all bonds that loading began with, always in the same order and where they were held, then what else
// touches at the moment; as lines centre-point-centre between circles and point-point between polygons.
// Cracks: a line for each bonded point that has broken so far, in the order of events.csv, placed by crack_faces.hpp.
// Joints: a line for each face on a trace, as long as that was when loading began; trace_faces.hpp.
// Cell data and their units: particle_arrays() and its like below; forces and stresses are of springs only,
// frame_forces.hpp; fragments, fragments.hpp; ages, contact_history.hpp.
//
// Points are Float32 (a hundred-millionth of the specimen) or Float64, what was computed Float64, ids and indices Int32
// (indices Int64 beyond 2³¹), state and mode UInt8. What never changes is packed once and put into every file again, up
// to 2,000 particles; beyond it would be a quarter of all memory, and packing it is little beside the steps between two
// frames. Tested by tests/specimens/frames/frame_test.cpp.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "solver/base/quantity.hpp"
#include "solver/base/vec2.hpp"
#include "specimens/frames/frame.hpp"
#include "specimens/frames/frame_forces.hpp"
#include "specimens/frames/placed_frame.hpp"
#include "specimens/frames/vtk_polydata.hpp"

namespace crackle {

/// What each file of a frame holds of the moment, and of each cell, in the order of the file.
std::span<const Quantity> frame_fields();
std::span<const Quantity> particle_arrays();
std::span<const Quantity> contact_arrays();
std::span<const Quantity> crack_arrays();
std::span<const Quantity> joint_arrays();

/// Corners of a circle drawn among so many particles.
int circle_corners(std::int64_t particles);
/// Corners of the regular polygon with the area of the unit circle, the first to the right.
std::vector<Vec2> unit_circle_outline(int corners);

enum class PointPrecision : std::uint8_t { single_, double_ };

/// Draws the frames of one test.
class FramePainter {
  public:
    /// Both must outlive the painter.
    FramePainter(const World& world, const TestSetup& setup, PointPrecision precision);
    bool paints(const World& world, const TestSetup& setup) const { return &world == &world_ && &setup == &setup_; }

    void write_particles(std::ostream& out, const PlacedFrame& placed, const FrameForces& forces) const;
    /// @param cracks  those that had come at the moment of the frame, here and below
    void write_contacts(std::ostream& out, const PlacedFrame& placed, const FrameForces& forces,
                        std::span<const Crack> cracks) const;
    void write_cracks(std::ostream& out, const PlacedFrame& placed, std::span<const Crack> cracks) const;
    void write_joints(std::ostream& out, const PlacedFrame& placed) const;

  private:
    template <class Visit>
    void visit_cells(const Visit& visit) const;
    template <class Visit>
    void visit_contacts(const LooseContacts& loose, const Visit& visit) const;
    void write_particle_cells(std::ostream& out) const;
    void write_contact_cells(std::ostream& out, const LooseContacts& loose) const;

    const World& world_;
    const TestSetup& setup_;
    PointPrecision precision_;
    std::vector<BodyIndex> order_;  // in which bodies are drawn
    std::vector<Vec2> outline_;     // of a circle
    VtpCounts particle_counts_;
    std::size_t centres_ = 0;  // of circles, from which contacts are drawn
    std::string particle_cells_,
        bond_cells_;  // what write_..._cells() write (without loose contacts), where it is kept
};

}  // namespace crackle
