// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/file_mark.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/read_pieces.hpp"

namespace crackle {

FileMark mark_of(std::string_view contents) { return {contents.size(), XXH3_64bits(contents.data(), contents.size())}; }

FileMark mark_of_file(const std::filesystem::path& file) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
    if (!state) throw std::bad_alloc();
    XXH3_64bits_reset(state.get());
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in)
        fail_reading(errno,
                     fmt::format("{}: cannot be read ({}), expected a file", file.string(), std::strerror(errno)));
    const std::streamoff length = length_of_stream(in);
    errno = 0;
    const bool whole = length >= 0 && read_pieces(in, 0, length, [&](std::string_view piece) {
                           XXH3_64bits_update(state.get(), piece.data(), piece.size());
                       });
    refuse_failed(in, file.string());
    if (!whole)
        throw InputError(
            fmt::format("{}: became shorter while it was read, expected a file that does not change", file.string()));
    return {static_cast<std::uint64_t>(length), XXH3_64bits_digest(state.get())};
}

std::string hash_text(const FileMark& mark) { return fmt::format("{:016x}", mark.hash); }

}  // namespace crackle
