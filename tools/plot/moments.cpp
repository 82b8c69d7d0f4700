// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plot/moments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "solver/base/errors.hpp"
#include "specimens/frames/frame.hpp"
#include "specimens/frames/read_frames.hpp"

namespace crackle::plot {
namespace {

namespace fs = std::filesystem;

/// Names of the minerals, indexed by material number; empty if the rock has only one material.
std::vector<std::string> minerals_of(const Recording& recording) {
    std::vector<std::string> names;
    if (const auto& minerals = recording.results.summary.minerals)
        for (const MineralFigures& mineral : *minerals) names.push_back(mineral.name.value_or(""));
    return names;
}

/// Motion of a cell since the first frame: new position = centre + displacement + R(angle) (position - centre).
struct Motion {
    Vec2 centre, displacement;
    double cosine = 1.0, sine = 0.0;

    Vec2 turned(Vec2 arm) const { return {cosine * arm.x - sine * arm.y, sine * arm.x + cosine * arm.y}; }
    Vec2 of(Vec2 place) const { return centre + displacement + turned(place - centre); }
    Motion with(double magnify) const { return {centre, magnify * displacement, cosine, sine}; }
};

Motion motion_of(const RecordedCell& cell, const RecordedFrame& frame, std::size_t k) {
    return {cell.centre, {frame.ux[k], frame.uy[k]}, std::cos(frame.angle[k]), std::sin(frame.angle[k])};
}

struct DrawnBody {
    Motion motion;
    bool shown = true;
};

/// The point of the first frame for which `mean` lies midway between its position moved with body a and its position
/// moved with body b. Both motions are affine, and so is their mean.
/// @return empty if the relative rotation of the bodies is so large that the solution is ill-conditioned
std::optional<Vec2> held_place(const Motion& a, const Motion& b, Vec2 mean) {
    // smallest length of the mean of the two rotations, 1 if they are equal; points in frames have single precision
    constexpr double least = 0.05;
    const double cosine = 0.5 * (a.cosine + b.cosine), sine = 0.5 * (a.sine + b.sine);
    const double square = cosine * cosine + sine * sine;
    if (square < least * least) return std::nullopt;
    const Vec2 of_origin = 0.5 * (a.of({}) + b.of({})), rest = mean - of_origin;
    return (1.0 / square) * Vec2{cosine * rest.x + sine * rest.y, cosine * rest.y - sine * rest.x};
}

/// The cracks or joints that the test wrote for a frame, drawn at their current positions on both faces that met there.
/// Frames contain the mean of the two positions, which lies in empty space if fragments have separated.
/// @param picture "cracks_" or "joints_"
std::vector<FaceLine> faces_of(const fs::path& folder, const FrameHead& head, const std::string& picture,
                               const std::unordered_map<int, DrawnBody>& bodies, double magnify) {
    fs::path file = folder / head.file;
    std::string name = file.filename().string();
    const std::string from = "particles_";
    if (!name.starts_with(from)) return {};
    file.replace_filename(picture + name.substr(from.size()));
    if (!fs::exists(file)) return {};
    const PolyData data = read_polydata(file);
    const bool joints = picture == "joints_";
    const auto word = data.cell_data.find(joints ? "state" : "mode"), opening = data.cell_data.find("opening");
    const std::vector<double>&body_i = cell_values(file, data, "body_i"), &body_j = cell_values(file, data, "body_j");
    std::vector<FaceLine> lines;
    for (std::size_t k = 0; k < data.cells.size(); ++k) {
        const std::vector<std::size_t>& ends = data.cells[k].points;
        const double value = word != data.cell_data.end() ? word->second.at(k) : 0.0;
        if (joints && value == static_cast<double>(ContactState::broken)) continue;  // drawn as a crack
        const bool open = value == static_cast<double>(ContactState::loose);
        const FaceLine::Kind kind = joints         ? (open ? FaceLine::Kind::open_joint : FaceLine::Kind::joint)
                                    : value != 0.0 ? FaceLine::Kind::shear
                                                   : FaceLine::Kind::tension;
        const auto i = bodies.find(static_cast<int>(body_i[k])), j = bodies.find(static_cast<int>(body_j[k]));
        if (i == bodies.end() || j == bodies.end())
            throw InputError(fmt::format("{}: line {}: found bodies {} and {}, of which one is not drawn",
                                         file.string(), k, body_i[k], body_j[k]));
        const auto begin = held_place(i->second.motion, j->second.motion, data.points.at(ends.front())),
                   end = held_place(i->second.motion, j->second.motion, data.points.at(ends.back()));
        if (!begin || !end) continue;
        for (const DrawnBody& body : {i->second, j->second}) {
            const Motion motion = body.motion.with(magnify);
            if (body.shown)
                lines.push_back({motion.of(*begin), motion.of(*end), kind,
                                 joints || opening == data.cell_data.end() ? 0.0 : opening->second.at(k)});
        }
    }
    return lines;
}

/// followed: distance up to which fragments are drawn, in widths of the specimen; showing fragments farther away would
/// make the specimen small. large_share: a fragment with more than this fraction of all cells is always drawn.
constexpr double followed = 0.4, large_share = 0.2;

struct Fragment {
    Extent extent;
    Vec2 sum;  // sum of the positions of the fragment's cells
    std::size_t cells = 0;
};

/// Chooses the cells to draw. Fragments are drawn completely or not at all, so that none is cut off by the frame.
/// @return number of cells left out
std::size_t choose_shown(Moment& moment, const RecordedFrame& frame) {
    const std::vector<RecordedCell>& cells = *moment.cells;
    const auto number = [&](std::size_t k) {
        return frame.fragment.empty() ? static_cast<double>(k) : frame.fragment[k];
    };
    Extent start;
    std::map<double, Fragment> fragments;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (cells[k].platen) {
            moment.extent.include_height(moment.outlines[k].front().y);
            continue;
        }
        if (cells[k].radius > 0.0) start.include(cells[k].centre, cells[k].radius);
        for (const Vec2 corner : cells[k].outline) start.include(corner, 0.0);
        Fragment& fragment = fragments[number(k)];
        Vec2 sum;
        for (const Vec2 place : moment.outlines[k]) {
            fragment.extent.include(place, cells[k].radius);
            sum = sum + place;
        }
        fragment.sum = fragment.sum + (1.0 / static_cast<double>(moment.outlines[k].size())) * sum;
        ++fragment.cells;
    }
    const double room = followed * start.width();
    const auto near = [&](const Fragment& fragment) {
        const Vec2 middle = (1.0 / static_cast<double>(fragment.cells)) * fragment.sum;
        return static_cast<double>(fragment.cells) >= large_share * static_cast<double>(cells.size()) ||
               (middle.x > start.x1 - room && middle.x < start.x2 + room && middle.y > start.y1 - room &&
                middle.y < start.y2 + room);
    };
    moment.extent.x1 = start.x1;
    moment.extent.x2 = start.x2;
    for (const auto& [key, fragment] : fragments) {
        if (!near(fragment)) continue;
        moment.extent.include({fragment.extent.x1, fragment.extent.y1}, 0.0);
        moment.extent.include({fragment.extent.x2, fragment.extent.y2}, 0.0);
    }
    std::size_t left_out = 0;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const bool shown = cells[k].platen || near(fragments.at(number(k)));
        moment.shown.push_back(shown);
        left_out += shown ? 0 : 1;
    }
    // Platens are drawn slightly wider than the specimen.
    const double beyond = 0.06 * start.width();
    moment.extent.x1 -= beyond;
    moment.extent.x2 += beyond;
    return left_out;
}

