// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

std::vector<std::filesystem::path> files_read(const ResolvedCase& test) {
    std::vector<std::filesystem::path> files = test.case_files;
    files.insert(files.end(), test.data_files.begin(), test.data_files.end());
    return files;
}

}  // namespace crackle
