// SPDX-License-Identifier: GPL-3.0-or-later
// State of a running test apart from its world: its curve and peak, the frames taken, and the lengths of its files.
// Together with the world and the setup it forms the complete contents of a checkpoint.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "solver/base/fields.hpp"
#include "specimens/emission/listener.hpp"
#include "specimens/frames/frame.hpp"
#include "specimens/observers/contact_history.hpp"
#include "specimens/observers/curve.hpp"
#include "specimens/observers/peak_and_failure.hpp"
#include "specimens/results/result_tables.hpp"
#include "specimens/setup/loading_path.hpp"
#include "specimens/setup/loading_rate.hpp"
#include "specimens/setup/trace_faces.hpp"

namespace crackle {

/// A frame that has been written.
struct FrameEntry {
    std::int64_t row = 0;
    double axial_strain = 0.0;
    double time = 0.0;  // s

    CRACKLE_FIELDS(row, axial_strain, time);
};

/// How a test ended, as written in summary.json.
inline constexpr const char* ended_by_failure = "failure";
inline constexpr const char* ended_by_strain = "max_axial_strain";
inline constexpr const char* ended_by_caller = "caller";  // TestHooks::look ended the test
inline constexpr const char* ended_by_interrupt = "interrupt";
inline constexpr const char* ended_by_instability = "instability";

/// State of a test that is kept between steps, apart from its world.
struct TestState {
    std::vector<CurveRow> rows;
    FailureTracker failure;
    ContactHistory history;
    Frame peak_frame;                ///< frame at the current peak; for large specimens, TestFiles stores it
    std::vector<FrameEntry> frames;  ///< frames that have been written
    std::int64_t next_frame =
        0;           ///< index of the next frame, which is taken at this multiple of the strain between frames
    RateState rate;  ///< used only if the loading rate is controlled by a tolerance
    LoadingPath path;
    std::int64_t breaks_in_shear = 0, breaks_in_tension = 0, breaks_after_sliding = 0;
    std::int64_t breaks_in_shear_to_peak = 0, breaks_in_tension_to_peak = 0;
    std::vector<FacePlaces> faces_at_peak;  ///< positions of the bodies of BondRecord::trace_faces at the current peak
    std::string ended_by;                   ///< empty while the test runs

    // Moduli of the specimen with all bonds intact and without sliding (linear solution); NaN if there is no solution.
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  // N/m
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
    double gauge_modulus =
        std::numeric_limits<double>::quiet_NaN();  ///< stress divided by the strain of the gauge length, N/m
    double modulus_residual = std::numeric_limits<double>::quiet_NaN();  ///< relative residual of the linear solution

    Emission emission;

    TableMarks tables;                              ///< lengths and hashes of the tables at the checkpoint
    double wall_seconds = 0.0, step_seconds = 0.0;  ///< time that earlier processes spent, s
    std::string command;                            ///< command line that started the test

    /// Total strain travelled, back and forth, up to the last row.
    double way() const { return rows.empty() ? 0.0 : path.travel(rows.back().axial_strain); }
    /// Mean rate of the travelled strain, 1/s; NaN before the first step.
    double mean_rate() const {
        return rows.empty() ? std::numeric_limits<double>::quiet_NaN() : way() / rows.back().time;
    }
    /// Fraction of the travelled strain during which the inertia error exceeded the tolerance; NaN before the first
    /// step. Only strain for which the tolerance controlled the loading rate counts.
    double share_above_tolerance() const { return rate.strain_above / std::min(way(), path.own_from); }

    CRACKLE_FIELDS(rows, failure, history, peak_frame, frames, next_frame, rate, path, breaks_in_shear,
                   breaks_in_tension, breaks_after_sliding, breaks_in_shear_to_peak, breaks_in_tension_to_peak,
                   faces_at_peak, ended_by, youngs_modulus, poissons_ratio, gauge_modulus, modulus_residual, emission,
                   tables, wall_seconds, step_seconds, command);
};

}  // namespace crackle