/// Stresses of the faces of drawn cells, each at the mean of the positions to which its two cells have carried it.
std::vector<FaceBand> bands_of(const Recording& recording, const RecordedFrame& frame, const std::vector<bool>& shown,
                               double magnify) {
    const auto motion = [&](std::int32_t cell) {
        const auto k = static_cast<std::size_t>(cell);
        return motion_of(recording.cells[k], frame, k).with(magnify);
    };
    std::vector<FaceBand> bands;
    for (std::size_t bond = 0; bond < frame.stress_begin.size(); ++bond) {
        const RecordedBond& face = recording.bonds[bond];
        if (!shown[static_cast<std::size_t>(face.i)] || !shown[static_cast<std::size_t>(face.j)]) continue;
        const Motion i = motion(face.i), j = motion(face.j);
        const auto mean = [&](Vec2 place) { return 0.5 * (i.of(place) + j.of(place)); };
        if (const auto band = face_band(frame, bond, mean(face.begin), mean(face.end))) bands.push_back(*band);
    }
    return bands;
}

}  // namespace

/// Light colours that also differ as shades of grey, because cracks are drawn over them.
const Colour& mineral_colour(std::size_t number) {
    static const std::array<Colour, 6> all{colour("#ece9e2"), colour("#d9b9a3"), colour("#a9a39a"),
                                           colour("#b9c7ac"), colour("#cdbfdc"), colour("#e8d48f")};
    return all[number % all.size()];
}

