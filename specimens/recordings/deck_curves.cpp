// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/deck_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/files/read_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t largest_step = std::numeric_limits<std::int64_t>::max();

/// Converts step numbers to times. A single factor is not enough, because the time step may have been reduced during
/// the run.
class StepTimes {
  public:
    explicit StepTimes(const std::vector<DeckFrameFile::Head>& frames) : frames_(frames) {}

    bool known() const { return frames_.size() > 1; }

    /// Time of a step. Outside the range of the frames, it is extrapolated from the two nearest frames. If the times
    /// are unknown, the step number itself is returned.
    double at(std::int64_t step) const {
        if (!known()) return static_cast<double>(step);
        const auto later = [&](const DeckFrameFile::Head& head) { return head.step < step; };
        auto after = std::partition_point(frames_.begin(), frames_.end(), later);
        after = std::clamp(after, frames_.begin() + 1, frames_.end() - 1);
        const DeckFrameFile::Head &from = *std::prev(after), &to = *after;
        if (step == from.step) return from.time;
        if (step == to.step) return to.time;
        const double share = static_cast<double>(step - from.step) / static_cast<double>(to.step - from.step);
        return from.time + share * (to.time - from.time);
    }

  private:
    const std::vector<DeckFrameFile::Head>& frames_;
};

/// Calls `read(reader)` for each complete row of a file.
template <class Read>
void read_rows(const fs::path& file, const Read& read) {
    if (!is_there(file)) return;
    const std::string text = read_file(file);
    std::string_view rest = text;
    for (int number = 1;; ++number) {
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos) return;
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end + 1);
        if (line.starts_with('#')) continue;
        DeckReader words(file.string(), std::string(line), number);
        read(words);
        words.expect_end("the row");
    }
}

/// Reads the step number of a row, which must be larger than the step number of the previous row.
std::int64_t read_step(DeckReader& words, std::int64_t& last) {
    const std::int64_t step = words.integer("step", 0, largest_step);
    if (step <= last) words.refuse("step", fmt::format("one after step {}", last));
    return last = step;
}

/// Reads the id of a body and returns the curve of that body.
template <class Curve>
Curve& curve_of_body(DeckReader& words, std::vector<Curve>& all) {
    const int id = static_cast<int>(words.integer("body", 1, std::numeric_limits<int>::max()));
    const auto found = std::ranges::find(all, id, &Curve::id);
    if (found != all.end()) return *found;
    all.emplace_back();
    all.back().id = id;
    return all.back();
}

/// Reads rows of several bodies. Rows of the same step are consecutive.
template <class Curve, class Read>
std::vector<Curve> read_bodies(const fs::path& file, const StepTimes& times, const Read& read) {
    std::vector<Curve> all;
    std::int64_t last = 0;
    read_rows(file, [&](DeckReader& words) {
        const std::int64_t step = words.integer("step", 0, largest_step);
        if (step < last) words.refuse("step", fmt::format("{} or a later one", last));
        last = step;
        Curve& curve = curve_of_body(words, all);
        const double time = times.at(step);
        if (!curve.time.empty() && !(time > curve.time.back()))
            words.refuse("body", fmt::format("only one row of this body for step {}", step));
        curve.time.push_back(time);
        read(words, curve);
    });
    return all;
}

}  // namespace

DeckCurves read_deck_curves(const fs::path& folder, const std::vector<DeckFrameFile::Head>& frames) {
    const StepTimes times(frames);
    DeckCurves curves;
    curves.in_time = times.known();
    std::int64_t last = -1;
    read_rows(folder / "energy.dat", [&](DeckReader& words) {
        curves.energy.time.push_back(times.at(read_step(words, last)));
        for (std::size_t k = 0; k < deck_energy_names.size(); ++k)
            curves.energy.parts[k].push_back(words.number(deck_energy_names[k]));
    });
    curves.bodies =
        read_bodies<DeckBodyCurve>(folder / "f-d_curve.dat", times, [](DeckReader& words, DeckBodyCurve& body) {
            body.force_x.push_back(words.number("fx"));
            body.x.push_back(words.number("x"));
            body.force_y.push_back(words.number("fy"));
            body.y.push_back(words.number("y"));
            body.moment.push_back(words.number("moment"));
            body.angle.push_back(words.number("angle"));
        });
    curves.velocities = read_bodies<DeckVelocityCurve>(
        folder / "velocity_y.dat", times,
        [](DeckReader& words, DeckVelocityCurve& body) { body.vy.push_back(words.number("vy")); });
    return curves;
}

}  // namespace crackle
