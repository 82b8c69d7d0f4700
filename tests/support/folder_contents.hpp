// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the files of a test's folder for comparison byte by byte.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "solver/files/read_file.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle::testing {

/// Contents of every file by name; summary.json without values that depend on the clock.
inline std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::string text = read_file(entry.path());
        if (entry.path().filename() == "summary.json") {
            auto json = nlohmann::ordered_json::parse(text);
            for (const char* key : {"wall_seconds", "step_seconds", "particle_steps_per_second", "threads"})
                json.erase(key);
            text = json.dump();
        }
        files[std::filesystem::relative(entry.path(), folder).string()] = text;
    }
    return files;
}

inline void expect_same(const std::map<std::string, std::string>& got,
                        const std::map<std::string, std::string>& expected, const std::string& what) {
    for (const auto& [name, text] : expected) {
        const auto found = got.find(name);
        if (found == got.end()) {
            ADD_FAILURE() << what << ": " << name << " is missing";
        } else {
            EXPECT_TRUE(found->second == text) << what << ": " << name << " has other bytes";
        }
    }
    EXPECT_EQ(got.size(), expected.size()) << what << ": number of files";
}

}  // namespace crackle::testing
