// SPDX-License-Identifier: GPL-3.0-or-later
// What joints have come to: share failed, opening and slip, by trace. Means are over the length of faces.
// Tested by tests/specimens/setup/trace_faces_test.cpp.
#pragma once

#include <cstdint>
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

/// At the present moment, by number of trace.
std::vector<TraceMotion> trace_motions(const World& world, const TestSetup& setup, const ContactHistory& history);

/// Bonds that broke on traces, of the first `count` of ContactHistory::cracks.
std::int64_t breaks_on_traces(const TestSetup& setup, const ContactHistory& history, std::size_t count);

}  // namespace crackle
