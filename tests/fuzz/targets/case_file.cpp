// SPDX-License-Identifier: GPL-3.0-or-later
// case.toml, and a file other.toml that it may include. The case that was read is written as a resolved case.

#include "specimens/case/case_file.hpp"

#include <sstream>

#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::case_file(std::string_view bytes) {
    const auto [text, other] = files_of<2>(bytes);
    write_file("other.toml", other);
    const ResolvedCase test = read_case(write_file("case.toml", text));
    std::ostringstream out;
    write_resolved_case(out, test, scratch());
}
