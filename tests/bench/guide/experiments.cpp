// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/guide/experiments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/errors.hpp"

namespace crackle::studies {
namespace {

constexpr Reach everything{};
constexpr Reach runs{.elastic = false};
constexpr Reach elastic{.tension = false, .compression = false};
constexpr Reach squeezing{.elastic = false, .tension = false};

void set_damping(TestCase& test, double ratio) { test.material.damping_ratio = ratio; }

void set_radii(TestCase& test, double least, double largest) {
    test.packing.radius_min = least;
    test.packing.radius_max = largest;
}

void set_platens(TestCase& test, double friction_angle) {
    test.loading.platens = PlatenKind::frictional;
    test.loading.platen_friction_angle = friction_angle;
}

/// Scales the overlaps at bonding, for circles and polygons.
void scale_overlap(TestCase& test, double factor) {
    test.packing.mean_overlap = factor * *test.packing.mean_overlap;
    if (test.bond.thick) test.bond.thick = *test.mesh.thick + factor * (*test.bond.thick - *test.mesh.thick);
}

}  // namespace

bool Reach::holds(const std::string& specimen, const std::string& loading) const {
    const bool body = specimen == "circles" ? circles : polygons;
    return body && (loading == "tension" ? tension : loading == "compression" ? compression : elastic);
}

const std::vector<GuideExperiment>& guide_experiments() {
    static const std::vector<GuideExperiment> all{
        {as_shipped, "the shipped cases", everything, [](TestCase&) {}},
        {"seeds_boundary", "triangles between the centres only, mesh.boundary = \"seeds\"; no platens", elastic,
         [](TestCase& test) {
             if (test.mesh.kind == MeshKind::delaunay) test.mesh.boundary = Boundary::centres;
             test.mesh.merge_destroyed = test.has_table("mesh");  // merges slivers at the uneven outline
         },
         true},
        {"narrow_radii", "radii from 1.8 to 2.2 cm instead of 1.333 to 2.667", everything,
         [](TestCase& test) { set_radii(test, 1.8e-2, 2.2e-2); }},
        {"wide_radii", "radii from 0.8 to 3.2 cm instead of 1.333 to 2.667", everything,
         [](TestCase& test) { set_radii(test, 0.8e-2, 3.2e-2); }},
        {"square", "as high as wide instead of twice as high", everything,
         [](TestCase& test) { test.packing.height_to_width = 1.0; }},
        {"double_overlap", "twice the overlap at bonding", everything,
         [](TestCase& test) { scale_overlap(test, 2.0); }},
        {"equal_springs", "k_s = k_n instead of k_n/4", everything,
         [](TestCase& test) { test.material.shear_stiffness = *test.material.normal_stiffness; }},
        {"soft_shear", "k_s = k_n/16 instead of k_n/4", everything,
         [](TestCase& test) { test.material.shear_stiffness = *test.material.normal_stiffness / 16.0; }},
        {"low_friction", "friction angle 10 degrees instead of 27", runs,
         [](TestCase& test) { test.material.friction_angle = 10.0; }},
        {"low_damping", "damping ratio 0.02 instead of 0.2", runs, [](TestCase& test) { set_damping(test, 0.02); }},
        {"high_damping", "damping ratio 1 instead of 0.2", runs, [](TestCase& test) { set_damping(test, 1.0); }},
        {"frictional_platens", "platens not bonded, friction 27 degrees", squeezing,
         [](TestCase& test) { set_platens(test, 27.0); }},
        {"smooth_platens", "platens not bonded, without friction", squeezing,
         [](TestCase& test) { set_platens(test, 0.0); }},
        {"fast", "loaded eight times as fast", runs, [](TestCase& test) { test.loading.scale_rate(8.0); }},
    };
    return all;
}

const GuideExperiment& guide_experiment(const std::string& name) {
    const auto& all = guide_experiments();
    const auto found = std::find_if(all.begin(), all.end(), [&](const GuideExperiment& e) { return e.name == name; });
    if (found == all.end()) throw InputError(fmt::format("found no experiment '{}' of the guide's rock", name));
    return *found;
}

}  // namespace crackle::studies
