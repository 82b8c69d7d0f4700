// SPDX-License-Identifier: GPL-3.0-or-later
// Files that receive their final names only when they are complete. Until then they have a random name in the same
// folder, so that no file or link of another user is overwritten.
// Tested by tests/solver/files/new_file_test.cpp.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>

#include "solver/files/file_stream.hpp"

namespace crackle {

/// Suffix of a file that is being written, after a random name of 16 hexadecimal digits.
inline constexpr std::string_view temporary_suffix = ".crackle_tmp";

/// Whether a name belongs to a file that is still being written.
bool is_temporary_name(const std::string& name);

/// An empty file created by this process, locked while it is open.
struct TemporaryFile {
    std::filesystem::path path;
    int descriptor;
};
/// Creates a temporary file. @param folder folder of the file; empty for the current folder @param shown name of the
/// final file in messages
/// @throws OutputError, SystemFailure if no file can be created in the folder
TemporaryFile make_temporary(const std::filesystem::path& folder, const std::filesystem::path& shown);

/// A file that receives its final name once it is complete.
class NewFile {
  public:
    /// Creates the file under a temporary name. @throws OutputError, SystemFailure if the file cannot be created, or
    /// `path` is a link; the other functions throw the same errors
    explicit NewFile(std::filesystem::path path);
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    /// Removes the file unless it has received its final name.
    ~NewFile();

    /// Stream to which the contents are written.
    std::ostream& stream() { return stream_; }
    /// Writes buffered output. @throws OutputError, SystemFailure if anything could not be written
    void flush();
    /// Flushes the file to the disc.
    void bring_to_disc();
    /// Gives the file its final name, replacing any existing file of that name.
    void take_name();

  private:
    std::filesystem::path path_, temporary_;
    FileStream stream_;
};

/// Which leftover files remove_leftovers() removes.
enum class Leftovers {
    old,  ///< files not modified for a minute
    all   ///< all files; only for a folder that this process has locked
};
/// Removes temporary files that interrupted processes of this user have left in a folder, but not files still being
/// written.
void remove_leftovers(const std::filesystem::path& folder, Leftovers which);

}  // namespace crackle
