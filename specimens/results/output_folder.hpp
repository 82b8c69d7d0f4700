// SPDX-License-Identifier: GPL-3.0-or-later
// The folder a test writes into, and the promise that goes with it: earlier results are never touched before the new
// ones are complete. A folder with results is refused; with `force` the new results grow in OUT.new beside it and take
// the old ones' place at the end. Nothing but a test's results is ever replaced. Single files appear under a temporary
// name and are renamed, so that a full disc leaves the previous one. While an OutputFolder lives its folders are locked
// against other processes.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "solver/files/folder_lock.hpp"

namespace crackle {

/// What a test makes in its folder.
struct ResultFile {
    const char* name;
    const char* holds;
};
std::span<const ResultFile> result_files();

/// Names that a test makes in its folder; anything else there belongs to the user.
bool is_result_name(const std::string& name);

/// Whether a folder holds what a test made. What is there of one that was stopped before its loading began is nothing:
/// such a test is simply run again.
bool holds_test_results(const std::filesystem::path& folder);

/// First line of a test's case.toml: by it a folder's case is known to be a result, not a user's own.
inline constexpr const char* resolved_case_mark = "# Resolved case of crackle ";

enum class Durable : bool { no, yes };

class OutputFolder {
  public:
    /// @param inputs files of the case, which must not lie where results go
    /// @throws InputError if the folder holds results (without force) or what only looks like them, is in use by
    /// another process, or cannot be written.
    static OutputFolder create(const std::filesystem::path& wanted, bool force,
                               std::span<const std::filesystem::path> inputs);
    /// An existing folder, to go on with; results that were just taking its place do so first.
    /// @throws InputError if there is none.
    static OutputFolder reopen(const std::filesystem::path& folder);

    OutputFolder(OutputFolder&&) = default;
    OutputFolder& operator=(OutputFolder&&) = delete;
    /// Removes what create() made, if nothing was written into it, and a folder that results were moved out of.
    ~OutputFolder();

    const std::filesystem::path& path() const { return working_; }   ///< where files are written now
    const std::filesystem::path& target() const { return target_; }  ///< where they will be in the end
    bool staged() const { return working_ != target_; }

    /// Writes a whole file, under a temporary name first. @param name relative to the folder
    /// @param durable it gets its name when it and all that was written before are on the disc: it never knows of more
    /// than a loss of power leaves
    void write(const std::string& name, const std::string& bytes, Durable durable = Durable::no) const;
    /// The same, of a file that is not in memory as a whole.
    void write(const std::string& name, const std::function<void(std::ostream&)>& write_to,
               Durable durable = Durable::no) const;
    /// Puts staged results in the place of the old ones; path() is target() from then on.
    void finish();
    /// Of a staged folder whose finish() did not end: what has become of the earlier results, as a sentence.
    std::string fate_of_earlier_results() const;

  private:
    OutputFolder(std::filesystem::path target, std::filesystem::path working)
        : target_(std::move(target)), working_(std::move(working)) {}

    std::filesystem::path target_, working_;
    std::filesystem::path moved_from_;  // may be there still
    bool made_ = false;
    std::vector<FolderLock> locks_;
};

}  // namespace crackle
