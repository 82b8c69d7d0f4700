// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a case with toml++ according to the declared parameters, and checks that its keys are consistent.

#include "specimens/case/case_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <ostream>
#include <sstream>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/scene/scene.hpp"
#include "specimens/case/consistency.hpp"
#include "specimens/case/joint_checks.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/case/resolve.hpp"
#include "specimens/case/toml_file.hpp"
#include "specimens/case/toml_shape.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

/// Converts a node to the type of the parameter. @throws InputError
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
                if (!p.accepts(number))
                    refuse(shown(node) +
                           (is_a_size(number) || !std::isfinite(number) ? "" : ", which is too small or too large"));
                return CaseValue(number);
            }
            break;
        case ValueKind::reals:
            if (const auto* list = node.as_array(); list != nullptr && !list->empty()) {
                std::vector<double> numbers;
                for (const toml::node& one : *list) {
                    const std::optional<double> number = one.value<double>();
                    if (!number || !p.accepts(*number)) refuse(shown(one));
                    numbers.push_back(*number);
                }
                return CaseValue(std::move(numbers));
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

const TableDescription* find_table(const std::string& name) {
    for (const TableDescription& t : case_tables())
        if (t.name == name) return &t;
    return nullptr;
}

/// Label of a table in error messages and in WrittenPlaces::position; a table that may occur several times gets a
/// number.
std::string table_label(const std::string& table, std::size_t entry) {
    return find_table(table)->repeated() ? fmt::format("{}[{}]", table, entry + 1) : table;
}
std::string key_label(const Parameter& p, std::size_t entry) {
    return p.table.empty() ? p.key : table_label(p.table, entry) + "." + p.key;
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
    throw InputError(fmt::format("{}: {:.40}: found an unknown key, expected one of {}; correct or remove it", where,
                                 table.empty() ? key : table + "." + key, fmt::join(known, ", ")));
}

void take_value(TestCase& test, const std::string& where, const std::string& table, const std::string& key,
                const toml::node& node, std::size_t entry = 0) {
    const Parameter* p = find_parameter(table, key);
    if (p == nullptr) refuse_unknown(where, table, key);
    const std::string name = key_label(*p, entry);
    p->set(test, value_of(*p, node, where, name), entry);
    test.position[name] = where;
}

/// Reads a list of tables. It replaces any list of the same name from the included files.
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
            take_value(test, line_of(file, value), table.name, std::string(key.str()), value, entry);
    }
}

