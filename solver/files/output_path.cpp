// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/output_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "solver/base/errors.hpp"
#include "solver/files/file_stream.hpp"
#include "solver/files/new_file.hpp"
#include "solver/files/read_file.hpp"

namespace crackle {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse_file(const fs::path& folder) {
    throw InputError(
        fmt::format("{}: found a file, expected a folder or nothing; choose another folder with -o", folder.string()));
}

}  // namespace

fs::path output_file(const fs::path& named) {
    if (named.empty()) throw InputError("found an empty name, expected the name of a file to write");
    if (!named.has_filename() || named.filename() == "." || named.filename() == "..")
        throw InputError(
            fmt::format("{}: found the name of a folder, expected the name of a file to write", named.string()));
    refuse_no_plain_file(named);
    remove_leftovers(folder_of(named), Leftovers::old);
    return named;
}

fs::path output_file(const fs::path& named, bool force, std::span<const fs::path> inputs) {
    fs::path output = output_file(named);
    if (!is_there(output)) return output;
    std::error_code error;
    for (const fs::path& input : inputs) {
        if (fs::equivalent(output, input, error) && !error) {
            throw InputError(fmt::format("{}: found an input of the same command, expected a different output file",
                                         output.string()));
        }
    }
    if (!force) {
        throw InputError(fmt::format(
            "{}: found an existing file, expected a new file; choose another name, or add --force to replace it",
            output.string()));
    }
    return output;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

fs::path output_folder(const fs::path& named) {
    if (named.empty()) throw InputError("found an empty name, expected the name of a folder to write into");
    const fs::path folder = named.has_filename() || !named.has_relative_path() ? named : named.parent_path();
    if (is_there(folder) && !is_folder(folder)) refuse_file(folder);
    const bool has_name = folder.filename() != "." && folder.filename() != "..";
    return has_name || !is_there(folder) ? folder : fs::canonical(folder);
}

void refuse_foreign_files(const fs::path& folder, const std::string& expected) {
    if (!is_there(folder)) return;
    if (!is_folder(folder)) refuse_file(folder);
    for (const std::string& name : names_in(folder)) {
        if (!is_temporary_name(name))
            throw InputError(fmt::format("{}: found {}, expected {}", folder.string(), name, expected));
    }
}

void refuse_folder_of_inputs(const fs::path& folder, std::span<const fs::path> inputs) {
    if (!is_there(folder)) return;
    const fs::path whole = fs::canonical(folder);
    for (const fs::path& input : inputs) {
        const fs::path holds = fs::weakly_canonical(folder_of(input));
        const auto rest = std::mismatch(whole.begin(), whole.end(), holds.begin(), holds.end()).first;
        if (rest != whole.end()) continue;
        throw InputError(fmt::format(
            "{}: found the input {} in this folder, expected a folder for results only; choose another folder with -o",
            folder.string(), input.string()));
    }
}

}  // namespace crackle
