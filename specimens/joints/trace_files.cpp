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
#include "solver/files/file_kind.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/table_reader.hpp"
#include "solver/files/text_lines.hpp"
#include "solver/scene/scene.hpp"
#include "specimens/statistics/spoken.hpp"

namespace crackle {
namespace {

double coordinate(std::string_view word, std::string_view what, const TextLines& lines) {
    const std::optional<double> value = number_of(word);
    if (!value || !is_a_size(*value))
        lines.refuse_number(word, fmt::format("a number for {} that is 0 or has a magnitude from 1e-30 to 1e30", what));
    return *value;
}

/// Traces, and the rows of the file where they begin.
struct Found {
    TracePoints traces;
    TraceRows rows;

    /// Adds a trace without repeated points. A trace of a single point is skipped; GIS intersection tools leave such
    /// rows behind.
    /// @param line  line where the trace begins
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

/// A line of a list file: the numbers of one trace.
struct ListedTrace {
    int line = 0;
    std::vector<double> numbers;
};

std::vector<Vec2> points_of(const ListedTrace& trace) {
    std::vector<Vec2> points;
    for (std::size_t k = 0; k + 1 < trace.numbers.size(); k += 2)
        points.push_back({trace.numbers[k], trace.numbers[k + 1]});
    return points;
}

/// Length of the polyline through the numbers of a list, with `each` numbers per point.
double path_length(const std::vector<double>& numbers, std::size_t each) {
    double length = 0.0;
    for (std::size_t k = each; k + each <= numbers.size(); k += each) {
        double square = 0.0;
        for (std::size_t c = 0; c < each; ++c) {
            const double step = numbers[k + c] - numbers[k + c - each];
            square += step * step;
        }
        length += std::sqrt(square);
    }
    return length;
}

/// Number of coordinates per point, from names such as "# x1 y1 z1 x2 y2 z2" in comments above the first trace; 0 if no
/// comment has names.
std::size_t named_coordinates(std::string_view text) {
    TextLines lines("", text);
    bool x = false, y = false, z = false;
    while (const auto line = lines.next()) {
        const std::string_view remark = stripped(*line);
        if (!remark.empty() && !remark.starts_with('#')) break;
        for (std::size_t k = 0; k < remark.size(); ++k) {
            const auto is_letter = [&](std::size_t at) {
                return at < remark.size() && std::isalpha(static_cast<unsigned char>(remark[at])) != 0;
            };
            if ((k > 0 && is_letter(k - 1)) || is_letter(k + 1)) continue;
            const int letter = std::tolower(static_cast<unsigned char>(remark[k]));
            x |= letter == 'x';
            y |= letter == 'y';
            z |= letter == 'z';
        }
    }
    if (!x || !y) return 0;
    return z ? 3 : 2;
}

/// Whether a list without coordinate names has a height after each x and y. If such triples are read as pairs, x, y
/// and height get mixed up, and the polyline becomes more than twice as long (a third longer if all heights are
/// equal). True pairs rarely look like this; surveys with heights are more common.
bool looks_like_heights(const std::vector<ListedTrace>& traces) {
    constexpr double leaping = 0.5, leaping_at_one_height = 0.75;
    double by_twos = 0.0, by_threes = 0.0;
    bool one_height = true;
    for (const ListedTrace& trace : traces) {
        by_twos += path_length(trace.numbers, 2);
        by_threes += path_length(trace.numbers, 3);
        for (std::size_t k = 2; k < trace.numbers.size(); k += 3)
            one_height = one_height && trace.numbers[k] == traces.front().numbers[2];
    }
    return by_threes < (one_height ? leaping_at_one_height : leaping) * by_twos;
}

Found parse_list(const std::string& name, std::string_view text) {
    TableReader reader(name, text, TableReader::Form::list);
    const std::size_t named = named_coordinates(text);
    std::vector<ListedTrace> listed;
    while (reader.next()) {
        ListedTrace trace{reader.line(), {}};
        for (const std::string_view word : reader.values())
            trace.numbers.push_back(coordinate(word, trace.numbers.size() % 2 == 0 ? "x" : "y", reader.lines()));
        listed.push_back(std::move(trace));
    }
    const bool by_threes = std::ranges::all_of(
        listed, [](const ListedTrace& t) { return t.numbers.size() >= 6 && t.numbers.size() % 3 == 0; });
    const bool stated = named == 3 && by_threes;
    for (const ListedTrace& trace : listed) {
        const std::size_t count = trace.numbers.size();
        if (stated || (count >= 4 && count % 2 == 0)) continue;
        throw InputError(fmt::format(
            "{}:{}: found {}, expected x and y of two points or more{}", name, trace.line, counted(count, "number"),
            count >= 6 && count % 3 == 0 ? "; if these are x y z, remove every third number" : ""));
    }
    if (!listed.empty() && (stated || (named == 0 && by_threes && looks_like_heights(listed)))) {
        throw InputError(fmt::format(
            "{}:{}: found x y z of each point, expected x y; remove every third number. If the numbers are x "
            "y, state this in a first line '# x1 y1 x2 y2'",
            name, listed.front().line));
    }
    Found found;
    for (const ListedTrace& trace : listed) found.add(points_of(trace), trace.line);
    return found;
}

class CsvTraces {
  public:
    CsvTraces(const std::string& name, std::string_view text) : reader_(name, text, TableReader::Form::table) {}

