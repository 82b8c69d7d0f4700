// SPDX-License-Identifier: GPL-3.0-or-later
// Compliance of a case's jointed specimen beside that of the same mesh with its traces welded, and of what persistent
// traces add to that by Amadei and Goodman (compliance.hpp), each by its own direction and length.
// Tested by tests/specimens/elastic/jointed_compliance_test.cpp.
#pragma once

#include <optional>
#include <string>

#include "specimens/case/case_file.hpp"
#include "specimens/elastic/compliance.hpp"
#include "specimens/making/hooks.hpp"

namespace crackle {

struct JointedCompliance {
    Compliance jointed{}, welded{};
    std::optional<Compliance> expected;  ///< welded, and what persistent traces add; of no others
    std::string why_not;                 ///< it is not
};

/// Makes the specimen, bonds it without platens and solves. @return nothing of a case without joints, or whose cells do
/// not fill a box  @throws InputError where there is no linear solution; TestInterrupted
std::optional<JointedCompliance> jointed_compliance(const TestCase& test, const TestHooks& hooks);

}  // namespace crackle
