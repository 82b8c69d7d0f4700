// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of the specimen: what of a moment a picture needs, taken fast and held small; frame_painter.hpp draws it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/world.hpp"
#include "specimens/test_setup.hpp"

namespace crackle {

struct CurveRow;

/// A moment of a test. The one at the peak waits here until it is known to be the peak: 40 bytes a body, 17 a bond.
struct Frame {
    struct Body {
        double x, y, angle;  // m, rad
        double vx, vy;       // m/s
    };
    std::int64_t row = -1;  ///< of the curve; -1: no frame
    double axial_strain = 0.0, axial_stress = 0.0, time = 0.0;
    std::vector<Body> bodies;                       ///< as in the world
    std::vector<double> normal_force, shear_force;  ///< N, elastic, as TestSetup::bonds; 0 of broken ones
    std::vector<std::uint8_t> broken;               ///< likewise, 0 or 1
};

/// Takes the frames of one test.
class Camera {
  public:
    explicit Camera(const TestSetup& setup);
    /// Needs compute_forces() to have been called. Linear in bodies and listed points, 30 ns a particle.
    /// @param frame  receives the moment; its room is used again
    void take(const World& world, const CurveRow& row, std::int64_t row_index, Frame& frame) const;

  private:
    const TestSetup& setup_;
    std::vector<std::uint32_t> listed_;  // bonds in the order in which the world lists its points
};

/// Frames over max_axial_strain where the case does not say: 100 up to 2,000 bodies, beyond that 200,000 over their
/// number, but at least 20, and never more than rows of the curve. A frame costs what some thirty steps cost, and
/// 310 bytes a circle.
std::int64_t default_frames(std::int64_t bodies, std::int64_t curve_rows);

std::string particles_file(std::int64_t row);  ///< "particles_00042.vtp"
std::string bonds_file(std::int64_t row);

}  // namespace crackle
