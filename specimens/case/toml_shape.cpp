// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/toml_shape.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

/// Goes through a text that is TOML, or up to where it is none: what it says behind that is not looked at by anybody.
class Walk {
  public:
    Walk(const std::string& name, std::string_view text) : name_(name), rest_(text) {}

    void check() {
        while (!rest_.empty()) {
            const char c = rest_.front();
            if (c == '"' || c == '\'') {
                pass_text(c);
                continue;
            }
            if (c == '#') {
                pass(std::min(rest_.find('\n'), rest_.size()));
                continue;
            }
            if ((static_cast<unsigned char>(c) & 0x80U) != 0) {
                throw InputError(
                    fmt::format("{}:{}: found a letter that is not ASCII outside of a text, expected keys and "
                                "values without; put it into quotes",
                                name_, line_));
            }
            if (c == '\n' && open_ == 0) levels_ = 0;
            if (c == '[' || c == '{') ++open_;
            if ((c == ']' || c == '}') && open_ > 0) --open_;
            if ((c == '.' || c == '[' || c == '{') && ++levels_ > deepest_toml_entry) {
                throw InputError(fmt::format(
                    "{}:{}: found more than {} dots and brackets in one entry, expected at most two levels: tables in "
                    "[brackets], then key = value",
                    name_, line_, deepest_toml_entry));
            }
            pass(1);
        }
    }

  private:
    void pass(std::size_t count) {
        line_ += static_cast<int>(std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
        rest_.remove_prefix(count);
    }

    /// A text in quotes, or in three of them over several lines.
    void pass_text(char quote) {
        const std::string three(3, quote);
        const bool several = rest_.starts_with(three);
        pass(several ? 3 : 1);
        while (!rest_.empty()) {
            if (quote == '"' && rest_.front() == '\\') {
                pass(std::min<std::size_t>(2, rest_.size()));
            } else if (several ? rest_.starts_with(three) : rest_.front() == quote) {
                pass(several ? 3 : 1);
                while (several && rest_.starts_with(quote)) pass(1);  // up to two that belong to the text
                return;
            } else {
                if (!several && rest_.front() == '\n') return;  // not closed
                pass(1);
            }
        }
    }

    const std::string& name_;
    std::string_view rest_;
    int line_ = 1;
    int open_ = 0;    // brackets
    int levels_ = 0;  // of the entry so far
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
