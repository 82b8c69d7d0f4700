// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/joint_keys.hpp"

#include <fmt/format.h>

#include <utility>

#include "specimens/case/declare_parameter.hpp"

namespace crackle {
namespace {

/// Joint keys of a repeated table. @param list  function that returns the table's entries, which contain JointKeys
template <class List>
std::vector<Parameter> mechanics_in(const char* table, List list) {
    using Keys = TestCase::JointKeys;
    using namespace declaring;
    const auto key = [&](auto member, const char* name, const char* unit, const char* sentence) {
        const auto reach_in = [list, member](TestCase& c, std::size_t entry) -> decltype(auto) {
            return (list(c)[entry].own.*member);
        };
        return With{declare(table, name, unit, reach_in, sentence)};
    };
    const auto angle = [&](auto member, const char* name, const char* sentence) {
        return key(member, name, "deg", sentence).at_least(0).below(90);
    };
    return {key(&Keys::bonded, "bonded", "",
                "Whether bonds hold the joint's faces together. false: the joint is open, so its faces only press "
                "against each other and slide. true if not given."),
            key(&Keys::strength_factor, "strength_factor", "",
                "Factor by which the rock's tensile strength and cohesion are multiplied; 1 if not given. Mechanical "
                "properties of joints need bond.law = \"coulomb\" or \"face\", and material.units = \"area\"; those "
                "that are not given are the rock's.")
                .at_least(0)
                .at_most(1e6),
            key(&Keys::tensile_strength, "tensile_strength", "Pa",
                "Tensile strength of the joint's bonds, in place of the rock's tensile strength times strength_factor; "
                "at 0, a bond breaks as soon as it is in tension.")
                .at_least(0),
            key(&Keys::cohesion, "cohesion", "Pa",
                "Cohesion of the joint's bonds, in place of the rock's cohesion times strength_factor; at least "
                "tan(friction_angle) times the tensile strength.")
                .at_least(0),
            angle(&Keys::friction_angle, "friction_angle",
                  "Friction angle of the joint's bonds, and also of its unbonded faces if residual_friction_angle is "
                  "not given."),
            angle(&Keys::residual_friction_angle, "residual_friction_angle",
                  "Friction angle of the joint's faces after its bonds have broken; at most friction_angle."),
            key(&Keys::normal_stiffness, "normal_stiffness", "Pa/m",
                "Normal stiffness K_n, normal stress per unit closure, in series with the stiffness of the faces: 1/k "
                "= 1/k_face + 1/(K_n L). Infinite if not given.")
                .above(0),
            key(&Keys::shear_stiffness, "shear_stiffness", "Pa/m",
                "Shear stiffness K_s, shear stress per unit shear displacement before sliding, in series with the "
                "shear stiffness of the faces. Infinite if not given.")
                .above(0),
            angle(&Keys::dilation_angle, "dilation_angle",
                  "Sliding faces open by tan(dilation_angle) times their slip, in whichever direction they slide; at "
                  "most the friction angle at which they slide."),
            key(&Keys::dilation_slip, "dilation_slip", "m",
                "Total slip after which sliding faces open no further; no limit if not given.")
                .above(0),
            key(&Keys::aperture, "aperture", "m",
                "Closure at which the faces of an open joint begin to carry force; at most the gap of the mesh, or "
                "the radius of the smallest circle.")
                .above(0),
            key(&Keys::residual_cohesion, "residual_cohesion", "Pa",
                "Cohesion of the joint's faces after they have failed in shear, with bond.law = \"face\"; the rock's "
                "value if not given, but at most the joint's cohesion.")
                .at_least(0),
            key(&Keys::softening_slip, "softening_slip", "m",
                "Slip over which the cohesion of the joint's faces falls to residual_cohesion; the rock's value if not "
                "given.")
                .at_least(0)};
}

}  // namespace

std::vector<Parameter> joint_mechanics_keys() {
    std::vector<Parameter> all = mechanics_in("joint_set", [](TestCase& c) -> decltype(auto) { return (c.joint_set); });
    const std::vector<Parameter> own = mechanics_in("trace", [](TestCase& c) -> decltype(auto) { return (c.trace); });
    all.insert(all.end(), own.begin(), own.end());
    return all;
}

std::vector<JointTable> joint_tables(const TestCase& test) {
    std::vector<JointTable> tables;
    for (std::size_t k = 0; k < test.joint_set.size(); ++k)
        tables.push_back({fmt::format("joint_set[{}]", k + 1), &test.joint_set[k].own});
    for (std::size_t k = 0; k < test.trace.size(); ++k)
        tables.push_back({fmt::format("trace[{}]", k + 1), &test.trace[k].own});
    return tables;
}

}  // namespace crackle
