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

using Settings = std::vector<CaseSetting>;

CaseSetting set_key(const char* key, CaseValue value) { return {key, std::move(value), "guide:1"}; }

Settings set_damping(double ratio) { return {set_key("material.damping_ratio", ratio)}; }

Settings set_radii(double least, double largest) {
    return {set_key("packing.radius_min", least), set_key("packing.radius_max", largest)};
}

Settings set_platens(double friction_angle) {
    return {set_key("loading.platens", std::string("frictional")),
            set_key("loading.platen_friction_angle", friction_angle)};
}

/// Scales the overlaps at bonding, for circles and polygons.
Settings scale_overlap(const ResolvedCase& test, double factor) {
    Settings settings{
        set_key("packing.mean_overlap", factor * std::get<parts::MeanOverlap>(test.packing()->target).value)};
    if (test.mesh) {
        const double thick = std::get<parts::MeshGap>(test.mesh->gap).thick;
        settings.push_back(set_key("bond.thick", thick + factor * (*test.bond.thick - thick)));
    }
    return settings;
}

}  // namespace

bool Reach::holds(const std::string& specimen, const std::string& loading) const {
    const bool body = specimen == "circles" ? circles : polygons;
    return body && (loading == "tension" ? tension : loading == "compression" ? compression : elastic);
}

const std::vector<GuideExperiment>& guide_experiments() {
    static const std::vector<GuideExperiment> all{
        {as_shipped, "the shipped cases", everything, [](const ResolvedCase&) { return Settings{}; }},
        {"seeds_boundary", "triangles between the centres alone, mesh.boundary = \"seeds\"; nothing has platens",
         elastic,
         [](const ResolvedCase& test) {
             Settings settings;
             if (test.mesh && test.mesh->kind == MeshKind::delaunay)
                 settings.push_back(set_key("mesh.boundary", std::string("seeds")));
             if (test.mesh)  // merges slivers at the uneven outline
                 settings.push_back(set_key("mesh.merge_destroyed", true));
             return settings;
         },
         1.0, true},
        {"narrow_radii", "radii from 1.8 to 2.2 cm in place of 1.333 to 2.667", everything,
         [](const ResolvedCase&) { return set_radii(1.8e-2, 2.2e-2); }},
        {"wide_radii", "radii from 0.8 to 3.2 cm in place of 1.333 to 2.667", everything,
         [](const ResolvedCase&) { return set_radii(0.8e-2, 3.2e-2); }},
        {"square", "as high as wide in place of twice as high", everything,
         [](const ResolvedCase&) { return Settings{set_key("packing.height_to_width", 1.0)}; }},
        {"double_overlap", "twice the overlap at bonding", everything,
         [](const ResolvedCase& test) { return scale_overlap(test, 2.0); }},
        {"equal_springs", "k_s = k_n in place of k_n/4", everything,
         [](const ResolvedCase& test) {
             return Settings{set_key("material.shear_stiffness", *test.material.normal_stiffness)};
         }},
        {"soft_shear", "k_s = k_n/16 in place of k_n/4", everything,
         [](const ResolvedCase& test) {
             return Settings{set_key("material.shear_stiffness", *test.material.normal_stiffness / 16.0)};
         }},
        {"low_friction", "friction angle 10 degrees in place of 27", runs,
         [](const ResolvedCase&) { return Settings{set_key("material.friction_angle", 10.0)}; }},
        {"low_damping", "damping ratio 0.02 in place of 0.2", runs,
         [](const ResolvedCase&) { return set_damping(0.02); }},
        {"high_damping", "damping ratio 1 in place of 0.2", runs, [](const ResolvedCase&) { return set_damping(1.0); }},
        {"frictional_platens", "platens not bonded, friction 27 degrees", squeezing,
         [](const ResolvedCase&) { return set_platens(27.0); }},
        {"smooth_platens", "platens not bonded, without friction", squeezing,
         [](const ResolvedCase&) { return set_platens(0.0); }},
        {"fast", "loaded eight times as fast", runs, [](const ResolvedCase&) { return Settings{}; }, 8.0},
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
