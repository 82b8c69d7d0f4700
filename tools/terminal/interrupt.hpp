// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C as a wish to end cleanly.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

namespace crackle::tools {

/// From now on SIGINT and SIGTERM are taken down instead of ending the program; a second one of the same kind ends it.
void watch_interrupts();

/// Whether one has come.
bool interrupted();

}  // namespace crackle::tools
