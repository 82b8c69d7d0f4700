// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a recording made by hand, packed and unpacked again: every number must be within half its step, in its own
// column and frame. For slips of a test, every row of the file must be present, and nothing if there is no file.

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
    constexpr std::size_t cells = 5, frames = 20;  // the frames need more than one block
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
                    // Within half a step, the slope of the scale is at most 1 + growth times that at the number.
                    const double step = (1.0 + table.growth) * std::hypot(table.quantum, table.growth * expected[k]);
                    EXPECT_NEAR(table.rows[f][k], expected[k], 0.5 * step) << "frame " << seen + f << ", cell " << k;
                }
            }
        }
        seen += std::begin(tables)->first.rows.size();
    }
    EXPECT_EQ(seen, frames);
}

/// A recording of two discs and an open chain in which all arrays differ.
Recording unlike_in_everything(std::vector<RecordedFrame>& all) {
    Recording recording;
    recording.kind = Recording::Kind::test;
    for (int k = 0; k < 3; ++k) {
        RecordedCell cell;
        cell.id = 11 + 2 * k;
        cell.material = 1 + k % 2;
        cell.centre = {0.5 + 2.0 * k, 1.25 - 0.5 * k};
        if (k < 2) cell.radius = 0.25 + 0.125 * k;
        if (k == 2) cell.outline = {{4.0, 0.0}, {5.0, 0.5}}, cell.open = true;
        cell.platen = k == 1;
        recording.cells.push_back(cell);
    }
    recording.bonds = {{0, 1, {1.5, 1.0}}, {1, 2, {3.5, 0.5}}};
    recording.results.curve = {{"axial_strain", "axial_stress", "bonds_broken"}, {{0.0, 1e-3}, {0.0, 5e6}, {0.0, 2.0}}};
    recording.results.events = {
        {"body_i", "body_j", "mode", "last_of_interface", "time", "axial_strain", "x", "y", "orientation", "energy"},
        {{11, 13},
         {13, 15},
         {0, 1},
         {1, 0},
         {1e-4, 2e-4},
         {3e-4, 4e-4},
         {1.5, 3.5},
         {1.0, 0.5},
         {0.25, -0.5},
         {6.0, 7.0}}};
    all.resize(2);
    double next = 1e-3;
    const auto fill = [&](std::vector<double>& values, std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) values.push_back(next *= 1.05);
    };
    for (RecordedFrame& frame : all) {
        for (std::vector<double>* of_cells :
             {&frame.ux, &frame.uy, &frame.angle, &frame.vx, &frame.vy, &frame.rotation_rate, &frame.stress_xx,
              &frame.stress_yy, &frame.stress_xy})
            fill(*of_cells, 3);
        fill(frame.normal_force, 2);
        fill(frame.shear_force, 2);
        fill(frame.stress_begin, 2);
        fill(frame.stress_end, 2);
        frame.fragment = {0.0, 1.0, 2.0};
        frame.state = {0.0, 2.0};
        frame.contacts.i = {0, 1};
        frame.contacts.j = {2, 0};
        for (std::vector<double>* of_contacts :
             {&frame.contacts.x, &frame.contacts.y, &frame.contacts.normal_force, &frame.contacts.shear_force})
            fill(*of_contacts, 2);
    }
    recording.frames.resize(2);
    recording.frame = [&all](std::size_t k) { return all[k]; };
    return recording;
}

