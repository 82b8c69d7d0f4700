// SPDX-License-Identifier: GPL-3.0-or-later
// Acoustic emission during a test: groups breaks into events and measures the moment tensor of each source.
//
// A break opens an event: a source disc and a window. The radius of the disc is one mean particle diameter. The window
// is twice the time that a shear wave takes to cross that radius (a crack runs at about half the shear wave speed). A
// later break inside the disc and the window joins the event, or the oldest of several such events. The centre then
// moves to the mean position of the breaks, the disc extends one diameter beyond the outermost break, and the window
// starts again for the new radius. The source's bodies are those that the breaks separated, except platens, which
// belong to the surroundings. Its moment is
//       M_ij = Σ ΔF_i r_j    over the contact points between a source body and any other
// where ΔF [N] is the change of the elastic force on the other body, measured from just before the break that made the
// source body part of the event. The arm r [m] leads from the centre to the point. Forces at a point between two source
// bodies cancel. The tensor with the largest scalar moment during the event is kept. The method follows Hazzard & Young
// (Int. J. Rock Mech. Min. Sci. 37, 2000; 41, 2004).
//
// A face between two polygons (bond.law = "face") counts as two contact points at its ends. Each has half its force;
// its moment is a pair of forces at both. A break changes the pressures of its two cells in the same pass. The forces
// on their other faces «just before» the break already contain that change.
//
// Forces are recorded each time they have been computed, so no break is missed. When a break is detected, all other
// forces are still those before the break. The force of the broken bond is taken from the record of the break. The
// window is meaningful only if masses are physical and damping is light. Otherwise particles do not vibrate, and waves
// are damped out within the source.
// Tested by tests/specimens/emission/listener_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/world/world.hpp"
#include "specimens/emission/acoustic_event.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Parameters that group breaks into events, from a test's linear solution and its masses.
struct EmissionRule {
    double diameter = 0.0;          // m, mean particle diameter (of circles of equal area); 0: emission is off
    double shear_wave_speed = 0.0;  // m/s, sqrt(G/ρ)
    bool mean_field = false;        ///< whether G is mean_field_shear_modulus() rather than that of the linear solution
    double density = 0.0;           // mass per area of the specimen including its pores, kg/m2
    double damping_ratio = 0.0;     ///< mean over bonds of the normal dashpot relative to critical damping
    /// Factor on moments and energies before magnitudes are computed, m. In area units, magnitudes refer to a thickness
    /// of 1 m; in point units, to the actual plate.
    double thickness = 1.0;

    /// Whether events are recorded.
    bool on() const { return diameter > 0.0; }
    /// Duration for which a source stays open after a break, s. @param radius  radius of the source, m
    double window(double radius) const { return 2.0 * radius / shear_wave_speed; }

    CRACKLE_FIELDS(diameter, shear_wave_speed, mean_field, density, damping_ratio, thickness);
};

/// Shear modulus of the bonds between particles, N/m, averaged over the tested area, if all particles moved with a
/// uniform pure shear and did not rotate. Bonds to platens are left out. Apart from these, it is an upper bound on the
/// specimen's modulus (Voigt).
double mean_field_shear_modulus(const World& world, const TestSetup& setup);

/// Emission rule with G = E/(2 (1 + ν)), as in two dimensions, or with mean_field_shear_modulus() if E or ν is unknown.
/// @param youngs_modulus, poissons_ratio  results of the linear solution; NaN if there is no solution
/// @param thickness  out of plane, m
/// @throws InputError if the shear modulus is not positive
EmissionRule emission_rule(const World& world, const TestSetup& setup, double youngs_modulus, double poissons_ratio,
                           double thickness);

/// Force at a contact point just before the break that made one of its bodies part of an event.
struct EarlierForce {
    PointKind kind = PointKind::circle_circle;
    ContactPoint point{};
    Vec2 force, place;  // force on body_i, N, and its position, m

    CRACKLE_FIELDS(kind, point, force, place);
};

/// An event whose window has not ended.
struct OpenEvent {
    AcousticEvent event;            ///< the event, with its duration and moment up to now
    std::vector<Vec2> places;       // m, positions of the event's breaks
    std::vector<BodyIndex> bodies;  ///< bodies of the source, sorted
    /// Forces just before the breaks at the loaded contact points of the source, sorted by kind and key
    /// (point_order.hpp).
    std::vector<EarlierForce> before;

    CRACKLE_FIELDS(event, places, bodies, before);
};

/// Events and rule of a test; part of the test's saved state.
struct Emission {
    EmissionRule rule;
    std::vector<OpenEvent> open;        ///< ordered by the time at which they began
    std::vector<AcousticEvent> events;  ///< ordered by the time at which they ended

    CRACKLE_FIELDS(rule, open, events);
};

/// Groups breaks into acoustic events while a test runs.
class EmissionListener {
  public:
    /// @param emission  state to continue from; all three arguments must outlive the listener
    EmissionListener(const World& world, const TestSetup& setup, Emission& emission)
        : world_(world), setup_(setup), emission_(emission), surfaces_(emission.open.size()) {}

    /// Whether listen() must be called after forces were computed. @param broke  whether a break was found
    bool must_listen(bool broke) const { return emission_.rule.on() && (broke || !emission_.open.empty()); }

    /// Updates the events after forces were computed; bodies may have moved since. @param breaks  breaks found then
    /// @param axial_strain  axial strain at which forces were computed
    /// @return number of events that ended before that time; they are the last ones in Emission::events
    std::size_t listen(std::span<const BreakEvent> breaks, double axial_strain);
    /// Ends all open events. @return number of events ended
    std::size_t end_all();

  private:
    /// A contact point between a source and its surroundings.
    struct SurfacePoint {
        PointIndex point;
        bool of_i;           ///< whether body_i belongs to the source
        std::size_t before;  ///< index into OpenEvent::before; npos if the point carried no force before the break
    };
    /// Surface of an open event's source. It is updated when the contact list is rebuilt or a body joins the event.
    struct Surface {
        bool found = false;
        std::vector<SurfacePoint> points;
        /// Indices into OpenEvent::before of points that are no longer in the contact list.
        std::vector<std::size_t> gone;
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
    std::vector<Surface> surfaces_;  // surfaces of Emission::open, in the same order
    std::int64_t list_builds_ = -1;
    // Points of all bodies, body after body: those of body b begin at points_[points_begin_[b]].
    std::vector<PointIndex> points_, points_begin_;
    std::vector<char> marks_;  // scratch memory, by body; all 0 between calls
};

}  // namespace crackle
