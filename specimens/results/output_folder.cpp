// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/frames/frame.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/recordings/replacement.hpp"
#include "specimens/recordings/test_results.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

// In the order in which staged results take the old ones' place: the summary, which readers look for, comes last.
constexpr std::array<ResultFile, 10> files_of_a_test{{
    {"case.toml",
     "the case with every value in the open and the hashes of its inputs, with a comment on each key "
     "(`crackle test --keys` lists them all); it can be run again"},
    {circles_file,
     "circles as packed or read, between the walls that they were packed against, in the layout of DEMseg's in_gm.dat "
     "(solver/demseg/FORMATS.md); the damping is in case.toml; not of polygons from a file"},
    {polygons_file, "polygons as meshed or read, likewise; not of circles"},
    {"curve.csv", "one row an observed step"},
    {"events.csv", "one row a broken bonded point"},
    {"slips.csv", "one row the first slip of a bonded point; with `output.slips = true`"},
    {"ae.csv",
     "one row an acoustic event: breaks that belong together, and the moment of their source; with "
     "`output.emission = true`"},
    {"frames", "a folder of pictures for ParaView, start, peak and end among them: open `frames/frames.pvd`"},
    {"checkpoint", "the complete state, for `--resume`; a format of its own, of one version of the program"},
    {"summary.json", "figures of the whole test"},
}};
constexpr auto result_names = [] {
    std::array<const char*, files_of_a_test.size()> names{};
    for (std::size_t k = 0; k < names.size(); ++k) names[k] = files_of_a_test[k].name;
    return names;
}();
constexpr const char* report_name =
    "report.html";  // made of the results by another command; stale once they are replaced
constexpr const char* temporary_suffix = ".tmp";

[[noreturn]] void cannot_write(const fs::path& path, const std::string& why) {
    throw OutputError(
        fmt::format("{}: cannot be written ({}), expected a writable folder with free space", path.string(), why));
}

std::string last_error() { return std::strerror(errno); }

bool holds_results(const fs::path& folder) {
    return std::any_of(result_names.begin(), result_names.end(),
                       [&](const char* name) { return is_there(folder / name); });
}

bool begins_with(const fs::path& file, const std::string& mark) {
    std::ifstream in(file, std::ios::binary);
    std::string begin(mark.size(), '\0');
    return in.read(begin.data(), static_cast<std::streamsize>(begin.size())) && begin == mark;
}

/// Whether a text file holds a heading at most. One that is not there does. @throws InputError if it cannot be read
bool is_heading_alone(const fs::path& file) {
    if (!is_there(file)) return true;
    const std::string text = read_file(file);
    const std::size_t end = text.find('\n');
    return end == std::string::npos || end + 1 == text.size();
}

/// Of a test that was stopped before its first checkpoint: headings without a row, and a case that is still elsewhere.
bool has_only_begun(const fs::path& folder) {
    for (const char* name : {"checkpoint", "summary.json", "frames"})
        if (is_there(folder / name)) return false;
    const fs::path own_case = folder / "case.toml";
    return is_there(folder / "curve.csv") && is_heading_alone(folder / "curve.csv") &&
           is_heading_alone(folder / "events.csv") &&
           (!is_there(own_case) || begins_with(own_case, resolved_case_mark));
}

/// A case.toml or a frames/ alone may be the user's own.
bool are_of_a_test(const fs::path& folder) {
    return is_there(folder / "summary.json") || is_there(folder / "checkpoint") ||
           begins_with(folder / "case.toml", resolved_case_mark);
}

bool is_frame(const std::string& name) { return name == "frames.pvd" || is_picture(name); }

void remove_results(const fs::path& folder) {
    std::error_code ignored;
    for (const char* name : result_names) fs::remove_all(folder / name, ignored);
}

/// What a process that was stopped while it wrote has left behind.
void remove_temporaries(const fs::path& folder) {
    std::vector<fs::path> files{folder / "probe.tmp", folder / (std::string(staged_mark) + temporary_suffix)};
    for (const std::string name : result_names) files.push_back(folder / (name + temporary_suffix));
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / "frames", error)) {
        const fs::path& file = entry.path();
        if (file.extension() == temporary_suffix && is_frame(file.stem().string())) files.push_back(file);
    }
    for (const fs::path& file : files) fs::remove(file, error);
}

