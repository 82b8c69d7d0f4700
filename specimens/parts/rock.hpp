// SPDX-License-Identifier: GPL-3.0-or-later
// The rock of a test: its material, minerals and bonds.
// Tested by tests/specimens/case/resolve_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "solver/base/names.hpp"
#include "solver/laws/face_bond.hpp"
#include "solver/laws/face_constants.hpp"
#include "solver/scene/bond_strength.hpp"
#include "solver/scene/scene.hpp"

namespace crackle {

/// Damping ratio of a packing if the case sets no damping. A particle vibrating on its contacts then loses 95 % of its
/// energy per period, since exp(-4πh) = 1/20. This damping reduces the stable time step by a fifth.
inline constexpr double default_damping_ratio = 0.2383941;  // ln(20)/(4π)

/// Whether two pairs of materials have the same values.
inline bool operator==(const MaterialPair& one, const MaterialPair& other) {
    const auto values = [](const MaterialPair& pair) {
        return std::tie(pair.a, pair.b, pair.normal_stiffness, pair.shear_stiffness, pair.friction_angle, pair.bond);
    };
    return values(one) == values(other);
}

namespace parts {

/// Values that replace the values of a material: all of them for a packing, or only those to change in a particle file.
struct MaterialValues : BondConstants, FaceConstants {
    std::optional<double> density;                        // kg/m2
    std::optional<double> normal_stiffness;               // N/m, or Pa
    std::optional<double> shear_stiffness;                // N/m, or Pa
    std::optional<double> friction_angle;                 // degrees
    std::optional<double> damping_ratio;                  // -
    std::optional<double> normal_damping, shear_damping;  // N s/m; either of them replaces a damping ratio

    /// Stiffnesses of faces of this rock. @throws InputError if no stiffnesses give this Poisson's ratio with this
    /// ratio of k_n to k_s
    FaceModuli face_moduli() const;
    /// Law of faces of this rock.
    FaceLaw face_law() const;
    double mesh_correction = 0.0;           ///< c_κ of the rock's mesh (solver/laws/face_bond.hpp)
    std::optional<double> stiffness_ratio;  ///< k_n over k_s of faces; empty: no pressure acts in the cells

    /// Replaces the values of `material`. Absent strengths become 0; the residual angle defaults to the friction angle.
    void apply_to(crackle::Material& material) const;

    bool operator==(const MaterialValues&) const = default;
};

/// The material of the particles and of the parts that hold them.
struct Material : MaterialValues {
    StiffnessUnits units = StiffnessUnits::point;
    bool damping_by_default = false;  ///< whether the damping ratio is default_damping_ratio

    bool operator==(const Material&) const = default;
};

/// A mineral.
struct Mineral {
    std::string name;
    MaterialValues material;
    std::optional<double> asked;  ///< area fraction that the case states
    double share = 0.0;           ///< requested area fraction: as stated, or what the other minerals leave

    bool operator==(const Mineral&) const = default;
};

/// Minerals that are assigned to grains at random until the areas are as requested.
struct RandomGrains {
    std::int64_t seed = 1;

    bool operator==(const RandomGrains&) const = default;
};

/// Minerals by size: the largest grains get the mineral listed first.
struct GrainsBySize {
    bool operator==(const GrainsBySize&) const = default;
};

/// A file with the mineral of each grain.
struct GrainLabels {
    std::filesystem::path path;

    bool operator==(const GrainLabels&) const = default;
};

/// An image laid over the box, in which each mineral has a colour.
struct GrainImage {
    std::filesystem::path path;
    std::string name;                         ///< name of the image in messages
    std::vector<std::uint32_t> colours = {};  ///< 0xrrggbb, one per mineral

    bool operator==(const GrainImage&) const = default;
};

/// The minerals of the grains; the list is empty if the rock has a single material.
struct Minerals {
    std::vector<Mineral> list;
    std::vector<MaterialPair> pairs;  ///< indices into `list`
    std::variant<RandomGrains, GrainsBySize, GrainLabels, GrainImage> assign;

    /// Whether the case states area fractions.
    bool by_share() const {
        return std::holds_alternative<RandomGrains>(assign) || std::holds_alternative<GrainsBySize>(assign);
    }

    bool operator==(const Minerals&) const = default;
};

/// A random factor on the strengths of bonds.
struct RandomStrengths {
    StrengthDistribution distribution = StrengthDistribution::weibull;
    double cv = 0.0;  ///< coefficient of variation
    std::int64_t seed = 0;

    bool operator==(const RandomStrengths&) const = default;
};

/// Values of bonds that are taken from the case without change.
struct BondValues {
    BondLaw law = BondLaw::back_tension;
    std::optional<double> thick;  ///< m; empty: the gap of the mesh, or a tenth of the mean radius
    std::optional<double> gap;    ///< m; empty: a twentieth of the thickness
    double range = 0.0;           // -
    /// Strengths divided by the mean back-tension; if present, they replace the strengths of the materials.
    std::optional<double> tensile_factor, cohesion_factor;

    /// Properties of the bonds' law.
    const BondLawFacts& facts() const { return facts_of(law); }

    bool operator==(const BondValues&) const = default;
};

/// The bonds between particles.
struct Bonds : BondValues {
    std::optional<RandomStrengths> random;  ///< empty: all bonds have the strengths of their materials

    bool operator==(const Bonds&) const = default;
};

}  // namespace parts
}  // namespace crackle
