// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/programs.hpp"

#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <system_error>

namespace crackle::tools {
namespace fs = std::filesystem;
namespace {

bool is_program(const fs::path& file) {
    std::error_code none;
    return fs::is_regular_file(file, none) && access(file.c_str(), X_OK) == 0;
}

}  // namespace

fs::path own_folder() {
    std::error_code none;
    return fs::read_symlink("/proc/self/exe", none).parent_path();
}

std::string program_on_path(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path file = fs::path(folder) / name;
        if (is_program(file)) return file.string();
    }
    return "";
}

std::string program_beside_or_on_path(const std::string& name) {
    const fs::path folder = own_folder();
    if (!folder.empty() && is_program(folder / name)) return (folder / name).string();
    return program_on_path(name);
}

}  // namespace crackle::tools
