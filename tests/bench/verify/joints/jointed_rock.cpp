// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/joints/jointed_rock.hpp"

#include <fmt/format.h>

#include <numbers>

#include "tests/bench/verify/scenes/packed_case.hpp"

namespace crackle::verification {

ResolvedCase jointed_rock(SpecimenKind kind, std::int64_t seed) {
    ResolvedCase test = packed_case(seed, LoadingKind::compression, 0.1, 1e-3);
    test.packing()->box = parts::Box{rock_width, rock_height};
    test.material.units = StiffnessUnits::area;
    test.material.normal_stiffness = rock_modulus;
    test.material.shear_stiffness = rock_modulus / rock_ratio;
    test.material.tensile_strength = 50e6;
    test.material.cohesion = 150e6;
    test.material.friction_angle = 40.0;
    test.bond.law = BondLaw::coulomb;
    if (kind == SpecimenKind::circles) {
        test.bond.range = bonded_range;
        return test;
    }
    test.mesh = parts::Mesh{{}, from_name<MeshKind>(name_of(kind)).value(), parts::MeshGap{8e-4, {}}};
    return test;
}

void add_set(ResolvedCase& test, double angle, double spacing, Vec2 through, const Joint& mechanics) {
    constexpr double radians = std::numbers::pi / 180.0;
    test.joints.sets.push_back({fmt::format("set {}", test.joints.sets.size() + 1),
                                OrientationLaw::fixed(angle * radians),
                                PersistentTraces{},
                                {AmountKind::spacing, spacing, LengthLaw::fixed(spacing), through},
                                {},
                                mechanics});
}

}  // namespace crackle::verification