    Found read() {
        reader_.read_heading(expected_heading);
        const auto trace = reader_.column("trace"), x = reader_.column("x"), y = reader_.column("y");
        const std::vector<PointColumns> along = columns_along();
        const bool by_point = trace && x && y;
        const bool by_line = along.size() >= 2;
        if (by_point == by_line) reader_.refuse(fmt::format("'{:.60}'", reader_.whole_line()), expected_heading);
        while (reader_.next()) {
            if (by_line)
                found_.add(points_along(along), reader_.line());
            else
                point(reader_.values()[*trace], {number(*x, "x"), number(*y, "y")});
        }
        finish();
        return std::move(found_);
    }

  private:
    static constexpr const char* expected_heading = "a heading with the column names trace,x,y or x1,y1,x2,y2";

    struct PointColumns {
        std::size_t x = 0, y = 0;
    };
    /// Columns of the points of a trace in one row: x1,y1,x2,y2 and all further numbered pairs in the heading.
    std::vector<PointColumns> columns_along() const {
        std::vector<PointColumns> columns;
        while (true) {
            const std::string number = std::to_string(columns.size() + 1);
            const auto x = reader_.column("x" + number), y = reader_.column("y" + number);
            if (!x || !y) return columns;
            columns.push_back({*x, *y});
        }
    }
    /// Points in a row. Traces with fewer points leave the last cells empty.
    std::vector<Vec2> points_along(std::vector<PointColumns> columns) const {
        const auto& values = reader_.values();
        while (columns.size() > 2 && values[columns.back().x].empty() && values[columns.back().y].empty())
            columns.pop_back();
        std::vector<Vec2> points;
        points.reserve(columns.size());
        for (const auto& [x, y] : columns)
            points.push_back({number(x, reader_.names()[x]), number(y, reader_.names()[y])});
        return points;
    }

    double number(std::size_t column, std::string_view name) const {
        return coordinate(reader_.values()[column], name, reader_.lines());
    }

    void point(std::string_view trace, Vec2 place) {
        if (trace.empty()) reader_.refuse("no name of a trace", "the name or number of the trace");
        if (points_.empty() || trace != trace_) {
            finish();
            trace_ = trace;
            begun_ = reader_.line();
            // If a trace appears again after another trace, it was probably split by mistake. It is refused, because
            // it is not known whether these points continue the first part.
            if (!seen_.insert(trace_).second)
                reader_.refuse(fmt::format("points of trace {:.40} after those of another trace", trace),
                               "all points of a trace in consecutive rows");
        }
        points_.push_back(place);
    }
    void finish() {
        if (!points_.empty()) found_.add(std::move(points_), begun_);
        points_.clear();
    }

    TableReader reader_;
    std::unordered_set<std::string> seen_;
    std::string trace_;
    int begun_ = 0;
    std::vector<Vec2> points_;
    Found found_;
};

/// Reads group codes and their values on alternate lines (AutoCAD DXF Reference, "Drawing interchange file formats").
class DxfTraces {
  public:
    DxfTraces(TextLines lines, const std::string& layer) : lines_(std::move(lines)), layer_(layer) {}

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
        if (!entities) lines_.refuse("no ENTITIES section", "a DXF file of lines");
        if (!ended)
            lines_.refuse("the end of the file within the ENTITIES section", "ENDSEC before the end of the file");
        return std::move(found_);
    }

