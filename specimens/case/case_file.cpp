// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a case with toml++ against the declared parameters, and checks the keys against each other.

#include "specimens/case/case_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/scene/bond_strength.hpp"
#include "specimens/case/mineral_checks.hpp"
#include "specimens/case/parameters.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

std::string line_of(const fs::path& file, const toml::node& node) {
    return fmt::format("{}:{}", file.string(), node.source().begin.line);
}

std::string kind_name(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::string:
            return "a text";
        case toml::node_type::integer:
            return "a whole number";
        case toml::node_type::floating_point:
            return "a number";
        case toml::node_type::boolean:
            return "true or false";
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return "an array";
        default:
            return "a date or time";
    }
}

std::string shown(const toml::node& node) {
    if (const auto* text = node.as_string()) return fmt::format("\"{}\"", text->get());
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
    return kind_name(node);
}

/// The value of a node as the parameter wants it. @throws InputError
CaseValue value_of(const Parameter& p, const toml::node& node, const std::string& where, const std::string& name) {
    const auto refuse = [&](const std::string& found) {
        throw InputError(fmt::format("{}: {}: found {}, expected {}", where, name, found, p.expected()));
    };
    switch (p.kind) {
        case ValueKind::flag:
            if (const auto* flag = node.as_boolean()) return CaseValue(flag->get());
            break;
        case ValueKind::integer:
            if (const auto* number = node.as_integer()) {
                if (!p.accepts(static_cast<double>(number->get()))) refuse(shown(node));
                return CaseValue(number->get());
            }
            break;
        case ValueKind::real:
            if (node.is_number()) {
                const double number = *node.value<double>();
                if (!p.accepts(number)) refuse(shown(node));
                return CaseValue(number);
            }
            break;
        case ValueKind::text:
            if (const auto* text = node.as_string()) {
                if (!p.choices.empty() &&
                    std::find(p.choices.begin(), p.choices.end(), text->get()) == p.choices.end()) {
                    refuse(shown(node));
                }
                if (p.is_path && text->get().empty()) refuse("an empty text");
                return CaseValue(text->get());
            }
            break;
        case ValueKind::text_pair:
            if (const auto* texts = node.as_array(); texts != nullptr && texts->size() == 2) {
                const auto *first = texts->get(0)->as_string(), *second = texts->get(1)->as_string();
                if (first != nullptr && second != nullptr)
                    return CaseValue(std::array<std::string, 2>{first->get(), second->get()});
            }
            break;
    }
    const bool scalar = node.is_value();
    refuse(scalar ? fmt::format("{} ({})", shown(node), kind_name(node)) : kind_name(node));
    return {};
}

toml::table parse(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
        throw InputError(fmt::format("{}: found no such file, expected a case file; check the path", path.string()));
    }
    try {
        return toml::parse_file(path.string());
    } catch (const toml::parse_error& problem) {
        throw InputError(fmt::format("{}:{}: not valid TOML: {}", path.string(), problem.source().begin.line,
                                     problem.description()));
    }
}

const TableDescription* find_table(const std::string& name) {
    for (const TableDescription& t : case_tables())
        if (t.name == name) return &t;
    return nullptr;
}

/// A table in errors and in TestCase::position: of those that may come several times with its number.
std::string table_label(const std::string& table, std::size_t entry) {
    return find_table(table)->repeated() ? fmt::format("{}[{}]", table, entry + 1) : table;
}
std::string key_label(const Parameter& p, std::size_t entry) {
    return p.table.empty() ? p.key : table_label(p.table, entry) + "." + p.key;
}

const Parameter* find_parameter(const std::string& table, const std::string& key) {
    for (const Parameter& p : case_parameters()) {
        if (p.table == table && p.key == key) return &p;
    }
    return nullptr;
}

[[noreturn]] void refuse_unknown(const std::string& where, const std::string& table, const std::string& key) {
    std::vector<std::string> known;
    for (const Parameter& p : case_parameters()) {
        if (p.table == table) known.push_back(p.key);
    }
    if (table.empty()) {
        known.push_back("include");
        for (const TableDescription& t : case_tables()) {
            if (!t.name.empty()) known.push_back(t.heading());
        }
    }
    throw InputError(fmt::format("{}: {}: found an unknown key, expected one of {}; correct or remove it", where,
                                 table.empty() ? key : table + "." + key, fmt::join(known, ", ")));
}

