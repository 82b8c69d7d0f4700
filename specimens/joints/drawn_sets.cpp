// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/joints/drawn_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "specimens/joints/clipping.hpp"
#include "specimens/statistics/random_numbers.hpp"

namespace crackle {
namespace {

namespace cr = correctly_rounded;
constexpr double radians = std::numbers::pi / 180.0;

Vec2 unit(double angle) { return {cr::cos(angle), cr::sin(angle)}; }

/// A length distribution divided into strata. Stratum k contains the lengths exceeded by a fraction between 2^-(k+1)
/// and 2^-k of all lengths.
class LengthStrata {
  public:
    LengthStrata(const LengthLaw& law, double width, double height) : law_(law) {
        double share = 1.0;
        for (std::size_t k = 0; k < count; ++k) {
            share *= 0.5;
            longest_[k] = law.exceeded_by(share);
            sum_ += share * (width + longest_[k]) * (height + longest_[k]);
            weight_below_[k] = sum_;
        }
    }

    struct Drawn {
        double length, longest;
    };
    /// Draws a length. The probability of a stratum is proportional to its fraction times the area of the box, widened
    /// by half the stratum's longest length on every side.
    Drawn draw(std::mt19937_64& generator) const {
        const double at = sum_ * uniform_number(generator);
        const auto k = static_cast<std::size_t>(
            std::min(std::upper_bound(weight_below_.begin(), weight_below_.end(), at), weight_below_.end() - 1) -
            weight_below_.begin());
        const double share = std::ldexp(1.0 - 0.5 * share_number(generator), -static_cast<int>(k));
        return {std::min(law_.exceeded_by(share), longest_[k]), longest_[k]};
    }

    /// Number of draws required for a density of one midpoint per unit area, m2.
    double draws_of_a_midpoint() const { return sum_; }

  private:
    static constexpr std::size_t count = 50;  // the probability of a length beyond the last stratum is 1e-15
    const LengthLaw& law_;
    std::array<double, count> longest_{}, weight_below_{};
    double sum_ = 0.0;
};

class SetDrawing {
  public:
    SetDrawing(const JointRequest& joints, std::size_t set, const Domain& box)
        : places_(joints.places),
          number_(set),
          set_(joints.sets[set]),
          amount_(set_.amount),
          directions_(set_.directions),
          box_(box),
          width_(box.x2 - box.x1),
          height_(box.y2 - box.y1),
          diagonal_(norm({width_, height_})),
          centre_{0.5 * (box.x1 + box.x2), 0.5 * (box.y1 + box.y2)},
          scan_line_(set_.scan_line ? *set_.scan_line * radians : directions_.mean() + 0.5 * std::numbers::pi) {
        std::seed_seq mixed{static_cast<std::uint32_t>(joints.seed), static_cast<std::uint32_t>(joints.seed >> 32U),
                            static_cast<std::uint32_t>(set)};
        generator_.seed(mixed);
    }

    std::vector<JointTrace> draw() {
        constexpr double parallel = 1e-6;  // sine below which directions count as parallel
        if (is(AmountKind::p10) && directions_.single() &&
            std::abs(cross(unit(directions_.mean()), unit(scan_line_))) < parallel) {
            throw InputError(
                fmt::format("{}: found {} deg, the direction of the set, expected another direction, since a line "
                            "along the set crosses none of its traces",
                            at(CaseKey::joint_set_scan_line), *set_.scan_line));
        }
        if (is(AmountKind::spacing))
            lines_at_spacing();
        else if (const auto* law = std::get_if<LengthLaw>(&set_.length))
            midpoints(*law);
        else
            lines_anywhere();
        return std::move(traces_);
    }

  private:
    std::string at(CaseKey key) const { return places_.at(key, number_); }
    bool is(AmountKind kind) const { return amount_.kind == kind; }

    /// The key that states the amount.
    CaseKey key_of_amount() const {
        using enum CaseKey;
        constexpr std::array keys{joint_set_number, joint_set_p10, joint_set_p20, joint_set_p21, joint_set_spacing};
        return keys[static_cast<std::size_t>(amount_.kind)];
    }

    /// The requested amount multiplied by the area, in the units in which measure_of() counts a trace.
    double asked() const {
        const double area = width_ * height_;
        if (is(AmountKind::number)) return amount_.value;
        if (is(AmountKind::p10) || is(AmountKind::p21)) return amount_.value * area;
        const double midpoints = std::round(amount_.value * area);
        if (midpoints < 1.0)
            throw InputError(
                fmt::format("{}: found {} 1/m2, expected at least half a midpoint in the box of {:.4g} "
                            "m2; raise it",
                            at(CaseKey::joint_set_p20), amount_.value, area));
        return midpoints;
    }
    double measure_of(const JointTrace& trace) const {
        if (is(AmountKind::number)) return 1.0;
        if (is(AmountKind::p10)) return length_across(trace, scan_line_);
        if (is(AmountKind::p21)) return trace.length();
        return trace.centred ? 1.0 : 0.0;
    }

