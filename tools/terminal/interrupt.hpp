// SPDX-License-Identifier: GPL-3.0-or-later
// Treats signals such as Ctrl-C as a request to end cleanly.
// Tested by tests/tools/terminal/interrupt_test.cpp and tests/tools/commands/test_test.cpp.
#pragma once

#include <functional>

namespace crackle::tools {

/// From now on, the first SIGINT, SIGTERM or SIGHUP (closed terminal) is only recorded, and a second one ends the
/// program. If the program is still running two seconds after the first, for example in a library call, a message on
/// stderr says that a second signal will end it.
void watch_interrupts();

/// From now on, if interrupted() is not called within five seconds of a signal, the program ends with exit code 130.
/// Use it during work that cannot poll, such as a factorisation, and that leaves no unfinished files behind.
/// @param last_words printed before the program ends; nullptr turns this behaviour off, for example while files are
/// being written
void end_unheard(const char* last_words);
/// Value of `last_words` for commands that can be resumed.
inline constexpr const char* words_of_resumable = "interrupted; run the same command again to resume";

/// From now on, writing to a pipe without a reader or beyond a file size limit causes an I/O error, as a full disc
/// does. By default it would end the program in the middle of a file.
void make_writing_fail_by_error();

/// For a host that handles signals itself, such as Python: watch_interrupts() then has no effect, and interrupted()
/// calls `host`.
void hear_interrupts_by(std::function<bool()> host);

/// Whether a signal to end the program was received.
bool interrupted();

}  // namespace crackle::tools
