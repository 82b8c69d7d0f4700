// SPDX-License-Identifier: GPL-3.0-or-later
// One test case as written, with defaults filled in. case_file.hpp reads it, parameters.hpp declares its keys, and
// resolve.hpp turns it into the parts that the stages of a test use.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/base/names.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// How minerals are assigned to grains.
enum class MineralAssignment : std::uint8_t { random, size, labels, image };
constexpr auto list_names(MineralAssignment) { return in_order("random", "size", "labels", "image"); }

/// Orientation of the modelled section through a 3D joint system.
enum class JointSection : std::uint8_t { vertical, horizontal };
constexpr auto list_names(JointSection) { return in_order("vertical", "horizontal"); }

/// Distribution of the orientations of a joint set.
enum class JointOrientation : std::uint8_t { fixed, uniform, von_mises, fisher };
constexpr auto list_names(JointOrientation) { return in_order("fixed", "uniform", "von_mises", "fisher"); }

/// Distribution of trace lengths.
enum class JointLength : std::uint8_t { persistent, gaps, fixed, uniform, lognormal, exponential, power_law };
constexpr auto list_names(JointLength) {
    return in_order("persistent", "gaps", "fixed", "uniform", "lognormal", "exponential", "power_law");
}

/// Distribution of the spacing between the lines of a joint set.
enum class JointSpacing : std::uint8_t { fixed, uniform, exponential, lognormal };
constexpr auto list_names(JointSpacing) { return in_order("fixed", "uniform", "exponential", "lognormal"); }

/// Default grip: fraction of the height at each end that glued platens hold in tension.
inline constexpr double default_grip = 0.1;

/// One virtual test as the user wrote it, with defaults filled in. Units and ranges: see parameters.hpp.
struct TestCase : WrittenPlaces {
    std::string title;

    /// Table [particles].
    struct Particles {
        std::optional<std::string> file;  ///< path as written in the case file; resolve_path() resolves it
    } particles;

    /// Table [packing].
    struct Packing {
        std::optional<double> width, height;  // m
        std::optional<std::int64_t> count;  // number of circles; used with height_to_width instead of width and height
        std::optional<double> height_to_width;  // -
        RadiusLaw sizes = RadiusLaw::uniform;
        std::optional<double> radius_min, radius_max;               // m
        std::optional<double> radius_median, radius_log_deviation;  // m, -
        std::optional<std::string> sieve;                           // CSV file
        std::optional<double> cell_diameter, cell_spread;           // m, -; size of mesh cells, instead of radii
        std::optional<double> mean_overlap;                         // m
        std::optional<double> void_ratio;                           // -
        std::int64_t seed = 1;
    } packing;

    /// Table [mesh].
    struct Mesh : parts::MeshValues {
        std::optional<MeshKind> kind;
        std::optional<double> thick;  // m
        std::optional<double> inset;  // m
    } mesh;

    /// Keys of [material]. Tables of minerals and of mineral pairs may contain them as well.
    struct MaterialKeys : parts::MaterialValues {
        StiffnessUnits units = StiffnessUnits::point;  // area: a modulus and stiffness_ratio replace stiffnesses
        std::optional<double> contact_modulus;         // Pa
    } material;

    /// Table [minerals].
    struct Minerals {
        MineralAssignment assign = MineralAssignment::random;
        std::int64_t seed = 1;
        std::optional<std::string> labels, image;  ///< paths as written in the case file
    } minerals;

    /// A table [[mineral]].
    struct Mineral {
        std::string name;
        std::optional<double> area_share;   ///< area fraction; if empty, the remainder left by the other minerals
        std::optional<std::string> colour;  ///< colour of this mineral in the image
        MaterialKeys own;                   ///< overrides the keys of [material]
    };
    std::vector<Mineral> mineral;

    /// A table [[mineral_pair]].
    struct MineralPair {
        std::array<std::string, 2> between;
        MaterialKeys own;  ///< overrides the values that follow from the two minerals
    };
    std::vector<MineralPair> mineral_pair;

    /// Table [joints].
    struct Joints : JointValues {
        std::int64_t seed = 1;
        JointSection section = JointSection::vertical;
        std::optional<double> section_trend;  // degrees from north, clockwise: azimuth of the section's +x axis
    } joints;

    /// Mechanical properties of a joint that differ from the rock's; a missing key keeps the rock's value.
    struct JointKeys : BondConstants {
        std::optional<bool> bonded;               // true if absent
        std::optional<double> strength_factor;    // -
        std::optional<double> friction_angle;     // degrees
        std::optional<double> normal_stiffness;   // Pa/m
        std::optional<double> shear_stiffness;    // Pa/m
        std::optional<double> dilation_angle;     // degrees
        std::optional<double> dilation_slip;      // m
        std::optional<double> aperture;           // m
        std::optional<double> residual_cohesion;  // Pa
        std::optional<double> softening_slip;     // m

        friend bool operator==(const JointKeys&, const JointKeys&) = default;
        /// Whether the joint is without bonds.
        bool open() const { return bonded && !*bonded; }
        /// Whether the joint has no mechanical properties of its own.
        bool as_rock() const { return *this == JointKeys{}; }
    };