    bool full() const { return !is(AmountKind::spacing) && reached_ >= asked_; }

    /// Adds a trace in the box. The last trace is shortened if the amount depends on lengths.
    void take(JointTrace trace) {
        if (traces_.size() >= most_traces_of_a_set)
            throw InputError(
                fmt::format("{}: found more than {} traces in the box of {:.4g} m by {:.4g} m, expected "
                            "fewer; lower the amount",
                            at(key_of_amount()), most_traces_of_a_set, width_, height_));
        const double more = is(AmountKind::spacing) ? 0.0 : measure_of(trace);
        if ((is(AmountKind::p10) || is(AmountKind::p21)) && reached_ + more > asked_) {
            const double share = (asked_ - reached_) / more;
            Vec2& end = trace.points.back();
            const Vec2 start = trace.points.front();
            end = start + share * (end - start);
            reached_ = asked_;
            if (!(norm(end - start) > least_share * diagonal_)) return;  // too short to count
        } else {
            reached_ += more;
        }
        traces_.push_back(std::move(trace));
    }
    void take_part(Vec2 a, Vec2 b, double whole_length) {
        const auto part = clipped(a, b, box_);
        if (!part) return;
        const Vec2 middle = 0.5 * (a + b);
        const bool centred = std::isfinite(whole_length) && middle.x >= box_.x1 && middle.x <= box_.x2 &&
                             middle.y >= box_.y1 && middle.y <= box_.y2;
        take({{part->first, part->second}, number_, whole_length, centred});
    }

    /// Checks the lengths of traces. @throws InputError if they are so short that rounding reduces traces to points,
    /// which do not count towards the amount
    void refuse_points(CaseKey key, double found, double typical) const {
        if (!(typical >= least_share * diagonal_))
            throw InputError(fmt::format(
                "{}: found {} m, expected lengths of at least {:.3g} m, a fraction of {} of the box's diagonal, "
                "for half of the traces; make them longer",
                at(key), found, least_share * diagonal_, least_share));
    }

    /// Checks the expected number of draws. @throws InputError if it is too large because few drawn traces meet the box
    void refuse_endless(CaseKey key, double found, const LengthLaw& law, const LengthStrata& strata) const {
        // Midpoints per area of the whole plane. The length of a trace across any scan line is at most the length of
        // the trace.
        const double area = width_ * height_, mean = law.mean();
        const double density = is(AmountKind::number) ? asked_ / (area + mean * (width_ + height_))
                               : is(AmountKind::p20)  ? asked_ / area
                                                      : asked_ / (area * mean);
        const double draws = density * strata.draws_of_a_midpoint();
        if (!(draws <= most_drawn))
            throw InputError(fmt::format(
                "{}: found {} m, expected lengths closer to the size of the box, {:.4g} m by {:.4g} m; {:.2g} "
                "midpoints would have to be drawn, more than {:.0e}, because few traces meet the box; make the traces "
                "shorter or reduce their number",
                at(key), found, width_, height_, draws, most_drawn));
    }

    void midpoints(const LengthLaw& law) {
        asked_ = asked();
        const LengthStrata strata(law, width_, height_);
        if (law.has_power_law()) {
            refuse_points(CaseKey::joint_set_length_min, law.shortest(), law.exceeded_by(0.5));
            refuse_endless(CaseKey::joint_set_length_max, law.longest(), law, strata);
        } else {
            refuse_points(CaseKey::joint_set_length_mean, law.mean(), law.exceeded_by(0.5));
            refuse_endless(CaseKey::joint_set_length_mean, law.mean(), law, strata);
        }
        while (!full()) {
            const auto [length, longest] = strata.draw(generator_);
            const Vec2 half = 0.5 * length * unit(directions_.draw(generator_));
            const Vec2 middle{
                uniform_number(generator_, box_.x1 - 0.5 * longest, box_.x2 + 0.5 * longest),
                uniform_number(generator_, box_.y1 - 0.5 * longest, box_.y2 + 0.5 * longest),
            };
            take_part(middle - half, middle + half, length);
        }
    }

    /// Adds one line through the plane: either a joint over its whole length, or joints alternating with gaps.
    void line(Vec2 through, double angle) {
        const Vec2 along = unit(angle);
        // The part of the line from middle - reach to middle + reach extends beyond the box at both ends.
        const double middle = dot(centre_ - through, along), reach = diagonal_;
        const auto* gaps = std::get_if<TracesWithGaps>(&set_.length);
        if (gaps == nullptr) {
            take_part(through + (middle - reach) * along, through + (middle + reach) * along,
                      std::numeric_limits<double>::infinity());
            return;
        }
        const LengthLaw &joint = gaps->joint, &gap = gaps->gap;
        const double cycle = joint.mean() + gap.mean();
        refuse_points(CaseKey::joint_set_length_mean, joint.mean(), joint.mean());
        if (gap.mean() > most_gap_share * diagonal_)
            throw InputError(
                fmt::format("{}: found {} m, expected at most {:.4g} m, {} diagonals of the box; with longer gaps, "
                            "hardly any line would have a joint in the box",
                            at(CaseKey::joint_set_gap_mean), gap.mean(), most_gap_share * diagonal_, most_gap_share));
        if (2.0 * reach / cycle > static_cast<double>(most_traces_of_a_set))
            throw InputError(
                fmt::format("{}: found {} m and gaps of {} m, expected at most {} joints along the box; "
                            "make them longer",
                            at(CaseKey::joint_set_length_mean), joint.mean(), gap.mean(), most_traces_of_a_set));
        // Joints and gaps begin well before the box, so that their distribution inside is stationary.
        double from = middle - reach - (settling_cycles + uniform_number(generator_)) * cycle;
        while (from < middle + reach && !full()) {
            const double length = joint.draw(generator_);
            take_part(through + from * along, through + (from + length) * along, length);
            from += length + gap.draw(generator_);
        }
    }

