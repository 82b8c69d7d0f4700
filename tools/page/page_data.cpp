// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/page/page_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <ranges>
#include <span>

#include "solver/base/errors.hpp"
#include "specimens/measures/verdicts.hpp"
#include "specimens/summary/summary_file.hpp"
#include "tools/page/page_blocks.hpp"

namespace crackle::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t frames_in_block = 16;

/// Member of a recorded frame that has one number per cell (or bond).
using Field = std::vector<double> RecordedFrame::*;

// Stored values are multiples of a quantum. These quanta are so fine that errors remain invisible even if displacements
// are magnified a hundred times. Finer quanta would only make pages larger.
constexpr double place_share = 0x1p-22;    // quantum of positions, relative to the specimen's size
constexpr double angle_quantum = 0x1p-18;  // quantum of angles, rad
// Quantum, relative to the block's largest value, for quantities of varying magnitude.
constexpr double least_share = 0x1p-20;
constexpr double growth = 0x1p-7;  // growth (see Code) for velocities and cells' stresses: a relative error below 0.4 %
// Growth (see Code) for forces and faces' stresses, which need much space: a relative error below 0.8 %.
constexpr double force_growth = 0x1p-6;

double largest_of(const std::vector<std::vector<double>>& rows) {
    double largest = 0.0;
    for (const std::vector<double>& row : rows) {
        for (const double value : row) largest = std::max(largest, std::abs(value));
    }
    return largest;
}

Code code_of(const std::vector<std::vector<double>>& rows, double with_growth) {
    const double largest = largest_of(rows);
    return largest > 0.0 ? Code{least_share * largest, with_growth} : Code{};
}

void add_field(CodedBlock& block, const std::string& name, const std::vector<RecordedFrame>& frames, Field field,
               const std::function<Code(const std::vector<std::vector<double>>&)>& code_for) {
    std::vector<std::vector<double>> rows;
    for (const RecordedFrame& frame : frames) {
        rows.push_back(frame.*field);
        if (rows.back().size() != rows.front().size())
            throw InputError(fmt::format(
                "{}: {}: found {} values in one frame and {} in another, expected the same number in all frames",
                block.where(), name, rows.front().size(), rows.back().size()));
    }
    block.add(name, rows, code_for(rows));
}

void add_contacts(CodedBlock& block, const std::vector<RecordedFrame>& frames, double place_quantum) {
    std::vector<double> count, i, j, x, y, normal_force, shear_force;
    const auto append = [](std::vector<double>& all, const auto& values) {
        all.insert(all.end(), values.begin(), values.end());
    };
    for (const RecordedFrame& frame : frames) {
        const RecordedContacts& contacts = frame.contacts;
        count.push_back(static_cast<double>(contacts.i.size()));
        append(i, contacts.i);
        append(j, contacts.j);
        append(x, contacts.x);
        append(y, contacts.y);
        append(normal_force, contacts.normal_force);
        append(shear_force, contacts.shear_force);
    }
    if (i.empty()) return;
    const Code places{place_quantum}, forces = code_of({normal_force, shear_force}, force_growth);
    block.add_row("contacts.count", count, Code{});
    block.add_row("contacts.i", i, Code{});
    block.add_row("contacts.j", j, Code{});
    block.add_row("contacts.x", x, places);
    block.add_row("contacts.y", y, places);
    block.add_row("contacts.fn", normal_force, forces);
    block.add_row("contacts.fs", shear_force, forces);
}

/// Largest extent of the specimen in the first frame, m.
double size_of(const std::vector<RecordedCell>& cells) {
    double x1 = 0.0, x2 = 0.0, y1 = 0.0, y2 = 0.0;
    bool any = false;
    const auto include = [&](Vec2 place, double reach) {
        x1 = any ? std::min(x1, place.x - reach) : place.x - reach;
        x2 = any ? std::max(x2, place.x + reach) : place.x + reach;
        y1 = any ? std::min(y1, place.y - reach) : place.y - reach;
        y2 = any ? std::max(y2, place.y + reach) : place.y + reach;
        any = true;
    };
    for (const RecordedCell& cell : cells) {
        if (cell.radius > 0.0) include(cell.centre, cell.radius);
        for (const Vec2 corner : cell.outline) include(corner, 0.0);
    }
    return std::max({x2 - x1, y2 - y1, std::numeric_limits<double>::min()});
}

