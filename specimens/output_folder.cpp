// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "solver/errors.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

// In the order in which staged results take the old ones' place: the summary, which readers look for, comes last.
constexpr std::array<const char*, 6> result_names{"case.toml", "curve.csv",  "events.csv",
                                                  "frames",    "checkpoint", "summary.json"};
constexpr const char* report_name =
    "report.html";  // made of the results by another command; stale once they are replaced
constexpr const char* temporary_suffix = ".tmp";

[[noreturn]] void cannot_write(const fs::path& path, const std::string& why) {
    throw InputError(
        fmt::format("{}: cannot be written ({}), expected a writable folder with free space; earlier results are as "
                    "they were",
                    path.string(), why));
}

std::string last_error() { return std::strerror(errno); }

bool holds_results(const fs::path& folder) {
    std::error_code error;
    return std::any_of(result_names.begin(), result_names.end(),
                       [&](const char* name) { return fs::exists(folder / name, error); });
}

void remove_results(const fs::path& folder) {
    std::error_code ignored;
    for (const char* name : result_names) fs::remove_all(folder / name, ignored);
}

fs::path without_trailing_slash(const fs::path& path) { return path.has_filename() ? path : path.parent_path(); }

/// Making a file tells more than permission bits: full discs and read-only mounts show, too.
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

bool is_result_name(const std::string& name) {
    return std::find(result_names.begin(), result_names.end(), name) != result_names.end();
}

OutputFolder OutputFolder::create(const fs::path& wanted, bool force) {
    const fs::path target = without_trailing_slash(wanted);
    std::error_code error;
    if (fs::exists(target, error) && !fs::is_directory(target, error)) {
        throw InputError(
            fmt::format("{}: found a file, expected a folder or nothing; choose another -o", target.string()));
    }
    fs::path working = target;
    if (holds_results(target)) {
        if (!force) {
            throw InputError(
                fmt::format("{}: found results, expected an empty or new folder; --force replaces them, --resume goes "
                            "on with them",
                            target.string()));
        }
        working = fs::path(target.string() + ".new");
        remove_results(working);  // of a forced test that was never finished; those in the target stay
    }
    OutputFolder folder(target, working);
    folder.made_ = !fs::exists(working, error);
    fs::create_directories(working, error);
    if (error) cannot_write(working, error.message());
    probe(working);
    return folder;
}

OutputFolder OutputFolder::reopen(const fs::path& folder) {
    const fs::path target = without_trailing_slash(folder);
    std::error_code error;
    if (!fs::is_directory(target, error)) {
        throw InputError(fmt::format("{}: found no such folder, expected one that a test was writing; check the path",
                                     target.string()));
    }
    probe(target);
    return {target, target};
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;  // not empty: results are kept
    if (made_) fs::remove(working_, ignored);
}

void OutputFolder::write(const std::string& name, const std::string& bytes) const {
    const fs::path file = working_ / name;
    const fs::path temporary = file.string() + temporary_suffix;
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (error) cannot_write(file.parent_path(), error.message());
    errno = 0;
    std::ofstream out(temporary, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
        const std::string why = last_error();
        fs::remove(temporary, error);
        cannot_write(file, why);
    }
    fs::rename(temporary, file, error);
    if (error) cannot_write(file, error.message());
}

void OutputFolder::finish() {
    if (!staged()) return;
    std::error_code error;
    fs::remove(target_ / report_name, error);
    for (const char* name : result_names) {
        if (!fs::exists(working_ / name, error)) continue;
        fs::remove_all(target_ / name, error);
        if (!error) fs::rename(working_ / name, target_ / name, error);
        if (error) cannot_write(target_ / name, error.message());
    }
    fs::remove(working_, error);
    working_ = target_;
    made_ = false;
}

GrowingFile::GrowingFile(fs::path path, std::uint64_t bytes) : path_(std::move(path)), bytes_(bytes) {
    std::error_code error;
    if (bytes == 0) {
        fs::remove(path_, error);
    } else {
        const auto there = fs::file_size(path_, error);
        if (error || there < bytes) {
            throw InputError(
                fmt::format("{}: found {} bytes, expected at least the {} of the checkpoint; the file was changed, run "
                            "the test again with --force",
                            path_.string(), error ? 0 : there, bytes));
        }
        fs::resize_file(path_, bytes, error);
        if (error) cannot_write(path_, error.message());
    }
    errno = 0;
    out_.open(path_, std::ios::binary | std::ios::app);
    if (!out_) cannot_write(path_, last_error());
}

void GrowingFile::write(const std::string& text) {
    out_ << text;
    bytes_ += text.size();
}

void GrowingFile::flush() {
    errno = 0;
    out_.flush();
    if (!out_) cannot_write(path_, last_error());
}

}  // namespace crackle
