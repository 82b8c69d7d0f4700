// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace crackle::verification {

double observed_order(const Convergence& errors) {
    return std::log(errors.coarse / errors.fine) / std::log(errors.refinement);
}

Rows& Rows::add(ClaimRow row) {
    rows_.push_back(std::move(row));
    return *this;
}

// Comparisons are written such that NaN fails.
Rows& Rows::relative(const std::string& label, double got, double expected, double tolerance,
                     const std::string& estimate) {
    const double error = std::abs(got - expected) / std::abs(expected);
    add({label, Relation::equal, expected, got, error, tolerance, estimate, {}, {}, error <= tolerance});
    rows_.back().relative_error = true;
    return *this;
}

Rows& Rows::absolute(const std::string& label, double got, double expected, double tolerance,
                     const std::string& estimate) {
    const double error = std::abs(got - expected);
    return add({label, Relation::equal, expected, got, error, tolerance, estimate, {}, {}, error <= tolerance});
}

Rows& Rows::at_most(const std::string& label, double got, double limit, const std::string& estimate) {
    return add({label, Relation::at_most, limit, got, std::max(0.0, got - limit), 0.0, estimate, {}, {}, got <= limit});
}

Rows& Rows::at_least(const std::string& label, double got, double limit, const std::string& estimate) {
    return add(
        {label, Relation::at_least, limit, got, std::max(0.0, limit - got), 0.0, estimate, {}, {}, got >= limit});
}

Rows& Rows::exactly(const std::string& label, double got, double expected) {
    return absolute(label, got, expected, 0.0, "exact");
}

Rows& Rows::shown(const std::string& label, double got) {
    ClaimRow row;
    row.label = label, row.got = got, row.holds = row.shown_only = true;
    return add(std::move(row));
}

Rows& Rows::unoffered(const std::string& label, double expected) {
    ClaimRow row;
    row.label = label, row.expected = expected;
    return add(std::move(row));
}

Rows& Rows::converging(const Convergence& errors) {
    ClaimRow& row = rows_.back();
    row.order = observed_order(errors);
    row.expected_order = errors.expected_order;
    row.holds = row.holds && *row.order >= errors.expected_order - order_slack;
    return *this;
}

}  // namespace crackle::verification