/// Left and right ends of the specimen over all frames, without platens and splinters, m. They let the viewer leave
/// enough space from the start.
class Sides {
  public:
    explicit Sides(const std::vector<RecordedCell>& cells) : cells_(cells) {
        for (const RecordedCell& cell : cells) {
            double reach = cell.radius;
            for (const Vec2 corner : cell.outline) reach = std::max(reach, norm(corner - cell.centre));
            reach_.push_back(reach);
            if (cell.platen) continue;
            left_ = std::min(left_, cell.centre.x - reach);
            right_ = std::max(right_, cell.centre.x + reach);
        }
        // Splinters that fly farther are ignored; otherwise the specimen would be drawn too small.
        const double followed = 0.4 * (right_ - left_);
        least_ = left_ - followed;
        most_ = right_ + followed;
    }
    void include(const RecordedFrame& frame) {
        for (std::size_t k = 0; k < cells_.size(); ++k) {
            const double x = cells_[k].centre.x + frame.ux[k];
            if (cells_[k].platen || x < least_ || x > most_) continue;
            left_ = std::min(left_, x - reach_[k]);
            right_ = std::max(right_, x + reach_[k]);
        }
    }
    std::array<double, 2> ends() const { return {left_, right_}; }

  private:
    const std::vector<RecordedCell>& cells_;
    std::vector<double> reach_;
    double left_ = std::numeric_limits<double>::infinity(), right_ = -left_, least_ = 0.0, most_ = 0.0;
};

template <class T, class Of, class Entries>
std::vector<T> listed(const Entries& entries, const Of& of) {
    std::vector<T> values;
    values.reserve(entries.size());
    for (const auto& entry : entries) values.push_back(static_cast<T>(of(entry)));
    return values;
}

void add_cells(PlainBlock& block, const std::vector<RecordedCell>& cells) {
    block.add("cells.id", listed<std::int32_t>(cells, [](const RecordedCell& c) { return c.id; }));
    block.add("cells.material", listed<std::int32_t>(cells, [](const RecordedCell& c) { return c.material; }));
    block.add("cells.radius", listed<float>(cells, [](const RecordedCell& c) { return c.radius; }));
    block.add("cells.x", listed<float>(cells, [](const RecordedCell& c) { return c.centre.x; }));
    block.add("cells.y", listed<float>(cells, [](const RecordedCell& c) { return c.centre.y; }));
    block.add("cells.open", listed<std::uint8_t>(cells, [](const RecordedCell& c) { return c.open; }));
    block.add("cells.platen", listed<std::uint8_t>(cells, [](const RecordedCell& c) { return c.platen; }));
    std::vector<std::int32_t> first_point{0};
    std::vector<float> x, y;
    for (const RecordedCell& cell : cells) {
        for (const Vec2 corner : cell.outline) {
            x.push_back(static_cast<float>(corner.x));
            y.push_back(static_cast<float>(corner.y));
        }
        first_point.push_back(static_cast<std::int32_t>(x.size()));
    }
    block.add("cells.first_point", first_point);
    block.add("outline.x", x);
    block.add("outline.y", y);
}

void add_bonds(PlainBlock& block, const std::vector<RecordedBond>& bonds) {
    block.add("bonds.i", listed<std::int32_t>(bonds, [](const RecordedBond& b) { return b.i; }));
    block.add("bonds.j", listed<std::int32_t>(bonds, [](const RecordedBond& b) { return b.j; }));
    block.add("bonds.x", listed<float>(bonds, [](const RecordedBond& b) { return b.place.x; }));
    block.add("bonds.y", listed<float>(bonds, [](const RecordedBond& b) { return b.place.y; }));
    if (std::ranges::none_of(bonds, [](const RecordedBond& b) { return norm(b.end - b.begin) > 0.0; })) return;
    // The face's half length as a vector; its ends are the bond's position plus and minus this vector.
    block.add("bonds.half_x", listed<float>(bonds, [](const RecordedBond& b) { return 0.5 * (b.end.x - b.begin.x); }));
    block.add("bonds.half_y", listed<float>(bonds, [](const RecordedBond& b) { return 0.5 * (b.end.y - b.begin.y); }));
}

void add_curve(PlainBlock& block, const NumberTable& curve) {
    for (const char* name : {"axial_strain", "axial_stress", "bonds_broken"})
        block.add(std::string("curve.") + name, *curve.find(name));
}

void add_breaks(PlainBlock& block, const TestResults& results) {
    const auto whole = [&](const char* name) {
        return listed<std::int32_t>(*results.events.find(name), [](double value) { return value; });
    };
    const auto flag = [&](const char* name, const char* column) {
        if (const std::vector<double>* values = results.events.find(column))
            block.add(std::string("events.") + name,
                      listed<std::uint8_t>(*values, [](double value) { return value != 0.0; }));
    };
    for (const char* name : {"body_i", "body_j"}) block.add(std::string("events.") + name, whole(name));
    flag("shear", "mode");
    flag("last_of_interface", "last_of_interface");
    const auto real = [&](const std::string& prefix, const NumberTable& table,
                          std::initializer_list<const char*> names) {
        for (const char* name : names) {
            if (const std::vector<double>* values = table.find(name)) block.add(prefix + name, *values);
        }
    };
    real("events.", results.events, {"time", "axial_strain", "x", "y", "orientation", "energy"});
    if (results.slips) real("slips.", *results.slips, {"time", "axial_strain", "x", "y", "orientation"});
}

