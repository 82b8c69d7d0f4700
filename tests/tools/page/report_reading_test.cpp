// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that frames and tables are read as they were written, and that damage is detected.

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/frames/base64.hpp"
#include "specimens/frames/read_frames.hpp"
#include "specimens/recordings/distinct_names.hpp"
#include "specimens/recordings/recording.hpp"
#include "tests/support/sample_results.hpp"
#include "tests/support/vtp_data.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::vtp_text;
using testing::VtpData;

class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& text)
        : path(fs::temp_directory_path() / ("crackle-reading-" + std::to_string(::getpid()) + ".vtp")) {
        std::ofstream(path, std::ios::binary) << text;
    }
    ~TemporaryFile() { fs::remove(path); }
    fs::path path;
};

std::string message_of(const std::string& text) {
    const TemporaryFile file(text);
    try {
        const PolyData data = read_polydata(file.path);
        for (const char* name : {"id", "radius", "angle"}) cell_values(file.path, data, name);
    } catch (const InputError& error) {
        return error.what();
    }
    return "read without complaint";
}

VtpData one_platen_one_triangle() {
    VtpData data;
    data.lines = {{{0.1, 0.2}, {1.0 / 3.0, 0.2}}};
    data.polygons = {{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1e-30}}};
    data.cell_arrays = {{"id", 1, {}, {9, 4}},
                        {"radius", 1, {0.0, 0.0}, {}},
                        {"angle", 1, {0.0, -0.25}, {}},
                        {"displacement", 3, {1, 2, 3, 4, 5, 6}, {}}};
    data.field_values = {{"time", 0.125}, {"axial_strain", 1e-3}};
    return data;
}

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string replaced(std::string text, const std::string& old_text, const std::string& new_text) {
    const std::size_t at = text.find(old_text);
    EXPECT_NE(at, std::string::npos) << old_text;
    return text.replace(at, old_text.size(), new_text);
}

TEST(Base64, ComesBackForEveryLength) {
    std::vector<unsigned char> bytes;
    for (int length = 0; length < 300; ++length) {
        EXPECT_EQ(decode_base64(encode_base64(bytes)), bytes) << length << " bytes";
        bytes.push_back(static_cast<unsigned char>(length * 37));
    }
}