TEST(PageData, HoldsEveryArrayUnderItsName) {
    std::vector<RecordedFrame> all;
    const Recording recording = unlike_in_everything(all);
    const testing::ScratchFolder scratch;
    const testing::PageContents shown = packed_into(scratch / "page.html", tools::pack_recording(recording));
    using Numbers = std::vector<double>;
    const std::vector<std::pair<std::string, Numbers>> plain{{"cells.id", {11, 13, 15}},
                                                             {"cells.material", {1, 2, 1}},
                                                             {"cells.radius", {0.25, 0.375, 0.0}},
                                                             {"cells.x", {0.5, 2.5, 4.5}},
                                                             {"cells.y", {1.25, 0.75, 0.25}},
                                                             {"cells.open", {0, 0, 1}},
                                                             {"cells.platen", {0, 1, 0}},
                                                             {"cells.first_point", {0, 0, 0, 2}},
                                                             {"outline.x", {4.0, 5.0}},
                                                             {"outline.y", {0.0, 0.5}},
                                                             {"bonds.i", {0, 1}},
                                                             {"bonds.j", {1, 2}},
                                                             {"bonds.x", {1.5, 3.5}},
                                                             {"bonds.y", {1.0, 0.5}},
                                                             {"curve.axial_strain", {0.0, 1e-3}},
                                                             {"curve.axial_stress", {0.0, 5e6}},
                                                             {"curve.bonds_broken", {0.0, 2.0}},
                                                             {"events.body_i", {11, 13}},
                                                             {"events.body_j", {13, 15}},
                                                             {"events.shear", {0, 1}},
                                                             {"events.last_of_interface", {1, 0}},
                                                             {"events.time", {1e-4, 2e-4}},
                                                             {"events.axial_strain", {3e-4, 4e-4}},
                                                             {"events.x", {1.5, 3.5}},
                                                             {"events.y", {1.0, 0.5}},
                                                             {"events.orientation", {0.25, -0.5}},
                                                             {"events.energy", {6.0, 7.0}}};
    for (const auto& [name, expected] : plain) EXPECT_EQ(shown.plain(name), expected) << name;
    // Eighty numbers, each 5 % larger than the previous one, so a tolerance of 2 % distinguishes them.
    const auto near = [](const std::string& name, const Numbers& got, const Numbers& expected) {
        ASSERT_EQ(got.size(), expected.size()) << name;
        for (std::size_t k = 0; k < got.size(); ++k)
            EXPECT_NEAR(got[k], expected[k], 0.02 * expected[k] + 1e-9) << name;
    };
    const std::vector<std::pair<std::string, Numbers RecordedFrame::*>> fields{
        {"ux", &RecordedFrame::ux},           {"uy", &RecordedFrame::uy},
        {"angle", &RecordedFrame::angle},     {"vx", &RecordedFrame::vx},
        {"vy", &RecordedFrame::vy},           {"rate", &RecordedFrame::rotation_rate},
        {"sxx", &RecordedFrame::stress_xx},   {"syy", &RecordedFrame::stress_yy},
        {"sxy", &RecordedFrame::stress_xy},   {"fragment", &RecordedFrame::fragment},
        {"fn", &RecordedFrame::normal_force}, {"fs", &RecordedFrame::shear_force},
        {"sb", &RecordedFrame::stress_begin}, {"se", &RecordedFrame::stress_end},
        {"state", &RecordedFrame::state}};
    for (const auto& [name, field] : fields)
        for (std::size_t f = 0; f < 2; ++f) near(name, shown.row(name, f), all[f].*field);
    const auto contacts = [&](const char* name, auto&& of) {
        Numbers expected;
        for (const RecordedFrame& frame : all)
            for (const auto value : of(frame.contacts)) expected.push_back(static_cast<double>(value));
        near(name, shown.coded(name, 0).rows[0], expected);
    };
    contacts("contacts.i", [](const RecordedContacts& c) { return c.i; });
    contacts("contacts.j", [](const RecordedContacts& c) { return c.j; });
    contacts("contacts.x", [](const RecordedContacts& c) { return c.x; });
    contacts("contacts.y", [](const RecordedContacts& c) { return c.y; });
    contacts("contacts.fn", [](const RecordedContacts& c) { return c.normal_force; });
    contacts("contacts.fs", [](const RecordedContacts& c) { return c.shear_force; });
    EXPECT_EQ(shown.coded("contacts.count", 0).rows[0], (Numbers{2.0, 2.0}));
}

/// Column `at` of a table of numbers, read independently of the program.
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
        EXPECT_EQ(with.manifest["arrays"][name], place) << name << ": slips are drawn behind everything else";
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
