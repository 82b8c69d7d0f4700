// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/measures/trace_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace crackle {

void TraceMotion::add(const TraceMotion& other) {
    const double both = length + other.length;
    if (both > 0.0) {
        opening = (length * opening + other.length * other.opening) / both;
        slip = (length * slip + other.length * other.slip) / both;
    }
    largest_opening = faces == 0 ? other.largest_opening : std::max(largest_opening, other.largest_opening);
    if (std::abs(other.largest_slip) > std::abs(largest_slip)) largest_slip = other.largest_slip;
    faces += other.faces;
    length = both;
    bonded += other.bonded;
    failed += other.failed;
}

std::vector<FacePlaces> places_of_faces(const World& world, const BondRecord& bonds) {
    const auto place = [&](BodyIndex b) {
        const BodyState& body = world.bodies.state[b];
        return StartPlace{body.x, body.y, body.angle};
    };
    std::vector<FacePlaces> places;
    places.reserve(bonds.trace_faces.size());
    for (const TraceFace& face : bonds.trace_faces) places.push_back({place(face.i), place(face.j)});
    return places;
}

std::vector<TraceMotion> trace_motions(const BondRecord& bonds, std::span<const FacePlaces> places,
                                       std::span<const Crack> cracks) {
    std::vector<std::int32_t> broken(bonds.trace_faces.size(), 0);
    if (!bonds.traces.empty())
        for (const Crack& crack : cracks)
            if (const std::int32_t face = bonds.face_of_bond[crack.bond]; face >= 0)
                ++broken[static_cast<std::size_t>(face)];
    std::vector<TraceMotion> motions(bonds.traces.size());
    for (std::size_t k = 0; k < bonds.trace_faces.size(); ++k) {
        const TraceFace& face = bonds.trace_faces[k];
        if (face.length == 0.0) continue;
        const FaceMotion moved = motion_of(face, bonds.start_of(face), places[k]);
        motions[static_cast<std::size_t>(face.trace)].add(
            {.faces = 1,
             .length = face.length,
             .bonded = face.bonds > 0 ? face.length : 0.0,
             .failed = face.bonds > 0 && broken[k] == face.bonds ? face.length : 0.0,
             .opening = moved.opening,
             .slip = moved.slip,
             .largest_opening = moved.opening,
             .largest_slip = moved.slip});
    }
    return motions;
}

std::int64_t breaks_on_traces(const BondRecord& bonds, std::span<const Crack> cracks) {
    return std::ranges::count_if(cracks, [&](const Crack& crack) { return bonds.trace_of(crack.bond) >= 0; });
}

}  // namespace crackle