TEST(Base64, MatchesTheExamplesOfItsStandard) {  // RFC 4648, section 10
    const auto encoded = [](const std::string& text) {
        return encode_base64({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
    };
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(Base64, RefusesWhatIsNotBase64) {
    for (const char* text : {"Zg=", "Zg", "Z!==", "====", "Zg==Zg==", "=Zg="})
        EXPECT_FALSE(decode_base64(text)) << text;
}

/// A point with the precision of a file.
Vec2 in_single_precision(Vec2 place) {
    return {static_cast<double>(static_cast<float>(place.x)), static_cast<double>(static_cast<float>(place.y))};
}

TEST(ReadFrames, BodiesComeBackBitForBit) {
    const TemporaryFile file(vtp_text(one_platen_one_triangle()));
    const PolyData data = read_polydata(file.path);
    const auto outline = [&](std::size_t cell) {
        std::vector<Vec2> corners;
        for (const std::size_t point : data.cells[cell].points) corners.push_back(data.points[point]);
        return corners;
    };
    EXPECT_EQ(data.field_values, (std::map<std::string, double>{{"time", 0.125}, {"axial_strain", 1e-3}}));
    EXPECT_EQ(read_field_values(file.path), data.field_values);
    ASSERT_EQ(data.cells.size(), 2U);
    EXPECT_TRUE(data.cells[0].line);
    EXPECT_EQ(outline(0), (std::vector<Vec2>{in_single_precision({0.1, 0.2}), in_single_precision({1.0 / 3.0, 0.2})}));
    EXPECT_FALSE(data.cells[1].line);
    EXPECT_EQ(outline(1), (std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.0}, in_single_precision({0.0, 1e-30})}));
    EXPECT_EQ(cell_values(file.path, data, "id"), (std::vector<double>{9, 4}));
    EXPECT_EQ(cell_values(file.path, data, "angle"), (std::vector<double>{0.0, -0.25}));
    EXPECT_EQ(cell_values(file.path, data, "displacement", 3), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST(ReadFrames, ReadsArraysInSeveralBlocksAsVtkWritesThem) {
    // 600 doubles in blocks of 1000 bytes: four full blocks and a shorter fifth one.
    std::vector<double> values(600);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = 0.1 * static_cast<double>(k);
    std::vector<unsigned char> bytes(4800), packed;
    std::memcpy(bytes.data(), values.data(), bytes.size());
    std::vector<std::uint64_t> header{5, 1000, 800};
    for (std::size_t at = 0; at < bytes.size(); at += 1000) {
        const std::size_t count = std::min<std::size_t>(1000, bytes.size() - at);
        uLongf size = compressBound(count);
        std::vector<unsigned char> block(size);
        ASSERT_EQ(compress(block.data(), &size, bytes.data() + at, count), Z_OK);
        header.push_back(size);
        packed.insert(packed.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(size));
    }
    std::vector<unsigned char> header_bytes(8 * header.size());
    std::memcpy(header_bytes.data(), header.data(), header_bytes.size());
    const TemporaryFile file(
        R"(<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">)"
        R"(<PolyData><Piece><CellData><DataArray type="Float64" Name="long" format="binary">)"
        "\n  " +
        encode_base64(header_bytes) + encode_base64(packed) + "\n</DataArray></CellData></Piece></PolyData></VTKFile>");
    EXPECT_EQ(read_polydata(file.path).cell_data.at("long"), values);
}

TEST(ReadFrames, SaysWhatIsWrongWithAFrame) {
    const std::string good = vtp_text(one_platen_one_triangle());
    EXPECT_NE(message_of(replaced(good, "vtkZLibDataCompressor", "vtkLZ4DataCompressor"))
                  .find("expected 'vtkZLibDataCompressor'"),
              std::string::npos);
    EXPECT_NE(message_of(replaced(good, "\"PolyData\"", "\"ImageData\"")).find("expected 'PolyData'"),
              std::string::npos);
    EXPECT_NE(message_of(replaced(good, "Name=\"radius\"", "Name=\"size\"")).find("cell data 'radius': found 0 values"),
              std::string::npos);
    EXPECT_NE(message_of(replaced(good, "type=\"Int32\" Name=\"id\"", "type=\"String\" Name=\"id\""))
                  .find("found type 'String'"),
              std::string::npos);
    EXPECT_NE(message_of(replaced(good, "format=\"binary\"", "format=\"appended\"")).find("expected 'binary'"),
              std::string::npos);
}

TEST(ReadFrames, EveryFlippedLetterOfItsDataIsReadOrRefusedButNeverCrashes) {
    const std::string good = vtp_text(one_platen_one_triangle());
    int refused = 0, read = 0;
    for (std::size_t at = 0; at < good.size(); ++at) {
        std::string bad = good;
        bad[at] = bad[at] == 'A' ? 'Z' : 'A';
        message_of(bad) == "read without complaint" ? ++read : ++refused;
    }
    std::printf("  %d of %zu damaged files refused\n", refused, good.size());
    EXPECT_GT(refused, read);
}

TEST(ReadResults, SampleFolderComesBackWithItsCounts) {
    const fs::path folder = fs::temp_directory_path() / ("crackle-sample-" + std::to_string(::getpid()));
    testing::SampleTest test;
    test.specimen = "voronoi";
    const testing::SampleCounts counts = testing::write_sample_results(folder, test);
    const Recording recording = read_test_recording(folder, 10);
    const TestResults& results = recording.results;

    const std::vector<double>& modes = *results.events.find("mode");
    EXPECT_EQ(std::count(modes.begin(), modes.end(), 1.0), counts.shear_breaks);
    EXPECT_EQ(std::count(modes.begin(), modes.end(), 0.0), counts.tension_breaks);
    EXPECT_EQ(results.curve.rows(), 601U);
    EXPECT_EQ(recording.cells.size(), static_cast<std::size_t>(counts.particles) + 2);
    ASSERT_EQ(recording.frames.size(), 3U);
    EXPECT_EQ(recording.frames[1].roles, std::vector<std::string>{"peak"});
    EXPECT_EQ(recording.frames[2].axial_strain, 1.5e-3);

    const fs::path peak = folder / "frames" / "particles_00400.vtp";
    const std::string good = text_of(peak);
    const auto complaint = [&](const std::string& text) -> std::string {
        std::ofstream(peak, std::ios::binary) << text;
        try {
            read_test_recording(folder, 10).frame(1);
        } catch (const InputError& error) {
            return error.what();
        }
        return "read without complaint";
    };
    EXPECT_EQ(complaint(good), "read without complaint");
    EXPECT_NE(complaint(replaced(good, "Name=\"time\"", "Name=\"date\"")).find("found no field value 'time'"),
              std::string::npos);
    VtpData others = one_platen_one_triangle();
    others.field_values.emplace_back("axial_stress", 0.0);
    EXPECT_NE(complaint(vtp_text(others)).find("particles_00400.vtp: found 2 cells, expected"), std::string::npos);
    fs::remove_all(folder);
}

Recording recorded(const std::string& path, const std::string& title = "", int seed = -1) {
    Recording recording;
    recording.path = path;
    recording.name = recording.path.filename().string();
    if (!title.empty()) recording.results.summary.about.title = title;
    if (seed >= 0) recording.results.summary.numerics.seed = seed;
    return recording;
}

TEST(DistinctNames, TellResultsInFoldersOfEqualNameApart) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(distinct_names({recorded("/lab/a", "Rock"), recorded("/lab/b", "Rock")}), (Names{"a", "b"}));
    EXPECT_EQ(distinct_names({recorded("/lab/a/c", "Wet"), recorded("/lab/b/c", "Dry")}), (Names{"Wet", "Dry"}));
    EXPECT_EQ(distinct_names({recorded("/lab/a/c", "Rock", 1), recorded("/lab/b/c", "Rock", 2)}),
              (Names{"Rock, seed 1", "Rock, seed 2"}));
    EXPECT_EQ(distinct_names({recorded("/lab/a/c", "", 1), recorded("/lab/b/c", "", 2)}),
              (Names{"c, seed 1", "c, seed 2"}));
    EXPECT_EQ(distinct_names({recorded("/lab/a/c", "Rock", 1), recorded("/lab/b/c", "Rock", 1)}),
              (Names{"a/c", "b/c"}));
    EXPECT_EQ(distinct_names({recorded("/x/a/c"), recorded("/y/a/c"), recorded("/y/b/c")}),
              (Names{"x/a/c", "y/a/c", "y/b/c"}));
    EXPECT_EQ(distinct_names({recorded("/lab/c", "Rock", 1), recorded("/lab/c", "Rock", 1)}),
              (Names{"c (1)", "c (2)"}));
}

}  // namespace
}  // namespace crackle
