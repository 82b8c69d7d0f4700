// SPDX-License-Identifier: GPL-3.0-or-later
// See outputs.hpp.

#include "solver/demseg/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/demseg/contact_files.hpp"
#include "solver/files/read_file.hpp"
#include "solver/measure/breaks.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"

namespace crackle {
namespace {

/// How the lines of a file are organised.
enum class Layout {
    frames,  ///< frames: a head with step, time and counts, followed by as many lines as the sum of the counts
    rows,    ///< rows that begin with the step
    table,   ///< comma-separated rows below a line of column names
};

constexpr std::array<Layout, deck_output_names.size()> layouts{Layout::frames, Layout::frames, Layout::frames,
                                                               Layout::rows,   Layout::rows,   Layout::rows,
                                                               Layout::rows,   Layout::table};

const std::array<std::string, deck_output_names.size()>& headers() {
    static const std::array<std::string, deck_output_names.size()> lines{
        "# step time circles segments, then per circle: body radius xc yc angle, per segment: body xs ys xe ye\n",
        "# step time contacts, then per contact: body other x y fx fy (force on body, dashpots included)\n",
        "# step time contacts, then per contact: body other nx ny overlap normal_force shear_force back_tension "
        "(springs)\n",
        "# step enrg enva enka enca enfr enxd enxf err enfb\n",
        "",  // no header, as in the DEMseg guide
        "# step body vy\n",
        "# step bonds broken\n",
        breaks_header(),
    };
    return lines;
}

constexpr std::int64_t most_lines_a_count = 1'000'000'000;  // largest count accepted in the first line of a frame

/// Reads the step and the number of further lines from the beginning of a row. In a table the step is the second value;
/// in the first line of a frame, the counts are added up. @return false if this program cannot have written the row
bool read_head(std::string_view line, Layout layout, std::int64_t& step, std::int64_t& lines) {
    const char *at = line.data(), *end = line.data() + line.size();
    double time = 0.0;
    const bool table = layout == Layout::table;
    if (table) {
        const auto behind = std::from_chars(at, end, time);
        if (behind.ec != std::errc() || behind.ptr == end || *behind.ptr != ',') return false;
        at = behind.ptr + 1;
    }
    auto result = std::from_chars(at, end, step);
    if (result.ec != std::errc() || result.ptr == end || *result.ptr != (table ? ',' : ' ')) return false;
    lines = 0;
    if (layout != Layout::frames) return true;
    result = std::from_chars(result.ptr + 1, end, time);
    if (result.ec != std::errc() || result.ptr == end) return false;
    while (result.ptr != end) {
        std::int64_t count = 0;
        result = std::from_chars(result.ptr + 1, end, count);
        if (result.ec != std::errc() || count < 0 || count > most_lines_a_count) return false;
        lines += count;
    }
    return true;
}

/// Length in bytes up to the end of the last complete row or frame whose step is at most `step`.
std::uintmax_t length_up_to(const std::filesystem::path& path, std::int64_t step, std::size_t which) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    const auto refuse_unread = [&] {  // without this check, an unreadable file would count as empty and be truncated
        fail_reading(errno, fmt::format("{}: cannot be read ({}), expected the rows of an earlier part", path.string(),
                                        std::strerror(errno)));
    };
    if (!file) refuse_unread();
    std::string line;
    std::uintmax_t at = 0, kept = 0;
    std::int64_t number = 0, row_step = 0, lines_left = 0;
    while (std::getline(file, line) && !file.eof()) {  // eof() means that the last line is incomplete
        at += line.size() + 1;
        ++number;
        if (lines_left > 0) {
            --lines_left;
        } else if (!line.starts_with('#') && !(number == 1 && line + '\n' == headers()[which])) {
            if (!read_head(line, layouts[which], row_step, lines_left)) {
                throw InputError(
                    fmt::format("{}:{}: found '{}', expected a row of an earlier part; give another folder with -o, or "
                                "move the file away",
                                path.string(), number, line.substr(0, 40)));
            }
            if (row_step > step) break;
        }
        if (lines_left == 0) kept = at;
    }
    if (file.bad()) refuse_unread();
    return kept;
}

bool touching(const World& world, PointIndex k) { return (world.points.state[k].flags & point_touching) != 0; }

}  // namespace