/// Names of the frames that are being moved out of a folder of staged results; none: nothing is.
std::optional<std::set<std::string>> frames_being_moved(const fs::path& working) {
    std::string lines;
    if (!is_being_moved(working, lines)) return std::nullopt;
    std::istringstream in(lines);
    std::set<std::string> names;
    for (std::string line; std::getline(in, line);) names.insert(line);
    return names;
}

/// Names of what a folder holds; none where there is no folder. @throws InputError if it cannot be listed
std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    if (error == std::errc::no_such_file_or_directory) return names;
    for (; !error && entry != fs::directory_iterator(); entry.increment(error))
        names.insert(entry->path().filename().string());
    if (error) throw InputError(fmt::format("{}: cannot be listed ({})", folder.string(), error.message()));
    return names;
}

void rename_or_throw(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) cannot_write(to, error.message());
}

void remove_or_throw(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error) throw InputError(fmt::format("{}: cannot be removed ({})", path.string(), error.message()));
}

/// Puts the frames in `from` in the place of those in `to`; other files there stay. Stopped at any moment and done
/// again, it ends the same. @param names of the new ones
void replace_frames(const fs::path& from, const fs::path& to, const std::set<std::string>& names) {
    std::error_code error;
    fs::create_directories(to, error);
    if (error) cannot_write(to, error.message());
    for (const std::string& name : names_in(from)) rename_or_throw(from / name, to / name);
    for (const std::string& name : names_in(to))
        if (is_frame(name) && !names.contains(name)) remove_or_throw(to / name);
    remove_or_throw(from);
}

/// Puts complete results in the place of the old ones, or goes on with that. @param names of the new frames
void move_staged(const fs::path& working, const fs::path& target, const std::set<std::string>& names) {
    if (is_report_page(target / report_name)) remove_or_throw(target / report_name);
    // Nothing has been moved while the first file is still here: what the new results lack is of the old ones.
    if (is_there(working / result_names.front())) {
        for (const char* name : {circles_file, polygons_file})
            if (!is_there(working / name)) remove_or_throw(target / name);
    }
    for (const std::string name : result_names) {
        if (!is_there(working / name)) continue;
        if (name == "frames") {
            replace_frames(working / name, target / name, names);
        } else {
            rename_or_throw(working / name, target / name);
        }
    }
    bring_all_to_disc(target);  // else a loss of power may leave the old results, and nothing of the new ones
    remove_or_throw(working / staged_mark);
    std::error_code not_empty;  // of files that are not ours, or that a network's file system keeps while they are open
    fs::remove(working, not_empty);
}

void refuse_inputs_among_results(const fs::path& target, std::span<const fs::path> inputs) {
    std::error_code error;
    for (const fs::path& input : inputs) {
        for (const char* name : result_names) {
            if (!fs::equivalent(input, target / name, error) || error) continue;
            throw InputError(
                fmt::format("{}: is an input of the test, expected a folder where no result takes its place; choose "
                            "another -o",
                            (target / name).string()));
        }
    }
}

fs::path without_trailing_slash(const fs::path& path) { return path.has_filename() ? path : path.parent_path(); }

/// Making a file shows more than permission bits do: full discs and read-only mounts show, too.
void probe(const fs::path& folder) {
    const fs::path file = folder / "probe.tmp";
    errno = 0;
    std::ofstream out(file);
    out << "probe\n";
    out.close();
    const std::string why = out ? "" : last_error();
    std::error_code ignored;
    fs::remove(file, ignored);
    if (!why.empty()) cannot_write(folder, why);
}

}  // namespace

namespace {

/// Ends a move of results into `target` that was stopped. @throws InputError if another process is at it
void complete_move(const fs::path& target) {
    const fs::path working = target.string() + staging_suffix;
    const auto names = frames_being_moved(working);
    if (!names) return;
    const FolderLock working_lock(working), target_lock(target);
    remove_temporaries(target);
    move_staged(working, target, *names);
}

}  // namespace

bool holds_test_results(const fs::path& folder) { return holds_results(folder) && !has_only_begun(folder); }

std::span<const ResultFile> result_files() { return files_of_a_test; }

bool is_result_name(const std::string& name) {
    return std::find(result_names.begin(), result_names.end(), name) != result_names.end();
}

