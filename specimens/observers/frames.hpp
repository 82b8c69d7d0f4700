// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of the specimen for ParaView and the report: particles_NNNNN.vtp and bonds_NNNNN.vtp, NNNNN the row of
// curve.csv (from 0) in which they were taken, and frames.pvd over all of them.
//
// Particles: platens as lines, circles as 24-gons, polygons by their corners. Cell data: id,
// radius [m, 0 for polygons], material, angle [rad, turned since loading began], displacement [m], velocity [m/s].
// Bonds: all that loading began with, as lines centre-point-centre between circles and point-point between polygons.
// Cell data: normal_force [N, elastic, compression positive], shear_force [N], broken [0/1], body_i, body_j.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/world.hpp"
#include "specimens/observers/vtk_polydata.hpp"
#include "specimens/test_setup.hpp"

namespace crackle {

struct CurveRow;

/// A picture in memory: the one at the peak waits here until it is known to be the peak.
struct Frame {
    std::int64_t row = -1;  ///< of the curve; -1: no frame
    double axial_strain = 0.0, axial_stress = 0.0, time = 0.0;
    VtpData particles, bonds;
};

/// Needs compute_forces() to have been called.
Frame capture_frame(const World& world, const TestSetup& setup, const CurveRow& row, std::int64_t row_index);

std::string particles_file(std::int64_t row);  ///< "particles_00042.vtp"
std::string bonds_file(std::int64_t row);

}  // namespace crackle
