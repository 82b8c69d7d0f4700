// SPDX-License-Identifier: GPL-3.0-or-later
// Tests which system errors concern a path given by the user, and which are system failures.
#include "solver/base/system_failure.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

constexpr int errors_of_paths[] = {ENOENT, ENOTDIR, EISDIR, EACCES, EPERM, EROFS, ENAMETOOLONG, ELOOP, EEXIST};
constexpr int errors_of_systems[] = {EMFILE, ENFILE, EIO,    ENOSPC, EDQUOT,  EFBIG,  ENOMEM,
                                     EAGAIN, EINTR,  ENOLCK, ESTALE, ENOBUFS, ENOSYS, EREMOTEIO};

TEST(SystemFailure, IsWhateverIsNotAboutAPath) {
    for (const int error : errors_of_paths) {
        EXPECT_THROW(fail_reading(error, "file"), InputError) << std::strerror(error);
        EXPECT_THROW(fail_writing(error, "file"), OutputError) << std::strerror(error);
    }
    for (const int error : errors_of_systems) {
        EXPECT_THROW(fail_reading(error, "file"), SystemFailure) << std::strerror(error);
        EXPECT_THROW(fail_writing(error, "file"), SystemFailure) << std::strerror(error);
    }
}

TEST(SystemFailure, OfAFileThatIsNotWrittenIsNoJudgementOnItsName) {
    const testing::ScratchFolder scratch;
    EXPECT_THROW(replace_file(scratch / "absent" / "file", "text"), OutputError);
    // This file can be opened, but reading it fails with EIO, as on a failing disc.
    EXPECT_THROW(static_cast<void>(read_file("/proc/self/mem")), SystemFailure);
    EXPECT_THROW(static_cast<void>(read_file(scratch / "absent")), InputError);
}

TEST(SystemFailure, KeepsItsTextWhereMoreIsSaid) {
    const SystemFailure full("out: cannot be written (No space left on device)");
    EXPECT_STREQ(SystemFailure(full, "earlier results are as they were").what(),
                 "out: cannot be written (No space left on device); earlier results are as they were");
}

}  // namespace
}  // namespace crackle
