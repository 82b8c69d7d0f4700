// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/replacement.hpp"

#include <fmt/format.h>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"

namespace crackle {

namespace fs = std::filesystem;

bool is_being_moved(const fs::path& working, std::string& frames) {
    const fs::path mark = working / staged_mark;
    if (!is_there(mark)) return false;
    const std::string text = read_file(mark), first = std::string(moving_line) + '\n';
    if (!text.starts_with(first)) return false;
    frames = text.substr(first.size());
    return true;
}

void refuse_half_replaced(const fs::path& folder) {
    const fs::path whole = folder.has_filename() ? folder : folder.parent_path();
    std::string frames;
    if (!is_being_moved(whole.string() + staging_suffix, frames)) return;
    throw InputError(
        fmt::format("{0}: found results of two tests, because replacing the older ones was interrupted; `crackle test "
                    "--resume {0}` completes the replacement",
                    whole.string()));
}

}  // namespace crackle
