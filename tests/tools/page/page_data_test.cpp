// SPDX-License-Identifier: GPL-3.0-or-later
// A recording made by hand, packed and taken apart again: every number within half its step, in its own column and
// frame. Slips of a test: every row of its file, and nothing of them where there is no file.

#include "tools/page/page_data.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "solver/base/errors.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/page_contents.hpp"
#include "tests/support/sample_results.hpp"

namespace crackle {
namespace {

testing::PageContents packed_into(const std::filesystem::path& file, const tools::PageData& packed) {
    {
        std::ofstream page(file);
        page << "<script id=\"crackle-data\">"
             << "{\"tests\":[" << packed.manifest.dump() << "]}</script>";
        for (std::size_t b = 0; b < packed.blocks.size(); ++b)
            page << "<script id=\"crackle-0-" << b << "\">" << packed.blocks[b] << "</script>";
    }
    return testing::PageContents(file);
}

TEST(PageData, HoldsEveryNumberToHalfAStep) {
    constexpr std::size_t cells = 5, frames = 20;  // more than one block
    Recording recording;
    for (std::size_t k = 0; k < cells; ++k) {
        RecordedCell cell;
        cell.id = static_cast<int>(k + 1);
        cell.radius = 0.5;
        cell.centre = {static_cast<double>(k), 0.0};
        recording.cells.push_back(cell);
    }
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> draw(-1e-3, 1e-3);
    std::vector<RecordedFrame> all(frames);
    for (RecordedFrame& frame : all) {
        for (std::vector<double>* values :
             {&frame.ux, &frame.uy, &frame.angle, &frame.vx, &frame.vy, &frame.rotation_rate}) {
            for (std::size_t k = 0; k < cells; ++k) values->push_back(draw(generator));
        }
    }
    recording.frames.resize(frames);
    recording.frame = [&](std::size_t k) { return all[k]; };
    const testing::ScratchFolder scratch;
    const testing::PageContents shown = packed_into(scratch / "page.html", tools::pack_recording(recording));
    std::size_t seen = 0;
    for (std::size_t g = 0; g < shown.test()["groups"].size(); ++g) {
        const auto tables = {std::pair{shown.coded("ux", g), &RecordedFrame::ux},
                             {shown.coded("angle", g), &RecordedFrame::angle},
                             {shown.coded("vx", g), &RecordedFrame::vx}};
        for (const auto& [table, field] : tables) {
            for (std::size_t f = 0; f < table.rows.size(); ++f) {
                const std::vector<double>& expected = all[seen + f].*field;
                ASSERT_EQ(table.rows[f].size(), cells);
                for (std::size_t k = 0; k < cells; ++k) {
                    // Within half a step the scale's slope is at most 1 + growth times that at the number.
                    const double step = (1.0 + table.growth) * std::hypot(table.quantum, table.growth * expected[k]);
                    EXPECT_NEAR(table.rows[f][k], expected[k], 0.5 * step) << "frame " << seen + f << ", cell " << k;
                }
            }
        }
        seen += std::begin(tables)->first.rows.size();
    }
    EXPECT_EQ(seen, frames);
}

/// Column `at` of a table of numbers, read here by itself.
std::vector<double> column_of(const std::filesystem::path& file, std::size_t at) {
    std::ifstream in(file);
    std::vector<double> values;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream fields(line);
        std::string field;
        for (std::size_t k = 0; k <= at; ++k) std::getline(fields, field, ',');
        values.push_back(std::stod(field));
    }
    return values;
}

TEST(PageData, HoldsEveryRowOfTheSlipsApartFromTheBreaks) {
    const testing::ScratchFolder scratch;
    testing::SampleTest sliding;
    sliding.slips = true;
    const testing::SampleCounts counts = testing::write_sample_results(scratch / "test", sliding);
    ASSERT_GT(counts.slips, 100);
    const testing::PageContents shown =
        packed_into(scratch / "page.html", tools::pack_recording(read_test_recording(scratch / "test", 10)));
    for (const auto& [name, column] :
         {std::pair{"time", 0U}, {"axial_strain", 2U}, {"x", 3U}, {"y", 4U}, {"orientation", 7U}}) {
        const std::vector<double> expected = column_of(scratch / "test" / "slips.csv", column);
        EXPECT_EQ(static_cast<int>(expected.size()), counts.slips);
        EXPECT_EQ(shown.plain(std::string("slips.") + name), expected) << name;
    }
    EXPECT_EQ(static_cast<int>(shown.plain("events.time").size()), counts.tension_breaks + counts.shear_breaks);
}

TEST(PageData, HoldsNothingOfSlipsThatWereNotRecorded) {
    const testing::ScratchFolder scratch;
    testing::SampleTest test;
    const auto blocks = [&](bool slips) {
        test.slips = slips;
        testing::write_sample_results(scratch / "test", test);
        return tools::pack_recording(read_test_recording(scratch / "test", 10));
    };
    const tools::PageData without = blocks(false), with = blocks(true);
    for (const auto& [name, place] : without.manifest["arrays"].items()) {
        EXPECT_FALSE(name.starts_with("slips.")) << name;
        EXPECT_EQ(with.manifest["arrays"][name], place) << name << ": slips stand behind all else";
    }
    EXPECT_EQ(with.manifest["arrays"].size(), without.manifest["arrays"].size() + 5);
}

TEST(PageData, NamesTheColumnThatAFileOfSlipsLacks) {
    const testing::ScratchFolder scratch;
    testing::write_sample_results(scratch / "test", {});
    std::ofstream(scratch / "test" / "slips.csv") << "time,step,axial_strain,x,y,body_i,body_j\n";
    try {
        read_test_recording(scratch / "test", 10);
        ADD_FAILURE() << "read without complaint";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("slips.csv:1: found no column 'orientation'"), std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace crackle
