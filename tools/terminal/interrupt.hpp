// SPDX-License-Identifier: GPL-3.0-or-later
// Signals: Ctrl-C as a wish to end cleanly.
// Tested by tests/tools/terminal/interrupt_test.cpp and tests/tools/commands/test_test.cpp.
#pragma once

#include <functional>

namespace crackle::tools {

/// From now on SIGINT, SIGTERM and SIGHUP (a closed terminal) are taken down instead of ending the program; a second
/// one, of whichever kind, ends it. Where the program is still there two seconds later, in a library's call that it
/// cannot leave, say, a line on standard error tells of the second one.
void watch_interrupts();

/// From now on a pipe without a reader and a file beyond the limit on its size are errors of writing, as a full disc
/// is, and not the end of the program in the middle of a file.
void make_writing_fail_by_error();

/// For a host that hears signals itself, as Python does: watch_interrupts() leaves them to it, and interrupted() asks.
void hear_interrupts_by(std::function<bool()> host);

/// Whether a signal to end has come.
bool interrupted();

}  // namespace crackle::tools
