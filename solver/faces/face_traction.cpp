// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/faces/face_traction.hpp"

#include <cmath>

#include "solver/faces/broken_face.hpp"
#include "solver/faces/hand_over.hpp"

namespace crackle {
namespace {

/// Linear stress along a face with a given normal force and moment. @param length m
FaceTraction linear(double length, double normal, double moment) {
    const double mean = normal / length, bending = 6.0 * moment / (length * length);
    return {0.5 * length, moment, mean - bending, mean + bending};
}

}  // namespace

FaceTraction traction_of_intact(const FaceSprings& s, const BondFaceMotion& m, double normal) {
    return linear(s.length, normal, s.moment() * m.turn);
}

FaceTraction traction_of_broken(const FaceSprings& s, const BondFaceMotion& m, double thick, double normal) {
    const double lap = 2.0 * half_lap_of(s, m);
    if (normal == 0.0 || lap == 0.0) return {0.5 * s.length};
    if (normal < 0.0) return linear(lap, normal, 0.0);
    const double share = 1.0 - share_of_points(s, m, thick), slope = share * s.normal / s.length * std::abs(m.turn);
    if (normal >= 0.5 * slope * lap * lap)
        return linear(lap, normal, std::copysign(slope * lap * lap * lap / 12.0, m.turn));
    const double closed = std::sqrt(2.0 * normal / slope), most = 2.0 * normal / closed,
                 least = most * (1.0 - lap / closed);
    const double moment = std::copysign(normal * (0.5 * lap - closed / 3.0), m.turn);
    return {0.5 * lap, moment, m.turn > 0.0 ? least : most, m.turn > 0.0 ? most : least};
}

}  // namespace crackle
