// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/figure_options.hpp"

#include <fmt/format.h>

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/value_semantic.hpp>
#include <boost/program_options/variables_map.hpp>
#include <optional>

#include "solver/base/errors.hpp"

namespace crackle::plot {
namespace {

namespace po = boost::program_options;

constexpr double column_width = 85.0, page_width = 180.0;  // widths of a column and a page in most journals, mm

}  // namespace

const std::vector<std::string>& figure_options() {
    static const std::vector<std::string> all{"columns", "width", "font", "font-size", "dpi", "title"};
    return all;
}

void add_figure_options(po::options_description& options, int columns) {
    options.add_options()("columns", po::value<int>()->value_name("N")->default_value(columns),
                          "width of the figure in columns of a journal: 1 (85 mm) or 2 (180 mm)")                     //
        ("width", po::value<double>()->value_name("MM"), "width of the figure, mm, instead of --columns")             //
        ("font", po::value<std::string>()->value_name("NAME")->default_value(SheetStyle{}.font), "font of all text")  //
        ("font-size", po::value<double>()->value_name("PT")->default_value(SheetStyle{}.font_size),
         "size of all text, pt")                                                                                  //
        ("dpi", po::value<double>()->value_name("N")->default_value(SheetStyle{}.dpi), "dots per inch, for PNG")  //
        ("title", po::value<std::string>()->value_name("TEXT")->default_value("", ""), "heading above the figure");
}

double number_between(const std::string& command, const po::variables_map& given, const char* option, double low,
                      double high, const char* unit) {
    const double value = given[option].as<double>();
    if (!(value >= low && value <= high))
        throw InputError(fmt::format("{}: --{}: found {}, expected {} to {}{}{}", command, option, value, low, high,
                                     *unit ? " " : "", unit));
    return value;
}

FigureLook figure_look(const std::string& command, const po::variables_map& given, Format format) {
    if (format != Format::png && !given["dpi"].defaulted())
        throw InputError(fmt::format(
            "{}: --dpi: found with a vector format, but has no effect there; leave it out, or write a .png", command));
    const int columns = given["columns"].as<int>();
    if (columns != 1 && columns != 2)
        throw InputError(fmt::format("{}: --columns: found {}, expected 1 or 2", command, columns));
    FigureLook look;
    const double width = given.contains("width") ? number_between(command, given, "width", 30.0, 1000.0, "mm")
                         : columns == 1          ? column_width
                                                 : page_width;
    look.width = width * points_of_mm;
    look.sheet.font = given["font"].as<std::string>();
    look.sheet.font_size = number_between(command, given, "font-size", 3.0, 72.0, "pt");
    look.sheet.dpi = number_between(command, given, "dpi", 20.0, 2400.0, "dots per inch");
    look.title = given["title"].as<std::string>();
    return look;
}

Format format_named(const std::string& command, const std::string& where, const std::string& name) {
    if (const std::optional<Format> format = from_name<Format>(name)) return *format;
    throw InputError(fmt::format("{}: {}: found '{}', expected svg, pdf or png", command, where, name));
}

Format format_of_output(const std::string& command, const std::filesystem::path& output) {
    const std::string extension = output.extension().string();
    return format_named(command, fmt::format("--output {}", output.string()),
                        extension.empty() ? "" : extension.substr(1));
}

}  // namespace crackle::plot
