// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/shipped.hpp"

#include <system_error>

#include "tools/terminal/programs.hpp"

namespace crackle::tools {
namespace fs = std::filesystem;

fs::path shipped_folder() {
    const fs::path folder = own_folder();
    if (folder.empty()) return {};
    std::error_code none;
    // The program is in PREFIX/bin if it is installed, and in SOURCES/build/PRESET/tools if it is run from its build
    // folder.
    for (const fs::path& data : {folder / "../share/crackle", folder / "../../.."})
        if (fs::is_directory(data / "specimens/guide_rock", none)) return fs::weakly_canonical(data, none);
    return {};
}

fs::path given_or_shipped(const std::string& path) {
    std::error_code none;
    if (fs::exists(path, none) || !path.starts_with("specimens/")) return path;
    const fs::path folder = shipped_folder();
    return !folder.empty() && fs::exists(folder / path, none) ? folder / path : fs::path(path);
}

}  // namespace crackle::tools
