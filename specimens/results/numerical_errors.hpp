// SPDX-License-Identifier: GPL-3.0-or-later
// The numerical errors that a test states for its peak (loading/companions.hpp explains how they are estimated).
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <optional>

#include "specimens/summary/run_figures.hpp"

namespace crackle {

/// Numerical errors of a test, estimated from companions: runs of the same specimen with another time step, rate or
/// damping.
struct NumericalErrors {
    /// Errors of the peak and, in compression tests, of crack stresses; also the results of the companions.
    ErrorsByFigure figures;
    std::optional<bool> peak_converged;  ///< whether runs with another time step or rate fail in the same way;
                                         ///< empty if the specimen has not failed
};

}  // namespace crackle
