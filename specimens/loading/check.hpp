// SPDX-License-Identifier: GPL-3.0-or-later
// Predicts the result and cost of a case without loading it. The check reports small-strain moduli, the first bonds to
// fail, a rough strength estimate, the number of steps, run time and memory, and likely problems.
//
// The strength estimate is Young's modulus times the strain at which a given fraction of the breakable bonded points is
// broken according to the linear solution (bond_break_share). The fraction was calibrated on supplied cases and others;
// specimens/loading/METHODS.md lists them with the errors of the estimate.
// Tested by tests/specimens/loading/check_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "specimens/elastic/analysis.hpp"
#include "specimens/loading/expected_run.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// The first bond to slide or to break.
struct FirstLoss {
    double strain = 0.0, stress = 0.0;  // -, N/m (Pa in area units); positive in the direction of loading
    int body_i = 0, body_j = 0;         ///< input ids
};

/// Estimate of the strength from the linear solution.
struct StrengthEstimate {
    double stress = 0.0, strain = 0.0;  ///< see FirstLoss
    /// Fraction of the breakable points that are assumed to be broken at the strength.
    double share = 0.0;
    /// Largest factor by which the estimate was too high or too low in the calibration tests.
    double factor = 1.0;
};

/// Whether a Brazilian test of a rock can be valid. The compression at the centre of a disc is three times the tension
/// there. The disc splits before it is crushed if the ratio of compressive to tensile strength is at least 3 + N, where
/// N = (1 + sin φ)/(1 - sin φ).
struct DiscOutlook {
    /// Ratio of compressive to tensile strength, both estimated from linear solutions of the whole packing.
    double strength_ratio = 0.0;
    double factor = 1.0;          ///< possible error of the ratio, as a factor
    double friction_angle = 0.0;  // degrees, mean over bonded points and faces
    double needed = 0.0;          ///< required ratio, 3 + N

    /// Empty if the estimate is too rough to decide.
    std::optional<bool> can_be_valid() const;
};

/// Expected results and cost of a test, without running it.
struct TestCheck {
    VirtualTest test;  ///< the test, a few steps after the start of loading
    double grains_across = 0.0;
    double youngs_modulus = 0.0, poissons_ratio = 0.0, gauge_modulus = 0.0;  ///< N/m, -, N/m; NaN if unknown
    std::optional<FirstLoss> first_slip, first_break;
    std::optional<StrengthEstimate> strength;
    std::optional<DiscOutlook> disc;        ///< only for a Brazilian test whose rock has a linear solution
    double rate = 0.0, slowest_rate = 0.0;  // 1/s; equal if the case states a rate
    double steps_per_second = 0.0;          ///< speed measured in this check
    std::optional<RunEstimate> to_strength;
    RunEstimate to_end;   ///< estimate up to max_axial_strain
    double memory = 0.0;  ///< peak memory of this process up to now, bytes
    /// Displacement of a cell's corner towards a platen, and its initial distance to the platen's face, m. At the
    /// estimated strength, this corner comes closest to passing through a platen, according to the linear solution.
    /// Both values are 0 for circles, in tension, and without an estimate.
    double corner_closing = 0.0, corner_distance = 0.0;
    std::vector<std::string> warnings;  ///< likely problems, one sentence each
};

/// Fraction of the breakable points that are broken at the strength, according to the linear solution, and largest
/// error of the strength estimate, as a factor.
struct BreakShare {
    double share, factor;
};
/// Calibrated fraction and error for a kind of specimen, bonds and loading.
BreakShare bond_break_share(const TestSetup& setup);

/// Strain at which a given fraction of the breakable points (at least one) has broken according to the linear solution;
/// infinite if the fraction is never reached.
double strain_of_share(const std::vector<LinearBond>& bonds, double share);

/// Checks a case. @throws the exceptions of prepare_test()
TestCheck check_test(const ResolvedCase& description, const TestHooks& hooks = {});

}  // namespace crackle
