// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that frames with impossible numbers are refused before any number is used as an index.
#include "specimens/frames/read_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include "solver/base/errors.hpp"
#include "specimens/frames/vtk_polydata.hpp"
#include "specimens/recordings/recording.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

/// Two triangles that share a side.
struct Arrays {
    std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    std::vector<double> connectivity{0, 1, 2, 1, 3, 2}, offsets{3, 6};
    std::vector<double> id{1, 2}, material{1, 2};
};

void write_array(std::ostream& out, const char* name, const std::vector<double>& values) {
    PackedArray<double> array(out, name, 1, values.size());
    for (const double value : values) array.add(value);
    array.finish();
}

class Triangles : public ::testing::Test {
  protected:
    Triangles() {
        std::filesystem::create_directories(folder_ / "frames");
        std::ofstream(folder_ / "summary.json") << R"({"kind": "tension", "specimen": "delaunay", "failed": true})";
        std::ofstream(folder_ / "curve.csv") << "axial_strain,axial_stress,bonds_broken,time\n0,0,0,0\n";
        std::ofstream(folder_ / "events.csv") << "time,axial_strain,x,y,body_i,body_j,mode,last_of_interface\n";
    }
    void write(const Arrays& arrays) const {
        std::ostringstream out;
        write_vtp_head(out, {{"time", 0.0}, {"axial_strain", 0.0}, {"axial_stress", 0.0}}, {4, 0, 2});
        begin_element(out, "Points");
        write_array(out, "points", arrays.points);
        end_element(out, "Points");
        begin_element(out, "Polys");
        write_array(out, "connectivity", arrays.connectivity);
        write_array(out, "offsets", arrays.offsets);
        end_element(out, "Polys");
        begin_element(out, "CellData");
        write_array(out, "id", arrays.id);
        write_array(out, "radius", {0.0, 0.0});
        write_array(out, "material", arrays.material);
        end_element(out, "CellData");
        write_vtp_end(out);
        std::ofstream(file_, std::ios::binary) << out.str();
    }
    void expect_refused(const Arrays& arrays, const std::string& says, const std::function<void()>& read) const {
        write(arrays);
        try {
            read();
            ADD_FAILURE() << "accepted, expected: " << says;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(file_.string() + ": " + says), std::string::npos) << error.what();
        }
    }

    testing::ScratchFolder scratch_;
    const std::filesystem::path folder_ = scratch_ / "out", file_ = folder_ / "frames/particles_00000.vtp";
};

TEST_F(Triangles, AreReadAsTheyAre) {
    write({});
    const PolyData data = read_polydata(file_);
    ASSERT_EQ(data.cells.size(), 2U);
    EXPECT_EQ(data.cells[1].points, (std::vector<std::size_t>{1, 3, 2}));
    EXPECT_EQ(read_test_recording(folder_, 1).cells[1].material, 2);
}

TEST_F(Triangles, WhoseOffsetsDoNotRiseAreRefused) {
    for (const std::vector<double>& offsets :
         {std::vector<double>{nan, 6}, {3, nan}, {4, 3}, {-1, 6}, {3, 7}, {3, infinite}}) {
        Arrays arrays;
        arrays.offsets = offsets;
        expect_refused(arrays, "found cell offsets that decrease", [&] { read_polydata(file_); });
    }
}

TEST_F(Triangles, OfPointsThatAreNotThereAreRefused) {
    for (const double point : {nan, -1.0, 4.0, infinite}) {
        Arrays arrays;
        arrays.connectivity[4] = point;
        expect_refused(arrays, "found a cell with point", [&] { read_polydata(file_); });
    }
}

TEST_F(Triangles, OfBodiesOrMaterialsThatAreNoWholeNumbersAreRefused) {
    for (const double number : {nan, infinite, 2e9, -2e9, 1e300}) {
        Arrays arrays;
        arrays.material[1] = number;
        expect_refused(arrays, "found material ", [&] { read_test_recording(folder_, 1); });
        arrays = {};
        arrays.id[1] = number;
        expect_refused(arrays, "found body ", [&] { read_test_recording(folder_, 1); });
    }
}

}  // namespace
}  // namespace crackle