void take_value(TestCase& test, const fs::path& file, const std::string& table, const std::string& key,
                const toml::node& node, std::size_t entry = 0) {
    const std::string where = line_of(file, node);
    const Parameter* p = find_parameter(table, key);
    if (p == nullptr) refuse_unknown(where, table, key);
    const std::string name = key_label(*p, entry);
    p->set(test, value_of(*p, node, where, name), entry);
    test.position[name] = where;
}

/// A list of tables takes the place of the whole list in the files before it.
void take_list(TestCase& test, const fs::path& file, const TableDescription& table, const toml::node& node) {
    const toml::array* entries = node.as_array();
    if (entries == nullptr ||
        std::any_of(entries->begin(), entries->end(), [](const toml::node& entry) { return !entry.is_table(); })) {
        throw InputError(fmt::format("{}: {}: found {}, expected a list of tables; write {} above each",
                                     line_of(file, node), table.name, kind_name(node), table.heading()));
    }
    std::erase_if(test.position, [&](const auto& one) { return one.first.starts_with(table.name + "["); });
    table.set_count(test, 0);
    table.set_count(test, entries->size());
    test.table_present.erase(table.name);
    if (!entries->empty()) test.table_present[table.name] = true;
    for (std::size_t entry = 0; entry < entries->size(); ++entry) {
        const toml::node& inner = *entries->get(entry);
        test.position[table_label(table.name, entry)] = line_of(file, inner);
        for (const auto& [key, value] : *inner.as_table())
            take_value(test, file, table.name, std::string(key.str()), value, entry);
    }
}

/// Of alternative keys for one quantity, the one that a file uses replaces those of the files before it.
void forget_other_ways(TestCase& test, const toml::table& content) {
    const auto writes = [&](const std::string& key) { return static_cast<bool>(content.at_path(key)); };
    for (const Alternatives& ways : case_alternatives()) {
        for (const auto& taken : ways) {
            if (std::none_of(taken.begin(), taken.end(), writes)) continue;
            for (const auto& other : ways) {
                if (&other == &taken) continue;
                for (const std::string& full_key : other) {
                    const std::size_t dot = full_key.find('.');
                    find_parameter(full_key.substr(0, dot), full_key.substr(dot + 1))->forget(test);
                    test.position.erase(full_key);
                }
            }
        }
    }
}

/// Puts the file's values into the case, over what is there.
void take_file(TestCase& test, const fs::path& file, const toml::table& content) {
    forget_other_ways(test, content);
    for (const auto& [name, node] : content) {
        const std::string key(name.str());
        if (key == "include") continue;
        if (const TableDescription* list = find_table(key); list != nullptr && list->repeated()) {
            take_list(test, file, *list, node);
            continue;
        }
        const toml::table* inner = node.as_table();
        if (inner == nullptr) {
            take_value(test, file, "", key, node);
            continue;
        }
        if (find_table(key) == nullptr) refuse_unknown(line_of(file, node), "", key);
        test.table_present[key] = true;
        test.position[key] = line_of(file, node);
        for (const auto& [inner_name, inner_node] : *inner) {
            take_value(test, file, key, std::string(inner_name.str()), inner_node);
        }
    }
}

/// Reads a file after what it includes, so that its own keys stand over it.
/// @param within the files that include this one, the case first: none may come again
void take_with_includes(TestCase& test, const fs::path& path, std::vector<fs::path> within) {
    const toml::table content = parse(path);
    test.inputs.push_back(path);
    if (const toml::node* include = content.get("include")) {
        const std::string where = line_of(path, *include);
        const auto* text = include->as_string();
        if (text == nullptr) {
            throw InputError(
                fmt::format("{}: include: found {}, expected a file name in quotes", where, shown(*include)));
        }
        const fs::path other = (path.parent_path() / text->get()).lexically_normal();
        std::error_code error;
        if (!fs::is_regular_file(other, error)) {
            throw InputError(fmt::format("{}: include: found no file {}, expected a case file; check the path", where,
                                         other.string()));
        }
        within.push_back(path);
        if (std::any_of(within.begin(), within.end(),
                        [&](const fs::path& file) { return fs::equivalent(file, other, error); })) {
            throw InputError(
                fmt::format("{}: include: found {}, which includes this file, expected no ring; remove one", where,
                            other.string()));
        }
        take_with_includes(test, other, std::move(within));
    }
    take_file(test, path, content);
}

