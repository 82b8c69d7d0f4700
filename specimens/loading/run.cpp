// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/base/version.hpp"
#include "solver/demseg/geometry.hpp"
#include "solver/files/read_file.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/companions.hpp"
#include "specimens/loading/expected_run.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/results/checkpoint.hpp"
#include "specimens/results/files.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/results/sha256.hpp"
#include "specimens/summary/summary_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::ifstream open_file(const fs::path& path) {
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in)
        fail_reading(errno,
                     fmt::format("{}: cannot be read ({}), expected a file", path.string(), std::strerror(errno)));
    return in;
}

FileOptions file_options(const VirtualTest& test) {
    return {.output = test.description.output,
            .emission = test.state.emission.rule.on(),
            .pressed = test.description.pressed(),
            .jointed = !test.setup.bonds.traces.empty()};
}

/// Sets the number of threads to `asked`, limited by options.most_threads and by the number of bodies.
void choose_threads(World& world, const TestOptions& options, int asked, const TestHooks& hooks) {
    const auto worth = static_cast<std::int64_t>(world.bodies.size()) / options.fewest_bodies_a_thread;
    const int most = static_cast<int>(std::clamp<std::int64_t>(worth, 1, options.most_threads));
    set_threads(world, std::min(asked, most));
    if (most < asked) {
        hooks.report_stage(fmt::format("notice: {} of {} threads are used: {}", most, asked,
                                       most < options.most_threads
                                           ? fmt::format("{} bodies do not keep more of them busy", world.bodies.size())
                                           : options.most_threads_why));
    }
}

/// Keeps the specimen's files in memory until the output folder exists. If the test cannot be set up, no folder is left
/// behind.
class SpecimenFiles {
  public:
    TestHooks collecting(TestHooks hooks) {
        hooks.made = [this](const std::string& name, Scene scene) {
            // Damping ratios are not part of the file format.
            for (Material& material : scene.materials) material.damping_ratio.reset();
            std::ostringstream text;
            write_geometry(text, scene);
            files_.emplace_back(name, std::move(text).str());
        };
        return hooks;
    }
    void write(const OutputFolder& folder) const {
        for (const auto& [name, text] : files_) folder.write(name, text);
    }

  private:
    std::vector<std::pair<std::string, std::string>> files_;
};

/// Text of case.toml in the output folder. @param made  the same test after its specimen was made
std::string case_text(const ResolvedCase& test, const ResolvedCase& made, const fs::path& folder) {
    std::ostringstream text;
    text << resolved_case_mark << project_version
         << ": the case with all values written out. Its input files and their SHA-256 hashes:\n";
    for (const fs::path& input : files_read(test)) {
        text << "#   " << sha256(read_file(input)) << "  " << input.filename().string() << '\n';
    }
    MadeValues values{.mesh_thick = {}, .frames = made.output.frames};
    if (made.mesh) values.mesh_thick = std::get<parts::MeshGap>(made.mesh->gap).thick;
    write_resolved_case(text, test, folder, values);
    return text.str();
}

TestTiming timing_of(const VirtualTest& test, const TestOptions& options) {
    return {test.state.wall_seconds + seconds_since(options.process_start), test.state.step_seconds,
            test.world.workers.threads};
}

