// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of the specimen: what of a moment a picture needs, taken fast and held small; frame_painter.hpp draws it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/files/scratch_file.hpp"
#include "solver/world/world.hpp"
#include "specimens/observers/contact_history.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

struct CurveRow;

/// What has become of a contact, as frames number it.
enum class ContactState : std::uint8_t {
    bonded = 0,
    bonded_slid = 1,  ///< has been at its Coulomb limit since bonding
    broken = 2,
    broken_touching = 3,  ///< broken, and its surfaces overlap again
    loose = 4,            ///< was never bonded
};

inline bool holds(ContactState state) { return state <= ContactState::bonded_slid; }

/// A moment of a test: 48 bytes a body, 9 a bond, 40 a contact without one.
struct Frame {
    /// Of a bond whose force the places of its bodies do not say: of flat faces, whose overlap without force follows
    /// their turning, and of one across a joint that broke and touches (LooseContact::joint_force).
    struct JointForce {
        PointIndex bond;
        double normal;

        template <class Self, class Visit>
        static constexpr void fields(Self& s, Visit&& visit) {
            visit("bond", s.bond);
            visit("normal", s.normal);
        }
    };
    struct Body {
        double x, y, angle;    // m, rad
        double vx, vy, omega;  // m/s, rad/s

        template <class Self, class Visit>
        static constexpr void fields(Self& s, Visit&& visit) {
            visit("x", s.x);
            visit("y", s.y);
            visit("angle", s.angle);
            visit("vx", s.vx);
            visit("vy", s.vy);
            visit("omega", s.omega);
        }
    };
    std::int64_t row = -1;  ///< of the curve; -1: no frame
    double axial_strain = 0.0, axial_stress = 0.0, time = 0.0;
    std::vector<Body> bodies;              ///< as in the world
    std::vector<double> shear_force;       ///< N, elastic, as TestSetup::bonds; 0 of broken ones that do not touch
    std::vector<ContactState> states;      ///< likewise
    LooseContacts loose;                   ///< of points that were never bonded
    std::uint64_t cracks = 0;              ///< so many have come first in ContactHistory::cracks
    std::vector<JointForce> joint_forces;  ///< by bond

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("row", s.row);
        visit("axial_strain", s.axial_strain);
        visit("axial_stress", s.axial_stress);
        visit("time", s.time);
        visit("bodies", s.bodies);
        visit("shear_force", s.shear_force);
        visit("states", s.states);
        visit("loose", s.loose);
        visit("cracks", s.cracks);
        visit("joint_forces", s.joint_forces);
    }
};

/// A moment whose largest arrays lie on the disc.
class FrameOnDisc {
  public:
    explicit FrameOnDisc(const std::filesystem::path& folder)
        : bodies_(folder), shear_force_(folder), states_(folder) {}

    void put(const Frame& frame);
    Frame whole();

  private:
    friend void take_frame(const World& world, const TestSetup& setup, const ContactHistory& history,
                           const CurveRow& row, std::int64_t row_index, FrameOnDisc& frame);

    Frame rest_;  // without the arrays below
    ScratchArray<Frame::Body> bodies_;
    ScratchArray<double> shear_force_;
    ScratchArray<ContactState> states_;
};

/// The present moment. Needs compute_forces() and look_at_contacts() to have been called. Linear in bodies and listed
/// points. While the stress rises every row is a new peak: what takes longer, the forces normal to contacts, is left to
/// who draws.
/// @param frame  receives the moment; its room is used again
void take_frame(const World& world, const TestSetup& setup, const ContactHistory& history, const CurveRow& row,
                std::int64_t row_index, Frame& frame);
/// The same, with no more of it in memory than a stretch.
void take_frame(const World& world, const TestSetup& setup, const ContactHistory& history, const CurveRow& row,
                std::int64_t row_index, FrameOnDisc& frame);

/// Frames over max_axial_strain where the case states none: 100 up to 2,000 bodies, beyond that 200,000 over their
/// number, but at least 20, and never more than rows of the curve. A frame costs what some thirty steps cost, and
/// 170 bytes a circle while it is drawn.
std::int64_t default_frames(std::int64_t bodies, std::int64_t curve_rows);

std::string particles_file(std::int64_t row);  ///< "particles_00042.vtp"
std::string contacts_file(std::int64_t row);
std::string cracks_file(std::int64_t row);
std::string joints_file(std::int64_t row);  ///< of jointed specimens
/// Whether a file of that name in frames/ is one of these.
bool is_picture(const std::string& name);

}  // namespace crackle
