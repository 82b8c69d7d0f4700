// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the compliance of a case's jointed specimen with that of the same mesh with welded traces. The expected
// difference is the compliance that persistent traces add according to Amadei and Goodman (compliance.hpp); each trace
// has its own direction and length.
// Tested by tests/specimens/elastic/jointed_compliance_test.cpp.
#pragma once

#include <optional>
#include <string>

#include "specimens/elastic/compliance.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// Compliance of a specimen with joints, without joints, and as theory predicts it.
struct JointedCompliance {
    Compliance jointed{}, welded{};
    /// Compliance of the welded specimen plus that of persistent traces; empty if the traces are not persistent.
    std::optional<Compliance> expected;
    std::string why_not;  ///< reason why there is no expected compliance
};

/// Makes the specimen, bonds it without platens and solves for both compliances.
/// @return empty if the case has no joints, or if its cells do not fill a box
/// @throws InputError if there is no linear solution; TestInterrupted
std::optional<JointedCompliance> jointed_compliance(const ResolvedCase& test, const TestHooks& hooks);

}  // namespace crackle
