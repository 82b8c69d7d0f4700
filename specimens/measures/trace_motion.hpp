// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of joints, by trace: failed length, opening and slip. Means are weighted by face length.
// Tested by tests/specimens/setup/trace_faces_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/base/fields.hpp"
#include "specimens/observers/contact_history.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Relative motion of the two sides of a trace.
struct TraceMotion {
    std::int64_t faces = 0;
    double length = 0.0;                // m, total length of the faces
    double bonded = 0.0, failed = 0.0;  // m, lengths of initially bonded faces, and of faces without bonds left
    double opening = 0.0, slip = 0.0;   // m, means over the faces; defined in trace_faces.hpp
    // Largest values of a single face, m; for slip, the value of largest magnitude, with its sign.
    double largest_opening = 0.0, largest_slip = 0.0;

    CRACKLE_FIELDS(faces, length, bonded, failed, opening, slip, largest_opening, largest_slip);

    /// Adds the values of another trace.
    void add(const TraceMotion& other);
};

/// Current positions of the bodies in BondRecord::trace_faces. They are stored for every row that may be the peak.
std::vector<FacePlaces> places_of_faces(const World& world, const BondRecord& bonds);

/// Motion of each trace since loading began, at a given time.
/// @param places  the positions of the faces' bodies at that time
/// @param cracks  the cracks formed up to that time
std::vector<TraceMotion> trace_motions(const BondRecord& bonds, std::span<const FacePlaces> places,
                                       std::span<const Crack> cracks);

/// Number of cracks that lie on traces.
std::int64_t breaks_on_traces(const BondRecord& bonds, std::span<const Crack> cracks);

}  // namespace crackle
