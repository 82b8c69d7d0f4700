// SPDX-License-Identifier: GPL-3.0-or-later
// A DEMseg deck from its files to its outputs: reads, builds the world, steps it, writes, and leaves the files with
// which the run goes on.
//
// The row of step n shows positions x_n and the forces there: n full steps, then the force pass, then the row. What
// goes into new_* is the state before that last force pass, for the next run does it again.
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

struct DeckOptions {
    std::filesystem::path folder;  ///< of in_gm.dat and in_bc.dat
    std::filesystem::path output;  ///< empty: the same folder
    bool goes_on = false;    ///< start from new_in_gm.dat and its fellows; in the same folder, outputs are appended
    bool overwrite = false;  ///< existing outputs may be replaced
    std::optional<std::int64_t> steps;     ///< do so many instead of nstep; ramps keep the length nstep
    std::optional<std::uint64_t> seed;     ///< of mode 0; 1 if not given
    std::optional<SegmentLaw> law;         ///< if not given that of the run before, which its state tells, or rounded
    std::optional<Integrator> integrator;  ///< likewise, or leapfrog
    bool allow_unstable = false;
    int threads = 1;
    double save_interval = 60.0;  ///< s of wall clock, after which new_* is written, to go on from should the run stop
};

class DeckRun {
  public:
    /// Reads and checks everything, and writes nothing.
    /// @throws InputError on files that cannot be used, and on outputs that are there already.
    explicit DeckRun(DeckOptions options);

    /// Steps to the end and writes. @param go_on asked before every step; on false the run ends there, with all its
    /// files.
    /// @throws InputError if something cannot be written; UnstableRun, after which the outputs so far are there, and
    /// new_* as they were last saved. Until they are first saved the files of an earlier run are as they were.
    void run(const std::function<bool(const World&)>& go_on = {});

    const World& world() const { return world_; }
    /// What the user should know, one sentence each.
    const std::vector<std::string>& notices() const { return notices_; }
    std::int64_t first_step() const { return first_step_; }
    std::int64_t last_step() const { return last_step_; }
    std::filesystem::path output_folder() const { return options_.output.empty() ? options_.folder : options_.output; }

  private:
    struct Texts;  // the deck's files as read

    /// Files that may hold the state of the run before.
    std::vector<std::filesystem::path> states() const;
    /// Contact law and integrator of a run that begins from text files. @param which text that was read under a law, if
    /// the deck has one
    DeckLaws laws_for(const Texts& texts, std::optional<std::size_t> which);
    /// What was asked for, else what the run before had. @param state in which that is
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
    bool appends() const { return options_.goes_on && options_.output.empty(); }
    std::filesystem::path input(const std::string& name) const;

    /// Whether write_rows() has something to write at the present step.
    bool rows_due() const;
    void write_rows(DeckOutputs& outputs) const;
    /// Bonds that have broken since the last call.
    void write_breaks(DeckOutputs& outputs);
    /// One step, with the rows that are due before it.
    void do_step(DeckOutputs& outputs);
    void step_to_end(DeckOutputs& outputs, const std::function<bool(const World&)>& go_on);
    bool first_part() const { return asked_.start != DeckStart::continued; }
    OutputMode mode() const;
    bool finished() const { return world_.stepping.steps - boundary_.steps_before >= boundary_.steps; }
    Scene present_scene() const;
    BoundaryConditions boundary_for_next() const;
    /// Contents of new_in_gm.dat, new_in_bc.dat, new_in_cf.dat, new_in_cf0.dat and new_state.bin, by name.
    FileSet files_for_next() const;
    /// Puts them in the place of the earlier ones, once the outputs are on the disc, which get their own names with it.
    void save(const FileSet& files, DeckOutputs& outputs) const;

    DeckOptions options_;
    // Of the output folder, from before its files are read where the run goes on there.
    std::optional<FolderLock> lock_;
    BoundaryConditions asked_;     // in_bc.dat of this run
    bool drawn_ = false;           // its bodies, by the seed
    DeckGeometry base_;            // bodies as they were when the run, all parts of it, began
    BoundaryConditions boundary_;  // and its conditions: ramps are counted from its steps_before
    World world_;
    std::vector<BodyIndex> order_;     // bodies in the order of the deck
    std::vector<BodyIndex> watched_;   // npfd's
    std::vector<BodyIndex> velocity_;  // those in velocity_y.dat
    std::vector<std::string> notices_;
    std::int64_t first_step_ = 0, last_step_ = 0;
    std::size_t breaks_written_ = 0;  // of the world's events
};

}  // namespace crackle
