// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/identity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "solver/base/version.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/results/sha256.hpp"

namespace crackle {
namespace {

// Keys of a case that affect no result.
constexpr std::array<std::string_view, 6> without_figures{"title",         "numerics.threads",
                                                          "output.frames", "output.frame_precision",
                                                          "output.slips",  "output.checkpoint_interval"};

std::string text_of(const ResolvedKey& key, FileHashes& files) {
    if (!key.file.empty()) return files.of(key.file);
    return std::visit(
        [](const auto& value) {
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::array<std::string, 2>>)
                return fmt::format("{}\n{}", value[0], value[1]);
            else
                return fmt::format("{}", value);
        },
        key.value);
}

std::string hash_of(const std::string& text) {
    const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

/// Results version, then a line "KEY LENGTH VALUE" for each key that `wanted` accepts; LENGTH avoids ambiguity.
template <class Wanted>
std::string listed(const ResolvedCase& test, FileHashes& files, const Wanted& wanted) {
    std::string text = fmt::format("results {}\n", results_version);
    for (const ResolvedKey& key : resolved_keys(test)) {
        if (!wanted(key)) continue;
        const std::string value = text_of(key, files);
        text += fmt::format("{} {} {}\n", key.label, value.size(), value);
    }
    return text;
}

bool states_material(const ResolvedCase& test) {
    const parts::MaterialValues& m = test.material;
    return m.density && m.normal_stiffness && m.shear_stiffness && m.friction_angle &&
           (m.damping_ratio || (m.normal_damping && m.shear_damping));
}

}  // namespace

const std::string& FileHashes::of(const std::filesystem::path& file) {
    auto known = known_.find(file);
    if (known == known_.end()) known = known_.emplace(file, sha256(read_file(file))).first;
    return known->second;
}

std::string identity_of(const ResolvedCase& test, FileHashes& files) {
    const auto counts = [](const ResolvedKey& key) {
        return std::find(without_figures.begin(), without_figures.end(), key.label) == without_figures.end();
    };
    return hash_of(listed(test, files, counts) +
                   fmt::format("damping {} step {}\n", test.damping_scale, test.step_scale));
}

bool differs_within_a_rock(const std::string& key) {
    constexpr std::array<std::string_view, 6> keys{"title",         "packing.seed", "bond.strength_seed",
                                                   "minerals.seed", "joints.seed",  "numerics.threads"};
    constexpr std::array<std::string_view, 3> tables{"confinement.", "loading.", "output."};
    return std::ranges::find(keys, key) != keys.end() ||
           std::ranges::any_of(tables, [&](std::string_view table) { return key.starts_with(table); });
}

std::map<std::string, std::string> keys_of_rock(const ResolvedCase& test, FileHashes& files) {
    std::map<std::string, std::string> keys;
    for (const ResolvedKey& key : resolved_keys(test)) {
        if (differs_within_a_rock(key.label)) continue;
        if (key.label == "particles.file" && states_material(test)) continue;
        keys[key.label] = text_of(key, files);
    }
    return keys;
}

std::string packing_identity(const ResolvedCase& test, FileHashes& files) {
    const parts::Packing* packing = test.packing();
    const bool for_cells = packing != nullptr && std::holds_alternative<parts::CellDiameters>(packing->sizes);
    return hash_of(listed(test, files, [&](const ResolvedKey& key) {
        return key.label.starts_with("packing.") || (for_cells && key.label.starts_with("mesh."));
    }));
}

std::string rows_mark(const Plan& plan, const std::vector<std::string>& identities) {
    std::string text;
    for (std::size_t k = 0; k < identities.size(); ++k)
        text += fmt::format("{} {} {} {}\n", plan.rows[k].point, plan.rows[k].seed, name_of(plan.rows[k].variant),
                            identities[k]);
    const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string rocks_text(const Plan& plan) {
    nlohmann::ordered_json rocks = nlohmann::ordered_json::object();
    FileHashes files;
    for (std::size_t k = 0; k < plan.points.size(); ++k) {
        const PlanPoint& point = plan.points[k];
        const std::string& name = plan.tests[point.test].name;
        if (rocks.contains(name)) continue;
        std::map<std::string, std::string> keys =
            keys_of_rock(plan.test_of({k, point.own_seed, Variant::as_asked}), files);
        for (const CaseSetting& setting : point.settings) keys.erase(setting.key);
        rocks[name] = keys;
    }
    return rocks.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace crackle