/// Whether the case uses an alternative to this key.
bool said_otherwise(const TestCase& test, const std::string& full_key) {
    const auto is_written = [&](const std::string& key) { return test.position.contains(key); };
    for (const Alternatives& ways : case_alternatives()) {
        const auto has_key = [&](const auto& way) { return std::find(way.begin(), way.end(), full_key) != way.end(); };
        if (std::none_of(ways.begin(), ways.end(), has_key)) continue;
        return std::any_of(ways.begin(), ways.end(), [&](const auto& way) {
            return !has_key(way) && std::any_of(way.begin(), way.end(), is_written);
        });
    }
    return false;
}

void fill_default(TestCase& test, const Parameter& p, std::size_t entry) {
    const std::string name = key_label(p, entry);
    if (test.position.contains(name)) return;
    if (p.presence == Presence::defaulted) {
        if (said_otherwise(test, name)) return;
        p.set(test, *p.default_value, entry);
    } else if (p.presence == Presence::required ||
               (p.presence == Presence::required_with_table && test.has_table(p.table))) {
        const auto table = test.position.find(table_label(p.table, entry));
        throw InputError(fmt::format("{}: {}: found nothing, expected {}; add it to {}",
                                     table == test.position.end() ? test.source.string() : table->second, name,
                                     p.expected(), find_table(p.table)->heading()));
    }
}

void fill_defaults(TestCase& test) {
    for (const Parameter& p : case_parameters()) {
        const TableDescription& table = *find_table(p.table);
        const std::size_t entries = table.repeated() ? table.count(test) : 1;
        for (std::size_t entry = 0; entry < entries; ++entry) fill_default(test, p, entry);
    }
    // A real grip is stronger than the rock.
    if (test.loading.kind == "tension" && !test.position.contains("loading.platens")) test.loading.platens = "glued";
    if (test.loading.platens == "glued" && !test.loading.grip)
        test.loading.grip = test.loading.kind == "tension" ? default_grip : 0.0;
    if (test.title.empty()) test.title = test.source.stem().string();
}

/// Checks of keys against each other.
class ConsistencyCheck {
  public:
    explicit ConsistencyCheck(const TestCase& test) : test_(test) {}

    void run() const {
        specimen();
        if (test_.has_table("packing")) packing();
        material();
        bond();
        check_minerals(test_);
        mesh();
        loading();
        if (test_.output.frames.value_or(0) > test_.output.curve_rows) {
            refuse("output.frames", fmt::format("{}", *test_.output.frames),
                   fmt::format("at most output.curve_rows = {}", test_.output.curve_rows),
                   "frames are taken at rows of the curve");
        }
    }

  private:
    [[noreturn]] void refuse(const std::string& key, const std::string& found, const std::string& expected,
                             const std::string& remedy) const {
        throw InputError(fmt::format("{}: found {}, expected {}; {}", test_.at(key), found, expected, remedy));
    }
    bool written(const std::string& key) const { return test_.position.contains(key); }

    void need(const std::string& key, const std::string& because) const {
        if (written(key)) return;
        const std::string table = key.substr(0, key.find('.'));
        const Parameter* p = find_parameter(table, key.substr(table.size() + 1));
        refuse(key, "nothing", p->expected(), because);
    }
    void exclude(const std::string& key, const std::string& because) const {
        if (written(key)) refuse(key, "a value", "none", because);
    }

    void specimen() const {
        const bool file = test_.has_table("particles");
        const bool pack = test_.has_table("packing");
        if (file && pack) refuse("packing", "[particles] beside it", "one of them", "remove one");
        if (!file && !pack)
            refuse("particles", "neither [particles] nor [packing]", "one of them",
                   "state where the specimen comes from");
    }

