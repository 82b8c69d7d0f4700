// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/envelope/measured_strengths.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/identity.hpp"
#include "specimens/campaign/ledger.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/making/cell_sizes.hpp"
#include "specimens/measures/parting.hpp"
#include "specimens/recordings/curve_points.hpp"
#include "specimens/recordings/test_results.hpp"
#include "specimens/summary/summary_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using RockKeys = std::map<std::string, std::string>;

double number_of(const Json& figures, const char* key) {
    const auto found = figures.find(key);
    return found != figures.end() && found->is_number() ? found->get<double>() : std::nan("");
}

std::string word_of(const Json& figures, const char* key) {
    const auto found = figures.find(key);
    return found != figures.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::string shown_value(const RockKeys& keys, const std::string& key) {
    const auto at = keys.find(key);
    return at == keys.end() ? "nothing" : fmt::format("{:.60}", at->second);
}

/// Name of the first key whose values differ between two rocks.
std::optional<std::string> first_difference(const RockKeys& a, const RockKeys& b) {
    std::set<std::string> keys;
    for (const RockKeys* rock : {&a, &b})
        for (const auto& [key, value] : *rock) keys.insert(key);
    for (const std::string& key : keys)
        if (shown_value(a, key) != shown_value(b, key)) return key;
    return std::nullopt;
}

/// A test that was read from its own folder or from a campaign.
struct StrengthTest {
    std::string where;    ///< description in messages
    std::string packing;  ///< name of the packing; the bootstrap draws whole packings
    Summary figures;
    RockKeys rock;
    std::optional<CurvePoints> curve = {};  ///< set if the curve was requested and kept
};

/// Collects tests, each of which is checked against the first one.
class Collection {
  public:
    explicit Collection(const StrengthMeasure& measure) { all_.measure = measure; }

    void add(const StrengthTest& test) {
        const Summary& figures = test.figures;
        const Stated<LoadingKind>& kind = figures.about.kind;
        if (!kind || !test_kind(*kind).uniaxial) {
            leave_out(test.where,
                      fmt::format("is a test of kind {}, whose peak is not a strength under confining pressure",
                                  kind.name()));
            return;
        }
        const bool pulled = test_kind(*kind).pulls();
        const std::string unit = figures.about.material_units == StiffnessUnits::area ? "Pa" : "N/m";
        if (all_.unit.empty()) {
            all_.unit = unit;
            first_ = test;
        }
        require_same(test, unit);
        const double strength = strength_of(test, pulled);
        if (!std::isfinite(strength)) {
            leave_out(test.where, why_without(test, pulled));
            return;
        }
        const auto parted = from_name<PartingPlace>(figures.damage.failed_at.value_or(""));
        if (pulled && parted.value_or(PartingPlace::gauge) != PartingPlace::gauge) {
            leave_out(test.where, fmt::format("separated at the {}, so its peak is not the rock's tensile strength",
                                              name_of(*parted)));
            return;
        }
        const double confinement = figures.confinement.confining_pressure.value_or(0.0);
        const auto [at, is_new] = seen_.emplace(std::tuple(pulled, confinement, test.packing), test.where);
        if (!is_new) {
            throw InputError(
                fmt::format("envelope: {}: found a second {} of packing {}{} (the first is in {}), expected only one; "
                            "leave one of them out",
                            test.where, pulled ? "tension" : "compression", test.packing,
                            pulled ? "" : fmt::format(" under {:g} {}", confinement, unit), at->second));
        }
        if (pulled)
            all_.tensions.push_back(strength);
        else
            all_.compressions.push_back({test.packing, confinement, strength});
        if (!pulled && is_bound(test)) ++all_.bounds;
    }
    void leave_out(const std::string& where, const std::string& why) { ++left_out_[{where, why}]; }
    void count_failure() { ++all_.failures; }

    MeasuredStrengths taken() {
        for (const auto& [one, count] : left_out_) {
            all_.left_out.push_back(count == 1 ? fmt::format("{}: {}", one.first, one.second)
                                               : fmt::format("{}: {} tests: {}", one.first, count, one.second));
        }
        return std::move(all_);
    }

  private:
    /// Whether the stress taken as the strength is that of the end of loading, up to a fiftieth of the strain.
    bool is_bound(const StrengthTest& test) const {
        constexpr double near_end = 0.98;
        return !all_.measure.strain && all_.measure.figure == "largest_stress" &&
               test.figures.strength.strain_at_largest_stress.or_nan() >=
                   near_end * test.figures.numerics.axial_strain_end.or_nan();
    }
    double strength_of(const StrengthTest& test, bool pulled) const {
        if (pulled) return test.figures.strength.peak_stress.or_nan();
        if (!all_.measure.strain) return number_of(json_of(test.figures), all_.measure.figure.c_str());
        return test.curve ? stress_at(*test.curve, *all_.measure.strain) : std::nan("");
    }
    /// Reason why a test has no strength.
    std::string why_without(const StrengthTest& test, bool pulled) const {
        const StrengthMeasure& measure = all_.measure;
        if (!pulled && measure.strain) {
            return test.curve ? fmt::format("does not reach a strain of {:g}", *measure.strain)
                              : std::string("its curve was not kept; set keep = \"curves\" under [run] in the plan");
        }
        if (!pulled && measure.figure != "peak_stress") return "has no " + measure.figure;
        return "did not fail before loading.max_axial_strain (for specimens that harden, use --figure largest_stress "
               "or --strain)";
    }

    void require_same(const StrengthTest& test, const std::string& unit) const {
        if (unit != all_.unit) {
            throw InputError(fmt::format(
                "envelope: {}: found stresses in {}, expected {} as in {}; all tests must be of the same rock",
                test.where, unit, all_.unit, first_.where));
        }
        if (const std::optional<std::string> key = first_difference(test.rock, first_.rock)) {
            const std::string expected =
                first_.rock.contains(*key) ? shown_value(first_.rock, *key) + " as in " : "no value, as in ";
            throw InputError(
                fmt::format("envelope: {}: {}: found {}, expected {}{}; all tests must be of the same rock", test.where,
                            *key, shown_value(test.rock, *key), expected, first_.where));
        }
    }

    MeasuredStrengths all_;
    StrengthTest first_;
    // Descriptions of the tests added, by kind, confinement and packing.
    std::map<std::tuple<bool, double, std::string>, std::string> seen_;
    std::map<std::pair<std::string, std::string>, int> left_out_;
};

/// Whether the gap in a resolved case equals the default, which is derived from the number of cells.
bool is_derived_gap(double thick, const SpecimenFigures& specimen) {
    constexpr double rounding = 1e-9;
    const double area = specimen.initial_width.or_nan() * specimen.initial_height.or_nan();
    return std::abs(thick / derived_gap(area, specimen.particles.or_nan()) - 1.0) < rounding;
}

StrengthTest read_test(const fs::path& folder, FileHashes& files) {
    StrengthTest test;
    test.where = folder.string();
    const TestResults results = read_results(folder);
    test.figures = results.summary;
    test.curve = strain_and_stress(results.curve);
    const ResolvedCase made = read_case(folder / "case.toml");
    test.rock = keys_of_rock(made, files);
    const auto* gap = made.mesh ? std::get_if<parts::MeshGap>(&made.mesh->gap) : nullptr;
    if (gap != nullptr && is_derived_gap(gap->thick, test.figures.specimen)) test.rock.erase("mesh.thick");
    if (const auto* file = std::get_if<parts::ParticleFile>(&made.source)) {
        const auto* grains = std::get_if<parts::RandomGrains>(&made.minerals.assign);
        test.packing =
            fmt::format("{:.8}, {}, {}, {}", files.of(file->path), made.bond.random ? made.bond.random->seed : 0,
                        grains != nullptr ? grains->seed : 1, made.joints.seed);
    } else {
        test.packing = fmt::format("{}", made.packing()->seed);
    }
    return test;
}

/// Text of a value as in keys_of_rock().
std::string axis_text(const std::string& key, const LedgerCell& cell) {
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    const double value = std::get<double>(cell);
    const std::size_t dot = key.find('.');
    const Parameter* p = find_parameter(key.substr(0, std::min(dot, key.find('['))), key.substr(dot + 1));
    if (p != nullptr && p->kind == ValueKind::flag) return value != 0.0 ? "true" : "false";
    return fmt::format("{}", value);
}

/// A row of a ledger with access by column name.
struct LedgerRow {
    const LedgerTable& table;
    const std::vector<LedgerCell>& cells;

    Json figures() const {
        Json all = Json::object();
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (const auto* number = std::get_if<double>(&cells[k])) all[table.columns[k]] = *number;
            if (const auto* text = std::get_if<std::string>(&cells[k])) all[table.columns[k]] = *text;
        }
        return all;
    }
    /// Folder of the ledger, followed by the name of the row's test.
    std::string where(const fs::path& folder) const {
        std::string text = fmt::format("{}, {}", folder.string(), std::get<std::string>(cells[1]));
        for (std::size_t k = 2; table.columns[k] != "seed"; ++k)
            if (!std::holds_alternative<std::monostate>(cells[k]))
                text += fmt::format(", {} = {}", table.columns[k], axis_text(table.columns[k], cells[k]));
        return text;
    }
    /// Values of the axes that apply to the row's test, from the columns between the test's name and the seed.
    RockKeys axes() const {
        RockKeys all;
        for (std::size_t k = 2; table.columns[k] != "seed"; ++k)
            if (!std::holds_alternative<std::monostate>(cells[k]) && !differs_within_a_rock(table.columns[k]))
                all[table.columns[k]] = axis_text(table.columns[k], cells[k]);
        return all;
    }
};

