// SPDX-License-Identifier: GPL-3.0-or-later
// What a case will give and cost, without loading it: small-strain moduli, the first bonds to give way, a rough
// estimate of the strength, steps, seconds and memory, and what is likely to go wrong.
//
// The estimate: E times the strain at which a share of the bonded points that can break would have broken, were the
// linear solution to hold that far (bond_break_share). The share is what the shipped and other cases had reached at
// their strength; specimens/METHODS.md 6 has them, and how far off the estimate was.
// Tested by tests/specimens/loading/check_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "specimens/case/case_file.hpp"
#include "specimens/elastic/analysis.hpp"
#include "specimens/loading/expected_run.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/hooks.hpp"

namespace crackle {

/// A bond that gives way first.
struct FirstLoss {
    double strain = 0.0, stress = 0.0;  // -, N/m (Pa in area units), positive in the sense of the test
    int body_i = 0, body_j = 0;         ///< input ids
};

struct StrengthEstimate {
    double stress = 0.0, strain = 0.0;  ///< as FirstLoss
    double share = 0.0;                 ///< of the breakable points, by which it was estimated
    double factor = 1.0;                ///< by which it was off at worst where it was calibrated
};

/// Whether a Brazilian test of a rock can be valid: the centre of a disc, under three times the tension there, splits
/// before it is crushed where strength over tensile strength is 3 + N or more, N = (1 + sin φ)/(1 - sin φ).
struct DiscOutlook {
    double strength_ratio = 0.0;  ///< of the rock's estimated strengths, by the linear solution of the whole packing
    double factor = 1.0;          ///< by which it may be off
    double friction_angle = 0.0;  // degrees, mean of the bonded points
    double needed = 0.0;          ///< 3 + N

    /// Nothing where the estimate is too rough to tell.
    std::optional<bool> can_be_valid() const;
};

struct TestCheck {
    VirtualTest test;  ///< a few steps into its loading
    double grains_across = 0.0;
    double youngs_modulus = 0.0, poissons_ratio = 0.0, gauge_modulus = 0.0;  ///< not a number where unknown
    std::optional<FirstLoss> first_slip, first_break;
    std::optional<StrengthEstimate> strength;
    std::optional<DiscOutlook> disc;        ///< of a Brazilian test whose rock has a linear solution
    double rate = 0.0, slowest_rate = 0.0;  // 1/s; equal where the rate is given
    double steps_per_second = 0.0;          ///< as measured here
    std::optional<RunEstimate> to_strength;
    RunEstimate to_end;   ///< to max_axial_strain
    double memory = 0.0;  ///< bytes, largest of this process so far
    /// Of the corner that a platen presses deepest by the linear solution at the estimated strength, m: its way, and
    /// its distance from the platen's face now; 0 of circles, in tension, and without an estimate.
    double corner_closing = 0.0, corner_distance = 0.0;
    std::vector<std::string> warnings;  ///< what is likely to go wrong, a sentence each
};

/// Share of the breakable points that has broken at the strength, by the linear solution, and the factor by which a
/// strength so estimated was off at worst.
struct BreakShare {
    double share, factor;
};
BreakShare bond_break_share(const TestSetup& setup);

/// Strain at which this share of the points (at least one) has broken by the linear solution; infinite where it never
/// has. Points that cannot break do not count.
double strain_of_share(const std::vector<LinearBond>& bonds, double share);

/// @throws as prepare_test()
TestCheck check_test(const TestCase& description, const TestHooks& hooks = {});

}  // namespace crackle
