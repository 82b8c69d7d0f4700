// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/face_bonds.hpp"

#include <limits>
#include <unordered_map>

namespace crackle {
namespace {

/// Replaces constants of a face law with the values that the case states for a pair of minerals.
FaceLaw law_of_pair(FaceLaw law, const MaterialPair& pair) {
    if (pair.bond.tensile_strength) law.tensile_strength = *pair.bond.tensile_strength;
    if (pair.bond.cohesion) law.cohesion = *pair.bond.cohesion;
    if (pair.friction_angle) law.friction = friction_coefficient(*pair.friction_angle);
    if (pair.bond.residual_friction_angle)
        law.residual_friction = friction_coefficient(*pair.bond.residual_friction_angle);
    return law;
}

/// Reference points in the order of the bodies of the world, which differs from their order in the scene.
std::vector<Vec2> references_of(const World& world, const Specimen& specimen) {
    if (specimen.cell_centres.empty()) return {};
    std::unordered_map<int, Vec2> centre_of_id;
    for (std::size_t k = 0; k < specimen.cell_centres.size(); ++k)
        centre_of_id.emplace(specimen.scene.bodies[k].id, specimen.cell_centres[k]);
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    std::vector<Vec2> references;
    references.reserve(world.bodies.size());
    for (const BodyName& body : world.bodies.names) {
        const auto found = centre_of_id.find(body.id);
        references.push_back(found == centre_of_id.end() ? Vec2{unknown, unknown} : found->second);
    }
    return references;
}

}  // namespace

FaceBonding face_bonding_of(const World& world, const Specimen& specimen, const parts::Bonds& bonds, PlatenKind platens,
                            double gap) {
    FaceBonding bonding;
    for (std::size_t m = 0; m < world.settings.materials.size(); ++m) {
        const std::vector<parts::Mineral>& minerals = specimen.mineral_parts.list;
        parts::MaterialValues values = m < minerals.size() ? minerals[m].material : specimen.material;
        // A particle file may state the friction angle.
        if (!values.friction_angle) values.friction_angle = world.settings.materials[m].friction_angle;
        bonding.materials.push_back({values.face_moduli(), values.face_law()});
        bonding.materials.back().law.damping_ratio = world.settings.materials[m].damping_ratio.value_or(0.0);
    }
    for (const MaterialPair& pair : specimen.mineral_parts.pairs) {
        const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
        bonding.pairs.push_back(
            {a, b, law_of_pair(weaker_law(bonding.materials[a].law, bonding.materials[b].law), pair)});
    }
    bonding.gap = gap;
    bonding.reference = references_of(world, specimen);
    bonding.platens = platens == PlatenKind::glued ? PlatenFaces::glued : PlatenFaces::bonded;
    if (const auto& random = bonds.random)
        bonding.factors = StrengthFactors(random->distribution, random->cv, random->seed);
    return bonding;
}

}  // namespace crackle