    void packing() const {
        const auto& p = test_.packing;
        if (p.count) {
            exclude("packing.width", "count and height_to_width give the box its size");
            exclude("packing.height", "count and height_to_width give the box its size");
        } else {
            need("packing.width", "or write count");
            need("packing.height", "or write count");
            exclude("packing.height_to_width", "width and height give the box its shape");
        }
        if (p.mean_overlap && p.void_ratio)
            exclude("packing.void_ratio", "a packing has one target: remove mean_overlap or void_ratio");
        if (!p.mean_overlap && !p.void_ratio) need("packing.mean_overlap", "or write void_ratio");
        if (p.cell_diameter || p.cell_spread) {
            cells();
            return;
        }
        if (p.sizes == "sieve") {
            need("packing.sieve", "sizes = \"sieve\" needs a curve");
            for (const char* key : {"radius_min", "radius_max", "radius_median", "radius_log_deviation"}) {
                exclude(std::string("packing.") + key, "the sieve curve gives the sizes");
            }
            return;
        }
        exclude("packing.sieve", "only sizes = \"sieve\" reads it");
        if (p.sizes == "uniform") {
            need("packing.radius_min", "sizes = \"uniform\" needs both ends");
            need("packing.radius_max", "sizes = \"uniform\" needs both ends");
            exclude("packing.radius_median", "only sizes = \"lognormal\" has it");
            exclude("packing.radius_log_deviation", "only sizes = \"lognormal\" has it");
        } else {
            need("packing.radius_median", "sizes = \"lognormal\" needs it");
            need("packing.radius_log_deviation", "sizes = \"lognormal\" needs it");
        }
        if (p.radius_min && p.radius_max && *p.radius_min > *p.radius_max) {
            refuse("packing.radius_min", fmt::format("{} m", *p.radius_min),
                   fmt::format("at most radius_max = {} m", *p.radius_max), "exchange them");
        }
    }

    /// The size of the cells in place of that of the circles.
    void cells() const {
        constexpr const char* because = "cell_diameter and cell_spread give the sizes: remove it, or them";
        for (const char* key : {"radius_min", "radius_max", "radius_median", "radius_log_deviation", "sieve"})
            exclude(std::string("packing.") + key, because);
        if (!test_.has_table("mesh"))
            refuse(test_.packing.cell_diameter ? "packing.cell_diameter" : "packing.cell_spread", "no [mesh] beside it",
                   "one", "circles have radii; cells are a mesh's");
        if (test_.packing.sizes == "sieve")
            refuse("packing.sizes", "\"sieve\"", "\"uniform\" or \"lognormal\"", because);
        need("packing.cell_diameter", "cell_spread is of diameters with a mean");
        need("packing.cell_spread", "cell_diameter needs their coefficient of variation beside it");
    }

    void material() const {
        const auto& m = test_.material;
        if (m.damping_ratio && (m.normal_damping || m.shear_damping)) {
            refuse("material.damping_ratio", "a ratio and dashpots", "one way of damping",
                   "remove damping_ratio or the dashpots");
        }
        const bool area = test_.area_units();
        if (area) {
            for (const char* key : {"normal_stiffness", "shear_stiffness"})
                exclude(std::string("material.") + key, "units = \"area\" has contact_modulus and stiffness_ratio");
            for (const char* key : {"normal_damping", "shear_damping"})
                exclude(std::string("material.") + key, "units = \"area\" has damping_ratio");
            for (const char* key : {"contact_modulus", "stiffness_ratio"})
                need(std::string("material.") + key, "units = \"area\" needs it");
            if (test_.numerics.contact_law != "rounded")
                refuse("material.units", "\"area\"", "\"point\" with the guide's contact law",
                       "that law knows of no faces; use contact_law = \"rounded\"");
        } else {
            for (const char* key : {"contact_modulus", "stiffness_ratio"})
                exclude(std::string("material.") + key, "only units = \"area\" has it");
        }
        if (m.residual_friction_angle && m.friction_angle && *m.residual_friction_angle > *m.friction_angle) {
            refuse("material.residual_friction_angle", fmt::format("{} deg", *m.residual_friction_angle),
                   fmt::format("at most friction_angle = {} deg", *m.friction_angle), "a broken bond is no rougher");
        }
        if (!test_.has_table("packing")) return;
        need("material.density", "a packing has no file to take it from");
        need("material.friction_angle", "a packing has no file to take it from");
        if (!area) {
            need("material.normal_stiffness", "a packing has no file to take it from");
            need("material.shear_stiffness", "a packing has no file to take it from");
        }
        if (!m.normal_damping && !m.shear_damping) return;  // a ratio, or the default one
        need("material.normal_damping", "dashpots come in pairs");
        need("material.shear_damping", "dashpots come in pairs");
    }