void drop_rows_after(const std::filesystem::path& folder, std::int64_t step) {
    std::vector<std::pair<std::filesystem::path, std::uintmax_t>> lengths;
    for (std::size_t k = 0; k < deck_output_names.size(); ++k) {
        const std::filesystem::path path = folder / deck_output_names[k];
        refuse_no_plain_file(path);
        if (is_there(path)) lengths.emplace_back(path, length_up_to(path, step, k));
    }
    for (const auto& [path, length] : lengths) {
        std::error_code error;
        if (std::filesystem::file_size(path, error) != length && !error)
            std::filesystem::resize_file(path, length, error);
        if (error)
            fail_writing(error.value(), fmt::format("{}: cannot be shortened ({})", path.string(), error.message()));
    }
}

void refuse_foreign_outputs(const std::filesystem::path& folder) {
    for (std::size_t k = 0; k < deck_output_names.size(); ++k) {
        const std::filesystem::path path = folder / deck_output_names[k];
        if (!is_there(path)) continue;
        errno = 0;
        std::ifstream file(path, std::ios::binary);
        if (!file.is_open())
            fail_reading(errno, fmt::format("{}: cannot be read ({}), expected an output of an earlier run",
                                            path.string(), std::strerror(errno)));
        std::string line;
        std::getline(file, line);
        refuse_failed(file, path.string());
        std::int64_t step = 0, lines = 0;
        if (line.empty() || line + '\n' == headers()[k] || line.starts_with("# step") ||
            read_head(line, layouts[k], step, lines))
            continue;
        throw InputError(
            fmt::format("{}:1: found '{}', expected an output of an earlier run to replace; give another folder with "
                        "-o, or move the file away",
                        path.string(), line.substr(0, 40)));
    }
}

DeckOutputs::DeckOutputs(const std::filesystem::path& folder, OutputMode mode, OutputNames names)
    : folder_(folder), suffix_(names == OutputNames::staged ? staged_suffix : "") {
    for (std::size_t k = 0; k < files_.size(); ++k) {
        files_[k].open(path(k),
                       mode == OutputMode::appending ? FileStream::Opening::appending : FileStream::Opening::fresh);
        if (mode == OutputMode::fresh) files_[k] << headers()[k];
    }
    flush();
}

std::filesystem::path DeckOutputs::path(std::size_t which) const {
    return folder_ / (deck_output_names[which] + suffix_);
}

Renames DeckOutputs::renames() const {
    Renames renames;
    if (suffix_.empty()) return renames;
    for (const char* name : deck_output_names) renames.emplace_back(name + suffix_, name);
    return renames;
}

void DeckOutputs::write(Which which, const World& world, const std::string& text) {
    if (text.find("inf") != std::string::npos || text.find("nan") != std::string::npos) {
        const auto largest = std::max_element(
            world.bodies.force.begin(), world.bodies.force.end(), [](const BodyForce& a, const BodyForce& b) {
                return std::abs(a.fx) + std::abs(a.fy) < std::abs(b.fx) + std::abs(b.fy);
            });
        const auto body = static_cast<std::size_t>(largest - world.bodies.force.begin());
        throw UnstableRun(world.stepping.steps, world.bodies.info(body).id,
                          fmt::format("a value in {} would not be finite (this body carries the largest force); "
                                      "look for a force, mass or stiffness of unrealistic size",
                                      deck_output_names[which]));
    }
    files_[which].write(text.data(), static_cast<std::streamsize>(text.size()));
    files_[which].require_written(path(which));
}

void DeckOutputs::flush() {
    for (std::size_t k = 0; k < files_.size(); ++k) {
        files_[k].flush();
        files_[k].require_written(path(k));
    }
}

