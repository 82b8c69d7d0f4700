// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures of `crackle plot` have in common, whatever they are drawn from.
// Tested by tests/tools/commands/plot_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "tools/command_line/command_line.hpp"
#include "tools/plot/figure_options.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::tools {

using Words = std::vector<std::string>;

/// Appearance of a figure, for all kinds of input.
struct Look : plot::FigureLook {
    plot::Format format = plot::Format::svg;
    plot::DrawingStyle drawing;
};

/// Refuses options that have no effect on figures of `input`. @param used options that have an effect, in addition to
/// --output, --force and those for the appearance
void expect_options(const po::variables_map& given, const std::string& input, Words used);

}  // namespace crackle::tools
