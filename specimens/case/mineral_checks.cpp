// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/mineral_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "solver/base/errors.hpp"
#include "specimens/case/parameters.hpp"

namespace crackle {
namespace {

class MineralCheck {
  public:
    explicit MineralCheck(const TestCase& test) : test_(test) {}

    void run() const {
        if (test_.mineral.empty()) {
            for (const char* table : {"minerals", "mineral_pair"}) {
                if (test_.has_table(table))
                    refuse(table == std::string("minerals") ? table : "mineral_pair[1]", "no [[mineral]]",
                           "one table per mineral", "add them, or remove this table");
            }
            return;
        }
        names();
        shares();
        files();
        damping();
        pairs();
    }

  private:
    [[noreturn]] void refuse(const std::string& key, const std::string& found, const std::string& expected,
                             const std::string& remedy) const {
        throw InputError(fmt::format("{}: found {}, expected {}; {}", test_.at(key), found, expected, remedy));
    }
    static std::string key_of(std::size_t mineral, const char* key) {
        return fmt::format("mineral[{}].{}", mineral + 1, key);
    }
    std::vector<std::string> all_names() const {
        std::vector<std::string> all;
        all.reserve(test_.mineral.size());
        for (const TestCase::Mineral& m : test_.mineral) all.push_back(m.name);
        return all;
    }

    void names() const {
        std::set<std::string> taken;
        for (std::size_t k = 0; k < test_.mineral.size(); ++k) {
            const std::string& name = test_.mineral[k].name;
            const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
            if (std::all_of(name.begin(), name.end(), is_digit))
                refuse(key_of(k, "name"), name.empty() ? "an empty text" : fmt::format("\"{:.40}\"", name),
                       "a name that is not a number",
                       "a whole number in a file of labels is the position of a mineral in the list");
            if (!taken.insert(name).second)
                refuse(key_of(k, "name"), fmt::format("\"{:.40}\" a second time", name), "a unique name", "rename one");
        }
    }

    void shares() const {
        double sum = 0.0;
        std::size_t open = 0;
        for (std::size_t k = 0; k < test_.mineral.size(); ++k) {
            const auto& share = test_.mineral[k].area_share;
            if (!share) {
                ++open;
                continue;
            }
            sum += *share;
            if (sum > 1.0 + share_rounding)
                refuse(key_of(k, "area_share"), fmt::format("{}, which makes a sum of {:g}", *share, sum),
                       "a sum of at most 1", "lower a share");
        }
        if (test_.minerals.assign != MineralAssignment::random && test_.minerals.assign != MineralAssignment::size)
            return;  // area fractions follow from the labels or the image
        if (open > 1) {
            refuse("mineral[1]", fmt::format("{} minerals without area_share", open), "at most one",
                   "give the other minerals an area_share");
        }
        if (open == 1 && sum >= 1.0 - share_rounding)
            refuse("mineral[1]", "a mineral without area_share although the others fill the specimen",
                   "shares that leave some area for this mineral", "lower a share, or remove it");
        if (open == 0 && sum < 1.0 - share_rounding)
            refuse("mineral[1]", fmt::format("shares with a sum of {:g}", sum), "a sum of 1",
                   "raise a share, or omit the share of one mineral, which then gets the remaining area");
    }