void DeckOutputs::write_frame(const World& world, std::span<const BodyIndex> order) {
    std::string circles, segments;
    std::size_t circle_count = 0, segment_count = 0;
    for (const BodyIndex b : order) {
        const BodyInfo info = world.bodies.info(b);
        const std::vector<Vec2> points = element_positions(world, b);
        if (info.piece_count == 0) {
            for (std::uint32_t k = 0; k < points.size(); ++k, ++circle_count) {
                const double radius = element_of(BodyView(world), b, info.first_element + k).radius;
                fmt::format_to(std::back_inserter(circles), "{} {} {} {} {}\n", info.id, radius, points[k].x,
                               points[k].y, world.bodies.state[b].angle);
            }
            continue;
        }
        const std::size_t count = info.closed ? points.size() : points.size() - 1;
        for (std::size_t k = 0; k < count; ++k, ++segment_count) {
            const Vec2 end = points[(k + 1) % points.size()];
            fmt::format_to(std::back_inserter(segments), "{} {} {} {} {}\n", info.id, points[k].x, points[k].y, end.x,
                           end.y);
        }
    }
    write(positions, world,
          fmt::format("{} {} {} {}\n", world.stepping.steps, world.stepping.time, circle_count, segment_count) +
              circles + segments);

    std::string forces, details;
    std::size_t contacts = 0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if (!touching(world, k)) continue;
        ++contacts;
        const PointView view = view_point(world, k);
        const ContactPoint point = world.points.contact[k];
        const int id = world.bodies.info(point.body_i).id, other = partner_id(world, view.kind, point);
        fmt::format_to(std::back_inserter(forces), "{} {} {} {} {} {}\n", id, other, view.position.x, view.position.y,
                       world.points.force[k].fx, world.points.force[k].fy);
        fmt::format_to(std::back_inserter(details), "{} {} {} {} {} {} {} {}\n", id, other, view.normal.x,
                       view.normal.y, view.overlap, view.normal_force, view.shear_force,
                       view.bonded ? -view.normal_stiffness * view.bond_overlap : 0.0);
    }
    const std::string head = fmt::format("{} {} {}\n", world.stepping.steps, world.stepping.time, contacts);
    write(contact_forces, world, head + forces);
    write(contact_details, world, head + details);
}

void DeckOutputs::write_energy_row(const World& world, std::span<const BodyIndex> bodies) {
    const Ledger e = measure_ledger(world);
    write(energies, world,
          fmt::format("{} {} {} {} {} {} {} {} {} {}\n", world.stepping.steps, e.potential, e.kinetic, e.strain,
                      e.dashpot_loss, e.friction_loss, e.displacement_work, e.force_work, e.closing_error - e.law_loss,
                      e.fracture_loss));
    for (const BodyIndex b : bodies)
        write(velocities, world,
              fmt::format("{} {} {}\n", world.stepping.steps, world.bodies.info(b).id, world.bodies.state[b].vy));
}

void DeckOutputs::write_bond_row(const World& world) {
    write(
        bonds, world,
        fmt::format("{} {} {}\n", world.stepping.steps, world.bonds.initial - world.bonds.broken, world.bonds.broken));
}

void DeckOutputs::write_breaks(const World& world, std::span<const BreakEvent> breaks) {
    std::string rows;
    for (const BreakEvent& event : breaks) rows += break_line(event);
    write(events, world, rows);
}

void DeckOutputs::write_force_rows(const World& world, std::span<const BodyIndex> bodies) {
    for (const BodyIndex b : bodies) {
        const BodyForce& f = world.bodies.force[b];
        const BodyState& s = world.bodies.state[b];
        write(force_displacement, world,
              fmt::format("{} {} {} {} {} {} {} {}\n", world.stepping.steps, world.bodies.info(b).id, f.fx, s.x, f.fy,
                          s.y, f.torque, s.angle));
    }
}

}  // namespace crackle
