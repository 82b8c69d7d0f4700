// SPDX-License-Identifier: GPL-3.0-or-later
// The commit from which the program was built. It is not written to results, since they would then differ between
// builds.
// Tested by tests/tools/command_line/build_commit_test.py.
#pragma once

namespace crackle::tools {

/// "0123456789ab"; or "0123456789ab, with changes" if tracked files differed from that commit; or "unknown: ..." with
/// the reason.
extern const char* const build_commit;

}  // namespace crackle::tools
