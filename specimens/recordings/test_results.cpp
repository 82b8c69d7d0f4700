// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/test_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/table_reader.hpp"
#include "specimens/recordings/replacement.hpp"
#include "specimens/recordings/stated_files.hpp"
#include "specimens/summary/summary_file.hpp"

namespace crackle {
namespace {

std::string read_result(const std::filesystem::path& file) {
    if (!is_file(file)) {
        throw InputError(
            fmt::format("{}: file not found, expected the results of a finished test; make them with "
                        "`crackle test CASE.toml -o {}`",
                        file.string(), file.parent_path().string()));
    }
    return read_file(file, most_bytes_of_particles);
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
            // A missing value, such as the gauge strain if there are no particles to measure it, is written as nan. No
            // value is infinite.
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
    if (!in.is_open()) fail_reading(errno, fmt::format("{}: cannot be read ({})", file.string(), std::strerror(errno)));
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
    const std::filesystem::path summary = folder / "summary.json";
    results.summary = read_summary(summary.string(), read_result(summary));
    const FileMarks stated = stated_files(results.summary, summary.string());
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
