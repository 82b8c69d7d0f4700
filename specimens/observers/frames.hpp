// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of the specimen: what of a moment a picture needs, taken fast and held small; frame_painter.hpp draws it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "solver/world.hpp"
#include "specimens/test_setup.hpp"

namespace crackle {

struct CurveRow;

/// A moment of a test. The one at the peak waits here until it is known to be the peak: 40 bytes a body, 9 a bond.
struct Frame {
    struct Body {
        double x, y, angle;  // m, rad
        double vx, vy;       // m/s
    };
    std::int64_t row = -1;  ///< of the curve; -1: no frame
    double axial_strain = 0.0, axial_stress = 0.0, time = 0.0;
    std::vector<Body> bodies;          ///< as in the world
    std::vector<double> shear_force;   ///< N, elastic, as TestSetup::bonds; 0 of broken ones
    std::vector<std::uint8_t> broken;  ///< likewise, 0 or 1
};

/// The present moment. Needs compute_forces() to have been called. Linear in bodies and listed points. While the stress
/// rises every row is a new peak: what takes longer, the forces normal to bonds, is left to who draws.
/// @param frame  receives the moment; its room is used again
void take_frame(const World& world, const TestSetup& setup, const CurveRow& row, std::int64_t row_index, Frame& frame);
/// k_n (δ - δ0) of all bonds, N, compression positive; 0 of broken ones. @param visit  called with each, in order
void visit_normal_forces(const World& world, const TestSetup& setup, const Frame& frame,
                         const std::function<void(double)>& visit);

/// Frames over max_axial_strain where the case does not say: 100 up to 2,000 bodies, beyond that 200,000 over their
/// number, but at least 20, and never more than rows of the curve. A frame costs what some thirty steps cost, and
/// 310 bytes a circle.
std::int64_t default_frames(std::int64_t bodies, std::int64_t curve_rows);

std::string particles_file(std::int64_t row);  ///< "particles_00042.vtp"
std::string bonds_file(std::int64_t row);

}  // namespace crackle
