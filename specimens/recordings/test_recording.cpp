// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the frames of a test in frames/ (frame_painter.hpp) as a recording.
// Tested by tests/tools/commands/view_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/frames/frame.hpp"
#include "specimens/frames/read_frames.hpp"
#include "specimens/recordings/cell_finder.hpp"
#include "specimens/recordings/recording.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

/// Row numbers of the files particles_NNNNN.vtp, in ascending order.
std::vector<std::int64_t> drawn_rows(const fs::path& frames) {
    std::vector<std::int64_t> rows;
    for (const std::string& name : names_in(frames)) {
        constexpr std::string_view head = "particles_";
        if (!name.starts_with(head)) continue;
        const std::int64_t row = std::atoll(name.c_str() + head.size());
        if (name == particles_file(row)) rows.push_back(row);
    }
    std::sort(rows.begin(), rows.end());
    return rows;
}

/// Values of an array of cell data; empty if the file has no such array.
std::vector<double> column_if_there(const fs::path& file, const PolyData& data, const char* name) {
    return data.cell_data.contains(name) ? cell_values(file, data, name) : std::vector<double>();
}

int whole_number(const fs::path& file, const char* what, double value) {
    if (!(std::abs(value) < 2e9)) refuse_frame(file, fmt::format("found {} {}, expected a whole number", what, value));
    return static_cast<int>(value);
}

int body_number(const fs::path& file, double id) { return whole_number(file, "body", id); }

std::vector<Vec2> centres(const fs::path& file, const PolyData& data) {
    std::vector<Vec2> all, corners;
    all.reserve(data.cells.size());
    for (const PolyData::Cell& cell : data.cells) {
        if (cell.points.empty()) refuse_frame(file, fmt::format("cell {} has no points", all.size()));
        corners.clear();
        for (const std::size_t point : cell.points) corners.push_back(data.points[point]);
        all.push_back(centroid(corners, cell.line));
    }
    return all;
}

void append_cells(const fs::path& file, const PolyData& data, std::vector<RecordedCell>& cells) {
    const auto& id = cell_values(file, data, "id");
    const auto& radius = cell_values(file, data, "radius");
    const std::vector<double> material = column_if_there(file, data, "material");
    const std::vector<Vec2> centre = centres(file, data);
    for (std::size_t k = 0; k < data.cells.size(); ++k) {
        const bool line = data.cells[k].line;
        RecordedCell cell{body_number(file, id[k]), 1, radius[k], line, line, centre[k], {}};
        if (!material.empty()) cell.material = whole_number(file, "material", material[k]);
        for (const std::size_t point : data.cells[k].points) {
            if (cell.radius == 0.0) cell.outline.push_back(data.points[point]);
        }
        cells.push_back(std::move(cell));
    }
}

/// Position of a contact on the line drawn for it: the point next to a circle's centre; for two polygons, the middle of
/// the line.
Vec2 place_of(const PolyData& data, const PolyData::Cell& line, bool first_is_circle, bool second_is_circle) {
    const auto at = [&](std::size_t corner) { return data.points[line.points[corner]]; };
    if (first_is_circle) return at(1);
    if (second_is_circle) return at(0);
    return 0.5 * (at(0) + at(1));
}

constexpr double unbonded = 4.0;  // `state` of contacts that were never bonded, which are listed after all bonds

/// Reads the frames of one test, one after the other.
class TestFrames {
  public:
    TestFrames(fs::path frames, std::vector<std::int64_t> rows) : frames_(std::move(frames)), rows_(std::move(rows)) {}

