// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/toml_file.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/toml_shape.hpp"

namespace crackle {
namespace {

using Json = nlohmann::ordered_json;

/// Converts a JSON value to TOML. @param where, key  the position of the value, for error messages
std::unique_ptr<toml::node> node_of(const Json& value, const std::string& where, const std::string& key = {}) {
    if (value.is_boolean()) return std::make_unique<toml::value<bool>>(value.get<bool>());
    if (value.is_number_integer()) return std::make_unique<toml::value<std::int64_t>>(value.get<std::int64_t>());
    if (value.is_number_float()) return std::make_unique<toml::value<double>>(value.get<double>());
    if (value.is_string()) return std::make_unique<toml::value<std::string>>(value.get<std::string>());
    if (value.is_array()) {
        auto list = std::make_unique<toml::array>();
        for (const Json& one : value)
            list->push_back(std::move(*node_of(one, where, fmt::format("{}[{}]", key, list->size() + 1))));
        return list;
    }
    if (!value.is_object())
        throw InputError(
            fmt::format("{}: {}: found {}, expected a value; leave it out", where, key, value.type_name()));
    auto table = std::make_unique<toml::table>();
    for (const auto& [name, inner] : value.items())
        table->insert(name, std::move(*node_of(inner, where, key.empty() ? name : fmt::format("{}.{}", key, name))));
    return table;
}

}  // namespace

toml::table parse_toml(const std::filesystem::path& path, const std::string& expected) {
    if (!is_file(path)) {
        throw InputError(fmt::format("{}: found no such file, expected {}; check the path", path.string(), expected));
    }
    return parse_toml_text(path, read_text(path, most_bytes_of_keys));
}

toml::table parse_toml_text(const std::filesystem::path& name, const std::string& text) {
    check_toml_shape(name.string(), text);
    try {
        return toml::parse(text, name.string());
    } catch (const toml::parse_error& problem) {
        throw InputError(fmt::format("{}:{}: not valid TOML: {:.200}", name.string(), problem.source().begin.line,
                                     problem.description()));
    }
}

toml::table toml_of_json(const std::filesystem::path& name, std::string_view json) {
    const Json content = Json::parse(json, nullptr, false);
    if (!content.is_object())
        throw InputError(fmt::format("{}: found {}, expected tables of keys", name.string(),
                                     content.is_discarded() ? "no JSON" : content.type_name()));
    return std::move(*node_of(content, name.string())->as_table());
}

std::string line_of(const std::filesystem::path& file, const toml::node& node) {
    const auto line = node.source().begin.line;
    return line == 0 ? file.string() : fmt::format("{}:{}", file.string(), line);
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
