// SPDX-License-Identifier: GPL-3.0-or-later
// Generates the page FILES.md from the declarations that also write the files. It lists all files of a test with all
// their columns, keys and arrays.
// Tested by tests/tools/readme_test.py.
#pragma once

#include <iosfwd>

namespace crackle {

/// Writes the page as Markdown.
void describe_test_files(std::ostream& out);

}  // namespace crackle
