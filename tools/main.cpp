// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle COMMAND ...`: runs the command, turns failures into one message and an exit code.
// Tested by tests/tools/commands/command_line_test.cpp.

#include <fmt/format.h>
#include <malloc.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <span>
#include <system_error>

#include "solver/base/errors.hpp"
#include "solver/base/instruction_set.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/interrupt.hpp"

#ifdef __SANITIZE_ADDRESS__
// What a command leaves behind when it ends goes back to the system; leaks of what it calls show in the unit tests.
// Looking for them takes as long as all else of a short command.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }  // NOLINT: the sanitizer's own name
#endif

namespace {

/// Of the standard output, a pipe.
bool reader_is_gone() {
    pollfd output{STDOUT_FILENO, 0, 0};
    return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace crackle::tools;
    // Arrays of large specimens go back to the system when they are freed. By itself glibc soon keeps them for good:
    // a list of neighbours built again would then cost as much memory as the whole specimen.
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 22);
    const auto all = std::span(argv, static_cast<std::size_t>(argc));
    make_writing_fail_by_error();
    try {
        crackle::chosen_set();  // an unknown CRACKLE_ISA is said before anything is done
        const int code = call_command({all.begin() + 1, all.end()});
        // A result that nobody receives is none: a full disk shows when the last of it is written.
        errno = 0;
        const bool written = std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
        if (written || code != exit_done) return code;
        if (reader_is_gone()) return exit_system_fails;  // `| head` has seen what it wanted
        report_error(fmt::format("standard output: {}, expected one that takes all that is printed",
                                 errno != 0 ? std::generic_category().message(errno) : "cannot be written"));
        return exit_system_fails;
    } catch (const crackle::InputError& error) {
        report_error(error.what());
        return exit_bad_input;
    } catch (const std::filesystem::filesystem_error& error) {
        report_error(fmt::format("{}: {}, expected a path that can be read and written; check its permissions",
                                 error.path1().string(), error.code().message()));
        return exit_bad_input;
    } catch (const std::bad_alloc&) {
        report_error("found less memory than the input needs; make the specimen smaller");
        return exit_bad_input;
    } catch (const crackle::UnstableRun& error) {
        report_error(error.what());
        return exit_unstable;
    } catch (const std::system_error& error) {
        if (reader_is_gone()) return exit_system_fails;  // seen while printing still
        report_error(fmt::format("{}: {}, expected to go on", argc > 1 ? argv[1] : "crackle", error.what()));
        return exit_system_fails;
    } catch (const std::exception& error) {  // of a library, which does not know what it was asked for
        report_error(fmt::format("{}: found '{}', expected to go on; please report it with the command and its files",
                                 argc > 1 ? argv[1] : "crackle", error.what()));
        return exit_system_fails;
    }
}
