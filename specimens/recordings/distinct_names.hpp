// SPDX-License-Identifier: GPL-3.0-or-later
// Names by which recordings on one page or in one figure are told apart: of their folders, if these differ.
// Tested by tests/tools/page/report_reading_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/recordings/recording.hpp"

namespace crackle {

/// A name for each, no two alike. The first of these that distinguishes all: folder or file; title; title with the
/// packing's seed; folder with its seed; the end of the path, as long as needed; folder with a number.
std::vector<std::string> distinct_names(const std::vector<Recording>& recordings);

}  // namespace crackle
