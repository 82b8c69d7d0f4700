// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

constexpr std::string_view blanks = " \t";

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    for (text = stripped(text); !text.empty(); text = stripped(text)) {
        const std::size_t end = std::min(text.find_first_of(blanks), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return words;
}

/// The line without its quoted parts.
std::string outside_quotes(std::string_view line) {
    std::string text;
    bool inside = false;
    for (const char c : line) {
        if (c == '"') inside = !inside;
        if (!inside) text += c;
    }
    return text;
}

/// Whether all commas of a line are decimal commas, as in "0,5 1,5".
bool has_only_decimal_commas(std::string_view line) {
    const std::vector<std::string_view> words = words_of(line);
    bool any = false;
    for (const std::string_view word : words) {
        if (word.find(',') == std::string_view::npos) continue;
        if (!has_decimal_comma(word)) return false;
        any = true;
    }
    return any && words.size() > 1;
}

/// Separator of the values in a line. Spreadsheets with decimal commas use semicolons, so a semicolon takes precedence
/// over a comma. In "a,\tb" the separator is the comma followed by a tab.
char separator_of(std::string_view line, TableReader::Form form) {
    if (form == TableReader::Form::words) return '\n';
    const std::string text = outside_quotes(line);
    if (text.find(';') != std::string::npos) return ';';
    const std::size_t comma = text.find(',');
    const bool commas = comma != std::string::npos && !has_only_decimal_commas(text);
    if (form == TableReader::Form::table && text.find('\t') != std::string::npos &&
        text.find(",\t") == std::string::npos)
        return '\t';
    return commas ? ',' : ' ';
}

const char* name_of_separator(char separator) {
    if (separator == ',') return "commas";
    if (separator == ';') return "semicolons";
    if (separator == '\n') return "lines";
    return separator == '\t' ? "tabs" : "blanks";
}

}  // namespace

TableReader::TableReader(std::string name, std::string_view text, Form form, int first_line)
    : lines_(std::move(name), text, first_line), form_(form) {}

void TableReader::read_heading(const std::string& expected) {
    if (!next_line()) lines_.refuse("no heading", expected);
    names_.assign(values_.begin(), values_.end());
}

std::optional<std::size_t> TableReader::column(std::string_view name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) return std::nullopt;
    if (std::find(found + 1, names_.end(), name) != names_.end())
        lines_.refuse(fmt::format("two columns named {:.40}", name), "only one; rename or remove the other");
    return static_cast<std::size_t>(found - names_.begin());
}

bool TableReader::next() {
    if (!next_line()) return false;
    if (!names_.empty()) require_as_many_as_names();
    return true;
}

void TableReader::require_as_many_as_names() {
    while (values_.size() > names_.size() && values_.back().empty()) values_.pop_back();
    if (values_.size() == names_.size()) return;
    std::string expected = fmt::format("{} as in the heading", names_.size());
    if (separator_ == ',' && values_.size() > names_.size())
        expected += "; a number with a decimal comma counts as two values: save the file with decimal points";
    lines_.refuse(fmt::format("{} value{} between {}", values_.size(), values_.size() == 1 ? "" : "s",
                              name_of_separator(separator_)),
                  expected);
}

/// Whether a line is a comment. In a table, a row may begin with a name such as #3. Therefore a space must follow the
/// #, or the number of values must differ from the number of columns.
bool TableReader::is_remark(std::string_view line) {
    if (!line.starts_with('#')) return false;
    if (names_.empty() || line.size() < 2 || blanks.find(line[1]) != std::string_view::npos) return true;
    split(line);
    return values_.size() != names_.size();
}

bool TableReader::next_line() {
    while (const std::optional<std::string_view> line = lines_.next()) {
        whole_ = stripped(*line);
        if (whole_.empty() || is_remark(whole_)) continue;
        const bool first = separator_ == '\0';
        if (first && whole_.size() == 5 &&
            whole_.starts_with("sep=")) {  // a spreadsheet's declaration of the separator
            separator_ = whole_.back();
            continue;
        }
        const std::string_view held = form_ == Form::list ? line->substr(0, line->find('#')) : *line;
        if (first) separator_ = separator_of(held, form_);
        split(held);
        if (names_.empty())
            while (!values_.empty() && values_.back().empty()) values_.pop_back();
        if (std::any_of(values_.begin(), values_.end(), [](std::string_view value) { return !value.empty(); }))
            return true;
    }
    return false;
}

/// Removes a quoted value and the spaces after it from the front of `rest`.
std::string_view TableReader::quoted(std::string_view& rest) {
    std::string value;
    for (std::size_t k = 1; k < rest.size(); ++k) {
        if (rest[k] != '"') {
            value += rest[k];
        } else if (k + 1 < rest.size() && rest[k + 1] == '"') {
            value += rest[k++];
        } else {
            rest = rest.substr(k + 1);
            unquoted_.push_back(std::string(stripped(value)));
            return unquoted_.back();
        }
    }
    lines_.refuse(fmt::format("a quote that is not closed: {:.40}", rest), "a closing quote on the same line");
}

void TableReader::split(std::string_view line) {
    values_.clear();
    unquoted_.clear();
    const bool by_blanks = separator_ == ' ';
    for (std::string_view rest = line;;) {
        // Leading white space to be skipped. Tabs are not skipped if they are the separator.
        const std::string_view passed_over = separator_ == '\t' ? " " : blanks;
        rest.remove_prefix(std::min(rest.find_first_not_of(passed_over), rest.size()));
        if (rest.starts_with('"')) {
            values_.push_back(quoted(rest));
            const std::size_t end =
                std::min(by_blanks ? rest.find_first_of(blanks) : rest.find(separator_), rest.size());
            if (!stripped(rest.substr(0, end)).empty())
                lines_.refuse(fmt::format("'{:.40}' after a value in quotes", rest.substr(0, end)),
                              fmt::format("nothing before the next separator; values are separated by {}",
                                          name_of_separator(separator_)));
            if (end == rest.size()) return;
            rest.remove_prefix(end + 1);
            continue;
        }
        const std::size_t end = std::min(by_blanks ? rest.find_first_of(blanks) : rest.find(separator_), rest.size());
        const std::string_view value = stripped(rest.substr(0, end));
        if (form_ == Form::list && !value.empty()) {  // in a list, "1,2 3,4" stands for four values
            const std::vector<std::string_view> words = words_of(value);
            values_.insert(values_.end(), words.begin(), words.end());
        } else if (!by_blanks || !value.empty()) {
            values_.push_back(value);
        }
        if (end == rest.size()) return;
        rest.remove_prefix(end + 1);
    }
}

double TableReader::number(std::size_t place, std::string_view what) const {
    const std::optional<double> value = number_of(values_[place]);
    if (!value || !std::isfinite(*value))
        lines_.refuse_number(values_[place], fmt::format("a number for {:.40}", what));
    return *value;
}

}  // namespace crackle
