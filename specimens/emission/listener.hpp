// SPDX-License-Identifier: GPL-3.0-or-later
// Acoustic emission while a test runs: clusters breaks into events and measures the moment of each source.
//
// A break opens an event: a source disc of the radius of one mean particle diameter about it, and a window of twice the
// time that a shear wave takes over that radius (a crack runs at about half its speed). A break inside both joins the
// oldest such event: the centre is then the mean place of the breaks, the disc reaches a diameter beyond the outermost
// of them, and the window begins anew with the new radius. The source's bodies are those that the breaks parted,
// platens excepted: these are part of what surrounds it. Its moment is
//     M_ij = Σ ΔF_i r_j    over the contact points between a source body and any other
// ΔF [N] the change of the elastic force on the other since just before the break that made the body one of the source,
// r [m] from the centre to the point; of a point between two source bodies both forces cancel. After Hazzard & Young
// (Int. J. Rock Mech. Min. Sci. 37, 2000; 41, 2004). Kept is the tensor of the largest scalar moment over the duration.
//
// Forces are those of the force passes, so that nothing is missed between two; in the pass that finds a break they are
// still those of before it, but for the bond's own, which its event has. The window means something only where masses
// are physical and damping is light: a damped particle does not ring, and waves die out within the source.
// Tested by tests/specimens/emission/listener_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "solver/world/world.hpp"
#include "specimens/emission/acoustic_event.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// How events are told apart; what a test's linear solution and its masses give.
struct EmissionRule {
    double diameter = 0.0;          // m, mean of the particles (of circles of their areas); 0: nothing is listened to
    double shear_wave_speed = 0.0;  // m/s, sqrt(G/ρ)
    bool mean_field = false;        ///< G is mean_field_shear_modulus(), else that of the linear solution
    double density = 0.0;           // kg/m2, of the specimen with its pores
    double damping_ratio = 0.0;     ///< mean over bonds of the normal dashpot over the critical one
    /// m, by which moments and energies of the world are multiplied before magnitudes are taken: in area units they are
    /// those of 1 m, in point units those of the plate as it is.
    double thickness = 1.0;

    bool on() const { return diameter > 0.0; }
    double window(double radius) const { return 2.0 * radius / shear_wave_speed; }  // s

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("diameter", s.diameter);
        visit("shear_wave_speed", s.shear_wave_speed);
        visit("mean_field", s.mean_field);
        visit("density", s.density);
        visit("damping_ratio", s.damping_ratio);
        visit("thickness", s.thickness);
    }
};

/// N/m, of the bonds between particles were all of these to move with one pure shear, none of them turning, over the
/// area of what is tested: but for the platens' bonds, which are left out, no less than the specimen's own (Voigt's
/// bound).
double mean_field_shear_modulus(const World& world, const TestSetup& setup);

/// G = E/(2 (1 + ν)), as it is in two dimensions, or the mean field's where these are not known.
/// @param youngs_modulus, poissons_ratio of the linear solution, NaN: there is none @param thickness m, out of plane
/// @throws InputError where there is no shear wave
EmissionRule emission_rule(const World& world, const TestSetup& setup, double youngs_modulus, double poissons_ratio,
                           double thickness);

/// Force of a point before the break that brought it into an event.
struct EarlierForce {
    PointKind kind = PointKind::circle_circle;
    ContactPoint point{};
    Vec2 force, place;  // N on body_i; m

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("kind", s.kind);
        visit("point", s.point);
        visit("force", s.force);
        visit("place", s.place);
    }
};

/// An event whose window has not ended.
struct OpenEvent {
    AcousticEvent event;               ///< its duration and moment so far
    std::vector<Vec2> places;          // m, of its breaks
    std::vector<BodyIndex> bodies;     ///< of the source, sorted
    std::vector<EarlierForce> before;  ///< of their points that bore something, by kind and key (point_order.hpp)

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("event", s.event);
        visit("places", s.places);
        visit("bodies", s.bodies);
        visit("before", s.before);
    }
};

/// Part of a test's state.
struct Emission {
    EmissionRule rule;
    std::vector<OpenEvent> open;        ///< in the order in which they began
    std::vector<AcousticEvent> events;  ///< in the order in which they ended

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("rule", s.rule);
        visit("open", s.open);
        visit("events", s.events);
    }
};

class EmissionListener {
  public:
    EmissionListener(const World& world, const TestSetup& setup, Emission& emission)
        : world_(world), setup_(setup), emission_(emission), surfaces_(emission.open.size()) {}

    /// Whether a force pass is to be listened to. @param broke found it a break
    bool hears(bool broke) const { return emission_.rule.on() && (broke || !emission_.open.empty()); }

    /// After a force pass, whether bodies have moved since or not. @param breaks that it found @param axial_strain then
    /// @return how many events ended before it: the last of Emission::events
    std::size_t listen(std::span<const BreakEvent> breaks, double axial_strain);
    /// Ends all events. @return how many
    std::size_t end_all();

  private:
    /// A point on the surface of a source.
    struct SurfacePoint {
        PointIndex point;
        bool of_i;           ///< body_i is the source's
        std::size_t before;  ///< into OpenEvent::before; npos: bore nothing then
    };
    /// Of an open event; found again where the list was built or it gained a body.
    struct Surface {
        bool found = false;
        std::vector<SurfacePoint> points;
        std::vector<std::size_t> gone;  ///< of OpenEvent::before those that are not listed any more
    };
    using PointRange = std::span<const PointIndex>;

    std::size_t end_before(double now);
    std::size_t event_of(const BreakEvent& one, double axial_strain);
    void add_break(std::size_t number, const BreakEvent& one, std::span<const BreakEvent> breaks);
    void add_body(OpenEvent& open, BodyIndex body, std::span<const BreakEvent> breaks);
    void list_points();
    PointRange points_of(BodyIndex body) const;
    Surface surface_of(const OpenEvent& open);
    MomentTensor moment_of(const OpenEvent& open, const Surface& surface) const;

    const World& world_;
    const TestSetup& setup_;
    Emission& emission_;
    std::vector<Surface> surfaces_;  // of Emission::open, in the same order
    std::int64_t list_builds_ = -1;
    std::vector<PointIndex> points_, points_begin_;  // by body: those of body b from points_begin_[b] on
    std::vector<char> marks_;                        // by body; 0 between calls
};

}  // namespace crackle
