// SPDX-License-Identifier: GPL-3.0-or-later
// The commit that the program was built from. Results do not name it: they would differ from build to build.
// Tested by tests/tools/command_line/build_commit_test.py.
#pragma once

namespace crackle::tools {

/// "0123456789ab", or "0123456789ab, with changes" where tracked files differed from it, or "unknown: ..." with the
/// reason.
extern const char* const build_commit;

}  // namespace crackle::tools
