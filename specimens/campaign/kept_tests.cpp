// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/kept_tests.hpp"

#include <fmt/format.h>

#include <cctype>
#include <string_view>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/files/file_mark.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/recordings/stated_files.hpp"
#include "specimens/results/sha256.hpp"
#include "specimens/summary/summary_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t identity_digits = 12, all_digits = 32;

/// Leading digits of a test's identity, taken from the name of its file in curves/ or its folder in tests/.
std::string digits_of(const std::string& name) {
    const std::size_t dash = name.rfind('-');
    if (dash != std::string::npos) return name.substr(dash + 1);
    return name.size() == all_digits ? name.substr(0, identity_digits) : "";
}

std::string name_of_kept(const fs::path& path) {
    return (path.extension() == ".csv" ? path.stem() : path.filename()).string();
}

/// Short form of a key for file names: "pressure" for "confinement.pressure", "mineral1.cohesion" for
/// "mineral[1].cohesion".
std::string short_key(const std::string& key) {
    if (key.find('[') == std::string::npos) return key.substr(key.rfind('.') + 1);
    std::string text = key;
    std::erase_if(text, [](char c) { return c == '[' || c == ']'; });
    return text;
}

/// Checks that a file has not changed since it was recorded.
/// @param text  contents of the file
/// @param recorded  recorded SHA-256
void require_recorded(const fs::path& file, std::string_view text, const std::string& recorded) {
    if (sha256(text) == recorded) return;
    throw InputError(fmt::format(
        "{}: found a file that has changed since its test wrote it, expected the hash in campaign.sqlite; run "
        "the command that made the ledger again, which repeats the test",
        file.string()));
}

}  // namespace

std::string kept_name(const Plan& plan, const PlanRow& row, const std::string& identity) {
    constexpr std::size_t longest = 80;  // largest number of characters for a point's settings
    std::string settings;
    for (const CaseSetting& setting : plan.points[row.point].settings)
        settings += fmt::format("-{}={}", short_key(setting.key), value_text(setting.value));
    if (settings.size() > longest) settings = fmt::format("-point{}", row.point + 1);
    std::string name = fmt::format("{}{}-packing{}", plan.kind_of(row).name, settings, row.seed);
    std::erase(name, '"');
    const auto plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               std::string_view("-_=.+").find(c) != std::string::npos;
    };
    for (char& c : name)
        if (!plain(c)) c = '_';
    return name + '-' + identity.substr(0, identity_digits);
}

KeptTests::KeptTests(const fs::path& folder, std::map<std::string, KeptHashes> hashes) : hashes_(std::move(hashes)) {
    const auto list = [](const fs::path& room, auto& entries) {
        for (const std::string& name : names_in(room)) {  // the folder is absent if nothing was kept
            const std::string digits = digits_of(name_of_kept(name));
            if (!digits.empty()) entries[digits] = room / name;
        }
    };
    list(folder / "curves", curves_);
    list(folder / "tests", folders_);
}

std::optional<std::string> KeptTests::name(const std::string& identity) const {
    for (const auto* entries : {&folders_, &curves_}) {
        const auto found = entries->find(identity.substr(0, identity_digits));
        if (found != entries->end()) return name_of_kept(found->second);
    }
    return std::nullopt;
}

std::optional<fs::path> KeptTests::curve(const std::string& identity) const {
    if (const auto alone = curves_.find(identity.substr(0, identity_digits)); alone != curves_.end())
        return alone->second;
    const std::optional<fs::path> all = folder(identity);
    return all && is_file(*all / "curve.csv") ? std::optional(*all / "curve.csv") : std::nullopt;
}

std::optional<fs::path> KeptTests::folder(const std::string& identity) const {
    const auto found = folders_.find(identity.substr(0, identity_digits));
    return found == folders_.end() ? std::nullopt : std::optional(found->second);
}

const KeptHashes* KeptTests::hashes_of(const std::string& identity) const {
    const auto found = hashes_.find(identity);
    return found == hashes_.end() ? nullptr : &found->second;
}

/// The test's curve in curves/; empty if there is none, or if the ledger states that none was kept there.
std::optional<KeptTests::Curve> KeptTests::curve_alone(const std::string& identity) const {
    const auto alone = curves_.find(identity.substr(0, identity_digits));
    const KeptHashes* hashes = hashes_of(identity);
    if (alone == curves_.end() || (hashes != nullptr && hashes->curve.empty())) return std::nullopt;
    Curve curve{alone->second, read_file(alone->second)};
    if (hashes != nullptr) require_recorded(curve.file, curve.text, hashes->curve);
    return curve;
}

/// The curve in the test's folder in tests/.
std::optional<KeptTests::Curve> KeptTests::curve_in_folder(const std::string& identity) const {
    const std::optional<fs::path> all = folder(identity);
    const KeptHashes* hashes = hashes_of(identity);
    if (!all || (hashes != nullptr && hashes->summary.empty()) || !is_file(*all / "summary.json") ||
        !is_file(*all / "curve.csv"))
        return std::nullopt;
    const std::string summary = read_file(*all / "summary.json");
    if (hashes != nullptr) require_recorded(*all / "summary.json", summary, hashes->summary);
    Curve curve{*all / "curve.csv", read_file(*all / "curve.csv")};
    require_as_stated(stated_files(parse_summary(summary), (*all / "summary.json").string()), curve.file,
                      mark_of(curve.text));
    return curve;
}

std::optional<KeptTests::Curve> KeptTests::read_curve(const std::string& identity) const {
    std::optional<Curve> curve = curve_alone(identity);
    return curve ? curve : curve_in_folder(identity);
}

/// Checks those files listed in the test's summary that still exist; a user may have removed some to free space.
void KeptTests::require_whole_folder(const fs::path& all, const std::string& identity) const {
    const std::string summary = read_file(all / "summary.json");
    if (const KeptHashes* hashes = hashes_of(identity))
        require_recorded(all / "summary.json", summary, hashes->summary);
    const FileMarks stated = stated_files(parse_summary(summary), (all / "summary.json").string());
    for (const auto& [name, mark] : stated)
        if (is_file(all / name)) require_as_stated(stated, all / name, mark_of_file(all / name));
}

std::string KeptTests::fault_of(const std::string& identity, Keep keep) const {
    constexpr const char* nothing = "kept files of a finished test are missing";
    try {
        if (keep == Keep::figures) return "";
        if (keep == Keep::curves) return read_curve(identity) ? "" : nothing;
        const std::optional<fs::path> all = folder(identity);
        if (!all || !is_file(*all / "summary.json")) return nothing;
        require_whole_folder(*all, identity);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

}  // namespace crackle
