// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/scenes/packed_case.hpp"

namespace crackle::verification {

ResolvedCase packed_case(std::int64_t seed, LoadingKind kind, double rate, double max_strain) {
    ResolvedCase test;
    test.title = "verification";
    test.source =
        parts::Packing{parts::CircleCount{120, 2.0}, parts::MeanOverlap{7.74e-5}, UniformRadii{0.015, 0.025}, seed};
    test.material.density = 2500.0;
    test.material.normal_stiffness = 1e7;
    test.material.shear_stiffness = 2.5e6;
    test.material.friction_angle = 27.0;
    test.material.damping_ratio = 0.2;
    test.loading.kind = kind;
    test.loading.rate = parts::StrainRate{rate};
    test.loading.max_axial_strain = max_strain;
    test.loading.strength_drop = 0.1;
    test.loading.stop_at_share_of_peak = 0.5;
    test.output.frames = 1;
    test.output.checkpoint_interval = 1e9;
    return test;
}

void mesh_voronoi(ResolvedCase& test) {
    test.mesh = parts::Mesh{{Boundary::domain, true}, MeshKind::voronoi, parts::MeshGap{1e-3, {}}};
    test.bond.thick = 1.08e-3;
}

}  // namespace crackle::verification
