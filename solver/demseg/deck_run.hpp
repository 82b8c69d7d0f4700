// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a DEMseg deck: reads its files, builds the world, runs the steps, and writes outputs and files from which the
// run can be continued.
//
// The output row of step n contains the positions x_n and the forces at these positions: it is written after n full
// steps and one more force pass. The new_* files contain the state before that last force pass, because the next run
// repeats it.
// Tested by tests/solver/demseg/deck_folder_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/demseg/boundary.hpp"
#include "solver/demseg/geometry.hpp"
#include "solver/files/file_set.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/world/world.hpp"

namespace crackle {

class DeckOutputs;
class DeckReader;
struct DeckLaws;
enum class OutputMode;

/// Input, output and settings of a deck run.
struct DeckOptions {
    std::filesystem::path folder;  ///< input folder, with in_gm.dat and in_bc.dat
    std::filesystem::path output;  ///< output folder; empty if it is the input folder
    bool goes_on = false;    ///< whether to continue from new_in_gm.dat and the other new_* files; if the output folder
                             ///< is the input folder, outputs are then appended
    bool overwrite = false;  ///< whether existing outputs may be replaced
    std::optional<std::int64_t> steps;  ///< number of steps, overriding nstep; ramps still take nstep steps
    std::optional<std::uint64_t> seed;  ///< seed of the random circles of mode 0; 1 if not given
    /// Law of segments. If not given, the law of the previous run according to its state file, or else the rounded law.
    std::optional<SegmentLaw> law;
    std::optional<Integrator> integrator;  ///< if not given, the integrator of the previous run, or else leapfrog
    bool allow_unstable = false;
    int threads = 1;
    /// Wall-clock time between saves of the new_* files, from which an interrupted run can be continued, s.
    double save_interval = 60.0;
};

/// A run of a deck, from its input files to its outputs.
class DeckRun {
  public:
    /// Reads and checks all input, without writing anything.
    /// @throws InputError if files cannot be used, or if outputs already exist
    explicit DeckRun(DeckOptions options);

    /// Runs to the end and writes the outputs. @param go_on called before every step; if it returns false, the run ends
    /// there and writes all its files
    /// @throws InputError if a file cannot be written; UnstableRun, after which the outputs written so far and the last
    /// saved new_* files remain. Files of an earlier run are unchanged until the first save.
    void run(const std::function<bool(const World&)>& go_on = {});

    /// The world at the current step, in the units of the deck.
    const World& world() const { return world_; }
    /// Notices for the user, one sentence each.
    const std::vector<std::string>& notices() const { return notices_; }
    /// Number of steps done by earlier parts of the run.
    std::int64_t first_step() const { return first_step_; }
    /// Step at which the run ends.
    std::int64_t last_step() const { return last_step_; }
    /// Output folder.
    std::filesystem::path output_folder() const { return options_.output.empty() ? options_.folder : options_.output; }

  private:
    struct Texts;  // the deck's files as read

    /// Files that may contain the state of the previous run.
    std::vector<std::filesystem::path> states() const;
    /// Contact law and integrator for a run that starts from text files. @param which index of the text file in which
    /// the identification of points depends on the contact law, if any
    DeckLaws laws_for(const Texts& texts, std::optional<std::size_t> which);
    /// The requested value of an option or, if not given, the value of the previous run. @param state file that
    /// contains the previous value
    template <class Choice>
    Choice chosen(const char* option, std::optional<Choice> asked, std::optional<Choice> before,
                  const std::filesystem::path& state);
    Scene scene_under(const DeckLaws& laws) const;
    void start_new(const Texts& texts);
    void start_from_contacts(const Texts& texts);
    bool start_from_state(const Texts& texts);
    void add_notices(const DeckReader& reader);
    void enter_steps_before();
    void find_bodies();
    void complete_earlier_run() const;
    void refuse_existing_outputs() const;
    void refuse_foreign_folder() const;
    bool appends() const { return options_.goes_on && options_.output.empty(); }
    std::filesystem::path input(const std::string& name) const;

    /// Whether write_rows() has anything to write at the current step.
    bool rows_due() const;
    void write_rows(DeckOutputs& outputs) const;
    /// Writes the bond breaks since the last call.
    void write_breaks(DeckOutputs& outputs);
    /// Writes the rows that are due, then runs one step.
    void do_step(DeckOutputs& outputs);
    void step_to_end(DeckOutputs& outputs, const std::function<bool(const World&)>& go_on);
    bool first_part() const { return asked_.start != DeckStart::continued; }
    OutputMode mode() const;
    /// Whether earlier outputs can no longer be kept. True if there are no earlier outputs, or a journal of their
    /// replacement exists, which the next run would complete.
    bool counts_as_done(const DeckOutputs& outputs) const;
    /// Removes the files that were to replace the earlier outputs. @return part of a message that says what happened to
    /// the earlier outputs
    std::string fate_of_earlier_outputs() const;
    bool finished() const { return world_.stepping.steps - boundary_.steps_before >= boundary_.steps; }
    Scene present_scene() const;
    BoundaryConditions boundary_for_next() const;
    /// Contents of new_in_gm.dat, new_in_bc.dat, new_in_cf.dat, new_in_cf0.dat and new_state.bin, by name.
    FileSet files_for_next() const;
    /// Flushes the outputs to disc and then replaces the earlier files with `files`. Staged outputs receive their final
    /// names as well.
    void save(const FileSet& files, DeckOutputs& outputs) const;

    DeckOptions options_;
    // Lock of the output folder. A run that continues in its input folder acquires the lock before reading the files.
    std::optional<FolderLock> lock_;
    BoundaryConditions asked_;  // contents of in_bc.dat for this part of the run
    bool drawn_ = false;        // whether the bodies were generated at random from the seed
    DeckGeometry base_;         // bodies at the start of the first part of the run
    // Boundary conditions at the start of the first part of the run; steps of ramps count from boundary_.steps_before.
    BoundaryConditions boundary_;
    World world_;
    std::vector<BodyIndex> order_;     // bodies in deck order
    std::vector<BodyIndex> watched_;   // bodies written to f-d_curve.dat
    std::vector<BodyIndex> velocity_;  // bodies written to velocity_y.dat
    std::vector<std::string> notices_;
    std::int64_t first_step_ = 0, last_step_ = 0;
    std::size_t breaks_written_ = 0;  // number of entries in Bonds::events that have been written
};

}  // namespace crackle
