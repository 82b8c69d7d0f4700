// SPDX-License-Identifier: GPL-3.0-or-later
// A recording made by hand, packed and taken apart again: every number within half its step, in its own column and
// frame.

#include "tools/page/page_data.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "tests/support/deck_files.hpp"
#include "tests/support/page_contents.hpp"

namespace crackle {
namespace {

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
    const tools::PageData packed = tools::pack_recording(recording);
    const testing::ScratchFolder scratch;
    {
        std::ofstream page(scratch / "page.html");
        page << "<script id=\"crackle-data\">"
             << "{\"tests\":[" << packed.manifest.dump() << "]}</script>";
        for (std::size_t b = 0; b < packed.blocks.size(); ++b)
            page << "<script id=\"crackle-0-" << b << "\">" << packed.blocks[b] << "</script>";
    }
    const testing::PageContents shown(scratch / "page.html");
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

}  // namespace
}  // namespace crackle
