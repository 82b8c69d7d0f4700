// SPDX-License-Identifier: GPL-3.0-or-later
// Empty page template for builds with CRACKLE_VIEWER=OFF.
// Tested by tests/tools/commands/report_test.cpp.
#include "tools/page/page_template.hpp"

namespace crackle::tools {

std::string_view page_template() { return {}; }

}  // namespace crackle::tools