  private:
    bool next() {
        const auto line = lines_.next();
        if (!line) {
            at_end_ = true;
            return false;
        }
        const std::string_view code = stripped(*line);
        const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), code_);
        if (error != std::errc{} || end != code.data() + code.size())
            lines_.refuse(fmt::format("'{:.40}'", code), "a group code, which is a whole number");
        const auto value = lines_.next();
        if (!value) lines_.refuse("the end of the file after a group code", "the value that belongs to this code");
        value_ = stripped(*value);
        return true;
    }

    /// Reads the remaining groups of an entity, whose name has already been read, and the name of the next entity.
    /// @return false at the end of the file
    bool entity() {
        const std::string kind(value_);
        const int line = lines_.line();
        std::string on_layer = "0";
        std::vector<Vec2> points;
        Vec2 first, second;
        bool closed = false, bulged = false;
        while (next() && code_ != 0) {
            const bool is_coordinate = (code_ >= 10 && code_ <= 11) || (code_ >= 20 && code_ <= 21);
            const double number = is_coordinate || code_ == 42 ? coordinate(value_, "a coordinate", lines_) : 0.0;
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
                    if (code_ == 10) place.x = coordinate(value_, "x", lines_);
                    if (code_ == 20) place.y = coordinate(value_, "y", lines_);
                    if (code_ == 42 && coordinate(value_, "a bulge", lines_) != 0.0) bulged = true;
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

    TextLines lines_;
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

/// Whether the text begins like a DXF drawing; the name of the file does not matter.
bool begins_as_drawing(std::string_view text) {
    TextLines lines("", text);
    const auto code = lines.next(), value = lines.next();
    return code && value && stripped(*code) == "0" && stripped(*value) == "SECTION";
}

/// Whether the first line with values begins with a name, as in the header of a table.
bool begins_with_names(const std::string& name, std::string_view text) {
    TableReader reader(name, text, TableReader::Form::table);
    if (!reader.next()) return false;
    const std::string_view first = reader.values().front();
    return !first.empty() && std::isalpha(static_cast<unsigned char>(first.front())) != 0 && !number_of(first);
}

Found parse_by_kind(const std::string& name, std::string_view text, const std::string& layer) {
    const std::string kind = ending(name);
    if (kind == ".dxf" || begins_as_drawing(text)) return DxfTraces(TextLines(name, text), layer).read();
    if (!layer.empty())
        throw InputError(
            fmt::format("{}: found layer = \"{:.40}\", expected none; only a DXF file has layers", name, layer));
    if (kind == ".csv" || begins_with_names(name, text)) return CsvTraces(name, text).read();
    return parse_list(name, text);
}

}  // namespace

TracePoints parse_traces(const std::string& name, std::string_view text, const std::string& layer, TraceRows* rows) {
    refuse_foreign(name, text,
                   "CSV (trace,x,y or x1,y1,x2,y2), DXF, or x1 y1 x2 y2 ... with one trace per line; export the file "
                   "in one of these formats");
    Found found = parse_by_kind(name, text, layer);
    if (found.traces.empty() && !found.rows.without_length.empty())
        throw InputError(
            fmt::format("{}:{}: found only traces whose points coincide, expected a trace with two "
                        "or more different points; correct its points",
                        name, found.rows.without_length.front()));
    if (found.traces.empty())
        throw InputError(fmt::format("{}: found no trace{}, expected at least one", name,
                                     layer.empty() ? "" : fmt::format(" on layer {:.40}", layer)));
    if (rows != nullptr) *rows = std::move(found.rows);
    return std::move(found.traces);
}

TracePoints read_traces(const std::filesystem::path& path, const std::string& layer, TraceRows* rows) {
    if (!is_file(path))
        throw InputError(
            fmt::format("found no file {:.200}, expected a file of traces; check the path", path.string()));
    return parse_traces(path.string(), read_text(path, most_bytes_of_table), layer, rows);
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
