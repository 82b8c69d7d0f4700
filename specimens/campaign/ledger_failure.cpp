// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/ledger_failure.hpp"

#include <SQLiteCpp/Exception.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"

namespace crackle {
namespace {

// Error numbers that can explain a failed read or write. Other numbers are left over from SQLite's search for files
// that need not exist.
constexpr std::array causes{ENOSPC, EDQUOT, EFBIG, ENOMEM, EMFILE, ENFILE, ENOLCK, EROFS, EPERM, EACCES};

/// errno that explains a failure. @param kept  errno kept by SQLite, or 0 @param last  errno of the last failed call
int reason_of(int code, int kept, int last) {
    if (code == SQLITE_FULL) return ENOSPC;
    if (code == SQLITE_IOERR) {
        for (const int error : {kept, last})
            if (std::find(causes.begin(), causes.end(), error) != causes.end()) return error;
        return EIO;
    }
    // When access to a file is denied, SQLite looks for further files. ENOENT therefore does not explain the failure.
    return code == SQLITE_CANTOPEN && last != 0 && last != ENOENT ? last : EACCES;
}

}  // namespace

void refuse_ledger(const SQLite::Exception& error, int kept, int last, const std::string& file) {
    // If the disc fails to return a page, SQLite reports the file as damaged.
    const int code = error.getErrorCode() == SQLITE_CORRUPT && last == EIO ? SQLITE_IOERR : error.getErrorCode();
    const int reason = reason_of(code, kept, last);
    switch (code) {
        case SQLITE_FULL:
        case SQLITE_IOERR:
        case SQLITE_READONLY:
        case SQLITE_CANTOPEN: {
            const std::string text = fmt::format(
                "{}: cannot be read or written ({}: {}), expected a writable folder with room on the disc; the "
                "same command resumes",
                file, ::sqlite3_errstr(code), std::strerror(reason));
            fail_writing(reason, text);
        }
        case SQLITE_NOMEM:
            throw std::bad_alloc();
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            throw OutputError(
                fmt::format("{}: found it locked by another program, expected it to be free within {} s; end "
                            "that program, then run the same command again",
                            file, busy_milliseconds / 1000));
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
            throw InputError(
                fmt::format("{}: found a file that is not a ledger or is damaged ({}), expected one that "
                            "`crackle campaign` made; restore a copy, or choose another folder with -o",
                            file, error.getErrorStr()));
        default:
            throw InputError(fmt::format("{}: {}, expected a ledger that `crackle campaign` made", file, error.what()));
    }
}

}  // namespace crackle