    void files() const {
        const MineralAssignment assign = test_.minerals.assign;
        for (const MineralAssignment file : {MineralAssignment::labels, MineralAssignment::image}) {
            const char* key = name_of(file);
            const std::string name = std::string("minerals.") + key;
            const bool written = test_.position.contains(name);
            if (written && assign != file) throw key_needs(test_, name, fmt::format("assign = \"{}\"", key));
            if (!written && assign == file)
                refuse(name, "nothing", "a file name in quotes", fmt::format("assign = \"{}\" needs this key", key));
        }
        std::map<std::uint32_t, std::string> taken;
        for (std::size_t k = 0; k < test_.mineral.size(); ++k) {
            const TestCase::Mineral& m = test_.mineral[k];
            if (!m.colour) {
                if (assign == MineralAssignment::image)
                    refuse(key_of(k, "colour"), "nothing", "\"#rrggbb\"", "assign = \"image\" needs this key");
                continue;
            }
            const auto colour = colour_of(*m.colour);
            if (!colour) {
                refuse(key_of(k, "colour"), fmt::format("\"{}\"", *m.colour),
                       "\"#rrggbb\" with two hexadecimal digits for each of red, green and blue", "correct it");
            }
            const auto [at, is_new] = taken.emplace(*colour, m.name);
            if (!is_new)
                refuse(key_of(k, "colour"), fmt::format("\"{}\", which {} has", *m.colour, at->second),
                       "a unique colour", "change one");
        }
    }

    /// Checks that [material] and minerals use the same kind of damping: either dashpots or damping ratios.
    void damping() const {
        const TestCase::MaterialKeys& rock = test_.material;
        const bool dashpots = rock.normal_damping || rock.shear_damping;
        for (std::size_t k = 0; k < test_.mineral.size(); ++k) {
            const TestCase::MaterialKeys& own = test_.mineral[k].own;
            if (own.damping_ratio && dashpots)
                refuse(key_of(k, "damping_ratio"),
                       "a damping ratio, which cannot be combined with the dashpots in [material]",
                       "the same kind of damping everywhere",
                       "give dashpots for the mineral, or damping_ratio in [material]");
            for (const bool normal : {true, false}) {
                if (!(normal ? own.normal_damping : own.shear_damping) || dashpots) continue;
                refuse(key_of(k, normal ? "normal_damping" : "shear_damping"),
                       "a dashpot, while [material] has no dashpots", "the same kind of damping everywhere",
                       "give damping_ratio for the mineral, or dashpots in [material]");
            }
        }
    }

    void pairs() const {
        const std::vector<std::string> names = all_names();
        std::map<std::array<std::string, 2>, std::size_t> taken;
        for (std::size_t k = 0; k < test_.mineral_pair.size(); ++k) {
            const std::string key = fmt::format("mineral_pair[{}]", k + 1);
            std::array<std::string, 2> between = test_.mineral_pair[k].between;
            for (const std::string& name : between) {
                if (std::find(names.begin(), names.end(), name) == names.end())
                    refuse(key + ".between", fmt::format("\"{:.40}\"", name),
                           fmt::format("names of minerals: {}", fmt::join(names, ", ")), "correct it");
            }
            std::sort(between.begin(), between.end());
            if (!taken.emplace(between, k).second)
                refuse(key + ".between", fmt::format("{} and {} a second time", between[0], between[1]),
                       "one table per pair", "merge the two tables");
            const auto& keys = mineral_pair_keys();
            const auto is_written = [&](const std::string& one) {
                return test_.position.contains(fmt::format("{}.{}", key, one));
            };
            if (std::none_of(keys.begin(), keys.end(), is_written))
                refuse(key, "only the names", fmt::format("at least one of {}", fmt::join(keys, ", ")),
                       "add one, or remove the table");
            if (test_.bond_facts().by_faces && is_written("stiffness_ratio"))
                refuse(key, "stiffness_ratio", "only strengths and friction with bond.law = \"face\"",
                       "the stiffness of a face follows from its two minerals");
            if (is_written("contact_modulus") != is_written("stiffness_ratio"))
                refuse(key, "only one of contact_modulus and stiffness_ratio", "both, or neither",
                       "together they replace the values of the two minerals");
        }
    }

    const TestCase& test_;
};

}  // namespace

std::optional<std::uint32_t> colour_of(const std::string& text) {
    const auto is_digit = [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; };
    if (text.size() != 7 || text[0] != '#' || !std::all_of(text.begin() + 1, text.end(), is_digit)) return {};
    return static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
}

void check_minerals(const TestCase& test) { MineralCheck(test).run(); }

}  // namespace crackle
