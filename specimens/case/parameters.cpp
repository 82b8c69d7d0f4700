// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "specimens/case/joint_keys.hpp"
#include "specimens/case/loading_keys.hpp"
#include "specimens/case/specimen_keys.hpp"

namespace crackle {
namespace {

/// Turns a key of [material] into a key of a list whose entries contain MaterialKeys.
template <class List>
Parameter owned(const Parameter& of_material, std::string table, List list) {
    Parameter p = of_material;
    p.table = std::move(table);
    p.presence = Presence::optional;
    p.default_value.reset();
    p.forget = {};
    p.set = [set = p.set, list](TestCase& c, const CaseValue& value, std::size_t entry) {
        TestCase material_alone;
        material_alone.material = list(c)[entry].own;
        set(material_alone, value, 0);
        list(c)[entry].own = material_alone.material;
    };
    p.get = [get = p.get, list](const TestCase& c, std::size_t entry) {
        TestCase material_alone;
        material_alone.material = list(c)[entry].own;
        return get(material_alone, 0);
    };
    return p;
}

/// Adds the keys of minerals and mineral pairs. Minerals have all numeric keys of [material], mineral pairs only the
/// keys that describe a contact.
void add_minerals_keys(std::vector<Parameter>& all) {
    const auto minerals = [](auto& c) -> auto& { return c.mineral; };
    const auto pairs = [](auto& c) -> auto& { return c.mineral_pair; };
    const std::vector<std::string>& of_pairs = mineral_pair_keys();
    std::vector<Parameter> own;
    for (const Parameter& p : all) {
        if (p.table != "material" || p.kind != ValueKind::real) continue;
        own.push_back(owned(p, "mineral", minerals));
        if (std::find(of_pairs.begin(), of_pairs.end(), p.key) != of_pairs.end())
            own.push_back(owned(p, "mineral_pair", pairs));
    }
    all.insert(all.end(), own.begin(), own.end());
}

}  // namespace

const std::vector<Parameter>& case_parameters() {
    static const std::vector<Parameter> all = [] {
        std::vector<Parameter> declared = specimen_keys();
        std::ranges::move(loading_keys(), std::back_inserter(declared));
        std::ranges::move(joint_mechanics_keys(), std::back_inserter(declared));
        add_minerals_keys(declared);
        return declared;
    }();
    return all;
}

const std::vector<std::string>& mineral_pair_keys() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> keys{"normal_stiffness", "shear_stiffness", "friction_angle", "contact_modulus",
                                      "stiffness_ratio"};
        for (const BondConstant& constant : all_bond_constants()) keys.emplace_back(constant.key);
        return keys;
    }();
    return all;
}

std::vector<std::string> material_tables(const TestCase& test) {
    std::vector<std::string> all{"material"};
    for (std::size_t k = 0; k < test.mineral.size(); ++k) all.push_back(fmt::format("mineral[{}]", k + 1));
    for (std::size_t k = 0; k < test.mineral_pair.size(); ++k) all.push_back(fmt::format("mineral_pair[{}]", k + 1));
    return all;
}

TestCase::MaterialKeys mineral_material(const TestCase& test, std::size_t mineral) {
    TestCase material_alone;
    material_alone.material = test.material;
    for (const Parameter& own : case_parameters()) {
        if (own.table != "mineral") continue;
        const std::optional<CaseValue> value = own.get(test, mineral);
        if (!value) continue;
        for (const Parameter& p : case_parameters())
            if (p.table == "material" && p.key == own.key) p.set(material_alone, *value, 0);
    }
    return material_alone.material;
}

TestCase::MaterialKeys pair_material(const TestCase& test, std::size_t pair) {
    TestCase::MaterialKeys keys = test.mineral_pair[pair].own;
    std::vector<std::optional<double> TestCase::MaterialKeys::*> weaker{&TestCase::MaterialKeys::friction_angle};
    for (const BondConstant& constant : all_bond_constants())
        if (!constant.is_angle) weaker.push_back(constant.given);
    for (const auto key : weaker) {
        if (keys.*key) continue;
        for (std::size_t k = 0; k < test.mineral.size(); ++k) {
            if (std::ranges::find(test.mineral_pair[pair].between, test.mineral[k].name) ==
                test.mineral_pair[pair].between.end())
                continue;
            const auto own = mineral_material(test, k).*key;
            if (own) keys.*key = std::min(own, keys.*key ? keys.*key : own);
        }
    }
    return keys;
}

const Parameter* find_parameter(const std::string& table, const std::string& key) {
    for (const Parameter& p : case_parameters()) {
        if (p.table == table && p.key == key) return &p;
    }
    return nullptr;
}

const std::vector<Alternatives>& case_alternatives() {
    static const std::vector<Alternatives> all{
        {{"packing.count", "packing.height_to_width"}, {"packing.width", "packing.height"}},
        {{"packing.cell_diameter", "packing.cell_spread"},
         {"packing.radius_min", "packing.radius_max", "packing.radius_median", "packing.radius_log_deviation",
          "packing.sieve"}},
        {{"packing.mean_overlap"}, {"packing.void_ratio"}},
        {{"material.damping_ratio"}, {"material.normal_damping", "material.shear_damping"}},
        {{"material.normal_stiffness", "material.shear_stiffness"},
         {"material.contact_modulus", "material.stiffness_ratio"}},
        {{"material.tensile_strength"}, {"bond.tensile_factor"}},
        {{"material.cohesion"}, {"bond.cohesion_factor"}},
        {{"loading.axial_strain_rate"}, {"loading.rate_tolerance"}},
        {{"loading.unload_at_strain"}, {"loading.unload_at_stress"}},
    };
    return all;
}

const std::vector<TableDescription>& case_tables() {
    static const std::vector<TableDescription> all{
        {"", "Keys at the top of the file."},
        {"particles", "A specimen read from a file, in place of [packing]."},
        {"packing", "A specimen made by packing circles, in place of [particles]."},
        {"mesh", "Turns the circles into polygons; without this table, they stay circles."},
        {"material", "Material of the specimen; with [particles], each key overrides the file's value."},
        {"minerals", "How the minerals listed below are assigned to the grains."},
        {"mineral",
         "One table per mineral; values that this table does not give are taken from [material], which also describes "
         "the platens.",
         [](const TestCase& c) { return c.mineral.size(); }, [](TestCase& c, std::size_t n) { c.mineral.resize(n); }},
        {"mineral_pair",
         "Properties of contacts between two minerals. Without this table, the springs of the two act in series, with "
         "the smaller of the two friction angles.",
         [](const TestCase& c) { return c.mineral_pair.size(); },
         [](TestCase& c, std::size_t n) { c.mineral_pair.resize(n); }},
        {"joints", "How traces of joints are generated."},
        {"joint_set", "One table per set of joints, whose traces are generated from the given distributions.",
         [](const TestCase& c) { return c.joint_set.size(); },
         [](TestCase& c, std::size_t n) { c.joint_set.resize(n); }},
        {"trace", "One table per measured trace, or per file of traces.",
         [](const TestCase& c) { return c.trace.size(); }, [](TestCase& c, std::size_t n) { c.trace.resize(n); }},
        {"bond", "Bonds between particles, and how they break."},
        {"shape", "Shape that is cut from the packing, for brazilian, bending and scb."},
        {"loading", "The kind of test, and how it is loaded: the lower platen is fixed, the upper one moves."},
        {"confinement", "Pressure on the sides, for a biaxial test."},
        {"numerics", "How the test is computed."},
        {"output", "What the test writes."},
    };
    return all;
}

}  // namespace crackle
