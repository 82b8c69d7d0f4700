// SPDX-License-Identifier: GPL-3.0-or-later
// Writes frames as files for ParaView and the report: particles_, contacts_ and cracks_NNNNN.vtp, and joints_ for
// jointed specimens. NNNNN is the zero-based curve row at which the frame was taken; frames.pvd lists all files (parts
// 0 to 3).
//
// Particles: platens are lines, polygons keep their corners, and circles are regular polygons of equal area. Circles
// have 24 corners for up to 2,000 particles, and 12 for more, which are viewed from farther away. With 12 corners, the
// area of the intersection of polygon and circle is 0.98 of that of their union; with 24, it is 0.996. True circles can
// be drawn with `radius` about the mean of the corners. All circles of a clump have the clump's values.
// Contacts: first all bonds at the start of loading, always in the same order and at the points where they were
// attached; then all other current contacts. A contact is a line: centre-point-centre between circles, point-point
// between polygons, and from end to end of a face by which polygons are bonded.
// Cracks: a line for each bonded point that has broken, in the order of events.csv, positioned by crack_faces.hpp.
// Joints: a line for each face on a trace, with its length at the start of loading (trace_faces.hpp).
// Cell data and their units are listed by particle_arrays(), contact_arrays(), crack_arrays() and joint_arrays().
// Forces and stresses are those of the springs only (frame_forces.hpp). fragments.hpp describes fragments, and
// contact_history.hpp the ages of contacts.
//
// Points are Float32 (resolution about 1e-8 of the specimen) or Float64, computed values Float64, ids and indices Int32
// (indices Int64 beyond 2³¹), state and mode UInt8. For up to 2,000 particles, arrays that never change are compressed
// once and written to every file. For more particles, keeping them would take a quarter of all memory, and compressing
// them each time costs little compared with the steps between two frames.
// Tested by tests/specimens/frames/frame_test.cpp.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "solver/base/vec2.hpp"
#include "solver/faces/face_traction.hpp"
#include "specimens/frames/frame.hpp"
#include "specimens/frames/frame_forces.hpp"
#include "specimens/frames/placed_frame.hpp"
#include "specimens/frames/vtk_polydata.hpp"

namespace crackle {

/// Number of corners of a circle's polygon in files with `particles` particles.
int circle_corners(std::int64_t particles);
/// Corners of the regular polygon whose area equals that of the unit circle. The first corner lies on the +x axis.
std::vector<Vec2> unit_circle_outline(int corners);

/// Writes the frames of one test.
class FramePainter {
  public:
    /// The world and the setup must outlive the painter.
    FramePainter(const World& world, const TestSetup& setup, FramePrecision precision);
    /// Whether this painter was made for the given world and setup.
    bool paints(const World& world, const TestSetup& setup) const { return &world == &world_ && &setup == &setup_; }

    /// Writes particles_NNNNN.vtp.
    void write_particles(std::ostream& out, const PlacedFrame& placed, const FrameForces& forces) const;
    /// Writes contacts_NNNNN.vtp. @param cracks  cracks that exist at the time of the frame
    void write_contacts(std::ostream& out, const PlacedFrame& placed, const FrameForces& forces,
                        std::span<const Crack> cracks) const;
    /// Writes cracks_NNNNN.vtp. @param cracks  cracks that exist at the time of the frame
    void write_cracks(std::ostream& out, const PlacedFrame& placed, std::span<const Crack> cracks) const;
    /// Writes joints_NNNNN.vtp.
    void write_joints(std::ostream& out, const PlacedFrame& placed) const;

  private:
    template <class Visit>
    void visit_cells(const Visit& visit) const;
    template <class Visit>
    void visit_contacts(const LooseContacts& loose, const Visit& visit) const;
    void write_particle_cells(std::ostream& out) const;
    void write_contact_points(std::ostream& out, const PlacedFrame& placed, std::size_t count,
                              std::span<const FaceTraction> tractions) const;
    void write_contact_cells(std::ostream& out, const LooseContacts& loose) const;

    const World& world_;
    const TestSetup& setup_;
    FramePrecision precision_;
    std::vector<BodyIndex> order_;  // order of the bodies in files
    std::vector<Vec2> outline_;     // polygon that represents the unit circle
    VtpCounts particle_counts_;
    std::size_t centres_ = 0;  // number of circle centres, at which contacts end
    // Cached output of write_particle_cells() and write_contact_cells() (without loose contacts), or empty.
    std::string particle_cells_, bond_cells_;
};

}  // namespace crackle