OutputFolder OutputFolder::create(const fs::path& wanted, bool force, std::span<const fs::path> inputs) {
    const fs::path target = without_trailing_slash(wanted);
    std::error_code error;
    if (is_there(target) && !is_folder(target)) {
        throw InputError(
            fmt::format("{}: found a file, expected a folder or nothing; choose another -o", target.string()));
    }
    refuse_inputs_among_results(target, inputs);
    complete_move(target);
    fs::path working = target;
    const bool staged = holds_test_results(target);
    if (staged) {
        if (!force) {
            throw InputError(
                fmt::format("{}: found results, expected an empty or new folder; --force replaces them, --resume goes "
                            "on with them",
                            target.string()));
        }
        if (!are_of_a_test(target)) {
            throw InputError(
                fmt::format("{}: found files with names of results that no test wrote, expected a test's results to "
                            "replace; choose another -o",
                            target.string()));
        }
        working = fs::path(target.string() + staging_suffix);
        if (holds_results(working) && !is_there(working / staged_mark)) {
            throw InputError(
                fmt::format("{}: found results, expected nothing where the new ones grow before they replace those in "
                            "{}; move or remove them",
                            working.string(), target.string()));
        }
    }
    OutputFolder folder(target, working);
    folder.made_ = !fs::exists(working, error);
    fs::create_directories(working, error);
    if (error) cannot_write(working, error.message());
    folder.locks_.emplace_back(working);
    remove_temporaries(working);
    if (!staged && has_only_begun(working)) remove_results(working);
    if (staged) {
        folder.locks_.emplace_back(target);
        remove_results(working);  // of a forced test that was never finished; those in the target stay
        folder.write(staged_mark, "");
    }
    probe(working);
    return folder;
}

OutputFolder OutputFolder::reopen(const fs::path& wanted) {
    fs::path target = without_trailing_slash(wanted);
    // Their place is no longer here, and what has been moved is missing.
    if (target.extension() == staging_suffix && frames_being_moved(target)) target.replace_extension();
    complete_move(target);
    std::error_code error;
    if (!is_folder(target)) {
        throw InputError(fmt::format("{}: found no such folder, expected one that a test was writing; check the path",
                                     target.string()));
    }
    OutputFolder folder(target, target);
    folder.locks_.emplace_back(target);
    remove_temporaries(target);
    probe(target);
    fs::remove(target / staged_mark, error);  // gone on with, they are results to keep
    return folder;
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;  // not empty: results are kept
    const bool empty = std::none_of(result_names.begin(), result_names.end(),
                                    [&](const char* name) { return fs::exists(working_ / name, ignored) || ignored; });
    if (staged() && empty) fs::remove(working_ / staged_mark, ignored);
    if (made_) fs::remove(working_, ignored);
    if (!moved_from_.empty()) fs::remove(moved_from_, ignored);
}

void OutputFolder::write(const std::string& name, const std::string& bytes, Durable durable) const {
    write(
        name, [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); }, durable);
}

void OutputFolder::write(const std::string& name, const std::function<void(std::ostream&)>& write_to,
                         Durable durable) const {
    const fs::path file = working_ / name;
    const fs::path temporary = file.string() + temporary_suffix;
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (error) cannot_write(file.parent_path(), error.message());
    errno = 0;
    std::vector<char> buffer(std::size_t{1} << 18);
    std::ofstream out;
    out.rdbuf()->pubsetbuf(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    out.open(temporary, std::ios::binary);
    write_to(out);
    out.close();
    if (!out) {
        const std::string why = last_error();
        fs::remove(temporary, error);
        cannot_write(file, why);
    }
    if (durable == Durable::yes) bring_all_to_disc(file.parent_path());
    fs::rename(temporary, file, error);
    if (error) cannot_write(file, error.message());
}

std::string OutputFolder::fate_of_earlier_results() const {
    if (frames_being_moved(working_)) {
        return fmt::format(
            "the new results are complete in {} and only partly in {}: `crackle test --resume {}` ends that",
            working_.string(), target_.string(), target_.string());
    }
    return fmt::format("earlier results in {} {}", target_.string(),
                       holds_results(target_) ? "are as they were" : "are no longer there");
}

void OutputFolder::finish() {
    if (!staged()) return;
    std::string mark = std::string(moving_line) + '\n';
    const std::set<std::string> names = names_in(working_ / "frames");
    for (const std::string& name : names) mark += name + '\n';
    write(staged_mark, mark, Durable::yes);  // whoever finds it ends the move
    bring_all_to_disc(working_);             // nothing is moved before its name is on the disc
    move_staged(working_, target_, names);
    moved_from_ = std::exchange(working_, target_);
    made_ = false;
}

}  // namespace crackle
