// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/demseg/deck_folder.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <vector>

#include "solver/base/system_failure.hpp"
#include "solver/demseg/deck_state.hpp"
#include "solver/demseg/outputs.hpp"
#include "solver/files/file_set.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/files/read_file.hpp"

namespace crackle {

namespace fs = std::filesystem;

fs::path deck_journal(const fs::path& folder) { return folder / "new_files.journal"; }

bool complete_deck_replacement(const fs::path& folder) {
    const fs::path journal = deck_journal(folder);
    if (!is_there(journal)) return false;
    const FolderLock lock(folder);
    return complete_replacement(journal);
}

std::optional<fs::path> earlier_output(const fs::path& folder) {
    for (const char* name : deck_output_names)
        if (is_there(folder / name)) return folder / name;
    for (const char* name : deck_text_names) {
        const fs::path path = folder / (std::string("new_") + name);
        if (is_there(path)) return path;
    }
    return std::nullopt;
}

void remove_staged_files(const fs::path& folder) {
    std::vector<std::string> names(deck_output_names.begin(), deck_output_names.end());
    for (const char* name : deck_text_names) names.push_back(std::string("new_") + name);
    names.emplace_back(state_name);
    for (const std::string& name : names) {
        const fs::path path = folder / (name + staged_suffix);
        std::error_code error;
        fs::remove(path, error);
        if (error)
            fail_writing(error.value(), fmt::format("{}: cannot be removed ({})", path.string(), error.message()));
    }
}

}  // namespace crackle
