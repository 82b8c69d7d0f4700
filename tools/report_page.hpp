// SPDX-License-Identifier: GPL-3.0-or-later
// Fills the bundled page with the results of tests: one HTML file that needs nothing else.
// A test's numbers are laid end to end as little-endian arrays, compressed with zlib, written as base64; a JSON
// manifest says where each array lies. tools/viewer/src/data.ts reads the same layout.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "specimens/results.hpp"

namespace crackle::tools {

/// @param page  the template, holding the marker once
/// @return the page's bytes: the same for the same results
std::string report_page(std::string_view page, const std::string& title, const std::vector<TestResults>& tests);

/// Reads the folders, writes the page under a temporary name and renames it.
/// @param title  empty: taken from the tests
/// @throws InputError for folders without results, or where `output` is a file that is not a report
void write_report(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& output,
                  const std::string& title = {});

}  // namespace crackle::tools