/// Keys of a test's rock. @param rocks  entry `rocks` of the ledger
RockKeys keys_of(const Json& rocks, const std::string& test, const fs::path& folder) {
    RockKeys keys;
    const auto found = rocks.is_object() ? rocks.find(test) : rocks.end();
    const bool known = found != rocks.end() && found->is_object() &&
                       std::ranges::all_of(*found, [](const Json& value) { return value.is_string(); });
    if (!known) {
        throw InputError(
            fmt::format("envelope: {}: found no record of the rock of test {} in the ledger, expected the keys of its "
                        "case; run `crackle campaign` again (finished tests are kept)",
                        folder.string(), test));
    }
    for (const auto& [key, value] : found->items()) keys[key] = value.get<std::string>();
    return keys;
}

void add_campaign(Collection& all, const fs::path& folder, bool with_curves) {
    const CampaignLedger ledger = CampaignLedger::read(ledger_file(folder));
    const KeptTests kept(folder, ledger.kept_hashes());
    const std::string text = ledger.meta("rocks");
    if (text.empty()) {
        throw InputError(
            fmt::format("envelope: {}: found no record of the tests' rocks in the ledger, expected one; run `crackle "
                        "campaign` again (finished tests are kept)",
                        folder.string()));
    }
    const Json rocks = Json::parse(text, nullptr, false);
    const LedgerTable table = ledger.results();
    for (const std::vector<LedgerCell>& cells : table.rows) {
        const LedgerRow row{table, cells};
        const Json figures = row.figures();
        if (word_of(figures, "variant") != name_of(Variant::as_asked)) continue;
        const std::string state = word_of(figures, "state");
        if (state != row_done) {
            all.leave_out(row.where(folder), state.empty() ? "not run yet" : "gone wrong (" + state + ")");
            if (!state.empty() && kind_of_row(state) == RowKind::failure) all.count_failure();
            continue;
        }
        RockKeys rock = keys_of(rocks, word_of(figures, "test"), folder);
        for (const auto& [key, value] : row.axes()) rock[key] = value;
        StrengthTest test{row.where(folder), fmt::format("{:.0f}", number_of(figures, "seed")), summary_from(figures),
                          rock};
        const auto curve = with_curves ? kept.read_curve(word_of(figures, "identity")) : std::nullopt;
        if (curve) test.curve = strain_and_stress(number_table(curve->file, curve->text));
        all.add(test);
    }
}