double Moment::cell_size() const {
    return std::sqrt(extent.width() * extent.height() / static_cast<double>(cells->size()));
}

const Colour& Moment::colour_of_cell(std::size_t k) const {
    static const Colour grain = colour("#e3e0d9"), light_grain = colour("#f4f2ee");
    const auto number = static_cast<std::size_t>((*cells)[k].material - 1);
    return number < minerals.size() ? mineral_colour(number) : forces ? light_grain : grain;
}

Moment moment_of(const DrawnMoment& drawn, const fs::path& folder, const DrawingStyle& style) {
    const Recording& recording = *drawn.recording;
    const RecordedFrame frame = recording.frame(drawn.frame);
    Moment moment;
    moment.cells = &recording.cells;
    moment.minerals = minerals_of(recording);
    std::unordered_map<int, DrawnBody> bodies;  // by body id; for a clump, one of its circles
    for (std::size_t k = 0; k < recording.cells.size(); ++k) {
        const RecordedCell& cell = recording.cells[k];
        const Motion moved = motion_of(cell, frame, k);
        bodies.emplace(cell.id, DrawnBody{moved, true});
        const Motion motion = moved.with(style.magnify);
        std::vector<Vec2> outline;
        if (cell.radius > 0.0) outline.push_back(motion.of(cell.centre));
        for (const Vec2 corner : cell.outline) outline.push_back(motion.of(corner));
        moment.outlines.push_back(std::move(outline));
    }
    const std::size_t left_out = choose_shown(moment, frame);
    for (std::size_t k = 0; k < recording.cells.size(); ++k) {
        if (!moment.shown[k]) bodies.at(recording.cells[k].id).shown = false;
    }
    moment.caption = drawn.caption;
    if (left_out > 0)
        moment.caption.push_back(fmt::format("{} {} farther out", left_out, left_out == 1 ? "particle" : "particles"));
    moment.marks = drawn.marks;
    const FrameHead& head = recording.frames[drawn.frame];
    moment.faces = faces_of(folder, head, "joints_", bodies, style.magnify);
    moment.forces = drawn.forces;
    if (drawn.forces) moment.bands = bands_of(recording, frame, moment.shown, style.magnify);
    if (!drawn.cracks) return moment;
    const std::vector<FaceLine> cracks = faces_of(folder, head, "cracks_", bodies, style.magnify);
    moment.faces.insert(moment.faces.end(), cracks.begin(), cracks.end());
    return moment;
}

std::size_t frame_at(const Recording& test, const std::string& at) {
    if (test.frames.empty())
        throw InputError(fmt::format(
            "plot: {}: found no frames, expected a test with frames (output.frames in its case)", test.name));
    const auto has_role = [&](const FrameHead& head) { return std::ranges::find(head.roles, at) != head.roles.end(); };
    if (const auto found = std::find_if(test.frames.begin(), test.frames.end(), has_role); found != test.frames.end())
        return static_cast<std::size_t>(found - test.frames.begin());
    double strain = 0.0;
    const auto [end, error] = std::from_chars(at.data(), at.data() + at.size(), strain);
    if (error != std::errc() || end != at.data() + at.size()) {
        const bool role = at == "start" || at == "peak" || at == "end";
        throw InputError(fmt::format("plot: --at: found '{}', {}", at,
                                     role ? fmt::format("for which {} has no frame", test.name)
                                          : std::string("expected a strain, start, peak or end")));
    }
    const double last = test.frames.back().axial_strain.value_or(0.0);
    if (!(strain >= 0.0 && strain <= last * (1.0 + 1e-9))) {
        throw InputError(
            fmt::format("plot: --at: found {}, expected 0 to {:.6g}, the last strain of {}", at, last, test.name));
    }
    const auto farther = [&](const FrameHead& a, const FrameHead& b) {
        return std::abs(a.axial_strain.value_or(0.0) - strain) < std::abs(b.axial_strain.value_or(0.0) - strain);
    };
    return static_cast<std::size_t>(std::min_element(test.frames.begin(), test.frames.end(), farther) -
                                    test.frames.begin());
}

}  // namespace crackle::plot
