// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/joints/trace_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <unordered_set>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/scene/scene.hpp"

namespace crackle {
namespace {

std::string_view stripped(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Lines of a text, one after another.
class Lines {
  public:
    Lines(std::string name, std::string_view text) : name_(std::move(name)), rest_(text) {}

    std::optional<std::string_view> next() {
        if (rest_.empty()) return std::nullopt;
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        const std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++number_;
        return stripped(line);
    }
    [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
        throw InputError(fmt::format("{}:{}: found {}, expected {}", name_, number_, found, expected));
    }
    double number(std::string_view word, const char* what) const {
        const std::string_view digits = !word.empty() && word.front() == '+' ? word.substr(1) : word;
        double value = 0.0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc{} || end != digits.data() + digits.size() || !is_a_size(value))
            refuse(fmt::format("'{:.40}'", word),
                   fmt::format("a number for {}, 0 or of a size from 1e-30 to 1e30", what));
        return value;
    }
    const std::string& name() const { return name_; }
    int line() const { return number_; }

  private:
    std::string name_;
    std::string_view rest_;
    int number_ = 0;
};

/// Traces and their rows.
struct Found {
    TracePoints traces;
    TraceRows rows;

    /// Repeated points are left out, a trace of one place altogether: intersection tools leave such rows behind.
    /// @param line of its beginning
    void add(std::vector<Vec2> points, int line) {
        points.erase(std::unique(points.begin(), points.end()), points.end());
        if (points.size() < 2) {
            rows.without_length.push_back(line);
            return;
        }
        traces.push_back(std::move(points));
        rows.lines.push_back(line);
    }
};

Found parse_table(Lines lines) {
    Found found;
    while (auto line = lines.next()) {
        std::vector<double> numbers;
        std::string_view rest = stripped(line->substr(0, line->find('#')));
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
            numbers.push_back(lines.number(rest.substr(0, end), numbers.size() % 2 == 0 ? "x" : "y"));
            rest = stripped(rest.substr(end));
        }
        if (numbers.empty()) continue;
        if (numbers.size() < 4 || numbers.size() % 2 != 0)
            lines.refuse(fmt::format("{} number{}", numbers.size(), numbers.size() == 1 ? "" : "s"),
                         "x and y of two points or more");
        std::vector<Vec2> points;
        for (std::size_t k = 0; k < numbers.size(); k += 2) points.push_back({numbers[k], numbers[k + 1]});
        found.add(std::move(points), lines.line());
    }
    return found;
}

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    while (true) {
        const std::size_t comma = line.find(',');
        fields.push_back(stripped(line.substr(0, comma)));
        if (comma == std::string_view::npos) return fields;
        line.remove_prefix(comma + 1);
    }
}

class CsvTraces {
  public:
    explicit CsvTraces(Lines lines) : lines_(std::move(lines)) {}

    Found read() {
        const auto heading = lines_.next();
        if (!heading) lines_.refuse("no heading", expected_heading);
        columns_ = fields_of(*heading);
        const bool by_point = has("trace") && has("x") && has("y");
        const bool by_line = has("x1") && has("y1") && has("x2") && has("y2");
        if (by_point == by_line) lines_.refuse(fmt::format("'{:.60}'", *heading), expected_heading);
        while (auto line = lines_.next()) {
            if (line->empty()) continue;
            fields_ = fields_of(*line);
            if (fields_.size() != columns_.size())
                lines_.refuse(fmt::format("{} fields", fields_.size()), fmt::format("{}", columns_.size()));
            if (by_line)
                found_.add({{number("x1"), number("y1")}, {number("x2"), number("y2")}}, lines_.line());
            else
                point();
        }
        finish();
        return std::move(found_);
    }

  private:
    static constexpr const char* expected_heading = "a heading with trace,x,y or with x1,y1,x2,y2";

    bool has(const char* name) const { return std::find(columns_.begin(), columns_.end(), name) != columns_.end(); }
    std::string_view field(const char* name) const {
        return fields_[static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), name) - columns_.begin())];
    }
    double number(const char* name) const { return lines_.number(field(name), name); }

    void point() {
        const std::string_view trace = field("trace");
        if (trace.empty()) lines_.refuse("no trace", "its name or number");
        if (points_.empty() || trace != trace_) {
            finish();
            trace_ = trace;
            begun_ = lines_.line();
            // Points of a trace that comes again would belong to the middle of it.
            if (!seen_.insert(trace).second)
                lines_.refuse(fmt::format("trace {:.40} again after another", trace), "its points one after another");
        }
        points_.push_back({number("x"), number("y")});
    }
    void finish() {
        if (!points_.empty()) found_.add(std::move(points_), begun_);
        points_.clear();
    }

    Lines lines_;
    std::vector<std::string_view> columns_, fields_;
    std::unordered_set<std::string_view> seen_;
    std::string_view trace_;
    int begun_ = 0;
    std::vector<Vec2> points_;
    Found found_;
};

/// Group codes and their values, by twos of lines (AutoCAD DXF Reference, "Drawing interchange file formats").
class DxfTraces {
  public:
    DxfTraces(Lines lines, const std::string& layer) : lines_(std::move(lines)), layer_(layer) {}

    Found read() {
        bool entities = false, ended = false;
        while (!ended && next()) {
            if (code_ == 0 && value_ == "EOF") break;
            if (code_ == 2 && value_ == "ENTITIES" && section_) entities = true;
            section_ = code_ == 0 && value_ == "SECTION";
            while (entities && !ended && code_ == 0) {
                if (value_ == "ENDSEC")
                    ended = true;
                else if (!entity())
                    break;
            }
            if (entities && !ended && at_end_) break;
        }
        if (!entities) lines_.refuse("no section ENTITIES", "a DXF file of lines");
        if (!ended) lines_.refuse("the end of the file within the section ENTITIES", "ENDSEC before it");
        return std::move(found_);
    }