    /// What a bond law has, and needs.
    void bond() const {
        const auto& b = test_.bond;
        if (!test_.coulomb_bonds()) {
            constexpr const char* because =
                "only bond.law = \"coulomb\" has it: by back-tension the overlap is the strength";
            for (const char* key :
                 {"material.tensile_strength", "material.cohesion", "material.residual_friction_angle", "bond.gap",
                  "bond.tensile_factor", "bond.cohesion_factor", "bond.strength_cv", "bond.strength_seed"})
                exclude(key, because);
            if (b.range > 0.0) exclude("bond.range", because);
            if (b.strength_distribution != "none") exclude("bond.strength_distribution", because);
            return;
        }
        if (test_.numerics.contact_law != "rounded")
            refuse("bond.law", "\"coulomb\"", "\"back_tension\" with the guide's contact law",
                   "or use contact_law = \"rounded\"");
        if (test_.material.shear_stiffness && *test_.material.shear_stiffness == 0.0)
            refuse("material.shear_stiffness", "0 N/m", "a number > 0 with coulomb bonds", "they hold in shear");
        strength("tensile");
        strength("cohesion");
        apex();
        const bool random = b.strength_distribution != "none";
        for (const char* key : {"bond.strength_cv", "bond.strength_seed"}) {
            if (random)
                need(key, "strength_distribution = \"" + b.strength_distribution + "\" needs it");
            else
                exclude(key, "strength_distribution = \"none\" has no random factor");
        }
        if (b.strength_distribution == "normal" && *b.strength_cv > largest_normal_cv)
            refuse("bond.strength_cv", fmt::format("{}", *b.strength_cv), fmt::format("at most {}", largest_normal_cv),
                   "a normal distribution truncated at 0 has no more; take weibull or lognormal");
        if (test_.has_table("mesh") && b.range > 0.0)
            exclude("bond.range", "only circles reach beyond their neighbours");
    }

    /// A strength is a number or a factor.
    void strength(const std::string& which) const {
        const std::string number = "material." + (which == "tensile" ? std::string("tensile_strength") : which);
        const std::string factor = "bond." + which + "_factor";
        if (written(number) && written(factor)) exclude(factor, "a strength is a number or a factor: remove one");
        if (!written(number) && !written(factor)) need(number, "bond.law = \"coulomb\" needs it, or " + factor);
        if (!written(factor)) return;
        if (test_.has_table("mesh"))
            exclude(factor, "polygons with coulomb bonds have no overlap to take a factor of; give " + number);
        if (test_.area_units()) exclude(factor, "units = \"area\" has strengths in Pa; give " + number);
    }

    /// Tensile strength beyond cohesion over friction would never be reached.
    void apex() const {
        const auto& m = test_.material;
        if (!m.tensile_strength || !m.cohesion || !m.friction_angle) return;
        const double friction = std::tan(*m.friction_angle * std::numbers::pi / 180.0);
        if (!(friction * *m.tensile_strength > *m.cohesion * (1.0 + 1e-12))) return;
        const std::string unit = test_.area_units() ? "Pa" : "N";
        refuse("material.tensile_strength", fmt::format("{} {}", *m.tensile_strength, unit),
               fmt::format("at most cohesion over tan(friction_angle) = {:.6g} {}", *m.cohesion / friction, unit),
               "the apex of the bond's envelope would cut it off; give more cohesion or less tensile strength");
    }

    void mesh() const {
        if (!test_.has_table("mesh")) return;
        if (*test_.mesh.kind == "voronoi" && test_.mesh.boundary == "seeds") {
            refuse("mesh.boundary", "\"seeds\"", "\"domain\" with kind = \"voronoi\"", "Voronoi cells always fill it");
        }
        if (test_.coulomb_bonds() && !test_.mesh.thick && !test_.mesh.inset) {
            exclude("bond.thick", "mesh.thick is derived: give both, or neither");
            return;
        }
        if (!test_.coulomb_bonds())
            need("mesh.thick", "by back-tension the excess of bond.thick over it is the strength");
        const double gap = test_.mesh.inset ? 2.0 * *test_.mesh.inset : *test_.mesh.thick;
        if (test_.coulomb_bonds()) {
            if (test_.bond.thick && *test_.bond.thick < gap)
                refuse("bond.thick", fmt::format("{} m", *test_.bond.thick), fmt::format("at least {} m", gap),
                       "faces that far apart would not bond; leave it out");
            return;
        }
        need("bond.thick", "polygons bond at the excess of bond.thick over mesh.thick");
        if (*test_.bond.thick <= gap) {
            refuse("bond.thick", fmt::format("{} m", *test_.bond.thick),
                   fmt::format("more than {} = {} m", test_.mesh.inset ? "twice mesh.inset" : "mesh.thick", gap),
                   "the excess is the overlap that bonds the polygons");
        }
    }

