// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of a TOML file whose keys are declared in a list: what is unknown or of another kind is refused with its file,
// line and key. Plans of campaigns and rocks to be calibrated are read so.
// Tested by tests/specimens/campaign/plan_test.cpp.
#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "specimens/case/test_case.hpp"
#include "specimens/case/toml_file.hpp"

namespace crackle {

struct DeclaredKey {
    const char* table;  ///< "", "[packings]", "[[axis]]" for one that may come several times
    const char *key, *expected, *sentence;
};

/// One table of a file.
class KeyedTable {
  public:
    /// @param name as declared  @throws InputError for a key that is not
    KeyedTable(const std::filesystem::path& file, std::string name, const toml::table& table,
               std::span<const DeclaredKey> declared);

    std::string where(const char* key) const;  ///< "file:line", of the table where the key is not there
    [[noreturn]] void refuse(const char* key, const std::string& found, const std::string& expected) const;
    /// As the list of keys describes it.
    [[noreturn]] void refuse(const char* key, const std::string& found) const;

    const toml::node* get(const char* key) const { return table_.get(key); }
    // What a key says; nothing where it is not there. @throws InputError for a value of another kind
    std::optional<std::string> text(const char* key) const;
    std::optional<double> number(const char* key) const;
    std::optional<double> positive(const char* key) const;
    std::optional<std::int64_t> whole(const char* key, std::int64_t least, std::int64_t most = 1'000'000'000'000) const;
    std::vector<std::string> texts(const char* key) const;
    /// The place of a word among those that a key understands; the first where the key is not there.
    template <class Value>
    Value choice(const char* key, std::initializer_list<const char*> words) const {
        const std::optional<std::string> found = text(key);
        if (!found) return Value{};
        const auto at = std::find_if(words.begin(), words.end(), [&](const char* word) { return *found == word; });
        if (at == words.end()) refuse(key, shown(*get(key)));
        return static_cast<Value>(at - words.begin());
    }
    /// A value that a key of a case may have.
    CaseValue case_value(const char* key, const toml::node& node) const;

  private:
    std::string label(const std::string& key) const { return name_.empty() ? key : name_ + " " + key; }

    const std::filesystem::path& file_;
    std::string name_;
    const toml::table& table_;
    std::span<const DeclaredKey> declared_;
};

/// A file and its declared tables. @param declared outlives it
class KeyedFile {
  public:
    /// @param expected in words, "a plan of a campaign" @throws InputError, also for an unknown table or key at the top
    KeyedFile(const std::filesystem::path& path, const std::string& expected, std::span<const DeclaredKey> declared);

    const std::filesystem::path& path() const { return path_; }
    KeyedTable top() const { return {path_, "", content_, declared_}; }
    bool has(const char* name) const { return content_.get(name) != nullptr; }
    /// "[name]"; empty where it is not there.
    KeyedTable table(const char* name) const;
    /// Each "[[name]]".
    std::vector<KeyedTable> tables(const char* name) const;

  private:
    std::filesystem::path path_;
    std::span<const DeclaredKey> declared_;
    toml::table content_, absent_;
};

/// Table of such keys, for people.
std::string describe_declared_keys(std::span<const DeclaredKey> declared);

}  // namespace crackle