/// Loads the specimen while its files are open, and writes the summary however loading ends.
TestOutcome run_with_files(VirtualTest& test, const TestOptions& options, const TestHooks& hooks, OutputFolder& folder,
                           TestFiles& files) {
    TestOutcome outcome;
    std::optional<NumericalErrors> errors;
    const auto write_summary = [&] {
        outcome.summary = make_summary(test.description, test.setup, test.state, test.world, timing_of(test, options),
                                       errors ? &*errors : nullptr);
        files.write_summary(outcome.summary, test.state);
    };
    const auto write_peak = [&] { files.add_peak(test.setup, test.state, test.world); };
    try {
        load_specimen(test, hooks, &files);
    } catch (const UnstableRun& error) {
        test.state.ended_by = ended_by_instability;
        test.setup.origin.notices.push_back(error.what());
        files.flush();
        write_peak();
        write_summary();
        throw UnstableRun(error, fmt::format("the output so far is in {}{}", folder.path().string(),
                                             folder.staged() ? "; " + folder.fate_of_earlier_results() : ""));
    }
    outcome.interrupted = test.state.ended_by.empty();
    if (outcome.interrupted) {
        // The checkpoint keeps neither the interrupt flag nor the frame at the current peak, because the resumed test
        // may reach a higher peak.
        TestState kept = test.state;
        kept.wall_seconds += seconds_since(options.process_start);
        files.write_checkpoint(test.setup, kept, test.world);
        test.state.ended_by = ended_by_interrupt;
        write_peak();
        write_summary();
    } else {
        write_peak();
        TestState kept = test.state;
        // The checkpoint stores these times as 0, so that the file is reproducible; no later run adds to them.
        kept.wall_seconds = kept.step_seconds = 0.0;
        files.write_checkpoint(test.setup, kept, test.world);
        write_summary();  // complete before the companion runs start, since they may fail
        if (options.verify) {
            errors = run_companions(test, hooks);
            outcome.unverified = !errors && test.state.failure.peak_row >= 0;
            write_summary();
        }
        folder.finish();
    }
    outcome.folder = folder.path();
    return outcome;
}

/// Runs `work`. If it fails while new results are replacing earlier ones, the error also states where the earlier
/// results are and whether they are complete.
template <class Work>
TestOutcome naming_the_fate(const OutputFolder& folder, const Work& work) {
    try {
        return work();
    } catch (const OutputError& error) {
        if (!folder.staged()) throw;
        throw OutputError(fmt::format("{}; {}", error.what(), folder.fate_of_earlier_results()));
    } catch (const SystemFailure& error) {
        if (!folder.staged()) throw;
        throw SystemFailure(error, folder.fate_of_earlier_results());
    } catch (const InputError& error) {
        if (!folder.staged()) throw;
        throw InputError(fmt::format("{}; {}", error.what(), folder.fate_of_earlier_results()));
    }
}

/// Handles a test that has already ended: carries out the companion runs if they are requested and missing.
TestOutcome finished_test(VirtualTest& test, const TestOptions& options, const TestHooks& hooks,
                          const OutputFolder& folder) {
    TestOutcome outcome;
    outcome.folder = folder.path();
    const fs::path name = folder.path() / "summary.json";
    // If there is no summary, the process was killed before writing it, and the run times are lost.
    const bool exists = is_file(name);
    if (exists) outcome.summary = parse_summary(read_file(name));
    const Summary& old = outcome.summary;
    const bool readable = exists && old.about.ended_by.value_or("") == test.state.ended_by;
    const bool verified = readable && old.numerical_errors && old.numerical_errors->companions.stated();
    outcome.was_finished = readable && (verified || !options.verify);
    if (readable) {
        const FileMarks stated = stated_files(old, name.string());
        for (const auto& [file, mark] : stated)
            require_as_stated(stated, folder.path() / file, mark_of_file(folder.path() / file));
    }
    if (outcome.was_finished) return outcome;
    TestTiming timing{0.0, 0.0, test.world.workers.threads};
    if (readable)  // `threads` is clamped, because the file may have been edited
        timing = {old.run.wall_seconds.value_or(0.0), old.run.step_seconds.value_or(0.0),
                  static_cast<int>(std::clamp<std::int64_t>(old.run.threads.value_or(1), 1, 1'000'000))};
    std::optional<NumericalErrors> errors;
    const auto write_summary = [&] {
        outcome.summary =
            make_summary(test.description, test.setup, test.state, test.world, timing, errors ? &*errors : nullptr);
        crackle::write_summary(folder, outcome.summary, named_marks(tables_of(file_options(test)), test.state.tables));
    };
    write_summary();
    if (options.verify) {
        errors = run_companions(test, hooks);
        outcome.unverified = !errors && test.state.failure.peak_row >= 0;
        write_summary();
    }
    return outcome;
}

}  // namespace

