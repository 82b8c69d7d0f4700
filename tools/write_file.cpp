// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/write_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "solver/errors.hpp"

namespace crackle::tools {

void write_file(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out)
        throw InputError(fmt::format("{}: cannot be written, expected a path that can; check its disc", file.string()));
}

}  // namespace crackle::tools
