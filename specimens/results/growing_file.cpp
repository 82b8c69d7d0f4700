// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/growing_file.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/read_pieces.hpp"
#include "solver/files/replace_file.hpp"

namespace crackle {

namespace fs = std::filesystem;

void GrowingFile::FreeHash::operator()(XXH3_state_s* state) const { XXH3_freeState(state); }

GrowingFile::~GrowingFile() = default;

GrowingFile::GrowingFile(fs::path path, const FileMark& marked)
    : path_(std::move(path)), bytes_(marked.bytes), hash_(XXH3_createState()) {
    if (!hash_) throw std::bad_alloc();
    XXH3_64bits_reset(hash_.get());
    refuse_no_plain_file(path_);
    if (marked.bytes > 0) {
        errno = 0;
        std::ifstream there(path_, std::ios::binary);
        if (!there && errno != ENOENT)
            fail_reading(errno, fmt::format("{}: cannot be read ({})", path_.string(), std::strerror(errno)));
        const auto end = static_cast<std::streamoff>(marked.bytes);
        const bool whole = there && read_pieces(there, 0, end, [&](std::string_view piece) {
                               XXH3_64bits_update(hash_.get(), piece.data(), piece.size());
                           });
        refuse_failed(there, path_.string());
        if (!whole || mark().hash != marked.hash) {
            throw InputError(fmt::format(
                "{}: found {}, expected the first {} bytes as they were written; restore the file, or run the test "
                "again with --force",
                path_.string(), whole ? "other contents" : "a shorter file", marked.bytes));
        }
    }
    std::error_code error;
    if (marked.bytes > 0) fs::resize_file(path_, marked.bytes, error);
    if (error) {
        errno = error.value();
        refuse_output(path_);
    }
    out_.open(path_, marked.bytes > 0 ? FileStream::Opening::appending : FileStream::Opening::fresh);
}

void GrowingFile::write(const std::string& text) {
    out_ << text;
    bytes_ += text.size();
    XXH3_64bits_update(hash_.get(), text.data(), text.size());
}

void GrowingFile::flush() {
    out_.flush();
    out_.require_written(path_);
    std::error_code gone;
    const auto there = fs::file_size(path_, gone);
    if (gone || there != bytes_) {
        fail_reading(gone.value(),
                     fmt::format("{}: found {}, expected the {} bytes that were written; it was moved or changed while "
                                 "the test ran: run "
                                 "the test again",
                                 path_.string(), gone ? gone.message() : fmt::format("{} bytes", there), bytes_));
    }
}

FileMark GrowingFile::mark() const { return {bytes_, XXH3_64bits_digest(hash_.get())}; }

}  // namespace crackle
