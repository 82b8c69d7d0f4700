// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of error that a user can cause or encounter. Libraries throw them; only tools/ prints messages and chooses
// exit codes.
// Tested by tests/tools/commands/test_test.cpp.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace crackle {

/// Input that cannot be used. Message: «file:line: key: found X, expected Y; what to do». Exit code 2.
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// An output location that cannot be written, so that any other command that writes there would also fail. Exit code 2.
class OutputError : public InputError {
  public:
    using InputError::InputError;
};

/// A simulation that became unstable (NaN, energy without a source, a body outside the domain). Exit code 3.
class UnstableRun : public std::runtime_error {
  public:
    /// @param at_step number of steps completed @param body_id input id of the body whose state shows the instability
    /// @param likely_cause description for the message
    UnstableRun(std::int64_t at_step, int body_id, const std::string& likely_cause)
        : std::runtime_error("unstable at step " + std::to_string(at_step) + ", body " + std::to_string(body_id) +
                             ": " + likely_cause),
          step(at_step),
          body(body_id) {}
    /// Copy of an error with text appended to its message, for example the location of the output.
    UnstableRun(const UnstableRun& error, const std::string& more)
        : std::runtime_error(std::string(error.what()) + "; " + more), step(error.step), body(error.body) {}

    std::int64_t step;  ///< number of steps completed since the run began
    int body;           ///< input id of the body
};

}  // namespace crackle