/// Rows needed to draw a curve: the first row, the last row, and the rows with the extremes of each column in each of
/// `intervals` equal parts of the curve.
std::vector<std::size_t> rows_seen(const std::vector<const std::vector<double>*>& columns, std::size_t intervals) {
    const std::size_t rows = columns.front()->size();
    std::vector<std::size_t> seen;
    if (rows <= 2 * intervals) {
        seen.resize(rows);
        std::iota(seen.begin(), seen.end(), std::size_t{0});
        return seen;
    }
    seen = {0, rows - 1};
    for (std::size_t k = 0; k < intervals; ++k) {
        const auto begin = static_cast<std::ptrdiff_t>(k * rows / intervals),
                   end = static_cast<std::ptrdiff_t>((k + 1) * rows / intervals);
        for (const std::vector<double>* column : columns) {
            const auto [low, high] = std::minmax_element(column->begin() + begin, column->begin() + end);
            seen.push_back(static_cast<std::size_t>(low - column->begin()));
            seen.push_back(static_cast<std::size_t>(high - column->begin()));
        }
    }
    std::ranges::sort(seen);
    const auto repeated = std::ranges::unique(seen);
    seen.erase(repeated.begin(), repeated.end());
    return seen;
}

/// Columns of one curve, thinned for display on screen, with names that begin with `prefix`.
class ThinnedCurve {
  public:
    ThinnedCurve(PlainBlock& block, std::string prefix) : block_(block), prefix_(std::move(prefix)) {}

    void add(const char* name, const std::vector<double>& values) {
        names_.emplace_back(name);
        columns_.push_back(&values);
    }
    void write(const std::vector<double>& time) const {
        constexpr std::size_t intervals = 400;  // number of intervals, each about two pixels wide in a diagram
        std::vector<const std::vector<double>*> all = columns_;
        all.push_back(&time);
        const std::vector<std::size_t> rows = rows_seen(all, intervals);
        const auto put = [&](const std::string& name, const std::vector<double>& values) {
            // Stored as double, because displacements are computed as differences of positions.
            block_.add(prefix_ + name, listed<double>(rows, [&](std::size_t row) { return values[row]; }));
        };
        put("time", time);
        for (std::size_t k = 0; k < columns_.size(); ++k) put(names_[k], *columns_[k]);
    }

  private:
    PlainBlock& block_;
    std::string prefix_;
    std::vector<std::string> names_;
    std::vector<const std::vector<double>*> columns_;
};

constexpr std::size_t most_bodies = 8;  // largest number of curves that a reader can distinguish

/// Adds the curves of a deck run. @return their entry in the page's manifest
Json add_curves(PlainBlock& block, const DeckCurves& curves) {
    ThinnedCurve energy(block, "energy.");
    for (std::size_t k = 0; k < deck_energy_names.size(); ++k) energy.add(deck_energy_names[k], curves.energy.parts[k]);
    energy.write(curves.energy.time);
    const auto listed_ids = [](const auto& all) {
        Json ids = Json::array();
        for (const auto& curve : all | std::views::take(most_bodies)) ids.push_back(curve.id);
        return Json{{"ids", ids}, {"of", all.size()}};
    };
    for (const DeckBodyCurve& body : curves.bodies | std::views::take(most_bodies)) {
        ThinnedCurve curve(block, fmt::format("body.{}.", body.id));
        curve.add("force_x", body.force_x);
        curve.add("x", body.x);
        curve.add("force_y", body.force_y);
        curve.add("y", body.y);
        curve.write(body.time);
    }
    for (const DeckVelocityCurve& body : curves.velocities | std::views::take(most_bodies)) {
        ThinnedCurve curve(block, fmt::format("velocity.{}.", body.id));
        curve.add("vy", body.vy);
        curve.write(body.time);
    }
    return {{"in_time", curves.in_time},
            {"bodies", listed_ids(curves.bodies)},
            {"velocities", listed_ids(curves.velocities)}};
}

/// Summary of a recording, with a sentence about each condition of validity that does not hold.
Json listed_summary(const Summary& summary) {
    Json all = json_of(summary);
    const std::vector<JudgedClaim> claims = summary.validity.validity.value_or(std::vector<JudgedClaim>());
    for (std::size_t k = 0; k < claims.size(); ++k)
        if (!claims[k].holds.value_or(true))
            all["validity"][k]["sentence"] = broken_claim(claims[k].claim.value_or(""), claims[k].found.value_or(""));
    return all;
}

