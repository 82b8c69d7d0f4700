// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/test_summary.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace crackle {
namespace {

/// @return nullptr where there is nothing
const nlohmann::ordered_json* value_at(const nlohmann::ordered_json& table, std::string_view place) {
    const std::size_t dot = place.find('.');
    const auto found = table.find(std::string(place.substr(0, dot)));
    if (found == table.end()) return nullptr;
    return dot == std::string_view::npos ? &*found : value_at(*found, place.substr(dot + 1));
}

}  // namespace

TestSummary::TestSummary() : tree_(std::make_unique<nlohmann::ordered_json>()) {}
TestSummary::TestSummary(nlohmann::ordered_json tree)
    : tree_(std::make_unique<nlohmann::ordered_json>(std::move(tree))) {}
TestSummary::TestSummary(const TestSummary& other) : tree_(std::make_unique<nlohmann::ordered_json>(*other.tree_)) {}
TestSummary::TestSummary(TestSummary&& other) noexcept = default;
TestSummary& TestSummary::operator=(const TestSummary& other) { return *this = TestSummary(other); }
TestSummary& TestSummary::operator=(TestSummary&& other) noexcept = default;
TestSummary::~TestSummary() = default;

TestSummary TestSummary::parse(std::string_view text) {
    return TestSummary(nlohmann::ordered_json::parse(text, nullptr, false));
}

bool TestSummary::contains(std::string_view place) const { return value_at(*tree_, place) != nullptr; }

std::optional<double> TestSummary::number(std::string_view place) const {
    const nlohmann::ordered_json* value = value_at(*tree_, place);
    return value != nullptr && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
}

std::string TestSummary::word(std::string_view place) const {
    const nlohmann::ordered_json* value = value_at(*tree_, place);
    return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

bool TestSummary::flag(std::string_view place) const {
    const nlohmann::ordered_json* value = value_at(*tree_, place);
    return value != nullptr && value->is_boolean() && value->get<bool>();
}

std::string TestSummary::text_of(std::string_view place) const {
    const nlohmann::ordered_json* value = value_at(*tree_, place);
    return value == nullptr ? std::string() : value->dump();
}

std::string TestSummary::text(int indent) const { return tree_->dump(indent); }

}  // namespace crackle
