// SPDX-License-Identifier: GPL-3.0-or-later
// Appearance of a figure, set by options common to all commands that draw.
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

/// Long names of the options added by add_figure_options().
const std::vector<std::string>& figure_options();

/// Adds --columns, --width, --font, --font-size, --dpi, --title. @param columns default width, in journal columns
void add_figure_options(boost::program_options::options_description& options, int columns);

/// @param command name for messages, for example "plot" @throws InputError if a value is out of range, or if --dpi is
/// given for a format other than PNG
FigureLook figure_look(const std::string& command, const boost::program_options::variables_map& given, Format format);

/// The format named "svg", "pdf" or "png". @param where source of the name, for messages @throws InputError for
/// any other name
Format format_named(const std::string& command, const std::string& where, const std::string& name);

/// The format given by the extension of the output file. @throws InputError
Format format_of_output(const std::string& command, const std::filesystem::path& output);

/// @throws InputError if the option's value is out of range
double number_between(const std::string& command, const boost::program_options::variables_map& given,
                      const char* option, double low, double high, const char* unit);

}  // namespace crackle::plot
