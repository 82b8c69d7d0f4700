// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/toml_shape.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

/// Scans a text up to its end, or up to the first position at which it is not valid TOML. The result does not depend on
/// anything after that position.
class Walk {
  public:
    Walk(const std::string& name, std::string_view text) : name_(name), rest_(text) {}

    void check() {
        while (!rest_.empty()) {
            const char c = rest_.front();
            if (c == '#') {
                pass(std::min(rest_.find('\n'), rest_.size()));
                continue;
            }
            refuse_beyond_ascii(c);
            if (c == '\n') misplaced_ = false;
            if (is_misplaced(c)) misplaced_ = true;
            if (c == '\n' && open_.empty()) levels_ = 0;
            if (c == '\n' || c == ',' || c == '{') assigned_ = false;
            if (c == '=') assigned_ = true;
            if (c == '[' || c == '{') open_ += c;
            if ((c == ']' || c == '}') && !open_.empty()) open_.pop_back();
            if ((c == '.' || c == '[' || c == '{') && ++levels_ > deepest_toml_entry) {
                refuse(fmt::format("more than {} dots and brackets in one entry", deepest_toml_entry),
                       "at most two levels: tables in [brackets], then key = value");
            }
            if (c != ' ' && c != '\t' && c != '\r') before_ = c;
            if (c == '"' || c == '\'') {
                pass_text(c);
            } else {
                pass(1);
            }
        }
    }

  private:
    [[noreturn]] void refuse(const std::string& found, const char* expected) const {
        throw InputError(fmt::format("{}:{}: found {}, expected {}", name_, line_, found, expected));
    }

    void refuse_beyond_ascii(char c) const {
        if ((static_cast<unsigned char>(c) & 0x80U) != 0)
            refuse("a non-ASCII letter outside quotes", "only ASCII letters outside quotes; put text in quotes");
    }

    /// A quotation mark or opening bracket must begin a key or a value, and a key has one value. Otherwise the parser
    /// would read the rest of the line as a number before it detects the error.
    bool is_misplaced(char c) const {
        const bool begins = c == '"' || c == '\'' || c == '[' || c == '{';
        if (begins) return std::string_view("\n=[,{").find(before_) == std::string_view::npos;
        return c == '=' && (assigned_ || (!open_.empty() && open_.back() == '['));
    }

    void pass(std::size_t count) {
        line_ += static_cast<int>(std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
        rest_.remove_prefix(count);
    }

    /// Skips a quoted string, or a multi-line string in triple quotes.
    void pass_text(char quote) {
        const std::string three(3, quote);
        const bool several = rest_.starts_with(three);
        pass(several ? 3 : 1);
        while (!rest_.empty()) {
            if (quote == '"' && rest_.front() == '\\') {
                if (misplaced_ && rest_.size() > 1) refuse_beyond_ascii(rest_[1]);
                pass(std::min<std::size_t>(2, rest_.size()));
            } else if (several ? rest_.starts_with(three) : rest_.front() == quote) {
                pass(several ? 3 : 1);
                while (several && rest_.starts_with(quote))
                    pass(1);  // up to two quotation marks at the end belong to the text
                return;
            } else {
                if (!several && rest_.front() == '\n') return;  // the string is not closed
                if (misplaced_) refuse_beyond_ascii(rest_.front());
                pass(1);
            }
        }
    }

    const std::string& name_;
    std::string_view rest_;
    char before_ = '\n';  // last character that is not white space
    int line_ = 1;
    std::string open_;        // brackets that are open
    bool assigned_ = false;   // whether the key's = has been read
    bool misplaced_ = false;  // whether something on this line is misplaced
    int levels_ = 0;          // bracket depth in the current entry
};

}  // namespace

void check_toml_shape(const std::string& name, std::string_view text) {
    int line = 0;
    for (std::string_view rest = text; !rest.empty();) {
        ++line;
        const std::size_t length = std::min(rest.find('\n'), rest.size());
        if (length > longest_toml_line) {
            throw InputError(fmt::format("{}:{}: found a line of {} bytes, expected at most {}; is this a case file?",
                                         name, line, length, longest_toml_line));
        }
        rest.remove_prefix(std::min(length + 1, rest.size()));
    }
    Walk(name, text).check();
}

}  // namespace crackle
