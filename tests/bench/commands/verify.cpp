// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle-bench verify`: checks verification claims and writes them with their results as a page.
// Tested by tests/bench_tests/commands/bench_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/files/replace_file.hpp"
#include "tests/bench/commands/bench.hpp"
#include "tests/bench/verify/page.hpp"
#include "tools/command_line/command_line.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;
using verification::CheckedClaim;
using verification::Claim;

std::vector<Claim> chosen_claims(const std::vector<std::string>& only) {
    if (only.empty()) return verification::claims();
    std::vector<Claim> some;
    for (const Claim& claim : verification::claims()) {
        if (std::find(only.begin(), only.end(), claim.name) != only.end()) some.push_back(claim);
    }
    for (const std::string& name : only) {
        if (std::none_of(some.begin(), some.end(), [&](const Claim& claim) { return claim.name == name; })) {
            throw InputError(fmt::format(
                "crackle-bench verify: found no claim '{}', expected one that crackle-bench verify --list names",
                name));
        }
    }
    return some;
}

/// Refuses a page that cannot be written before the claims are checked, which takes minutes.
void check_writable(const fs::path& page) {
    const fs::path folder = page.has_parent_path() ? page.parent_path() : fs::path(".");
    if (!fs::is_directory(folder) || fs::is_directory(page)) {
        throw InputError(fmt::format("{}: cannot be written, expected a file in a folder that exists", page.string()));
    }
}

/// One line per claim, and each row that fails. Failed rows are printed even with -q, since they are the result.
void report(Messages& messages, const CheckedClaim& checked) {
    const bool fails = checked.fails();
    messages.stage(fmt::format("{:<50} {}", checked.claim.name,
                               !checked.claim.offered ? "not offered"
                               : fails                ? "FAILS"
                                                      : fmt::format("holds, {} rows", checked.rows.size())));
    messages.make_room();
    for (const verification::ClaimRow& row : checked.rows) {
        const std::string text =
            fmt::format("  {}: expected {:.8g}, got {:.8g}, error {:.2g}, tolerance {:.2g}{}", row.label, row.expected,
                        row.got, row.error, row.tolerance,
                        row.order ? fmt::format(", order {:.2f}, expected {:g}", *row.order, *row.expected_order) : "");
        if (fails && !row.holds) {
            fmt::print(stderr, "{}\n", text);
        } else {
            messages.detail(text);
        }
    }
}

}  // namespace

CommandLine describe_bench_verify() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("FILE"),
                          "file for the page (Markdown); default: print it")                                    //
        ("only", po::value<Arguments>()->value_name("CLAIM"), "check this claim; may be given more than once")  //
        ("list", "list the names of all claims");
    Choices names{"only", {}};
    for (const Claim& claim : verification::claims()) names.words.push_back(claim.name);
    return {.synopses = {"crackle-bench verify [OPTIONS]"},
            .description =
                "Compares the engine with closed forms and laws. Prints each claim with expected value, result, error, "
                "tolerance, observed order and verdict.",
            .options = {{"options", options}},
            .choices = {names},
            .verbose = "each row of a claim",
            .examples = {{"crackle-bench verify -o verification.md"},
                         {"crackle-bench verify --only disc_on_a_slope --only bonded_chain_hangs_as_a_catenary"},
                         {"crackle-bench verify --list"}},
            .notes = {"exit codes: 0 all rows hold, 1 a row fails, 2 bad input"}};
}

int bench_verify(const Invocation& invocation) {
    const po::variables_map& given = invocation.values;
    Messages& messages = invocation.messages;
    if (given.contains("list")) {
        for (const Claim& claim : verification::claims()) std::cout << claim.name << '\n';
        return exit_done;
    }
    const auto only =
        given.contains("only") ? given["only"].as<std::vector<std::string>>() : std::vector<std::string>{};
    const std::vector<Claim> wanted = chosen_claims(only);
    const fs::path page = given.contains("output") ? given["output"].as<std::string>() : "";
    if (!page.empty()) check_writable(page);

    std::vector<CheckedClaim> checked;
    bool fails = false;
    messages.progress().begin("", static_cast<double>(wanted.size()), "claims");
    for (const Claim& claim : wanted) {
        messages.progress().step(static_cast<double>(checked.size()), claim.name);
        checked.push_back({claim, verification::check_claim(claim)});
        fails = fails || checked.back().fails();
        report(messages, checked.back());
    }
    std::string command = "crackle-bench verify";
    if (!page.empty()) command += " -o " + page.filename().string();
    for (const std::string& name : only) command += " --only " + name;
    const std::string text = verification_page(checked, command);
    if (page.empty()) {
        std::cout << text;
    } else {
        replace_file(page, text);
    }
    return fails ? exit_claim_fails : exit_done;
}

}  // namespace crackle::tools
