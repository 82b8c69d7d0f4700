// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/toml_file.hpp"

#include <fmt/format.h>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/toml_shape.hpp"

namespace crackle {

toml::table parse_toml(const std::filesystem::path& path, const std::string& expected) {
    if (!is_file(path)) {
        throw InputError(fmt::format("{}: found no such file, expected {}; check the path", path.string(), expected));
    }
    const std::string text = read_text(path);
    check_toml_shape(path.string(), text);
    try {
        return toml::parse(text, path.string());
    } catch (const toml::parse_error& problem) {
        throw InputError(fmt::format("{}:{}: not valid TOML: {:.200}", path.string(), problem.source().begin.line,
                                     problem.description()));
    }
}

std::string line_of(const std::filesystem::path& file, const toml::node& node) {
    return fmt::format("{}:{}", file.string(), node.source().begin.line);
}

std::string kind_name(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::string:
            return "a text";
        case toml::node_type::integer:
            return "a whole number";
        case toml::node_type::floating_point:
            return "a number";
        case toml::node_type::boolean:
            return "true or false";
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return "an array";
        default:
            return "a date or time";
    }
}

std::string shown(const toml::node& node) {
    if (const auto* text = node.as_string()) return fmt::format("\"{:.40}\"", text->get());
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
    return kind_name(node);
}

}  // namespace crackle
