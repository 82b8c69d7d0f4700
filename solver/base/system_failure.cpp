// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/system_failure.hpp"

#include <algorithm>
#include <array>
#include <cerrno>

namespace crackle {
namespace {

constexpr std::array about_the_path{ENOENT, ENOTDIR, EISDIR, EACCES,    EPERM, EROFS,  ENAMETOOLONG, ELOOP, EEXIST,
                                    EXDEV,  EINVAL,  EILSEQ, ENOTEMPTY, ENXIO, ENODEV, ETXTBSY,      EBUSY};

}  // namespace

bool is_about_the_path(int error) {
    return std::find(about_the_path.begin(), about_the_path.end(), error) != about_the_path.end();
}

void fail_reading(int error, const std::string& text) {
    if (error == 0 || is_about_the_path(error)) throw UnreadableFile(text);
    throw SystemFailure(text);
}

void fail_writing(int error, const std::string& text) {
    if (error == 0 || is_about_the_path(error)) throw OutputError(text);
    throw SystemFailure(text);
}

}  // namespace crackle
