// SPDX-License-Identifier: GPL-3.0-or-later
// The files that grow while a test runs: curve.csv, events.csv, frames/, checkpoint, and summary.json at the end.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "specimens/frames/frame_painter.hpp"
#include "specimens/recordings/stated_files.hpp"
#include "specimens/results/background.hpp"
#include "specimens/results/growing_file.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/results/summary.hpp"

namespace crackle {

/// Writes summary.json, which states these files (stated_files.hpp) and the checkpoint, if there is one.
void write_summary(const OutputFolder& folder, TestSummary& summary, FileMarks files);

struct FileOptions {
    PointPrecision precision = PointPrecision::single_;  ///< of frames
    bool slips = false;                                  ///< slips.csv is written
    bool pressed = false, jointed = false;               ///< the curve, the events, have the columns of such a test
    std::size_t large_frame = 200'000;  ///< bodies from which on the frame at the peak waits on the disc
};

class TestFiles {
  public:
    /// Begins from the start (state without rows) or goes on from the state, removing what came after it.
    /// ae.csv is written where the state says that emission is listened to.
    TestFiles(const OutputFolder& folder, std::string case_hash, TestState& state, const FileOptions& options);

    void add_row(const CurveRow& row);
    /// @param trace number of that on which it broke, or -1
    void add_event(const BreakEvent& event, double axial_strain, std::int32_t trace);
    void add_slip(const SlipEvent& event, double axial_strain);
    void add_emission(const AcousticEvent& event, double thickness);
    /// Takes the present moment for a frame, as take_frame(). Lists it in state.frames, in the order of rows, and has
    /// its pictures written beside the stepping: they are there, all of them, before a checkpoint or a summary is.
    /// frames.pvd follows within a second, or then: replacing a file costs more than a small specimen's frame. World
    /// and setup must outlive these files.
    void add_frame(const CurveRow& row, std::int64_t row_index, const TestSetup& setup, TestState& state,
                   const World& world);
    /// Keeps the present moment: the peak so far. While the stress rises every row is one. In state.peak_frame, of a
    /// large specimen on the disc.
    void keep_peak(const CurveRow& row, std::int64_t row_index, const TestSetup& setup, TestState& state,
                   const World& world);
    /// The frame kept last, if there is one, as add_frame().
    void add_peak(const TestSetup& setup, TestState& state, const World& world);
    /// Flushes the growing files, notes how far they go in the state, and writes the checkpoint when all is on the
    /// disc.
    void write_checkpoint(const TestSetup& setup, TestState& state, const World& world);
    /// Without a checkpoint: for a run that has gone wrong, whose last good checkpoint stays.
    void flush();
    void write_summary(TestSummary& summary, const TestState& state);

  private:
    /// Whether it is to be drawn: it was not before.
    bool list_frame(const FrameEntry& entry, const TestSetup& setup, TestState& state, const World& world);
    void draw(Frame frame, const TestSetup& setup, const TestState& state, const World& world);
    std::string due_collection(const TestState& state);
    void write_collection(const TestState& state);

    const OutputFolder& folder_;
    std::string case_hash_;
    FileOptions options_;
    GrowingFile curve_, events_;
    std::optional<GrowingFile> slips_, ae_;
    std::optional<FrameOnDisc> peak_on_disc_;  // in place of TestState::peak_frame
    std::optional<FramePainter> painter_;      // once there is a frame
    bool collection_due_;                      // frames.pvd is not of the state
    std::chrono::steady_clock::time_point collected_;
    Background background_;  // last: what it still has to do needs the others
};

}  // namespace crackle
