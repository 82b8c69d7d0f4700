// SPDX-License-Identifier: GPL-3.0-or-later
// The report page that the build bundles from tools/viewer and links into the program.
// Tested by tests/tools/commands/report_test.cpp.
#pragma once

#include <string_view>

namespace crackle::tools {

/// The page with markers in place of the data; empty in a build without the viewer.
std::string_view page_template();

}  // namespace crackle::tools