    void loading() const {
        if (test_.loading.axial_strain_rate && test_.loading.rate_tolerance) {
            refuse("loading.rate_tolerance", "a tolerance besides axial_strain_rate", "one of them",
                   "remove axial_strain_rate to have the rate chosen, or rate_tolerance");
        }
        if (test_.loading.platens == "frictional") {
            if (test_.loading.kind == "tension") {
                refuse("loading.platens", "\"frictional\"", "\"bonded\" in tension",
                       "a platen that is not bonded cannot pull");
            }
            need("loading.platen_friction_angle", "frictional platens need it");
            if (test_.numerics.intact)
                refuse("numerics.intact", "true", "false with frictional platens",
                       "they touch only what comes into contact later");
        } else {
            exclude("loading.platen_friction_angle",
                    "only platens = \"frictional\" has it: bonded and glued platens take the specimen's");
        }
        if (test_.loading.platens != "glued") exclude("loading.grip", "only platens = \"glued\" has grips");
    }

    const TestCase& test_;
};

}  // namespace

TestCase read_case(const fs::path& path) {
    TestCase test;
    test.source = path;
    take_with_includes(test, path, {});
    fill_defaults(test);
    ConsistencyCheck(test).run();
    return test;
}

namespace {

std::string quoted(const std::string& text) {
    std::ostringstream out;
    out << toml::value<std::string>(text);
    return out.str();
}

/// A value as a case writes it. @param folder that paths are relative to
std::string written_value(const TestCase& test, const Parameter& p, const CaseValue& value, const fs::path& folder) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* number = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *number);
    if (const auto* number = std::get_if<double>(&value)) {
        const std::string text = fmt::format("{}", *number);
        return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
    }
    if (const auto* texts = std::get_if<std::array<std::string, 2>>(&value))
        return fmt::format("[{}, {}]", quoted((*texts)[0]), quoted((*texts)[1]));
    const std::string& text = std::get<std::string>(value);
    if (!p.is_path) return quoted(text);
    const fs::path target = test.resolve_path(p.full_key(), text);
    return quoted(fs::absolute(target)
                      .lexically_normal()
                      .lexically_proximate(fs::absolute(folder).lexically_normal())
                      .generic_string());
}

/// Tables that say nothing where the case has none.
bool left_out(const TestCase& test, const std::string& table) {
    if (table == "minerals") return !test.has_table("mineral");
    return (table == "packing" || table == "mesh") && !test.has_table(table);
}

}  // namespace

void write_resolved_case(std::ostream& out, const TestCase& test, const fs::path& folder) {
    for (const TableDescription& table : case_tables()) {
        if (left_out(test, table.name)) continue;
        const std::size_t entries = table.repeated() ? table.count(test) : 1;
        for (std::size_t entry = 0; entry < entries; ++entry) {
            std::string lines;
            for (const Parameter& p : case_parameters()) {
                if (p.table != table.name) continue;
                const std::optional<CaseValue> value = p.get(test, entry);
                if (!value) continue;
                lines += fmt::format("{} = {}  # {}{}\n", p.key, written_value(test, p, *value, folder),
                                     p.unit.empty() ? "" : p.unit + ": ", p.sentence);
            }
            if (lines.empty()) continue;
            if (!table.name.empty()) out << '\n' << table.heading() << "  # " << table.sentence << '\n';
            out << lines;
        }
    }
}

void describe_case_keys(std::ostream& out) {
    out << "include = \"FILE\" at the top: values of FILE hold wherever the case is silent; FILE may include "
           "another. A list, [[mineral]] or [[mineral_pair]], holds as a whole.\n";
    for (const TableDescription& table : case_tables()) {
        if (!table.name.empty()) out << '\n' << table.heading() << "  " << table.sentence << '\n';
        for (const Parameter& p : case_parameters()) {
            if (p.table != table.name) continue;
            std::string presence = "optional";
            if (p.presence == Presence::required) presence = "required";
            if (p.presence == Presence::required_with_table) presence = "required with the table";
            if (p.presence == Presence::defaulted && p.full_key() != "title") {
                const CaseValue& value = *p.default_value;
                presence = "default " + std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
            }
            out << fmt::format("  {:24} {}; {}. {}\n", p.key, p.expected(), presence, p.sentence);
        }
    }
}

}  // namespace crackle
