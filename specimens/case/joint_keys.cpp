// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/joint_keys.hpp"

#include <fmt/format.h>

#include <utility>

#include "specimens/case/declare_parameter.hpp"

namespace crackle {
namespace {

/// @param list  gives the tables of a case, whose entries hold JointKeys of their own
template <class List>
void add_mechanics(std::vector<Parameter>& all, const char* table, List list) {
    using Keys = TestCase::JointKeys;
    using namespace declaring;
    const auto key = [&](auto member, const char* name, const char* unit, const char* sentence) {
        const auto reach_in = [list, member](TestCase& c, std::size_t entry) -> decltype(auto) {
            return (list(c)[entry].own.*member);
        };
        return With{declare(table, name, unit, reach_in, sentence)};
    };
    all.push_back(key(&Keys::bonded, "bonded", "",
                      "Whether bonds hold its faces together; false: open, they push, rub and slide from the start. "
                      "Bonded if not given."));
    all.push_back(key(&Keys::strength_factor, "strength_factor", "",
                      "Times the rock's tensile strength and cohesion; 1 if not given. Mechanics of joints need "
                      "bond.law = \"coulomb\" and material.units = \"area\"; what is not given is as in the rock.")
                      .at_least(0)
                      .at_most(1e6));
    all.push_back(key(&Keys::tensile_strength, "tensile_strength", "Pa",
                      "Of its bonds, in place of the rock's times strength_factor; at 0 one breaks when it is pulled.")
                      .at_least(0));
    all.push_back(
        key(&Keys::cohesion, "cohesion", "Pa", "Likewise; at least tan(friction_angle) times the tensile strength.")
            .at_least(0));
    all.push_back(key(&Keys::friction_angle, "friction_angle", "deg",
                      "Of its bonds, and of its faces without bonds where residual_friction_angle is not given.")
                      .at_least(0)
                      .below(90));
    all.push_back(key(&Keys::residual_friction_angle, "residual_friction_angle", "deg",
                      "Of its faces once bonds have broken, at most friction_angle.")
                      .at_least(0)
                      .below(90));
    all.push_back(key(&Keys::normal_stiffness, "normal_stiffness", "Pa/m",
                      "K_n, stress a closure, in series with the faces' own stiffness: 1/k = 1/k_face + 1/(K_n L). "
                      "None of its own, as if infinite, if not given.")
                      .above(0));
    all.push_back(key(&Keys::shear_stiffness, "shear_stiffness", "Pa/m", "K_s, stress a slip before sliding, likewise.")
                      .above(0));
    all.push_back(key(&Keys::dilation_angle, "dilation_angle", "deg",
                      "Faces that slide open by tan(dilation_angle) of their slip, whatever its direction; at most the "
                      "friction angle that they slide at.")
                      .at_least(0)
                      .below(90));
    all.push_back(
        key(&Keys::dilation_slip, "dilation_slip", "m", "Slip after which they open no farther; none if not given.")
            .above(0));
    all.push_back(key(&Keys::aperture, "aperture", "m",
                      "Of an open joint: way that its faces close without force; at most the gap of the mesh, among "
                      "circles the radius of the smallest.")
                      .above(0));
}

}  // namespace

std::vector<Parameter> joint_mechanics_keys() {
    std::vector<Parameter> all;
    add_mechanics(all, "joint_set", [](TestCase& c) -> decltype(auto) { return (c.joint_set); });
    add_mechanics(all, "trace", [](TestCase& c) -> decltype(auto) { return (c.trace); });
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
