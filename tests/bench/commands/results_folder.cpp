// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/commands/results_folder.hpp"

#include <fmt/format.h>

#include "solver/base/errors.hpp"

namespace crackle::tools {

void make_results_folder(const std::filesystem::path& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (!std::filesystem::is_directory(folder))
        throw InputError(fmt::format("{}: cannot be made, expected a folder or a path for one", folder.string()));
}

}  // namespace crackle::tools
