// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/scenes/packed_case.hpp"

namespace crackle::verification {

TestCase packed_case(std::int64_t seed, LoadingKind kind, double rate, double max_strain) {
    TestCase test;
    test.title = "verification";
    test.source = "verification.toml";  // only named in errors
    test.packing.count = 120;
    test.packing.height_to_width = 2.0;
    test.packing.radius_min = 0.015;
    test.packing.radius_max = 0.025;
    test.packing.mean_overlap = 7.74e-5;
    test.packing.seed = seed;
    test.table_present["packing"] = true;
    test.material.density = 2500.0;
    test.material.normal_stiffness = 1e7;
    test.material.shear_stiffness = 2.5e6;
    test.material.friction_angle = 27.0;
    test.material.damping_ratio = 0.2;
    test.loading.kind = kind;
    test.loading.axial_strain_rate = rate;
    test.loading.max_axial_strain = max_strain;
    test.loading.strength_drop = 0.1;
    test.loading.stop_at_share_of_peak = 0.5;
    test.numerics.safety_factor = 0.8;
    test.output.curve_rows = 2000;
    test.output.frames = 1;
    test.output.checkpoint_interval = 1e9;
    return test;
}

void mesh_voronoi(TestCase& test) {
    test.mesh.kind = MeshKind::voronoi;
    test.mesh.thick = 1e-3;
    test.mesh.merge_destroyed = true;
    test.table_present["mesh"] = true;
    test.bond.thick = 1.08e-3;
}

}  // namespace crackle::verification