/// Stresses in summary.json that can be plotted against a confining pressure.
constexpr std::array<std::string_view, 4> axial_stresses = {"peak_stress", "largest_stress", "crack_initiation_stress",
                                                            "crack_damage_stress"};

}  // namespace

std::string StrengthMeasure::spoken_one() const {
    if (strain) return fmt::format("stress at a strain of {:g}", *strain);
    if (figure == "peak_stress") return "strength";
    std::string text = figure;
    std::ranges::replace(text, '_', ' ');
    return text;
}

std::string StrengthMeasure::spoken() const {
    if (strain) return fmt::format("stresses at a strain of {:g}", *strain);
    const std::string one = spoken_one();
    return one + (one.ends_with("ss") ? "es" : "s");
}

MeasuredStrengths read_strengths(std::span<const fs::path> folders, const StrengthMeasure& measure) {
    if (!measure.strain && std::ranges::find(axial_stresses, measure.figure) == axial_stresses.end())
        throw InputError(fmt::format("envelope: --figure: found '{:.60}', expected an axial stress of summary.json: {}",
                                     measure.figure, fmt::join(axial_stresses, ", ")));
    Collection all(measure);
    FileHashes files;
    for (const fs::path& folder : folders) {
        if (is_file(ledger_file(folder)))
            add_campaign(all, folder, measure.strain.has_value());
        else
            all.add(read_test(folder, files));
    }
    return all.taken();
}

}  // namespace crackle
