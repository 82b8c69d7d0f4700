// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/test_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/table_reader.hpp"
#include "specimens/recordings/replacement.hpp"
#include "specimens/recordings/stated_files.hpp"

namespace crackle {
namespace {

using Json = nlohmann::ordered_json;

std::string read_result(const std::filesystem::path& file) {
    if (!is_file(file)) {
        throw InputError(
            fmt::format("{}: file not found, expected the results of a finished test; make them with "
                        "`crackle test CASE.toml -o {}`",
                        file.string(), file.parent_path().string()));
    }
    return read_file(file);
}

constexpr const char* test_again = "write the results again with `crackle test --force`";

void require_columns(const std::filesystem::path& file, const NumberTable& table, const std::vector<const char*>& names,
                     const char* again = test_again) {
    for (const char* name : names) {
        if (!table.find(name))
            throw InputError(fmt::format("{}:1: found no column '{}'; {}", file.string(), name, again));
    }
}

void require_whole_numbers(const std::filesystem::path& file, const NumberTable& table,
                           const std::vector<const char*>& names, int names_line) {
    for (const char* name : names) {
        const std::vector<double>& values = *table.find(name);
        const auto wrong = std::find_if(values.begin(), values.end(), [](double value) {
            return !(std::abs(value) < 2e9 && value == std::round(value));
        });
        if (wrong != values.end()) {
            throw InputError(fmt::format("{}:{}: {}: found {}, expected a whole number", file.string(),
                                         wrong - values.begin() + 1 + names_line, name, *wrong));
        }
    }
}

constexpr int deepest_summary = 100;  // levels; it has three, and what walks through them does so by recursion

nlohmann::ordered_json read_summary(const std::filesystem::path& file) {
    Json summary;
    const auto bound_depth = [&](int depth, Json::parse_event_t /*event*/, Json& /*value*/) {
        if (depth <= deepest_summary) return true;
        throw InputError(
            fmt::format("{}: found more than {} brackets within each other, expected a test's summary; "
                        "write the results again with `crackle test --force`",
                        file.string(), deepest_summary));
    };
    try {
        const std::string text = read_result(file);
        summary = Json::parse(without_byte_order_mark(text), bound_depth);
    } catch (const nlohmann::json::parse_error& error) {
        throw InputError(
            fmt::format("{}: found broken JSON at byte {}; write the results again with `crackle test --force`",
                        file.string(), error.byte));
    } catch (const nlohmann::json::out_of_range&) {
        throw InputError(fmt::format(
            "{}: found a number beyond 1.8e308; write the results again with `crackle test --force`", file.string()));
    }
    const auto expect = [&](const char* key, bool right, const char* expected) {
        if (right) return;
        const std::string found = summary.is_object() && summary.contains(key) ? summary[key].dump() : "nothing";
        throw InputError(fmt::format("{}: {}: found {:.40}, expected {}", file.string(), key, found, expected));
    };
    const auto text = [&](const char* key) {
        return summary.is_object() && summary.contains(key) && summary[key].is_string()
                   ? summary[key].get<std::string>()
                   : std::string();
    };
    const std::string kind = text("kind");
    expect("kind", !kind.empty(), "a kind of test, as \"compression\"");
    expect("specimen", !text("specimen").empty(), "\"circles\", \"delaunay\" or \"voronoi\"");
    expect("failed", summary.contains("failed") && summary["failed"].is_boolean(), "true or false");
    expect("material_units", !summary.contains("material_units") || summary["material_units"].is_string(),
           "\"point\" or \"area\"");
    return summary;
}

}  // namespace

NumberTable number_table(const std::filesystem::path& file, std::string_view text, std::string_view word_column,
                         const std::vector<std::string>& words, int names_line) {
    TableReader reader(file.string(), without_byte_order_mark(text), TableReader::Form::table, names_line);
    reader.read_heading("the names of the columns");
    NumberTable table;
    table.names = reader.names();
    table.columns.resize(table.names.size());
    while (reader.next()) {
        for (std::size_t k = 0; k < table.names.size(); ++k) {
            const std::string_view found = reader.values()[k];
            if (!word_column.empty() && table.names[k] == word_column) {
                const auto word = std::find(words.begin(), words.end(), found);
                if (word == words.end()) {
                    throw InputError(fmt::format("{}:{}: {}: found '{:.40}', expected one of: {}", file.string(),
                                                 reader.line(), word_column, found, fmt::join(words, ", ")));
                }
                table.columns[k].push_back(static_cast<double>(word - words.begin()));
                continue;
            }
            // Not a number is what has no value, such as a strain without gauge; infinite is nothing.
            const std::optional<double> value = number_of(found);
            if (!value || std::isinf(*value))
                reader.refuse_number(found, fmt::format("a number or nan for {:.40}", table.names[k]));
            table.columns[k].push_back(*value);
        }
    }
    return table;
}

NumberTable break_table(const std::filesystem::path& file, std::string_view text,
                        const std::vector<const char*>& needed, const char* again, int names_line) {
    NumberTable breaks = number_table(file, text, "mode", {"tension", "shear"}, names_line);
    require_columns(file, breaks, needed, again);
    require_whole_numbers(file, breaks, {"body_i", "body_j", "last_of_interface"}, names_line);
    return breaks;
}

bool is_report_page(const std::filesystem::path& file) {
    if (!is_file(file)) return false;
    errno = 0;
    std::ifstream in(file);
    std::string first, second;
    const bool is_page = std::getline(in, first) && std::getline(in, second) && second == report_mark;
    if (!in.is_open()) throw InputError(fmt::format("{}: cannot be read ({})", file.string(), std::strerror(errno)));
    refuse_failed(in, file.string());
    return is_page;
}

const std::vector<double>* NumberTable::find(std::string_view name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

TestResults read_results(const std::filesystem::path& folder) {
    if (!std::filesystem::is_directory(folder)) {
        throw InputError(fmt::format(
            "{}: found no such folder, expected the results of a test; make them with `crackle test CASE.toml -o {}`",
            folder.string(), folder.string()));
    }
    refuse_half_replaced(folder);
    TestResults results;
    results.name = std::filesystem::weakly_canonical(folder).filename().string();
    results.summary = TestSummary(read_summary(folder / "summary.json"));
    const FileMarks stated = stated_files(results.summary, (folder / "summary.json").string());
    const auto read_stated = [&](const char* name) {
        std::string text = read_result(folder / name);
        require_as_stated(stated, folder / name, mark_of(text));
        return text;
    };
    const auto read_table = [&](const char* name, std::string_view word_column = {},
                                const std::vector<std::string>& words = {}) {
        return number_table(folder / name, read_stated(name), word_column, words);
    };
    results.curve = read_table("curve.csv");
    require_columns(folder / "curve.csv", results.curve, {"axial_strain", "axial_stress", "bonds_broken", "time"});
    results.events =
        break_table(folder / "events.csv", read_stated("events.csv"),
                    {"time", "axial_strain", "x", "y", "body_i", "body_j", "mode", "last_of_interface"}, test_again);
    const std::filesystem::path slips = folder / "slips.csv";
    if (is_there(slips) || states(stated, "slips.csv")) {
        results.slips = read_table("slips.csv");
        require_columns(slips, *results.slips, {"time", "axial_strain", "x", "y", "orientation"});
    }
    const std::filesystem::path emission = folder / "ae.csv";
    if (is_there(emission) || states(stated, "ae.csv")) {
        results.emission = read_table("ae.csv", "type", {"opening", "shear", "closing", "none"});
        require_columns(emission, *results.emission, {"time", "axial_strain", "x", "y", "moment_magnitude"});
    }
    return results;
}

}  // namespace crackle