/// If a file uses one of several alternative keys for a quantity, drops the values that earlier files set with the
/// other keys.
/// @param writes  a function that returns whether the file contains a key, given as "table.key"
template <class Writes>
void forget_other_ways(TestCase& test, const Writes& writes) {
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

/// Stores the file's values in the case, overriding earlier ones.
void take_file(TestCase& test, const fs::path& file, const toml::table& content) {
    forget_other_ways(test, [&](const std::string& key) { return static_cast<bool>(content.at_path(key)); });
    for (const auto& [name, node] : content) {
        const std::string key(name.str());
        if (key == "include") continue;
        if (const TableDescription* list = find_table(key); list != nullptr && list->repeated()) {
            take_list(test, file, *list, node);
            continue;
        }
        const TableDescription* table = key.empty() ? nullptr : find_table(key);
        if (table == nullptr) {
            take_value(test, line_of(file, node), "", key, node);
            continue;
        }
        const toml::table* inner = node.as_table();
        if (inner == nullptr)
            throw InputError(fmt::format("{}: {}: found {}, expected a table of keys; write {} above them",
                                         line_of(file, node), key, kind_name(node), table->heading()));
        test.table_present[key] = true;
        test.position[key] = line_of(file, node);
        for (const auto& [inner_name, inner_node] : *inner) {
            take_value(test, line_of(file, inner_node), key, std::string(inner_name.str()), inner_node);
        }
    }
}

void take_with_includes(TestCase& test, const fs::path& path, std::vector<fs::path> within);

/// Applies the included file first and then the file itself, whose keys override the included keys.
/// @param within  the chain of including files, starting with the case; used to reject a file that includes itself
void take_content(TestCase& test, const fs::path& path, const toml::table& content, std::vector<fs::path> within) {
    if (const toml::node* include = content.get("include")) {
        const std::string where = line_of(path, *include);
        const auto* text = include->as_string();
        if (text == nullptr) {
            throw InputError(
                fmt::format("{}: include: found {}, expected a file name in quotes", where, shown(*include)));
        }
        const fs::path other = (path.parent_path() / text->get()).lexically_normal();
        std::error_code error;
        if (!is_file(other)) {
            throw InputError(fmt::format("{}: include: found no file {:.200}, expected a case file; check the path",
                                         where, other.string()));
        }
        within.push_back(path);
        if (std::any_of(within.begin(), within.end(),
                        [&](const fs::path& file) { return fs::equivalent(file, other, error); })) {
            throw InputError(fmt::format(
                "{}: include: found {:.200}, which includes this file, expected no cycle; remove one of the includes",
                where, other.string()));
        }
        take_with_includes(test, other, std::move(within));
    }
    take_file(test, path, content);
}

void take_with_includes(TestCase& test, const fs::path& path, std::vector<fs::path> within) {
    const toml::table content = parse_toml(path, "a case file");
    test.inputs.push_back(path);
    take_content(test, path, content, std::move(within));
}

/// Converts a value to a TOML node, so that it passes the same checks as a value from a file.
std::unique_ptr<toml::node> node_of(const CaseValue& value) {
    return std::visit(
        [](const auto& one) -> std::unique_ptr<toml::node> {
            using Value = std::decay_t<decltype(one)>;
            if constexpr (std::is_same_v<Value, std::array<std::string, 2>>)
                return std::make_unique<toml::array>(one[0], one[1]);
            else if constexpr (std::is_same_v<Value, std::vector<double>>) {
                auto list = std::make_unique<toml::array>();
                for (const double number : one) list->push_back(number);
                return list;
            } else
                return std::make_unique<toml::value<Value>>(one);
        },
        value);
}

/// Stores one setting in the case, overriding earlier values.
void take_setting(TestCase& test, const CaseSetting& setting) {
    const std::size_t dot = setting.key.find('.');
    std::string table = dot == std::string::npos ? "" : setting.key.substr(0, dot);
    const std::string key = dot == std::string::npos ? setting.key : setting.key.substr(dot + 1);
    std::size_t entry = 0;
    const std::size_t bracket = table.find('[');
    const TableDescription* list = find_table(table.substr(0, bracket));
    if (list != nullptr && list->repeated()) {
        const std::size_t count = list->count(test);
        const std::string number = bracket == std::string::npos ? "" : table.substr(bracket + 1);
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), entry);
        if (error != std::errc() || std::string(end, number.data() + number.size()) != "]" || entry < 1 ||
            entry > count) {
            throw InputError(fmt::format("{}: {:.40}: found no such table, expected {}[1] to {}[{}], as the case has",
                                         setting.where, table, list->name, list->name, count));
        }
        --entry;
        table = list->name;
    } else {
        if (list == nullptr) refuse_unknown(setting.where, "", table);
        forget_other_ways(test, [&](const std::string& other) { return other == setting.key; });
        if (!table.empty()) {
            test.table_present[table] = true;
            test.position.try_emplace(table, setting.where);
        }
    }
    take_value(test, setting.where, table, key, *node_of(setting.value), entry);
}

/// Whether the case states the quantity of a key by an alternative key.
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
    // By default, only platens that press are not glued. A real grip is stronger than the rock, and pads, jaws and
    // boxes are not made of rock.
    const TestKind& kind = test_kind(test.loading.kind);
    if (!kind.presses() && !test.position.contains("loading.platens")) test.loading.platens = PlatenKind::glued;
    if (test.loading.platens == PlatenKind::glued && !test.loading.grip)
        test.loading.grip = kind.pulls() ? default_grip : 0.0;
    if (test.title.empty()) test.title = test.source.stem().string();
}

}  // namespace

CaseFiles::CaseFiles(const fs::path& path) {
    TestCase written;
    written.source = path;
    take_with_includes(written, path, {});
    written_ = std::make_shared<const TestCase>(std::move(written));
}

CaseFiles::CaseFiles(const CaseText& text) {
    TestCase written;
    written.source = text.name;
    take_content(written, text.name,
                 text.json ? toml_of_json(text.name, text.text) : parse_toml_text(text.name, text.text), {});
    written_ = std::make_shared<const TestCase>(std::move(written));
}

ResolvedCase CaseFiles::with(std::span<const CaseSetting> settings, const RunScale& scale) const {
    TestCase test = *written_;
    for (const CaseSetting& setting : settings) take_setting(test, setting);
    fill_defaults(test);
    check_consistency(test);
    if (test.loading.axial_strain_rate) *test.loading.axial_strain_rate *= scale.rate;
    // The tolerance is proportional to the square of the rate.
    if (test.loading.rate_tolerance) *test.loading.rate_tolerance *= scale.rate * scale.rate;
    if (test.numerics.time_step) *test.numerics.time_step *= scale.step;
    ResolvedCase resolved = resolve(std::make_shared<const TestCase>(std::move(test)));
    resolved.step_scale = scale.step;
    return resolved;
}

