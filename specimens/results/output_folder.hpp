// SPDX-License-Identifier: GPL-3.0-or-later
// The folder to which a test writes. Earlier results are never changed before the new ones are complete. A folder with
// results is rejected. With `force`, the new results are written to OUT.new beside it and replace the old ones at the
// end. Only results of tests are ever replaced. Files receive their final names once complete (new_file.hpp), so that
// the previous file survives a full disk. While an OutputFolder exists, its folders are locked against other processes.
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

/// A file that a test writes to its folder, with a description of its contents.
struct ResultFile {
    const char* name;
    const char* holds;
};
/// All files and folders that a test may make.
std::span<const ResultFile> result_files();

/// Whether a test writes a file of this name; all other files belong to the user.
bool is_result_name(const std::string& name);

/// Whether a folder contains results of a test. Files of a test that was stopped before its first row and checkpoint do
/// not count, because they are simply written again.
bool holds_test_results(const std::filesystem::path& folder);

/// Start of the first line of a test's case.toml. It distinguishes this file from a case that a user wrote.
inline constexpr const char* resolved_case_mark = "# Resolved case of crackle ";

/// Whether a file must be on disk before it receives its final name.
enum class Durable : bool { no, yes };

/// What to do with earlier complete results in OUT and with unfinished results in OUT.new.
enum class Earlier {
    refused,     ///< earlier results are an error
    replaced,    ///< earlier results are replaced, unless OUT.new contains an unfinished test, which can be resumed
    begun_again  ///< as `replaced`, and the contents of OUT.new are discarded
};

/// The folder of a test's results, locked against other processes. New results are written beside earlier ones.
class OutputFolder {
  public:
    /// @param inputs  input files of the case, which must not lie in a folder to which results are written
    /// @throws InputError if the folder contains results (unless they are replaced) or foreign files, is in use by
    /// another process, or cannot be written.
    static OutputFolder create(const std::filesystem::path& wanted, Earlier earlier,
                               std::span<const std::filesystem::path> inputs);
    /// Opens an existing folder to resume its test; an interrupted replacement is completed first. Results in OUT.new
    /// replace the results in OUT once they are complete.
    /// @throws InputError if there is no such folder.
    static OutputFolder reopen(const std::filesystem::path& folder);

    /// Takes over the folder and its lock.
    OutputFolder(OutputFolder&&) = default;
    OutputFolder& operator=(OutputFolder&&) = delete;
    /// Removes the folder that create() made if it is empty, and the folder from which results were moved.
    ~OutputFolder();

    const std::filesystem::path& path() const { return working_; }   ///< folder to which files are currently written
    const std::filesystem::path& target() const { return target_; }  ///< folder where the results will finally be
    /// Whether new results are written beside older ones, which they replace at the end.
    bool staged() const { return working_ != target_; }

    /// Writes a whole file, first under a temporary name. @param name  relative to the folder
    /// @param durable  whether the file receives its name only when it and all earlier writes are on disk, so that it
    /// never refers to data lost in a power failure
    void write(const std::string& name, const std::string& bytes, Durable durable = Durable::no) const;
    /// Writes a file that is too large to hold in memory, also first under a temporary name.
    void write(const std::string& name, const std::function<void(std::ostream&)>& write_to,
               Durable durable = Durable::no) const;
    /// Replaces the old results with the staged ones; afterwards path() equals target().
    void finish();
    /// A sentence on the state of the earlier results, for messages if finish() was not completed.
    std::string fate_of_earlier_results() const;

  private:
    OutputFolder(std::filesystem::path target, std::filesystem::path working)
        : target_(std::move(target)), working_(std::move(working)) {}

    std::filesystem::path target_, working_;
    std::filesystem::path moved_from_;  // emptied folder that may still have to be removed
    bool made_ = false;
    std::vector<FolderLock> locks_;
};

}  // namespace crackle
