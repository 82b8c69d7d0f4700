// SPDX-License-Identifier: GPL-3.0-or-later
// The page FILES.md: every file of a test with every column, key and array, from the declarations by which they are
// written.
// Tested by tests/tools/readme_test.py.
#pragma once

#include <iosfwd>

namespace crackle {

void describe_test_files(std::ostream& out);

}  // namespace crackle