    void read_start(Recording& recording) {
        const fs::path file = frames_ / particles_file(rows_.front());
        append_cells(file, read_polydata(file), recording.cells);
        for (const RecordedCell& cell : recording.cells) start_.push_back({cell.centre, cell.id});
        const fs::path contacts = frames_ / contacts_file(rows_.front());
        if (!is_there(contacts)) return;
        finder_.emplace(recording.cells);
        const PolyData data = read_polydata(contacts);
        const auto [i, j, state] = columns(contacts, data);
        for (std::size_t k = 0; k < data.cells.size() && state[k] != unbonded; ++k) {
            const Vec2 place = place_at(contacts, data, k, i[k], j[k]);
            recording.bonds.push_back({cell_of(contacts, i[k], place), cell_of(contacts, j[k], place), place});
            if (!data.cell_data.contains("stress_begin")) continue;
            recording.bonds.back().begin = data.points[data.cells[k].points.front()];
            recording.bonds.back().end = data.points[data.cells[k].points.back()];
        }
        bonds_ = recording.bonds.size();
    }

    RecordedFrame read(std::size_t k) const {
        RecordedFrame frame;
        read_particles(frames_ / particles_file(rows_[k]), frame);
        const fs::path contacts = frames_ / contacts_file(rows_[k]);
        if (finder_) read_contacts(contacts, frame);
        return frame;
    }

  private:
    struct ContactColumns {
        const std::vector<double>&i, &j, &state;
    };
    static ContactColumns columns(const fs::path& file, const PolyData& data) {
        return {cell_values(file, data, "body_i"), cell_values(file, data, "body_j"), cell_values(file, data, "state")};
    }
    std::int32_t cell_of(const fs::path& file, double id, Vec2 place) const {
        const std::int32_t cell = finder_->find(body_number(file, id), place);
        if (cell < 0)
            refuse_frame(file, fmt::format("found a contact of body {}, which is not in the first frame", id));
        return cell;
    }
    Vec2 place_at(const fs::path& file, const PolyData& data, std::size_t line, double i, double j) const {
        if (data.cells[line].points.size() < 2)
            refuse_frame(file, fmt::format("contact {}: found fewer than two points, expected at least two", line));
        const bool circles_i = finder_->is_circle(body_number(file, i)),
                   circles_j = finder_->is_circle(body_number(file, j));
        return place_of(data, data.cells[line], circles_i, circles_j);
    }

    void read_particles(const fs::path& file, RecordedFrame& frame) const {
        const PolyData data = read_polydata(file);
        const std::size_t cells = data.cells.size();
        if (cells != start_.size())
            refuse_frame(file, fmt::format("found {} cells, expected {} as in the first frame", cells, start_.size()));
        const std::vector<double>& id = cell_values(file, data, "id");
        const std::vector<Vec2> centre = centres(file, data);
        for (std::size_t k = 0; k < cells; ++k) {
            if (id[k] != start_[k].id)
                refuse_frame(file, fmt::format("cell {}: found body {}, expected {} as in the first frame", k, id[k],
                                               start_[k].id));
            frame.ux.push_back(centre[k].x - start_[k].centre.x);
            frame.uy.push_back(centre[k].y - start_[k].centre.y);
        }
        frame.angle = cell_values(file, data, "angle");
        if (data.cell_data.contains("velocity")) {
            const std::vector<double>& velocity = cell_values(file, data, "velocity", 3);
            for (std::size_t k = 0; k < cells; ++k) {
                frame.vx.push_back(velocity[3 * k]);
                frame.vy.push_back(velocity[3 * k + 1]);
            }
        }
        frame.rotation_rate = column_if_there(file, data, "rotation_rate");
        frame.stress_xx = column_if_there(file, data, "stress_xx");
        frame.stress_yy = column_if_there(file, data, "stress_yy");
        frame.stress_xy = column_if_there(file, data, "stress_xy");
        frame.fragment = column_if_there(file, data, "fragment");
    }

