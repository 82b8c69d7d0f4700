// SPDX-License-Identifier: GPL-3.0-or-later
// The files written during a test: curve.csv, events.csv, frames/, the checkpoint, and finally summary.json.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>

#include "specimens/frames/frame_painter.hpp"
#include "specimens/recordings/stated_files.hpp"
#include "specimens/results/background.hpp"
#include "specimens/results/growing_file.hpp"
#include "specimens/results/make_summary.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/results/result_tables.hpp"

namespace crackle {

/// Writes summary.json. It records the given lengths and hashes of files (stated_files.hpp), and the length and hash of
/// the checkpoint, if it exists.
void write_summary(const OutputFolder& folder, Summary& summary, FileMarks files);

/// The files of a test while it runs.
class TestFiles {
  public:
    /// Starts the files of a new test. For a resumed test, continues the files from the checkpoint and removes
    /// everything written after it.
    TestFiles(const OutputFolder& folder, std::string case_hash, TestState& state, const FileOptions& options);

    /// Adds a row to curve.csv.
    void add_row(const CurveRow& row);
    /// @param trace  index of the trace on which the bond broke, or -1
    void add_event(const BreakEvent& event, double axial_strain, std::int32_t trace);
    /// Adds a line to a table, unless the test has no such table. @param line  including the line end
    void add(ResultTable table, const std::string& line);
    /// Takes a frame of the current state, as take_frame() does, and adds it to state.frames in the order of rows. The
    /// frame's files are written in the background; they are complete before a checkpoint or a summary is written.
    /// frames.pvd is replaced at most once a second, and before a checkpoint or a summary, because replacing a file
    /// costs more than a frame of a small specimen. World and setup must outlive this object.
    void add_frame(const CurveRow& row, std::int64_t row_index, const TestSetup& setup, TestState& state,
                   const World& world);
    /// Stores the current state as the frame of the peak, instead of the previous one; while the stress rises, every
    /// row is a new peak. The frame is stored in state.peak_frame, or on disk for a large specimen.
    void keep_peak(const CurveRow& row, std::int64_t row_index, const TestSetup& setup, TestState& state,
                   const World& world);
    /// Adds the frame that keep_peak() stored last, if any, as add_frame() does.
    void add_peak(const TestSetup& setup, TestState& state, const World& world);
    /// Flushes the files, records their lengths in the state, and writes the checkpoint once all data are on disk.
    void write_checkpoint(const TestSetup& setup, TestState& state, const World& world);
    /// Flushes without writing a checkpoint. Used for a run that has become unstable; its last checkpoint stays valid.
    void flush();
    /// Writes summary.json, with the lengths and hashes of all files of the test.
    void write_summary(Summary& summary, const TestState& state);

  private:
    /// Adds a frame to the list. @return whether it must be drawn, because it was not in the list yet
    bool list_frame(const FrameEntry& entry, const TestSetup& setup, TestState& state, const World& world);
    void draw(Frame frame, const TestSetup& setup, const TestState& state, const World& world);
    TableMarks marks() const;
    std::string due_collection(const TestState& state);
    void write_collection(const TestState& state);

    const OutputFolder& folder_;
    std::string case_hash_;
    FileOptions options_;
    std::array<std::optional<GrowingFile>, result_tables> tables_;  // files of the tables that this test writes
    std::optional<FrameOnDisc> peak_on_disc_;  // for large specimens, used instead of TestState::peak_frame
    std::optional<FramePainter> painter_;      // exists once there is a frame
    bool collection_due_;                      // whether frames.pvd is older than the state
    std::chrono::steady_clock::time_point collected_;
    Background background_;  // last member, so that its jobs end before the other members are destroyed
};

}  // namespace crackle