JointCase CaseFiles::joints() const {
    TestCase test = *written_;
    for (const Parameter& p : case_parameters()) {
        if (p.table != "joints" && p.table != "joint_set" && p.table != "trace") continue;
        const TableDescription& table = *find_table(p.table);
        const std::size_t entries = table.repeated() ? table.count(test) : 1;
        for (std::size_t entry = 0; entry < entries; ++entry) fill_default(test, p, entry);
    }
    check_joints(test);
    return resolve_joints(std::make_shared<const TestCase>(std::move(test)));
}

ResolvedCase read_case(const fs::path& path) { return CaseFiles(path).with({}); }
ResolvedCase read_case(const CaseText& text) { return CaseFiles(text).with({}); }
JointCase joints_of(const ResolvedCase& test) { return resolve_joints(written_case(test)); }

namespace {

std::string quoted_text(const std::string& text) {
    std::ostringstream out;
    out << toml::value<std::string>(text);
    return out.str();
}

/// Formats a value as in a case file. @param folder  the folder that written paths are relative to
std::string written_value(const ResolvedKey& key, const fs::path& folder) {
    const Parameter& p = *key.parameter;
    const CaseValue& value = key.value;
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* number = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *number);
    const auto written = [](double number) {
        const std::string text = fmt::format("{}", number);
        return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
    };
    if (const auto* number = std::get_if<double>(&value)) return written(*number);
    if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
        std::vector<std::string> texts;
        for (const double number : *numbers) texts.push_back(written(number));
        return fmt::format("[{}]", fmt::join(texts, ", "));
    }
    if (const auto* texts = std::get_if<std::array<std::string, 2>>(&value))
        return fmt::format("[{}, {}]", quoted_text((*texts)[0]), quoted_text((*texts)[1]));
    const std::string& text = std::get<std::string>(value);
    if (!p.is_path) return quoted_text(text);
    return quoted_text(fs::absolute(key.file)
                           .lexically_normal()
                           .lexically_proximate(fs::absolute(folder).lexically_normal())
                           .generic_string());
}

/// Whether a table is omitted because it does not apply to this case.
bool left_out(const TestCase& test, const std::string& table) {
    if (table == "minerals") return !test.has_table("mineral");
    if (table == "joints") return !test.jointed();
    if (table == "shape" && test.uniaxial()) return true;
    return (table == "packing" || table == "mesh") && !test.has_table(table);
}

/// The keys of a case with their values, including values that are known only after the specimen has been made.
std::vector<ResolvedKey> keys_with(const ResolvedCase& resolved, const MadeValues& made) {
    TestCase test = *written_case(resolved);
    test.numerics.threads = resolved.numerics.threads;
    test.numerics.allow_unstable = resolved.numerics.allow_unstable;
    if (made.mesh_thick) test.mesh.thick = made.mesh_thick;
    if (made.frames) test.output.frames = made.frames;
    std::vector<ResolvedKey> keys;
    for (const TableDescription& table : case_tables()) {
        if (left_out(test, table.name)) continue;
        const std::size_t entries = table.repeated() ? table.count(test) : 1;
        for (std::size_t entry = 0; entry < entries; ++entry) {
            for (const Parameter& p : case_parameters()) {
                if (p.table != table.name) continue;
                const std::optional<CaseValue> value = p.get(test, entry);
                if (!value) continue;
                const std::string label = key_label(p, entry);
                keys.push_back({label, &p, *value,
                                p.is_path ? test.resolve_path(label, std::get<std::string>(*value)) : fs::path()});
            }
        }
    }
    return keys;
}

}  // namespace

std::vector<ResolvedKey> resolved_keys(const ResolvedCase& test) { return keys_with(test, {}); }

void write_resolved_case(std::ostream& out, const ResolvedCase& test, const fs::path& folder, const MadeValues& made) {
    std::string table;
    for (const ResolvedKey& key : keys_with(test, made)) {
        const Parameter& p = *key.parameter;
        const std::string own = key.label.substr(0, key.label.size() - p.key.size());
        if (own != table) {
            const TableDescription& described = *find_table(p.table);
            out << '\n' << described.heading() << "  # " << described.sentence << '\n';
            table = own;
        }
        out << fmt::format("{} = {}  # {}{}\n", p.key, written_value(key, folder), p.unit.empty() ? "" : p.unit + ": ",
                           p.sentence);
    }
}

void describe_case_keys(std::ostream& out) {
    out << "include = \"FILE\" at the top of a case: FILE supplies the values of keys that the case does not set, and "
           "may itself include another file. A list in the case, such as [[mineral]], replaces the whole list in FILE. "
           "A line may have at most "
        << longest_toml_line << " bytes.\n";
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
