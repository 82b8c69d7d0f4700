// SPDX-License-Identifier: GPL-3.0-or-later
// System failures: a full disk, too many open files, not enough memory, a faulty device. They do not depend on the
// input, so the same command may succeed later. An error caused by a path that the user gave is an input error instead.
#pragma once

#include <stdexcept>
#include <string>

#include "solver/base/errors.hpp"

namespace crackle {

/// A system failure that the input did not cause. Exit code 4.
class SystemFailure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// Copy of an error with text appended to its message, for example the location of the output.
    SystemFailure(const SystemFailure& error, const std::string& more)
        : std::runtime_error(std::string(error.what()) + "; " + more) {}
};

/// A file that cannot be opened or read because of its path. Exit code 2. The error says nothing about the contents of
/// the file, which may have been read successfully before.
class UnreadableFile : public InputError {
  public:
    using InputError::InputError;
};

/// Whether a value of errno means that the given path is at fault, for example because it is missing, is a folder or
/// must not be accessed. The error then persists until the user changes something. All other errors are system
/// failures.
bool is_about_the_path(int error);

/// Throws the error for a file that cannot be read. @param error errno of the failed call; 0 counts as an input error
/// @throws UnreadableFile, SystemFailure
[[noreturn]] void fail_reading(int error, const std::string& text);

/// As fail_reading(), for an output location. @throws OutputError, SystemFailure
[[noreturn]] void fail_writing(int error, const std::string& text);

}  // namespace crackle
