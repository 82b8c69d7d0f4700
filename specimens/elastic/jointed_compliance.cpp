// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/elastic/jointed_compliance.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "solver/base/correctly_rounded.hpp"
#include "specimens/joints/joint_network.hpp"
#include "specimens/making/make_specimen.hpp"
#include "specimens/setup/bonded_specimen.hpp"

namespace crackle {
namespace {

/// Reason why the formulas for persistent joints do not apply; empty if they do.
std::string not_persistent(const JointNetwork& network) {
    for (const JointTrace& trace : network.traces) {
        if (std::isinf(trace.whole_length)) continue;
        return fmt::format("the traces of {} end within the box", network.sources[trace.source].name);
    }
    return network.traces.empty() ? "no trace is in the box" : "";
}

void add(Compliance& sum, const Compliance& other) {
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column) sum[row][column] += other[row][column];
}

}  // namespace

std::optional<JointedCompliance> jointed_compliance(const ResolvedCase& test, const TestHooks& hooks) {
    if (test.joints.empty()) return std::nullopt;
    const Specimen specimen = make_specimen(test, hooks);
    if (!specimen.shape.whole()) return std::nullopt;
    const Domain& box = specimen.scene.domain;
    const double inset = 0.5 * specimen.mesh_gap;
    JointedCompliance found;
    hooks.report_work("solving for the compliance");
    found.jointed = compliance_of(bond_alone(specimen, test.bond, test), box, inset);
    found.welded = compliance_of(bond_alone(specimen, test.bond, test, Traces::welded), box, inset);
    const std::size_t centres =
        specimen.centres > 0 ? static_cast<std::size_t>(specimen.centres) : specimen.scene.bodies.size();
    const JointNetwork network = make_joints(test.joints, box, centres);
    found.why_not = not_persistent(network);
    if (!found.why_not.empty()) return found;
    found.expected = found.welded;
    constexpr double rigid = std::numeric_limits<double>::infinity();
    for (const JointTrace& trace : network.traces) {
        const Joint joint = network.sources[trace.source].mechanics.value_or(Joint{});
        const Vec2 along = trace.points.back() - trace.points.front();
        add(*found.expected,
            compliance_of_set(correctly_rounded::atan2(along.y, along.x), network.area() / trace.length(),
                              joint.normal_stiffness.value_or(rigid), joint.shear_stiffness.value_or(rigid)));
    }
    return found;
}

}  // namespace crackle
