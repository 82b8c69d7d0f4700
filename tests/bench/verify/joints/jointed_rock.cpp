// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/joints/jointed_rock.hpp"

#include <fmt/format.h>

#include "tests/bench/verify/scenes/packed_case.hpp"

namespace crackle::verification {

TestCase jointed_rock(SpecimenKind kind, std::int64_t seed) {
    TestCase test = packed_case(seed, LoadingKind::compression, 0.1, 1e-3);
    test.packing.count.reset();
    test.packing.height_to_width.reset();
    test.packing.width = rock_width;
    test.packing.height = rock_height;
    test.material.normal_stiffness.reset();
    test.material.shear_stiffness.reset();
    test.material.units = StiffnessUnits::area;
    test.material.contact_modulus = rock_modulus;
    test.material.stiffness_ratio = rock_ratio;
    test.material.tensile_strength = 50e6;
    test.material.cohesion = 150e6;
    test.material.friction_angle = 40.0;
    test.bond.law = BondLaw::coulomb;
    if (kind == SpecimenKind::circles) {
        test.bond.range = bonded_range;
        return test;
    }
    test.mesh.kind = from_name<MeshKind>(name_of(kind));
    test.mesh.thick = 8e-4;
    test.table_present["mesh"] = true;
    return test;
}

void add_set(TestCase& test, double angle, double spacing, Vec2 through, const TestCase::JointKeys& own) {
    TestCase::JointSet set;
    set.name = fmt::format("set {}", test.joint_set.size() + 1);
    set.angle = angle;
    set.spacing = spacing;
    set.through = std::vector{through.x, through.y};
    set.own = own;
    test.joint_set.push_back(set);
}

}  // namespace crackle::verification