TestOutcome run_test(const ResolvedCase& description, const TestOptions& options, const TestHooks& hooks) {
    OutputFolder folder = OutputFolder::create(options.folder,
                                               !options.force         ? Earlier::refused
                                               : options.begins_again ? Earlier::begun_again
                                                                      : Earlier::replaced,
                                               files_read(description));
    std::optional<SpecimenFiles> specimen(std::in_place);
    const int threads = options.threads > 0 ? options.threads : description.numerics.threads;
    ResolvedCase made = description;
    made.numerics.threads = std::min(threads, options.most_threads);
    BondedTest bonded = make_and_bond(made, specimen->collecting(hooks));
    compute_forces(bonded.test.world);
    VirtualTest test = prepare_test(std::move(bonded), made, hooks);
    choose_threads(test.world, options, threads, hooks);
    const RunEstimate run = expected_run(test, description.loading.max_axial_strain, roughly_steps_per_second(test));
    if (!options.endless) refuse_endless(test, run);
    refuse_resting(test);  // must throw before anything is written, so that the new folder is removed
    hooks.report_detail(
        fmt::format("{:.3g} steps to max_axial_strain = {:g}, in about {:.2g} s", run.steps, run.strain, run.seconds));
    Profile profile;
    if (options.profile) test.world.workers.profile = &profile;
    test.state.command = options.command;
    // Derived values are recorded for keys that the case does not set.
    const std::string text = case_text(description, test.description, folder.target());
    if (options.loading_begins) options.loading_begins();
    return naming_the_fate(folder, [&] {
        // Written first, because it marks the folder as the output of a test.
        folder.write("case.toml", text, Durable::yes);
        TestFiles files(folder, sha256(text), test.state, file_options(test));
        specimen->write(folder);
        specimen.reset();  // not needed during the test
        return run_with_files(test, options, hooks, folder, files);
    });
}

TestOutcome resume_test(const TestOptions& options, const TestHooks& hooks) {
    OutputFolder folder = OutputFolder::reopen(options.folder);
    const fs::path checkpoint_path = folder.path() / "checkpoint";
    std::error_code error;
    if (!is_file(checkpoint_path)) {
        throw InputError(fmt::format(
            "{}: found no checkpoint, {}", checkpoint_path.string(),
            holds_test_results(folder.path())
                ? "expected one to resume from; run the test again with --force"
                : "because the test was stopped before loading began; nothing is lost, run the test again"));
    }
    const fs::path case_path = folder.path() / "case.toml";
    VirtualTest test;
    test.description = read_case(case_path);
    std::ifstream saved = open_file(checkpoint_path);
    TestCheckpoint checkpoint = load_test(saved, checkpoint_path.string());
    saved.close();
    if (checkpoint.case_hash != sha256(read_file(case_path))) {
        throw InputError(fmt::format(
            "{}: found a case that differs from the one of the checkpoint, expected no change; restore the file, "
            "or run the test again with --force",
            case_path.string()));
    }
    test.setup = std::move(checkpoint.setup);
    test.state = std::move(checkpoint.state);
    test.world = std::move(checkpoint.world);
    choose_threads(test.world, options, options.threads > 0 ? options.threads : test.description.numerics.threads,
                   hooks);
    if (!test.state.ended_by.empty()) {
        return naming_the_fate(folder, [&] {
            TestOutcome outcome = finished_test(test, options, hooks, folder);
            folder.finish();
            outcome.folder = folder.path();
            return outcome;
        });
    }
    if (options.loading_begins) options.loading_begins();
    // The summary of the interrupted test is removed, because the resumed test extends curve and frames.
    fs::remove(folder.path() / "summary.json", error);
    hooks.report_stage(fmt::format("resumed at step {}, axial strain {:.4g}", test.world.stepping.steps,
                                   test.setup.apparatus.axial_strain(test.world)));
    return naming_the_fate(folder, [&] {
        TestFiles files(folder, checkpoint.case_hash, test.state, file_options(test));
        return run_with_files(test, options, hooks, folder, files);
    });
}

}  // namespace crackle