    /// Half the width of the box perpendicular to a direction.
    double half_width_across(Vec2 along) const {
        return 0.5 * (std::abs(along.y) * width_ + std::abs(along.x) * height_);
    }

    void lines_anywhere() {
        asked_ = asked();
        while (!full()) {
            const double angle = directions_.draw(generator_);
            const Vec2 along = unit(angle);
            const double offset = uniform_number(generator_, -0.5 * diagonal_, 0.5 * diagonal_);
            if (std::abs(offset) < half_width_across(along)) line(centre_ + offset * perpendicular(along), angle);
        }
    }

    void lines_at_spacing() {
        const LengthLaw& law = amount_.spacing;
        const Vec2 along = unit(directions_.mean()), normal = perpendicular(along);
        // Lines that deviate from the mean direction by d and meet the box lie up to 1/cos d times farther away.
        const double half_width = directions_.single() ? half_width_across(along) : 0.5 * diagonal_;
        const double reach = half_width * directions_.stretch();
        const auto refuse_beyond = [&](double length, double most, const char* lines) {
            if (length / amount_.value > most)
                throw InputError(fmt::format(
                    "{}: found {} m, expected a spacing that gives at most {:.0f} lines {}; make the spacing larger",
                    at(CaseKey::joint_set_spacing), amount_.value, most, lines));
        };
        refuse_beyond(2.0 * half_width, most_traces_of_a_set, "in the box");
        refuse_beyond(2.0 * reach, most_drawn,
                      "in and near the box (lines near it may cross it, because their directions scatter)");
        const auto place = [&](double offset) {
            const double angle = directions_.draw(generator_);
            const Vec2 through = centre_ + offset * normal;
            if (!directions_.single() &&
                std::abs(cross(unit(angle), through - centre_)) > half_width_across(unit(angle)))
                return;
            line(through, angle);
        };
        if (!amount_.through) {
            double offset = -reach - (settling_cycles + uniform_number(generator_)) * law.mean();
            for (; offset <= reach; offset += law.draw(generator_))
                if (offset >= -reach) place(offset);
            return;
        }
        const double first = dot(*amount_.through - centre_, normal);
        if ((std::abs(first) + half_width) / amount_.value > static_cast<double>(most_traces_of_a_set))
            throw InputError(
                fmt::format("{}: found a point more than {} spacings away from the box, expected one "
                            "closer to the box; choose one inside",
                            at(CaseKey::joint_set_through), most_traces_of_a_set));
        // Places lines upwards from the first one, then downwards, including lines outside the box that may meet it
        // because their directions scatter.
        const double furthest = std::abs(first) + reach;
        double offset = 0.0;
        for (; offset <= furthest; offset += law.draw(generator_))
            if (std::abs(first + offset) <= reach) place(first + offset);
        for (offset = law.draw(generator_); offset <= furthest; offset += law.draw(generator_))
            if (std::abs(first - offset) <= reach) place(first - offset);
    }

    static constexpr double settling_cycles = 20.0;
    static constexpr double most_gap_share = 1e3;
    static constexpr double most_drawn = 1e7;  // largest number of draws, which take some seconds
    // Shortest trace, relative to the box's diagonal; shorter ones are rounding errors.
    static constexpr double least_share = 1e-9;

    const Places& places_;
    std::size_t number_;
    const JointSet& set_;
    const TraceAmount& amount_;
    const OrientationLaw& directions_;
    Domain box_;
    double width_, height_, diagonal_;
    Vec2 centre_;
    double scan_line_;
    std::mt19937_64 generator_;
    std::vector<JointTrace> traces_;
    double asked_ = 0.0, reached_ = 0.0;
};

}  // namespace

std::vector<JointTrace> draw_set(const JointRequest& joints, std::size_t set, const Domain& box) {
    return SetDrawing(joints, set, box).draw();
}

double length_across(const JointTrace& trace, double scan_line) {
    const Vec2 along = unit(scan_line);
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < trace.points.size(); ++k)
        sum += std::abs(cross(trace.points[k + 1] - trace.points[k], along));
    return sum;
}

}  // namespace crackle
