// SPDX-License-Identifier: GPL-3.0-or-later
// What a running test knows besides its world: the curve so far, the peak, the frames taken, where its files end.
// Together with the world and the setup this is all that a checkpoint holds.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "specimens/emission/listener.hpp"
#include "specimens/frames/frame.hpp"
#include "specimens/observers/contact_history.hpp"
#include "specimens/observers/curve.hpp"
#include "specimens/observers/peak_and_failure.hpp"
#include "specimens/results/growing_file.hpp"
#include "specimens/setup/loading_path.hpp"
#include "specimens/setup/loading_rate.hpp"
#include "specimens/setup/trace_faces.hpp"

namespace crackle {

/// A frame on disc.
struct FrameEntry {
    std::int64_t row = 0;
    double axial_strain = 0.0;
    double time = 0.0;  // s

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("row", s.row);
        visit("axial_strain", s.axial_strain);
        visit("time", s.time);
    }
};

/// How a test ended; words as in summary.json.
inline constexpr const char* ended_by_failure = "failure";
inline constexpr const char* ended_by_strain = "max_axial_strain";
inline constexpr const char* ended_by_caller = "caller";  // who looks at it, by TestHooks::look
inline constexpr const char* ended_by_interrupt = "interrupt";
inline constexpr const char* ended_by_instability = "instability";

struct TestState {
    std::vector<CurveRow> rows;
    FailureTracker failure;
    ContactHistory history;
    Frame peak_frame;                ///< waits until the peak is known; of large specimens TestFiles has it
    std::vector<FrameEntry> frames;  ///< written so far
    std::int64_t next_frame = 0;     ///< due at this multiple of the strain between frames
    RateState rate;                  ///< loading by tolerance
    LoadingPath path;
    std::int64_t breaks_in_shear = 0, breaks_in_tension = 0, breaks_after_sliding = 0;
    std::int64_t breaks_in_shear_to_peak = 0, breaks_in_tension_to_peak = 0;
    std::vector<FacePlaces> faces_at_peak;  ///< of the peak so far, of TestSetup::trace_faces
    std::string ended_by;                   ///< empty while the test runs

    // Of the specimen with all bonds intact and sticking (sparse solve); not a number where there is no solution.
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  // N/m
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
    double gauge_modulus = std::numeric_limits<double>::quiet_NaN();  ///< N/m, stress over strain of the gauge length
    double modulus_residual = std::numeric_limits<double>::quiet_NaN();  ///< of the solve, its relative error

    Emission emission;

    FileMark curve, events, slips, ae;              ///< the files at the checkpoint
    double wall_seconds = 0.0, step_seconds = 0.0;  ///< spent before this process
    std::string command;                            ///< that began the test

    /// Strain gone through, back and forth, up to the last row.
    double way() const { return rows.empty() ? 0.0 : path.travel(rows.back().axial_strain); }
    /// 1/s, of that; not a number before the first step.
    double mean_rate() const {
        return rows.empty() ? std::numeric_limits<double>::quiet_NaN() : way() / rows.back().time;
    }
    /// Of the strain that passed by tolerance the share with an error above it; not a number before the first step.
    double share_above_tolerance() const { return rate.strain_above / std::min(way(), path.own_from); }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("rows", s.rows);
        visit("failure", s.failure);
        visit("history", s.history);
        visit("peak_frame", s.peak_frame);
        visit("frames", s.frames);
        visit("next_frame", s.next_frame);
        visit("rate", s.rate);
        visit("path", s.path);
        visit("breaks_in_shear", s.breaks_in_shear);
        visit("breaks_in_tension", s.breaks_in_tension);
        visit("breaks_after_sliding", s.breaks_after_sliding);
        visit("breaks_in_shear_to_peak", s.breaks_in_shear_to_peak);
        visit("breaks_in_tension_to_peak", s.breaks_in_tension_to_peak);
        visit("faces_at_peak", s.faces_at_peak);
        visit("ended_by", s.ended_by);
        visit("youngs_modulus", s.youngs_modulus);
        visit("poissons_ratio", s.poissons_ratio);
        visit("gauge_modulus", s.gauge_modulus);
        visit("modulus_residual", s.modulus_residual);
        visit("emission", s.emission);
        visit("curve", s.curve);
        visit("events", s.events);
        visit("slips", s.slips);
        visit("ae", s.ae);
        visit("wall_seconds", s.wall_seconds);
        visit("step_seconds", s.step_seconds);
        visit("command", s.command);
    }
};

}  // namespace crackle
