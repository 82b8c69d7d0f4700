// SPDX-License-Identifier: GPL-3.0-or-later
// plan.toml of a campaign, and the case.toml that it names. The plan has at most 200 tests, since each test reads a
// case again.

#include "specimens/campaign/plan_file.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::plan(std::string_view bytes) {
    const auto [text, test] = files_of<2>(bytes);
    write_file("case.toml", test);
    const Plan plan = read_plan(write_file("plan.toml", text), true, 200);
    if (!plan.rows.empty()) plan.test_of(plan.rows.back());
}