    void read_contacts(const fs::path& file, RecordedFrame& frame) const {
        const PolyData data = read_polydata(file);
        const auto [i, j, state] = columns(file, data);
        const auto& normal = cell_values(file, data, "normal_force");
        const auto& shear = cell_values(file, data, "shear_force");
        if (data.cells.size() < bonds_)
            refuse_frame(file,
                         fmt::format("found {} contacts, expected at least {}, the number of bonds in the first frame",
                                     data.cells.size(), bonds_));
        const auto bonds = static_cast<std::ptrdiff_t>(bonds_);
        frame.normal_force.assign(normal.begin(), normal.begin() + bonds);
        frame.shear_force.assign(shear.begin(), shear.begin() + bonds);
        frame.state.assign(state.begin(), state.begin() + bonds);
        if (data.cell_data.contains("stress_begin")) {
            const auto &begin = cell_values(file, data, "stress_begin"), &end = cell_values(file, data, "stress_end");
            frame.stress_begin.assign(begin.begin(), begin.begin() + bonds);
            frame.stress_end.assign(end.begin(), end.begin() + bonds);
        }
        RecordedContacts& contacts = frame.contacts;
        for (std::size_t k = bonds_; k < data.cells.size(); ++k) {
            const Vec2 place = place_at(file, data, k, i[k], j[k]);
            contacts.i.push_back(cell_of(file, i[k], place));
            contacts.j.push_back(cell_of(file, j[k], place));
            contacts.x.push_back(place.x);
            contacts.y.push_back(place.y);
            contacts.normal_force.push_back(normal[k]);
            contacts.shear_force.push_back(shear[k]);
        }
    }

    fs::path frames_;
    std::vector<std::int64_t> rows_;
    struct Start {
        Vec2 centre;
        int id = 0;
    };
    std::vector<Start> start_;
    std::optional<CellFinder> finder_;  ///< empty if there are no contacts
    std::size_t bonds_ = 0;
};

/// Calls `use` with each role (start, peak, end) and the file name of its frame, which is empty if there is no such
/// frame.
void each_role(const TestResults& results, const auto& use) {
    const FrameFiles& files = results.summary.frames;
    use("start", files.frame_start.value_or(""));
    use("peak", files.frame_peak.value_or(""));
    use("end", files.frame_end.value_or(""));
}

FrameHead head_of(const fs::path& folder, const TestResults& results, std::int64_t row) {
    FrameHead head;
    head.file = "frames/" + particles_file(row);
    const std::map<std::string, double> values = read_field_values(folder / head.file);
    const auto value = [&](const char* name) {
        const auto found = values.find(name);
        if (found == values.end()) refuse_frame(folder / head.file, fmt::format("found no field value '{}'", name));
        return found->second;
    };
    head.time = value("time");
    head.axial_strain = value("axial_strain");
    head.axial_stress = value("axial_stress");
    each_role(results, [&](const char* role, const std::string& file) {
        if (file == head.file) head.roles.emplace_back(role);
    });
    return head;
}

}  // namespace

Recording read_test_recording(const fs::path& folder, std::size_t most_frames) {
    Recording recording;
    recording.kind = Recording::Kind::test;
    recording.results = read_results(folder);
    recording.name = recording.results.name;
    recording.path = fs::weakly_canonical(folder);
    const std::vector<std::int64_t> rows = drawn_rows(folder / "frames");
    if (rows.empty()) return recording;
    each_role(recording.results, [&](const char* role, const std::string& named) {
        if (!named.empty() && !is_there(folder / named))
            throw InputError(fmt::format("{:.200}: file not found, expected the frame at {} that summary.json names",
                                         (folder / named).string(), role));
    });

    std::vector<FrameHead> heads;
    std::vector<std::size_t> with_role;
    for (const std::int64_t row : rows) {
        heads.push_back(head_of(folder, recording.results, row));
        if (!heads.back().roles.empty()) with_role.push_back(heads.size() - 1);
    }
    std::vector<std::int64_t> chosen;
    for (const std::size_t k : chosen_frames(rows.size(), most_frames, with_role)) {
        recording.frames.push_back(heads[k]);
        chosen.push_back(rows[k]);
    }
    const auto frames = std::make_shared<TestFrames>(folder / "frames", std::move(chosen));
    frames->read_start(recording);
    recording.frame = [frames](std::size_t k) { return frames->read(k); };
    return recording;
}

}  // namespace crackle