    /// A joint set drawn from distributions (specimens/joints). case/joint_checks.cpp checks which keys may be
    /// combined.
    struct JointSet {
        std::string name;
        JointOrientation orientation = JointOrientation::fixed;
        std::optional<double> angle, angle_deviation, kappa;  // angles in degrees, counter-clockwise from +x
        std::optional<double> dip, dip_direction, fisher_k;   // degrees; dip direction clockwise from north
        JointLength length = JointLength::persistent;
        std::optional<double> length_mean, length_deviation;  // m
        std::optional<double> length_min, length_max;         // m
        std::optional<double> length_exponent;                // -
        std::optional<double> gap_mean, gap_deviation;        // m
        std::optional<std::int64_t> number;                   // a set gives exactly one of these five values:
        std::optional<double> p10, p20, p21;                  // 1/m, 1/m2, m/m2
        std::optional<double> spacing;                        // m
        std::optional<double> scan_line;                      // degrees from +x; direction of the scan line of p10
        std::optional<JointSpacing> spacing_law;              // fixed if absent
        std::optional<double> spacing_deviation;              // m
        std::optional<std::vector<double>> through;           // m, x and y
        JointKeys own;
    };
    std::vector<JointSet> joint_set;

    /// Measured traces: the points of one trace, or a file with any number of traces.
    struct Trace {
        std::optional<std::string> name;
        std::optional<std::vector<double>> points;  // m, x1, y1, x2, y2, ...
        std::optional<std::string> file;            ///< path as written in the case file
        std::optional<std::string> layer;           ///< layer of a DXF file
        std::optional<double> scale;                // m per length unit of the file
        std::optional<std::vector<double>> offset;  // m, x and y
        JointKeys own;
    };
    std::vector<Trace> trace;
    /// Whether the specimen has joints.
    bool jointed() const { return !joint_set.empty() || !trace.empty(); }

    /// Table [bond].
    struct Bond : parts::BondValues {
        StrengthDistribution strength_distribution = StrengthDistribution::none;
        std::optional<double> strength_cv;  // -
        std::optional<std::int64_t> strength_seed;
    } bond;

    parts::Shape shape;  ///< table [shape]

    /// Table [loading].
    struct Loading : parts::LoadingValues {
        std::optional<double> axial_strain_rate;  // 1/s; alternative to rate_tolerance
        std::optional<double> rate_tolerance;
        std::optional<double> grip;                           // -; fraction of the height, for glued platens only
        std::optional<double> platen_friction_angle;          // degrees
        std::optional<double> half_angle;                     // degrees; half the angle spanned by a jaw's arc
        std::optional<JawShape> jaws;                         // an arc if absent
        std::optional<double> normal_stress;                  // N/m, or Pa
        std::optional<double> normal_stiffness;               // N/m2, or Pa/m
        std::optional<LoadingControl> control;                // axial if absent
        std::optional<std::vector<double>> unload_at_strain;  // -; alternative to unload_at_stress
        std::optional<std::vector<double>> unload_at_stress;  // N/m, or Pa
        std::optional<double> unload_to;                      // -; fraction of the stress at which unloading began

        /// Whether the lateral strain, instead of the axial strain, increases at a steady rate.
        bool by_lateral_strain() const { return control == LoadingControl::lateral; }
        /// Whether the specimen is unloaded and reloaded.
        bool unloads() const { return unload_at_strain || unload_at_stress; }
    } loading;

    /// Table [confinement].
    struct Confinement {
        std::optional<double> pressure;     // N/m, or Pa
        std::optional<ConfiningSide> side;  ///< a membrane if absent

        /// Whether walls, instead of a membrane, press on the sides.
        bool by_walls() const { return side == ConfiningSide::walls; }
    } confinement;

    parts::Numerics numerics;  ///< table [numerics]
    parts::Output output;      ///< table [output]

    std::map<std::string, bool> table_present;  ///< "packing", "mesh", …
    std::vector<std::filesystem::path> inputs;  ///< files read so far, starting with the case file

    /// Whether a file has this table. @param table  the name of the table, without brackets
    bool has_table(const std::string& table) const { return table_present.contains(table); }
    /// Whether a pressure acts on the sides.
    bool confined() const { return test_kind(loading.kind).confined; }
    /// Whether the whole packing lies between platens, so that stress and strain are those of the rock.
    bool uniaxial() const { return test_kind(loading.kind).uniaxial; }
    /// Properties of the case's bond law.
    const BondLawFacts& bond_facts() const { return bond.facts(); }
    /// Correction factor c_κ of faces (solver/laws/face_bond.hpp): the mean over meshes of packed circles in a box.
    double face_correction() const { return has_table("mesh") && mesh.kind == MeshKind::delaunay ? 0.79 : 0.3; }
    /// Whether stiffness and strengths are given per area, in Pa.
    bool area_units() const { return material.units == StiffnessUnits::area; }
    /// Path of a file named in the case, resolved relative to the file that names it.
    std::filesystem::path resolve_path(const std::string& key, const std::string& written) const;
};

/// Error for a key that requires something missing from the case. @param what  the missing part, such as units = "area"
InputError key_needs(const TestCase& test, const std::string& key, const std::string& what);

/// Error for a key that conflicts with the rest of the case. @param because  a sentence that gives the reason
InputError key_without_room(const TestCase& test, const std::string& key, const std::string& because);

}  // namespace crackle
