// SPDX-License-Identifier: GPL-3.0-or-later
// The frames of a test as a recording. The bytes are values of arrays, which are compressed as in a frame, since
// mutations of compressed text would never get past zlib.

#include "specimens/recordings/recording.hpp"

#include <sstream>

#include "specimens/frames/vtk_polydata.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

namespace crackle::fuzz {
namespace {

void write_array(std::ostream& out, const char* name, const std::vector<double>& values) {
    PackedArray<double> array(out, name, 1, values.size());
    for (const double value : values) array.add(value);
    array.finish();
}

void write_frame(const char* file, Values& values, std::initializer_list<const char*> arrays) {
    std::ostringstream out;
    write_vtp_head(out, {{"time", values.number()}, {"axial_strain", 0.0}, {"axial_stress", 0.0}}, {});
    begin_element(out, "Points");
    write_array(out, "points", values.numbers());
    end_element(out, "Points");
    for (const char* list : {"Lines", "Polys"}) {
        begin_element(out, list);
        write_array(out, "connectivity", values.numbers());
        write_array(out, "offsets", values.numbers());
        end_element(out, list);
    }
    begin_element(out, "CellData");
    for (const char* name : arrays) write_array(out, name, values.numbers());
    end_element(out, "CellData");
    write_vtp_end(out);
    write_file(file, out.view());
}

void write_particles(const char* file, Values& values) {
    write_frame(file, values, {"id", "radius", "material", "angle", "velocity", "stress_xx"});
}

void write_contacts(const char* file, Values& values) {
    write_frame(file, values, {"body_i", "body_j", "state", "normal_force", "shear_force"});
}

}  // namespace

void recording(std::string_view bytes) {
    const std::filesystem::path folder = scratch() / "recording";
    std::filesystem::create_directories(folder / "frames");
    write_file("recording/summary.json", R"({"kind": "tension", "specimen": "circles", "failed": true})");
    write_file("recording/curve.csv", "axial_strain,axial_stress,bonds_broken,time\n0,0,0,0\n");
    write_file("recording/events.csv", "time,axial_strain,x,y,body_i,body_j,mode,last_of_interface\n");
    Values values(bytes);
    write_particles("recording/frames/particles_00000.vtp", values);
    write_contacts("recording/frames/contacts_00000.vtp", values);
    write_particles("recording/frames/particles_00001.vtp", values);
    write_contacts("recording/frames/contacts_00001.vtp", values);
    const Recording read = read_test_recording(folder, 2);
    for (std::size_t k = 0; k < read.frames.size(); ++k) read.frame(k);
}

}  // namespace crackle::fuzz
