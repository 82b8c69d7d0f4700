// SPDX-License-Identifier: GPL-3.0-or-later
// What joints have come to: share failed, opening and slip, by trace. Means are over the length of faces.
// Tested by tests/specimens/setup/trace_faces_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "specimens/observers/contact_history.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

struct TraceMotion {
    std::int64_t faces = 0;
    double length = 0.0;                               // m, of the faces together
    double bonded = 0.0, failed = 0.0;                 // m, of those with bonds at first; of these without any left
    double opening = 0.0, slip = 0.0;                  // m, means, trace_faces.hpp
    double largest_opening = 0.0, largest_slip = 0.0;  // m, of one face; of slips the largest in size, with its sign

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("faces", s.faces);
        visit("length", s.length);
        visit("bonded", s.bonded);
        visit("failed", s.failed);
        visit("opening", s.opening);
        visit("slip", s.slip);
        visit("largest_opening", s.largest_opening);
        visit("largest_slip", s.largest_slip);
    }

    /// Both together.
    void add(const TraceMotion& other);
};

/// Where the bodies of TestSetup::trace_faces are: all that is kept of every row that may be the peak.
std::vector<FacePlaces> places_of_faces(const World& world, const TestSetup& setup);

/// By number of trace. @param places of faces at the moment @param cracks until then
std::vector<TraceMotion> trace_motions(const TestSetup& setup, std::span<const FacePlaces> places,
                                       std::span<const Crack> cracks);

/// Those of the cracks that are on traces.
std::int64_t breaks_on_traces(const TestSetup& setup, std::span<const Crack> cracks);

}  // namespace crackle
