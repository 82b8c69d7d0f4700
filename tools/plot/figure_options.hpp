// SPDX-License-Identifier: GPL-3.0-or-later
// How a figure looks, by the options that the commands that draw have in common.
// Tested by tests/tools/commands/plot_test.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/plot/canvas.hpp"

namespace boost::program_options {
class options_description;
class variables_map;
}  // namespace boost::program_options

namespace crackle::plot {

struct FigureLook {
    double width = 0.0;  // pt
    SheetStyle sheet;
    std::string title;
};

/// Long names of what add_figure_options() adds.
const std::vector<std::string>& figure_options();

/// --columns, --width, --font, --font-size, --dpi, --title. @param columns of a journal, by default
void add_figure_options(boost::program_options::options_description& options, int columns);

/// @param command for messages, "plot" @throws InputError for a value out of range, and for --dpi of a figure without
/// dots
FigureLook figure_look(const std::string& command, const boost::program_options::variables_map& given, Format format);

/// Of "svg", "pdf" or "png". @param where the name stands, for messages @throws InputError for another
Format format_named(const std::string& command, const std::string& where, const std::string& name);

/// By the ending of the figure's name. @throws InputError
Format format_of_output(const std::string& command, const std::filesystem::path& output);

/// @throws InputError if the option's number lies outside
double number_between(const std::string& command, const boost::program_options::variables_map& given,
                      const char* option, double low, double high, const char* unit);

}  // namespace crackle::plot
