// SPDX-License-Identifier: GPL-3.0-or-later
// Moduli of a rock's tests from sparse linear solves, averaged over packings. The elastic keys are calibrated to these
// moduli before any test is loaded.
// Tested by tests/specimens/calibration/calibrate_test.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "specimens/calibration/rock.hpp"

namespace crackle {

enum class LinearFigure : std::uint8_t { youngs_modulus, poissons_ratio, gauge_modulus };
inline constexpr std::size_t linear_figures = 3;

/// The linear result that approximates an entry of summary.json as long as no bond is broken; empty if there is none.
std::optional<LinearFigure> linear_figure_of(std::string_view figure);
/// Whether the linear search adjusts this key of a case.
bool is_elastic_key(std::string_view key);

struct LinearRequest {
    const Rock* rock = nullptr;
    std::vector<std::size_t> tests;  ///< indices of the tests whose moduli are requested
    std::filesystem::path packings;  ///< folder of a campaign's packings
    int workers = 1;
    std::function<bool()> interrupted;
};
/// Mean moduli over the packings used for fitting. @param values  values of all free keys
/// @return one vector per requested test, indexed by LinearFigure
/// @throws InputError if a packing has no moduli; TestInterrupted
std::vector<std::vector<double>> mean_linear_figures(const LinearRequest& request, std::span<const double> values);

}  // namespace crackle
