// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/keyed_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

/// The table name in a heading, such as axis in "[[axis]]".
std::string_view word_of(std::string_view heading) {
    while (!heading.empty() && heading.front() == '[') heading = heading.substr(1, heading.size() - 2);
    return heading;
}

}  // namespace

KeyedTable::KeyedTable(const fs::path& file, std::string name, const toml::table& table,
                       std::span<const DeclaredKey> declared)
    : file_(file), name_(std::move(name)), table_(table), declared_(declared) {
    std::vector<std::string> known;
    const auto add = [&](const std::string& word) {
        if (std::find(known.begin(), known.end(), word) == known.end()) known.push_back(word);
    };
    for (const DeclaredKey& one : declared_)
        if (name_ == one.table) add(one.key);
    if (name_.empty()) {
        for (const DeclaredKey& one : declared_)
            if (*one.table != '\0') add(one.table);
    }
    for (const auto& [key, node] : table_) {
        const std::string_view word = key.str();
        const bool is_known = std::any_of(known.begin(), known.end(), [&](const std::string& one) {
            return word == (one.front() == '[' ? word_of(one) : std::string_view(one));
        });
        if (is_known) continue;
        throw InputError(fmt::format("{}: {:.40}: found an unknown key, expected one of {}; correct or remove it",
                                     line_of(file_, node), label(std::string(word)), fmt::join(known, ", ")));
    }
}

std::string KeyedTable::where(const char* key) const {
    const toml::node* node = table_.get(key);
    return node != nullptr ? line_of(file_, *node) : line_of(file_, table_);
}

void KeyedTable::refuse(const char* key, const std::string& found, const std::string& expected) const {
    throw InputError(fmt::format("{}: {}: found {}, expected {}", where(key), label(key), found, expected));
}

void KeyedTable::refuse(const char* key, const std::string& found) const {
    const auto declared = std::find_if(declared_.begin(), declared_.end(), [&](const DeclaredKey& one) {
        return name_ == one.table && std::string_view(key) == one.key;
    });
    refuse(key, found, declared->expected);
}

std::optional<std::string> KeyedTable::text(const char* key) const {
    const toml::node* node = get(key);
    if (node == nullptr) return std::nullopt;
    const auto* found = node->as_string();
    if (found == nullptr || found->get().empty()) refuse(key, shown(*node));
    return found->get();
}

std::optional<double> KeyedTable::number(const char* key) const {
    const toml::node* node = get(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_number() || !std::isfinite(*node->value<double>())) refuse(key, shown(*node));
    return *node->value<double>();
}

std::optional<double> KeyedTable::positive(const char* key) const {
    const std::optional<double> found = number(key);
    if (found && !(*found > 0.0)) refuse(key, shown(*get(key)));
    return found;
}

std::optional<std::int64_t> KeyedTable::whole(const char* key, std::int64_t least, std::int64_t most) const {
    const toml::node* node = get(key);
    if (node == nullptr) return std::nullopt;
    const auto* found = node->as_integer();
    if (found == nullptr || found->get() < least || found->get() > most) refuse(key, shown(*node));
    return found->get();
}

std::vector<std::string> KeyedTable::texts(const char* key) const {
    std::vector<std::string> all;
    const toml::node* node = get(key);
    if (node == nullptr) return all;
    const toml::array* entries = node->as_array();
    if (entries == nullptr) refuse(key, kind_name(*node));
    for (const toml::node& entry : *entries) {
        if (!entry.is_string()) refuse(key, kind_name(entry));
        all.push_back(entry.as_string()->get());
    }
    return all;
}

CaseValue KeyedTable::case_value(const char* key, const toml::node& node) const {
    if (const auto* flag = node.as_boolean()) return flag->get();
    if (const auto* number = node.as_integer()) return number->get();
    if (const auto* number = node.as_floating_point()) return number->get();
    if (const auto* text = node.as_string()) return text->get();
    refuse(key, kind_name(node), "a value that a key of a case can have: a number, a text, true or false");
}

KeyedFile::KeyedFile(const fs::path& path, const std::string& expected, std::span<const DeclaredKey> declared)
    : path_(path), declared_(declared), content_(parse_toml(path, expected)) {
    (void)top();
}

KeyedTable KeyedFile::table(const char* name) const {
    const toml::node* node = content_.get(name);
    const std::string heading = fmt::format("[{}]", name);
    if (node == nullptr) return {path_, heading, absent_, declared_};
    if (!node->is_table()) {
        throw InputError(fmt::format("{}: {}: found {}, expected a table; write {} above its keys",
                                     line_of(path_, *node), name, kind_name(*node), heading));
    }
    return {path_, heading, *node->as_table(), declared_};
}

std::vector<KeyedTable> KeyedFile::tables(const char* name) const {
    std::vector<KeyedTable> all;
    const toml::node* node = content_.get(name);
    if (node == nullptr) return all;
    const std::string heading = fmt::format("[[{}]]", name);
    const toml::array* entries = node->as_array();
    if (entries == nullptr ||
        std::any_of(entries->begin(), entries->end(), [](const toml::node& entry) { return !entry.is_table(); })) {
        throw InputError(fmt::format("{}: {}: found {}, expected a list of tables; write {} above each",
                                     line_of(path_, *node), name, kind_name(*node), heading));
    }
    for (const toml::node& entry : *entries) all.emplace_back(path_, heading, *entry.as_table(), declared_);
    return all;
}

std::string describe_declared_keys(std::span<const DeclaredKey> declared) {
    std::string text, table;
    for (const DeclaredKey& key : declared) {
        if (table != key.table) text += fmt::format("\n{}\n", table = key.table);
        text += fmt::format("  {:12} {}. {}\n", key.key, key.expected, key.sentence);
    }
    return text;
}

}  // namespace crackle
