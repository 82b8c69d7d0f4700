// SPDX-License-Identifier: GPL-3.0-or-later
// The contents of a test's summary.json, asked for numbers, words and flags by their keys. Sources that need the whole
// tree take json() and include the JSON library.
// Tested by tests/specimens/results/stated_files_test.cpp.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace crackle {

class TestSummary {
  public:
    TestSummary();  ///< without any key
    explicit TestSummary(nlohmann::ordered_json tree);
    TestSummary(const TestSummary& other);
    TestSummary(TestSummary&& other) noexcept;
    TestSummary& operator=(const TestSummary& other);
    TestSummary& operator=(TestSummary&& other) noexcept;
    ~TestSummary();

    /// From the text of a file; without any key if it is no JSON.
    static TestSummary parse(std::string_view text);

    // `place` is a key, or behind that of a table a key within: "emission.window".
    bool contains(std::string_view place) const;
    std::optional<double> number(std::string_view place) const;  ///< none where there is no number
    std::string word(std::string_view place) const;              ///< empty where there is no string
    bool flag(std::string_view place) const;                     ///< false where there is no flag
    std::string text_of(std::string_view place) const;  ///< as JSON writes the value; empty where there is none

    /// All of it: on one line, or a line an entry, each level indented by so many spaces.
    std::string text(int indent = -1) const;

    nlohmann::ordered_json& json() { return *tree_; }
    const nlohmann::ordered_json& json() const { return *tree_; }

  private:
    std::unique_ptr<nlohmann::ordered_json> tree_;  // nothing only where it was moved from
};

}  // namespace crackle
