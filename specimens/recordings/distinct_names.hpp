// SPDX-License-Identifier: GPL-3.0-or-later
// Names that distinguish recordings on one page or in one plot. Folder names are used if they differ.
// Tested by tests/tools/page/report_reading_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/recordings/recording.hpp"

namespace crackle {

/// A distinct name for each recording. The first naming scheme that distinguishes all of them is used: folder or file;
/// title; title with seed; folder with seed; end of the path; folder with a number. The seed is the packing's seed.
std::vector<std::string> distinct_names(const std::vector<Recording>& recordings);

}  // namespace crackle
