// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/scenes/lattice_case.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "solver/demseg/geometry.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/scenes/temporary_folder.hpp"

namespace crackle::verification {

VirtualTest LatticeCase::bonded() const {
    Material material;
    material.density = 2500.0;
    material.normal_stiffness = kn;
    material.shear_stiffness = share * kn;
    material.friction_angle = 45.0;
    Scene scene = triangular_lattice(columns, rows, radius, overlap, material);
    double x1 = 1e9, x2 = -1e9, y1 = 1e9, y2 = -1e9;
    for (const CircleElement& circle : scene.circles) {
        x1 = std::min(x1, circle.centre.x), x2 = std::max(x2, circle.centre.x);
        y1 = std::min(y1, circle.centre.y), y2 = std::max(y2, circle.centre.y);
    }
    const double edge = radius - overlap;
    scene.domain = {x1 - edge, x2 + edge + room, y1 - edge, y2 + edge, {true, true, true, true}};
    scene.time_step = 1e-8;
    const TemporaryFolder folder;
    {
        std::ofstream out(folder.path() / "lattice.dat");
        write_geometry(out, scene);
    }
    const char* const cells = hexagons ? "tensile_strength = 1e4\ncohesion = 1e5\n[mesh]\nkind = \"voronoi\"\n"
                                         "[bond]\nlaw = \"coulomb\"\n"
                                       : "";
    std::ofstream(folder.path() / "case.toml") << "[particles]\nfile = \"lattice.dat\"\n[material]\n"
                                               << "damping_ratio = 0.1\n"
                                               << cells << shape << loading;
    return bond_test(read_case(folder.path() / "case.toml"));
}

double LatticeCase::modulus() const {
    return (hexagons ? 4.0 : 1.0) * kn * 2.0 * std::sqrt(3.0) * (1.0 + share) / (3.0 + share);
}

}  // namespace crackle::verification
