// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/bench/verify/rows.hpp"

namespace crackle::verification {
namespace {

std::string number(double value, int digits) {
    return std::isnan(value) ? std::string("–") : fmt::format("{:.{}g}", value, digits);
}

/// Text escaped for a cell of a Markdown table.
std::string cell(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '|') safe += '\\';
        safe += c;
    }
    return safe;
}

std::string expected_of(const ClaimRow& row) {
    const char* relation = row.relation == Relation::equal ? "" : row.relation == Relation::at_most ? "≤ " : "≥ ";
    return relation + number(row.expected, 8);
}

std::string order_of(const ClaimRow& row) {
    return row.order ? fmt::format("{:.2f} ({:g})", *row.order, *row.expected_order) : std::string("–");
}

std::string tolerance_of(const ClaimRow& row) {
    if (row.estimate.empty()) return "–";
    if (row.relation != Relation::equal || row.tolerance == 0.0) return row.estimate;
    return fmt::format("{} ({})", number(row.tolerance, 2), row.estimate);
}

std::string verdict_of_all(const CheckedClaim& checked) {
    if (!checked.claim.offered) return "not offered";
    return checked.fails() ? "FAILS" : "holds";
}

std::string error_of(const ClaimRow& row) { return number(row.error, 2) + (row.relative_error ? " rel." : ""); }

std::string row_line(const Claim& claim, const ClaimRow& row) {
    return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", cell(row.label), expected_of(row), number(row.got, 8),
                       error_of(row), cell(tolerance_of(row)), order_of(row), verdict_of(claim, row));
}

std::string overview(const std::vector<CheckedClaim>& checked) {
    std::string text = "| claim | rows | largest error / tolerance | verdict |\n| --- | --- | --- | --- |\n";
    for (const CheckedClaim& one : checked) {
        text += fmt::format("| [{0}](#{0}) | {1} | {2} | {3} |\n", one.claim.name, one.rows.size(),
                            number(one.share_of_tolerance(), 2), verdict_of_all(one));
    }
    return text;
}

std::string section(const CheckedClaim& one) {
    std::string text = fmt::format("### {}\n\n{}.\n\n", one.claim.name, one.claim.statement);
    text += "| row | expected | got | error | tolerance | order (expected) | verdict |\n";
    text += "| --- | --- | --- | --- | --- | --- | --- |\n";
    for (const ClaimRow& row : one.rows) text += row_line(one.claim, row);
    if (!one.claim.note.empty()) text += fmt::format("\n{}\n", one.claim.note);
    return text + "\n";
}

}  // namespace

bool CheckedClaim::fails() const {
    return claim.offered &&
           (rows.empty() || !std::all_of(rows.begin(), rows.end(), [](const ClaimRow& row) { return row.holds; }));
}

double CheckedClaim::share_of_tolerance() const {
    double worst = std::numeric_limits<double>::quiet_NaN();
    for (const ClaimRow& row : rows) {
        if (row.tolerance > 0.0) worst = std::fmax(worst, row.error / row.tolerance);
    }
    return worst;
}

std::string verification_page(const std::vector<CheckedClaim>& checked, const std::string& command) {
    std::size_t held = 0, failed = 0, shown = 0, unoffered = 0;
    for (const CheckedClaim& one : checked) {
        for (const ClaimRow& row : one.rows) {
            std::size_t& count = !one.claim.offered ? unoffered : row.shown_only ? shown : row.holds ? held : failed;
            ++count;
        }
    }
    std::string text = fmt::format(
        "# Verification\n\nMade by `{}`; the same rows are tests (`ctest -R ClaimTest`). {} claims; {} rows hold, {} "
        "fail, {} are only reported, {} belong to options that the engine does not offer.\n\n"
        "Errors are absolute unless marked «rel.»; error and tolerance are then relative to the expected value. Each "
        "tolerance names its source: «reference» is the requirement of the table of closed forms, «exact» means "
        "equality. The order of convergence is measured by reducing the time step; a row holds only if the order is "
        "below the expected one by at most {}. The last digits of errors at rounding level depend on the machine.\n\n",
        command, checked.size(), held, failed, shown, unoffered, order_slack);
    text += overview(checked);
    std::string group;
    for (const CheckedClaim& one : checked) {
        if (one.claim.group != group) text += fmt::format("\n## {}\n\n", group = one.claim.group);
        text += section(one);
    }
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
}

}  // namespace crackle::verification
