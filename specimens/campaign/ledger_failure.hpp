// SPDX-License-Identifier: GPL-3.0-or-later
// Translates failures of SQLite into errors: a failed system call, a lock held by another program, or a damaged file.
// Tested by tests/specimens/campaign/ledger_test.cpp.
#pragma once

#include <string>

namespace SQLite {
class Exception;
}

namespace crackle {

/// Time to wait for another program that has locked the ledger, ms.
inline constexpr int busy_milliseconds = 10'000;

/// Throws the error that describes a failure of SQLite. @param kept errno kept by SQLite, or 0 @param last errno of the
/// last failed call @param file name of the ledger
/// @throws OutputError for failures of the operating system, std::bad_alloc, or InputError for a file that is not a
/// complete ledger
[[noreturn]] void refuse_ledger(const SQLite::Exception& error, int kept, int last, const std::string& file);

}  // namespace crackle
