// SPDX-License-Identifier: GPL-3.0-or-later
// summary.json, curve.csv, events.csv and slips.csv of a test.

#include "specimens/recordings/test_results.hpp"

#include "specimens/recordings/recording.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::results(std::string_view bytes) {
    const auto [summary, curve, events, slips] = files_of<4>(bytes);
    const std::filesystem::path folder = scratch() / "results";
    std::filesystem::create_directories(folder);
    write_file("results/summary.json", summary);
    write_file("results/curve.csv", curve);
    write_file("results/events.csv", events);
    write_file("results/slips.csv", slips);
    read_test_recording(folder, 1);
}