  private:
    bool next() {
        const auto code = lines_.next();
        if (!code) {
            at_end_ = true;
            return false;
        }
        const auto [end, error] = std::from_chars(code->data(), code->data() + code->size(), code_);
        if (error != std::errc{} || end != code->data() + code->size())
            lines_.refuse(fmt::format("'{:.40}'", *code), "a group code, a whole number");
        const auto value = lines_.next();
        if (!value) lines_.refuse("the end of the file behind a group code", "its value");
        value_ = *value;
        return true;
    }

    /// One entity, whose name has been read, with all its groups: behind it the name of the next one has been read.
    /// @return false at the end of the file
    bool entity() {
        const std::string kind(value_);
        const int line = lines_.line();
        std::string on_layer = "0";
        std::vector<Vec2> points;
        Vec2 first, second;
        bool closed = false, bulged = false;
        while (next() && code_ != 0) {
            const bool coordinate = (code_ >= 10 && code_ <= 11) || (code_ >= 20 && code_ <= 21);
            const double number = coordinate || code_ == 42 ? lines_.number(value_, "a coordinate") : 0.0;
            if (code_ == 8) on_layer = value_;
            if (code_ == 10) {
                first.x = number;
                if (kind == "LWPOLYLINE") points.push_back({number, 0.0});
            }
            if (code_ == 20) {
                first.y = number;
                if (kind == "LWPOLYLINE" && !points.empty()) points.back().y = number;
            }
            if (code_ == 11) second.x = number;
            if (code_ == 21) second.y = number;
            if (code_ == 42 && number != 0.0) bulged = true;
            if (code_ == 70 && !value_.empty()) closed = (value_.back() - '0') % 2 != 0;
        }
        if (at_end_) return false;
        const bool wanted = layer_.empty() || on_layer == layer_;
        if (kind == "POLYLINE") {
            bulged = false;
            while (code_ == 0 && value_ == "VERTEX") {
                Vec2 place;
                while (next() && code_ != 0) {
                    if (code_ == 10) place.x = lines_.number(value_, "x");
                    if (code_ == 20) place.y = lines_.number(value_, "y");
                    if (code_ == 42 && lines_.number(value_, "a bulge") != 0.0) bulged = true;
                }
                if (at_end_) return false;
                points.push_back(place);
            }
            if (value_ != "SEQEND") lines_.refuse(fmt::format("{:.40} in a POLYLINE", value_), "VERTEX or SEQEND");
            while (next() && code_ != 0) {
            }
            if (at_end_) return false;
        } else if (kind == "LINE") {
            points = {first, second};
        } else if (kind != "LWPOLYLINE" && wanted) {
            throw InputError(
                fmt::format("{}:{}: found {:.40} on layer {:.40}, expected LINE, POLYLINE or LWPOLYLINE; "
                            "explode it into lines, or name the layer of the traces (layer)",
                            lines_.name(), line, kind, on_layer));
        } else if (kind != "LWPOLYLINE") {
            return true;
        }
        if (!wanted) return true;
        if (bulged)
            throw InputError(fmt::format("{}:{}: found a {} with arcs, expected straight parts; explode it into lines",
                                         lines_.name(), line, kind));
        if (closed && points.size() > 2) points.push_back(points.front());
        found_.add(std::move(points), line);
        return true;
    }

    Lines lines_;
    const std::string& layer_;
    int code_ = -1;
    std::string_view value_;
    bool section_ = false, at_end_ = false;
    Found found_;
};

std::string ending(const std::string& name) {
    std::string text = std::filesystem::path(name).extension().string();
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

}  // namespace

TracePoints parse_traces(const std::string& name, std::string_view text, const std::string& layer, TraceRows* rows) {
    const std::string kind = ending(name);
    if (kind != ".dxf" && !layer.empty())
        throw InputError(
            fmt::format("{}: found layer = \"{:.40}\", expected none; only a DXF file has layers", name, layer));
    Lines lines(name, text);
    Found found = kind == ".csv"   ? CsvTraces(std::move(lines)).read()
                  : kind == ".dxf" ? DxfTraces(std::move(lines), layer).read()
                                   : parse_table(std::move(lines));
    if (found.traces.empty() && !found.rows.without_length.empty())
        throw InputError(
            fmt::format("{}:{}: found a trace of one place and none with a length, expected a trace of two "
                        "places or more; correct its points",
                        name, found.rows.without_length.front()));
    if (found.traces.empty())
        throw InputError(fmt::format("{}: found no trace{}, expected one at least", name,
                                     layer.empty() ? "" : fmt::format(" on layer {:.40}", layer)));
    if (rows != nullptr) *rows = std::move(found.rows);
    return std::move(found.traces);
}

TracePoints read_traces(const std::filesystem::path& path, const std::string& layer, TraceRows* rows) {
    if (!is_file(path))
        throw InputError(
            fmt::format("found no file {:.200}, expected a file of traces; check the path", path.string()));
    return parse_traces(path.string(), read_text(path), layer, rows);
}

std::string traces_text(const TracePoints& traces) {
    std::string text;
    for (const std::vector<Vec2>& points : traces) {
        for (std::size_t k = 0; k < points.size(); ++k)
            text += fmt::format("{}{} {}", k == 0 ? "" : " ", points[k].x, points[k].y);
        text += '\n';
    }
    return text;
}

}  // namespace crackle
