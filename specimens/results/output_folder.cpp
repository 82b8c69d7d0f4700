// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/files/new_file.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/frames/frame.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/recordings/replacement.hpp"
#include "specimens/recordings/test_results.hpp"
#include "specimens/results/checkpoint.hpp"
#include "specimens/results/result_tables.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr const char* frames_folder = "frames";

/// The files in the order in which staged results replace the old ones. The summary comes last, because other programs
/// check for it.
std::vector<ResultFile> files_of_a_test() {
    std::vector<ResultFile> files{
        {"case.toml",
         "the case with all values written out, including defaults, the hashes of its inputs, and a comment on each "
         "key (`crackle test --keys` lists all keys); it can be run again"},
        {circles_file,
         "circles as packed or read, with the walls between which they were packed, in the layout of DEMseg's "
         "in_gm.dat (solver/demseg/FORMATS.md); the damping is in case.toml. Absent if polygons were read from a file"},
        {polygons_file, "polygons as meshed or read, in the same layout; absent for circles"}};
    for (std::size_t k = 0; k < result_tables; ++k) {
        const auto table = static_cast<ResultTable>(k);
        files.push_back({name_of(table), facts_of(table).holds});
    }
    files.push_back({frames_folder,
                     "folder of frames for ParaView, including those at the start, at the peak and at the end; open "
                     "`frames/frames.pvd`"});
    files.push_back(
        {"checkpoint", "complete state of the test, for `--resume`; its format depends on the version of the program"});
    files.push_back({"summary.json", "results of the whole test"});
    return files;
}

constexpr const char* report_name =
    "report.html";  // made from the results by another command; outdated once the results are replaced

[[noreturn]] void cannot_write(const fs::path& path, int error) {
    fail_writing(error, fmt::format("{}: cannot be written ({}), expected a writable folder with free space",
                                    path.string(), std::strerror(error)));
}

bool holds_results(const fs::path& folder) {
    return std::ranges::any_of(result_files(), [&](const ResultFile& file) { return is_there(folder / file.name); });
}

/// @throws InputError, SystemFailure if the file exists but cannot be read, because the answer is then unknown
bool begins_with(const fs::path& file, const std::string& mark) {
    if (!is_file(file)) return false;
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in.is_open())
        fail_reading(errno,
                     fmt::format("{}: cannot be read ({}), expected a file", file.string(), std::strerror(errno)));
    std::string begin(mark.size(), '\0');
    const bool as_long = !in.read(begin.data(), static_cast<std::streamsize>(begin.size())).fail();
    refuse_failed(in, file.string());
    return as_long && begin == mark;
}

/// Recognises a test's folder by the contents of its case.toml or checkpoint, because other programs may use the same
/// file names.
bool is_of_a_test(const fs::path& folder) {
    return begins_with(folder / "case.toml", resolved_case_mark) ||
           begins_with(folder / "checkpoint", checkpoint_title);
}

/// Whether a text file is missing or contains at most a header line. @throws InputError if it cannot be read
bool is_heading_alone(const fs::path& file) {
    if (!is_there(file)) return true;
    const std::string text = read_file(file);
    const std::size_t end = text.find('\n');
    return end == std::string::npos || end + 1 == text.size();
}

/// Whether a test was stopped before its first checkpoint: there is a case, but only header lines without rows.
bool has_only_begun(const fs::path& folder) {
    for (const char* name : {"checkpoint", "summary.json", "frames"})
        if (is_there(folder / name)) return false;
    return begins_with(folder / "case.toml", resolved_case_mark) &&
           std::ranges::all_of(table_of_names<ResultTable>,
                               [&](std::string_view table) { return is_heading_alone(folder / table); });
}

bool is_frame(const std::string& name) { return name == "frames.pvd" || is_picture(name); }

void remove_results(const fs::path& folder) {
    std::error_code ignored;
    for (const ResultFile& file : result_files()) fs::remove_all(folder / file.name, ignored);
}

/// Removes temporary files left by a stopped process from a folder that this process has locked.
void remove_temporaries(const fs::path& folder) {
    remove_leftovers(folder, Leftovers::all);
    remove_leftovers(folder / "frames", Leftovers::all);
}

/// Names of the frames that are being moved out of a staging folder; empty if no results are being moved.
std::optional<std::set<std::string>> frames_being_moved(const fs::path& working) {
    std::string lines;
    if (!is_being_moved(working, lines)) return std::nullopt;
    std::istringstream in(lines);
    std::set<std::string> names;
    for (std::string line; std::getline(in, line);) names.insert(line);
    return names;
}

void rename_or_throw(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) cannot_write(to, error.value());
}

void remove_or_throw(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error) fail_writing(error.value(), fmt::format("{}: cannot be removed ({})", path.string(), error.message()));
}

/// Replaces the frames in `to` with the frames in `from`; other files in `to` stay. The operation may be interrupted at
/// any time and repeated. @param names  names of the new frames
void replace_frames(const fs::path& from, const fs::path& to, const std::set<std::string>& names) {
    std::error_code error;
    fs::create_directories(to, error);
    if (error) cannot_write(to, error.value());
    for (const std::string& name : names_in(from)) rename_or_throw(from / name, to / name);
    for (const std::string& name : names_in(to))
        if (is_frame(name) && !names.contains(name)) remove_or_throw(to / name);
    remove_or_throw(from);
}

