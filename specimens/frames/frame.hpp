// SPDX-License-Identifier: GPL-3.0-or-later
// Frames: the data needed to plot the specimen at one moment, in compact form. frame_painter.hpp writes them to files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/files/scratch_file.hpp"
#include "solver/world/world.hpp"
#include "specimens/observers/contact_history.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

struct CurveRow;

/// State of a contact; the values are written to frames.
enum class ContactState : std::uint8_t {
    bonded = 0,
    bonded_slid = 1,  ///< bonded; the Coulomb limit was reached at least once
    broken = 2,
    broken_touching = 3,  ///< broken; the surfaces overlap again
    loose = 4,            ///< never bonded
};

/// Whether a contact in the given state is bonded.
inline bool holds(ContactState state) { return state <= ContactState::bonded_slid; }

/// State of a test at one moment: 48 bytes per body, 9 per bond, 40 per contact without a bond.
struct Frame {
    /// Normal force of a bond that cannot be computed from the positions of its bodies. This applies to flat faces,
    /// because their force-free overlap depends on their rotation. It also applies to broken bonds across a joint whose
    /// surfaces touch (LooseContact::joint_force).
    struct JointForce {
        PointIndex bond;
        double normal;

        CRACKLE_FIELDS(bond, normal);
    };
    /// Position and velocity of a body.
    struct Body {
        double x, y, angle;    // m, rad
        double vx, vy, omega;  // m/s, rad/s

        CRACKLE_FIELDS(x, y, angle, vx, vy, omega);
    };
    std::int64_t row = -1;  ///< row of the curve; -1 if there is no frame
    double axial_strain = 0.0, axial_stress = 0.0, time = 0.0;
    std::vector<Body> bodies;  ///< the bodies in the order of World::bodies
    /// Elastic shear force, N, in the order of BondRecord::points; 0 for broken bonds whose surfaces do not touch.
    std::vector<double> shear_force;
    std::vector<ContactState> states;  ///< states of the bonds, in the order of BondRecord::points
    LooseContacts loose;               ///< contacts that were never bonded
    /// Number of cracks at this moment; they are the first entries of ContactHistory::cracks.
    std::uint64_t cracks = 0;
    std::vector<JointForce> joint_forces;  ///< ordered by bond

    CRACKLE_FIELDS(row, axial_strain, axial_stress, time, bodies, shear_force, states, loose, cracks, joint_forces);
};

/// A frame whose largest arrays are stored on disk.
class FrameOnDisc {
  public:
    /// An empty frame. @param folder  folder of the unnamed files with the arrays
    explicit FrameOnDisc(const std::filesystem::path& folder)
        : bodies_(folder), shear_force_(folder), states_(folder) {}

    /// Stores a copy of a frame.
    void put(const Frame& frame);
    /// Returns the whole frame, in memory.
    Frame whole();

  private:
    friend void take_frame(const World& world, const BondRecord& bonds, const ContactHistory& history,
                           const CurveRow& row, std::int64_t row_index, FrameOnDisc& frame);

    Frame rest_;  // the frame without the arrays below
    ScratchArray<Frame::Body> bodies_;
    ScratchArray<double> shear_force_;
    ScratchArray<ContactState> states_;
};

/// Takes a frame of the current state. Call compute_forces() and look_at_contacts() first. The cost is linear in the
/// numbers of bodies and listed points. The expensive part, the normal forces of contacts, is left to find_forces().
/// While the stress rises, a frame is taken at every row, but most of these frames are never written.
/// @param frame  receives the data; its memory is reused
void take_frame(const World& world, const BondRecord& bonds, const ContactHistory& history, const CurveRow& row,
                std::int64_t row_index, Frame& frame);
/// Takes a frame while holding only part of it in memory.
void take_frame(const World& world, const BondRecord& bonds, const ContactHistory& history, const CurveRow& row,
                std::int64_t row_index, FrameOnDisc& frame);

/// Default number of frames up to max_axial_strain. It is 100 for up to 2,000 bodies, and 200,000 divided by the number
/// of bodies above that. It is at least 20, but at most the number of curve rows. Writing a frame takes about as long
/// as thirty steps, and needs 170 bytes of memory per circle.
std::int64_t default_frames(std::int64_t bodies, std::int64_t curve_rows);

/// Name of the particle file, e.g. "particles_00042.vtp".
std::string particles_file(std::int64_t row);
/// Name of the contact file, e.g. "contacts_00042.vtp".
std::string contacts_file(std::int64_t row);
/// Name of the crack file, e.g. "cracks_00042.vtp".
std::string cracks_file(std::int64_t row);
/// Name of the file of joint faces, e.g. "joints_00042.vtp"; jointed specimens only.
std::string joints_file(std::int64_t row);
/// Whether a file with this name in frames/ belongs to a frame.
bool is_picture(const std::string& name);

}  // namespace crackle
