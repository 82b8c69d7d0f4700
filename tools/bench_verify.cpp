// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle bench verify`: checks every verification claim and writes them as a page.

#include <fmt/format.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "solver/errors.hpp"
#include "solver/replace_file.hpp"
#include "specimens/verification/page.hpp"
#include "tools/bench.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;
using verification::CheckedClaim;
using verification::Claim;

constexpr const char* verify_examples = R"(
examples:
  crackle bench verify -o verification.md
  crackle bench verify --only disc_on_a_slope --only catenary
  crackle bench verify --list

exit codes: 0 all rows hold, 1 a row fails, 2 bad input
)";

std::vector<Claim> chosen_claims(const std::vector<std::string>& only) {
    if (only.empty()) return verification::claims();
    std::vector<Claim> some;
    for (const Claim& claim : verification::claims()) {
        if (std::find(only.begin(), only.end(), claim.name) != only.end()) some.push_back(claim);
    }
    for (const std::string& name : only) {
        if (std::none_of(some.begin(), some.end(), [&](const Claim& claim) { return claim.name == name; })) {
            throw InputError(fmt::format(
                "bench verify: found no claim '{}', expected one that crackle bench verify --list names", name));
        }
    }
    return some;
}

/// Before minutes are spent on a page that cannot be written.
void check_writable(const fs::path& page) {
    const fs::path folder = page.has_parent_path() ? page.parent_path() : fs::path(".");
    if (!fs::is_directory(folder) || fs::is_directory(page)) {
        throw InputError(fmt::format("{}: cannot be written, expected a file in a folder that exists", page.string()));
    }
}

/// One line a claim, and each row that fails.
void tell(const CheckedClaim& checked) {
    const bool fails = checked.fails();
    fmt::print(stderr, "{:<50} {}\n", checked.claim.name,
               !checked.claim.offered ? "not offered"
               : fails                ? "FAILS"
                                      : fmt::format("holds, {} rows", checked.rows.size()));
    if (!fails) return;
    for (const verification::ClaimRow& row : checked.rows) {
        if (row.holds) continue;
        fmt::print(stderr, "  {}: expected {:.8g}, got {:.8g}, error {:.2g}, tolerance {:.2g}{}\n", row.label,
                   row.expected, row.got, row.error, row.tolerance,
                   row.order ? fmt::format(", order {:.2f}, expected {:g}", *row.order, *row.expected_order) : "");
    }
}

}  // namespace

int bench_verify(const Arguments& arguments) {
    po::options_description options("options");
    options.add_options()("help,h", "show this")("output,o", po::value<std::string>(),
                                                 "write the page there (Markdown); default: print it")(
        "only", po::value<std::vector<std::string>>(), "check this claim; may be given more than once")(
        "list", "name all claims, one a line");
    po::variables_map given;
    po::store(po::command_line_parser(arguments).options(options).positional({}).run(), given);
    po::notify(given);
    if (given.contains("help")) {
        std::cout << "usage: crackle bench verify [OPTIONS]\n\nChecks every closed form and law that the engine has to "
                     "meet and shows claim, expected, got, error, tolerance, observed order and verdict.\n\n"
                  << options << verify_examples;
        return exit_done;
    }
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
    for (const Claim& claim : wanted) {
        checked.push_back({claim, verification::check_claim(claim)});
        fails = fails || checked.back().fails();
        tell(checked.back());
    }
    std::string command = "crackle bench verify";
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
