// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>
#include <set>
#include <string_view>

#include "solver/base/errors.hpp"
#include "solver/demseg/outputs.hpp"

namespace crackle {

Vec2 centroid(const std::vector<Vec2>& corners, bool open) {
    // Sums are relative to a corner, so that small cells far from the origin keep their precision.
    const Vec2 origin = corners.front();
    Vec2 by_area, by_length;
    double twice_area = 0.0, length = 0.0;
    for (std::size_t k = 0; k + 1 < corners.size() + (open ? 0 : 1); ++k) {
        const Vec2 from = corners[k] - origin, to = corners[(k + 1) % corners.size()] - origin;
        const double twice = cross(from, to), side = norm(to - from);
        by_area = by_area + twice / 3.0 * (from + to);
        by_length = by_length + 0.5 * side * (from + to);
        twice_area += twice;
        length += side;
    }
    if (!open && twice_area != 0.0) return origin + (1.0 / twice_area) * by_area;
    return length > 0.0 ? origin + (1.0 / length) * by_length : origin;
}

std::vector<std::size_t> chosen_frames(std::size_t count, std::size_t most, const std::vector<std::size_t>& kept) {
    std::set<std::size_t> chosen(kept.begin(), kept.end());
    if (count > 0) chosen.insert({0, count - 1});
    // Adds frames that are evenly spaced from the first to the last.
    const std::size_t even = std::min(count, most > kept.size() ? most - kept.size() : 0);
    for (std::size_t k = 0; k < even; ++k) chosen.insert(even < 2 ? 0 : k * (count - 1) / (even - 1));
    return {chosen.begin(), chosen.end()};
}

namespace {

namespace fs = std::filesystem;

/// Whether a file, whatever its name, starts like an output file of `crackle run`.
bool has_rows_of_a_run(const fs::path& file) {
    constexpr std::string_view head = "# step ";
    std::ifstream in(file, std::ios::binary);
    std::string begin(head.size(), '\0');
    in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    return begin == head;
}

}  // namespace

fs::path folder_of_run(const fs::path& path) {
    constexpr std::array<const char*, 3> results{"summary.json", "curve.csv", "events.csv"};
    if (!fs::is_regular_file(path)) return path;
    fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const auto is_named = [name = path.filename().string()](const char* one) { return name == one; };
    if (std::ranges::any_of(deck_output_names, is_named) && fs::exists(folder / deck_output_names[0])) return folder;
    if (std::ranges::any_of(results, is_named) && fs::exists(folder / results[0])) return folder;
    return path;
}

Recording read_recording(const fs::path& given, std::size_t most_frames, std::uint64_t seed) {
    const fs::path path = folder_of_run(given);
    if (fs::is_regular_file(path)) {
        if (has_rows_of_a_run(path)) {
            throw InputError(fmt::format(
                "{}: found rows that `crackle run` wrote, expected a particle file or the folder of a run, in which "
                "they are called {}",
                path.string(), fmt::join(deck_output_names, ", ")));
        }
        return read_particle_recording(path, seed);
    }
    if (!fs::is_directory(path)) {
        throw InputError(fmt::format(
            "{}: found no such file or folder, expected the folder of a test or of a deck, or a particle file",
            path.string()));
    }
    if (fs::exists(path / "summary.json")) return read_test_recording(path, most_frames);
    if (fs::exists(path / "output.dat")) return read_deck_recording(path, most_frames);
    if (fs::exists(path / "in_gm.dat")) return read_particle_recording(path / "in_gm.dat", seed);
    throw InputError(
        fmt::format("{}: found neither summary.json nor output.dat nor in_gm.dat, expected results of `crackle test "
                    "-o` or `crackle run` in this folder",
                    path.string()));
}

}  // namespace crackle
