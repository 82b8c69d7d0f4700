// SPDX-License-Identifier: GPL-3.0-or-later
// Runs shipped decks in temporary folders and reads their outputs.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <string>
#include <vector>

#include "solver/demseg/deck_reader.hpp"
#include "solver/demseg/deck_run.hpp"
#include "solver/files/read_file.hpp"

namespace crackle::testing {

using Rows = std::vector<std::vector<double>>;

inline std::filesystem::path shipped_deck(const std::string& name) {
    return std::filesystem::path(CRACKLE_SOURCE_DIR) / "specimens" / "demseg" / name;
}

/// An empty temporary folder, removed at the end of the test.
class ScratchFolder {
  public:
    ScratchFolder() {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        std::string name =
            std::string("crackle_") + test->test_suite_name() + "_" + test->name() + "_" + std::to_string(::getpid());
        for (char& c : name) {
            if (c == '/') c = '_';
        }
        path_ = std::filesystem::temp_directory_path() / name;
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() {
        std::error_code ignored;  // the next run empties a folder that was left
        std::filesystem::remove_all(path_, ignored);
    }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

/// Numbers of every line that is not a comment.
inline Rows read_rows(const std::filesystem::path& path) {
    const std::string text = read_file(path);
    Rows rows;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (text[begin] != '#') {
            std::vector<double> row;
            const char* at = text.data() + begin;
            while (at < text.data() + end) {
                double value = 0.0;
                const auto result = std::from_chars(at, text.data() + end, value);
                if (result.ec != std::errc()) throw std::runtime_error(path.string() + ": not a number");
                row.push_back(value);
                at = result.ptr + 1;
            }
            rows.push_back(std::move(row));
        }
        begin = end + 1;
    }
    return rows;
}

/// One frame of output.dat, cont.dat or cont2.dat.
struct DeckFrame {
    double step, time;
    Rows rows;
};

inline std::vector<DeckFrame> read_frames(const std::filesystem::path& path) {
    const Rows all = read_rows(path);
    std::vector<DeckFrame> frames;
    for (std::size_t k = 0; k < all.size();) {
        double count = 0.0;
        for (std::size_t c = 2; c < all[k].size(); ++c) count += all[k][c];
        DeckFrame frame{all[k][0], all[k][1], {}};
        const std::size_t end = k + 1 + static_cast<std::size_t>(count);
        frame.rows.assign(all.begin() + static_cast<std::ptrdiff_t>(k + 1),
                          all.begin() + static_cast<std::ptrdiff_t>(end));
        frames.push_back(std::move(frame));
        k = end;
    }
    return frames;
}

/// Rows whose column `column` is `value`.
inline Rows rows_of(const Rows& rows, std::size_t column, double value) {
    Rows chosen;
    for (const auto& row : rows) {
        if (row[column] == value) chosen.push_back(row);
    }
    return chosen;
}

}  // namespace crackle::testing