/// Adds the quantities of all cells and bonds in some frames.
void add_fields(CodedBlock& block, const std::vector<RecordedFrame>& frames, double place_quantum) {
    const auto evenly = [](double quantum) { return [=](const auto&) { return Code{quantum}; }; };
    const auto by_size = [](double with_growth) {
        return [=](const auto& rows) { return code_of(rows, with_growth); };
    };
    add_field(block, "ux", frames, &RecordedFrame::ux, evenly(place_quantum));
    add_field(block, "uy", frames, &RecordedFrame::uy, evenly(place_quantum));
    add_field(block, "angle", frames, &RecordedFrame::angle, evenly(angle_quantum));
    add_field(block, "vx", frames, &RecordedFrame::vx, by_size(growth));
    add_field(block, "vy", frames, &RecordedFrame::vy, by_size(growth));
    add_field(block, "rate", frames, &RecordedFrame::rotation_rate, by_size(growth));
    add_field(block, "sxx", frames, &RecordedFrame::stress_xx, by_size(growth));
    add_field(block, "syy", frames, &RecordedFrame::stress_yy, by_size(growth));
    add_field(block, "sxy", frames, &RecordedFrame::stress_xy, by_size(growth));
    add_field(block, "fragment", frames, &RecordedFrame::fragment, evenly(1.0));
    add_field(block, "fn", frames, &RecordedFrame::normal_force, by_size(force_growth));
    add_field(block, "fs", frames, &RecordedFrame::shear_force, by_size(force_growth));
    add_field(block, "state", frames, &RecordedFrame::state, evenly(1.0));
    add_field(block, "sb", frames, &RecordedFrame::stress_begin, by_size(force_growth));
    add_field(block, "se", frames, &RecordedFrame::stress_end, by_size(force_growth));
}

Json listed_frame(const FrameHead& head) {
    Json entry{{"time", head.time}};
    if (head.axial_strain) entry["axial_strain"] = *head.axial_strain;
    if (head.axial_stress) entry["axial_stress"] = *head.axial_stress;
    if (head.step) entry["step"] = *head.step;
    if (!head.roles.empty()) entry["roles"] = head.roles;
    if (!head.file.empty()) entry["file"] = head.file;
    return entry;
}

}  // namespace

PageData pack_recording(const Recording& recording, const std::function<void(std::size_t)>& packed_frames) {
    PlainBlock first;
    add_cells(first, recording.cells);
    add_bonds(first, recording.bonds);
    if (recording.kind == Recording::Kind::test) add_curve(first, recording.results.curve);
    if (!recording.results.events.names.empty()) add_breaks(first, recording.results);

    PageData data;
    Json& manifest = data.manifest;
    manifest["name"] = recording.name;
    manifest["kind"] = name_of(recording.kind);
    manifest["summary"] = listed_summary(recording.results.summary);
    if (recording.walls) manifest["walls"] = *recording.walls;
    if (recording.mean_velocities) manifest["velocities"] = "mean";
    if (recording.kind == Recording::Kind::deck) manifest["curves"] = add_curves(first, recording.curves);
    manifest["arrays"] = first.places();
    manifest["frames"] = Json::array();
    for (const FrameHead& head : recording.frames) manifest["frames"].push_back(listed_frame(head));
    manifest["groups"] = Json::array();
    data.blocks.push_back(packed(first.bytes()));

    const double place_quantum = place_share * size_of(recording.cells);
    Sides sides(recording.cells);
    for (std::size_t begin = 0; begin < recording.frames.size(); begin += frames_in_block) {
        const std::size_t end = std::min(begin + frames_in_block, recording.frames.size());
        std::vector<RecordedFrame> frames;
        for (std::size_t k = begin; k < end; ++k) {
            frames.push_back(recording.frame(k));
            sides.include(frames.back());
            if (packed_frames) packed_frames(k);
        }
        const FrameHead &from = recording.frames[begin], &to = recording.frames[end - 1];
        CodedBlock block(fmt::format("{}: {} to {}", recording.name, from.file, to.file));
        add_fields(block, frames, place_quantum);
        add_contacts(block, frames, place_quantum);
        manifest["groups"].push_back(
            {{"block", data.blocks.size()}, {"first", begin}, {"count", frames.size()}, {"arrays", block.places()}});
        data.blocks.push_back(packed(block.bytes()));
    }
    if (recording.kind == Recording::Kind::test && !recording.frames.empty()) manifest["sides"] = sides.ends();
    return data;
}

}  // namespace crackle::tools
