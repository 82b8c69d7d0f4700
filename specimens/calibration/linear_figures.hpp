// SPDX-License-Identifier: GPL-3.0-or-later
// Moduli of a rock's tests by the sparse linear solve, as means over packings: what the elastic keys are found from
// before anything is loaded.
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

/// Which of them a figure of summary.json is near, before anything breaks; nothing: none.
std::optional<LinearFigure> linear_figure_of(std::string_view figure);
/// Of a key of a case: whether the linear search moves it.
bool is_elastic_key(std::string_view key);

struct LinearRequest {
    const Rock* rock = nullptr;
    std::vector<std::size_t> tests;  ///< whose moduli
    std::filesystem::path packings;  ///< folder of a campaign's
    int workers = 1;
    std::function<bool()> interrupted;
};
/// @param values of all free keys  @return a vector a test asked for, by LinearFigure: mean over the fit packings
/// @throws InputError if a packing gives none; TestInterrupted
std::vector<std::vector<double>> mean_linear_figures(const LinearRequest& request, std::span<const double> values);

}  // namespace crackle