/// Replaces old results with complete new ones, or resumes the replacement. @param names  names of the new frames
void move_staged(const fs::path& working, const fs::path& target, const std::set<std::string>& names) {
    if (is_report_page(target / report_name)) remove_or_throw(target / report_name);
    // As long as the first file is still in `working`, nothing has been moved, so extra files in `target` belong to the
    // old results.
    if (is_there(working / result_files().front().name)) {
        for (const ResultFile& file : result_files())
            if (file.name != std::string(frames_folder) && !is_there(working / file.name))
                remove_or_throw(target / file.name);
    }
    for (const ResultFile& file : result_files()) {
        const std::string name = file.name;
        if (!is_there(working / name)) continue;
        if (name == frames_folder) {
            replace_frames(working / name, target / name, names);
        } else {
            rename_or_throw(working / name, target / name);
        }
    }
    bring_all_to_disc(target);  // otherwise a power failure might leave some old results and none of the new ones
    remove_or_throw(working / staged_mark);
    // The error is set if files remain: foreign files, or files that a network file system keeps while they are open.
    std::error_code not_empty;
    fs::remove(working, not_empty);
}

/// Checks that the folder is writable by creating a file, because permission bits do not reveal full disks and
/// read-only mounts.
void probe(const fs::path& folder) {
    NewFile file(folder / "probe");
    file.stream() << "probe\n";
    file.flush();
}

/// Completes an interrupted move of results into `target`. @throws InputError if another process is moving them
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

std::span<const ResultFile> result_files() {
    static const std::vector<ResultFile> files = files_of_a_test();
    return files;
}

bool is_result_name(const std::string& name) {
    return std::ranges::any_of(result_files(), [&](const ResultFile& file) { return file.name == name; });
}

OutputFolder OutputFolder::create(const fs::path& wanted, Earlier earlier, std::span<const fs::path> inputs) {
    const fs::path target = output_folder(wanted);
    refuse_folder_of_inputs(target, inputs);
    complete_move(target);
    remove_leftovers(target, Leftovers::old);
    if (!is_of_a_test(target))
        refuse_foreign_files(target,
                             "a new or empty folder, or the output folder of an earlier test; choose another with -o");
    fs::path working = target;
    const bool staged = holds_test_results(target);
    if (staged) {
        if (earlier == Earlier::refused) {
            throw InputError(fmt::format(
                "{}: found results, expected an empty or new folder; --force replaces them, --resume continues them",
                target.string()));
        }
        working = fs::path(target.string() + staging_suffix);
        if (!is_there(working / staged_mark))
            refuse_foreign_files(working, fmt::format("only new results, which are written here until they replace "
                                                      "those in {}; move or remove other files",
                                                      target.string()));
        if (earlier == Earlier::replaced && is_there(working / "checkpoint")) {
            throw InputError(
                fmt::format("{0}: found an unfinished test that was to replace {1}, expected no such test; resume it "
                            "with `crackle test --resume {0}`, or remove {0} to start again",
                            working.string(), target.string()));
        }
    }
    std::error_code error;
    OutputFolder folder(target, working);
    folder.made_ = !fs::exists(working, error);
    fs::create_directories(working, error);
    if (error) cannot_write(working, error.value());
    folder.locks_.emplace_back(working);
    remove_temporaries(working);
    if (!staged && has_only_begun(working)) remove_results(working);
    if (staged) {
        folder.locks_.emplace_back(target);
        remove_results(working);  // results of a forced test that was never finished; the target folder is not changed
        folder.write(staged_mark, "");
    }
    probe(working);
    return folder;
}

OutputFolder OutputFolder::reopen(const fs::path& wanted) {
    fs::path folder_given = output_folder(wanted), target = folder_given;
    const bool is_staged = target.extension() == staging_suffix && is_there(target / staged_mark);
    if (is_staged) target.replace_extension();
    complete_move(target);
    // If complete_move() has moved the results, they are in their final folder and no longer staged.
    const bool staged = is_staged && is_there(folder_given / staged_mark);
    const fs::path working = staged ? folder_given : target;
    if (!is_folder(working)) {
        throw InputError(fmt::format("{}: found no such folder, expected one that a test was writing; check the path",
                                     working.string()));
    }
    OutputFolder folder(target, working);
    folder.locks_.emplace_back(working);
    if (staged) {
        if (!is_of_a_test(target))
            refuse_foreign_files(
                target,
                fmt::format(
                    "only results of an earlier test, which are to be replaced with those in {}; move other files away",
                    working.string()));
        make_folder(target);
        folder.locks_.emplace_back(target);
    }
    remove_temporaries(working);
    probe(working);
    return folder;
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;  // set if a folder is not empty and is therefore kept
    const bool empty = std::ranges::none_of(
        result_files(), [&](const ResultFile& file) { return fs::exists(working_ / file.name, ignored) || ignored; });
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
    const fs::path path = working_ / name;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) cannot_write(path.parent_path(), error.value());
    NewFile file(path);
    write_to(file.stream());
    file.flush();
    if (durable == Durable::yes) bring_all_to_disc(path.parent_path());
    file.take_name();
}

std::string OutputFolder::fate_of_earlier_results() const {
    if (frames_being_moved(working_)) {
        return fmt::format(
            "the new results are complete, but moving them from {} to {} was interrupted; `crackle test --resume {}` "
            "completes the move",
            working_.string(), target_.string(), target_.string());
    }
    return fmt::format("earlier results in {} {}", target_.string(),
                       holds_results(target_) ? "are unchanged" : "no longer exist");
}

void OutputFolder::finish() {
    if (!staged()) return;
    std::string mark = std::string(moving_line) + '\n';
    const std::set<std::string> names = names_in(working_ / "frames");
    for (const std::string& name : names) mark += name + '\n';
    write(staged_mark, mark, Durable::yes);  // from here on, any later command completes the move
    bring_all_to_disc(working_);             // nothing is moved before the new file names are on disk
    move_staged(working_, target_, names);
    moved_from_ = std::exchange(working_, target_);
    made_ = false;
}

}  // namespace crackle
