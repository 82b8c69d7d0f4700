// SPDX-License-Identifier: GPL-3.0-or-later
// The few kinds of failure that a user can cause or meet. Libraries throw them; only tools/ prints and chooses exit
// codes.
// Tested by tests/tools/commands/test_test.cpp.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace crackle {

/// Input that cannot be used. The text reads «file:line: key: found X, expected Y; what to do». Exit code 2.
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A place that cannot be written: whatever else is asked for would fail alike. Exit code 2.
class OutputError : public InputError {
  public:
    using InputError::InputError;
};

/// A simulation that went wrong (not a number, runaway energy, a body leaving the world). Exit code 3.
class UnstableRun : public std::runtime_error {
  public:
    UnstableRun(std::int64_t at_step, int body_id, const std::string& likely_cause)
        : std::runtime_error("unstable at step " + std::to_string(at_step) + ", body " + std::to_string(body_id) +
                             ": " + likely_cause),
          step(at_step),
          body(body_id) {}
    /// The same with further lines, such as where the output is.
    UnstableRun(const UnstableRun& error, const std::string& more)
        : std::runtime_error(std::string(error.what()) + "; " + more), step(error.step), body(error.body) {}

    std::int64_t step;  ///< steps done since the run began
    int body;           ///< id as in the input
};

}  // namespace crackle
