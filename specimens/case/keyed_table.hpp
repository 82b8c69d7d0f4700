// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of a TOML file whose keys are declared in a list. Unknown keys and values of the wrong type are rejected with
// file, line and key. Used to read campaign plans and the rocks to be calibrated.
// Tested by tests/specimens/campaign/plan_test.cpp.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/base/names.hpp"
#include "specimens/case/parameter.hpp"
#include "specimens/case/toml_file.hpp"

namespace crackle {

struct DeclaredKey {
    const char* table;  ///< "", "[packings]", or "[[axis]]" for a table that may occur several times
    const char *key, *expected, *sentence;
};

/// One table of a file.
class KeyedTable {
  public:
    /// @param name  the table's name in the declarations  @throws InputError if the table has a key that is not
    /// declared
    KeyedTable(const std::filesystem::path& file, std::string name, const toml::table& table,
               std::span<const DeclaredKey> declared);

    std::string where(const char* key) const;  ///< "file:line" of the key, or of the table if the key is missing
    [[noreturn]] void refuse(const char* key, const std::string& found, const std::string& expected) const;
    /// Rejects a value; the error states the expected value from the declaration.
    [[noreturn]] void refuse(const char* key, const std::string& found) const;

    const toml::node* get(const char* key) const { return table_.get(key); }
    // The value of a key; empty if the key is missing. @throws InputError if the value has the wrong type
    std::optional<std::string> text(const char* key) const;
    std::optional<double> number(const char* key) const;
    std::optional<double> positive(const char* key) const;
    std::optional<std::int64_t> whole(const char* key, std::int64_t least, std::int64_t most = 1'000'000'000'000) const;
    std::vector<std::string> texts(const char* key) const;
    /// Enumerator named by the key's value; the first enumerator if the key is missing.
    template <HasNames Value>
    Value choice(const char* key) const {
        const std::optional<std::string> name = text(key);
        const std::optional<Value> found = name ? from_name<Value>(*name) : Value{};
        if (!found) refuse(key, shown(*get(key)));
        return *found;
    }
    /// Converts a TOML value to a CaseValue.
    CaseValue case_value(const char* key, const toml::node& node) const;

  private:
    std::string label(const std::string& key) const { return name_.empty() ? key : name_ + " " + key; }

    const std::filesystem::path& file_;
    std::string name_;
    const toml::table& table_;
    std::span<const DeclaredKey> declared_;
};

/// A file and its declared tables. @param declared  the declarations, which must outlive this object
class KeyedFile {
  public:
    /// @param expected  the kind of file, such as "a plan of a campaign" @throws InputError, including for unknown
    /// top-level tables or keys
    KeyedFile(const std::filesystem::path& path, const std::string& expected, std::span<const DeclaredKey> declared);

    const std::filesystem::path& path() const { return path_; }
    KeyedTable top() const { return {path_, "", content_, declared_}; }
    bool has(const char* name) const { return content_.get(name) != nullptr; }
    /// The table "[name]"; empty if the table is missing.
    KeyedTable table(const char* name) const;
    /// All tables "[[name]]".
    std::vector<KeyedTable> tables(const char* name) const;

  private:
    std::filesystem::path path_;
    std::span<const DeclaredKey> declared_;
    toml::table content_, absent_;
};

/// Formats the declared keys as a table for users.
std::string describe_declared_keys(std::span<const DeclaredKey> declared);

}  // namespace crackle
