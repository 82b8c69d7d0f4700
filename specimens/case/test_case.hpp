// SPDX-License-Identifier: GPL-3.0-or-later
// A case as data: everything one virtual test needs to know. case_file.hpp reads it, parameters.hpp declares its keys.
//
// Units: any consistent set, SI in what we ship. Strictly 2D: stiffnesses, stresses and moduli in N/m.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "solver/base/errors.hpp"

namespace crackle {

/// A value as TOML knows it.
using CaseValue =
    std::variant<bool, std::int64_t, double, std::string, std::array<std::string, 2>, std::vector<double>>;

/// Of a packing whose case sets no damping: a particle ringing on its contacts loses 95 % of its energy a
/// period, exp(-4πh) = 1/20; it shortens the stable step by a fifth.
inline constexpr double default_damping_ratio = 0.2383941;  // ln(20)/(4π)

/// Share of the height at each end that glued platens hold in tension, unless the case gives another.
inline constexpr double default_grip = 0.1;

/// One virtual test as the user wrote it, defaults filled in. Units and ranges: parameters.hpp.
struct TestCase {
    std::string title;

    struct Particles {
        std::optional<std::string> file;  ///< as written; resolve_path() leads to it
    } particles;

    struct Packing {
        std::optional<double> width, height;    // m
        std::optional<std::int64_t> count;      // circles; with height_to_width in place of width and height
        std::optional<double> height_to_width;  // -
        std::string sizes = "uniform";
        std::optional<double> radius_min, radius_max;               // m
        std::optional<double> radius_median, radius_log_deviation;  // m, -
        std::optional<std::string> sieve;                           // CSV file
        std::optional<double> cell_diameter, cell_spread;           // m, -; of the mesh's cells, in place of radii
        std::optional<double> mean_overlap;                         // m
        std::optional<double> void_ratio;                           // -
        std::int64_t seed = 1;
    } packing;

    struct Mesh {
        std::optional<std::string> kind;
        std::optional<double> thick;  ///< m; absent until the cells are counted: derived_mesh_thick()
        std::optional<double> inset;  // m
        std::string boundary = "domain";
        bool merge_destroyed = false;
    } mesh;

    struct MaterialKeys {
        std::optional<double> density;                  // kg/m2
        std::optional<double> normal_stiffness;         // N/m
        std::optional<double> shear_stiffness;          // N/m
        std::optional<double> friction_angle;           // degrees
        std::optional<double> damping_ratio;            // -
        std::optional<double> normal_damping;           // N s/m
        std::optional<double> shear_damping;            // N s/m
        std::string units = "point";                    // or "area": the five below, strengths in Pa
        std::optional<double> contact_modulus;          // Pa
        std::optional<double> stiffness_ratio;          // -, k_n over k_s
        std::optional<double> tensile_strength;         // N, or Pa
        std::optional<double> cohesion;                 // N, or Pa
        std::optional<double> residual_friction_angle;  // degrees
    } material;

    struct Minerals {
        std::string assign = "random";
        std::int64_t seed = 1;
        std::optional<std::string> labels, image;  ///< files as written
    } minerals;

    struct Mineral {
        std::string name;
        std::optional<double> area_share;   ///< -; of one that has none: what the others leave
        std::optional<std::string> colour;  ///< in the image
        MaterialKeys own;                   ///< over [material]'s
    };
    std::vector<Mineral> mineral;

    struct MineralPair {
        std::array<std::string, 2> between;
        MaterialKeys own;  ///< over what the two minerals give
    };
    std::vector<MineralPair> mineral_pair;

    struct Joints {
        std::int64_t seed = 1;
        std::string section = "vertical";     // or "horizontal"
        std::optional<double> section_trend;  // degrees from north, clockwise: where +x of the section points
        std::optional<double> shortest;       // m
        std::optional<double> snap;           // m
    } joints;

    /// What a joint does in place of the rock; where nothing is given it is as the rock.
    struct JointKeys {
        std::optional<bool> bonded;                     // true if not given
        std::optional<double> strength_factor;          // -
        std::optional<double> tensile_strength;         // Pa
        std::optional<double> cohesion;                 // Pa
        std::optional<double> friction_angle;           // degrees
        std::optional<double> residual_friction_angle;  // degrees
        std::optional<double> normal_stiffness;         // Pa/m
        std::optional<double> shear_stiffness;          // Pa/m
        std::optional<double> dilation_angle;           // degrees
        std::optional<double> dilation_slip;            // m
        std::optional<double> aperture;                 // m

        friend bool operator==(const JointKeys&, const JointKeys&) = default;
        bool open() const { return bonded && !*bonded; }
        bool as_rock() const { return *this == JointKeys{}; }
    };

    /// Joints drawn by laws (specimens/joints). Which keys go together: case/joint_checks.cpp.
    struct JointSet {
        std::string name;
        std::string orientation = "fixed";
        std::optional<double> angle, angle_deviation, kappa;  // degrees from +x, counter-clockwise; degrees; -
        std::optional<double> dip, dip_direction, fisher_k;   // degrees; degrees from north, clockwise; -
        std::string length = "persistent";
        std::optional<double> length_mean, length_deviation;  // m
        std::optional<double> length_min, length_max;         // m
        std::optional<double> length_exponent;                // -
        std::optional<double> gap_mean, gap_deviation;        // m
        std::optional<std::int64_t> number;                   // of one set one of these five:
        std::optional<double> p10, p20, p21;                  // 1/m, 1/m2, m/m2
        std::optional<double> spacing;                        // m
        std::optional<double> scan_line;                      // degrees from +x, of p10
        std::optional<std::string> spacing_law;               // "fixed" if not given
        std::optional<double> spacing_deviation;              // m
        std::optional<std::vector<double>> through;           // m, x and y
        JointKeys own;
    };
    std::vector<JointSet> joint_set;

    /// Measured traces: points of one, or a file of any number.
    struct Trace {
        std::optional<std::string> name;
        std::optional<std::vector<double>> points;  // m, x1, y1, x2, y2, ...
        std::optional<std::string> file;            ///< as written
        std::optional<std::string> layer;           ///< of a DXF file
        std::optional<double> scale;                // m a unit of the file
        std::optional<std::vector<double>> offset;  // m, x and y
        JointKeys own;
    };
    std::vector<Trace> trace;
    bool jointed() const { return !joint_set.empty() || !trace.empty(); }

    struct Bond {
        std::string law = "back_tension";       // or "coulomb"
        std::optional<double> thick;            // m
        std::optional<double> gap;              // m
        double range = 0.0;                     // -
        std::optional<double> tensile_factor;   // -
        std::optional<double> cohesion_factor;  // -
        std::string strength_distribution = "none";
        std::optional<double> strength_cv;  // -
        std::optional<std::int64_t> strength_seed;
    } bond;

    struct Shape {
        std::optional<double> diameter, notch;  // m
    } shape;

    struct Loading {
        std::string kind = "compression";         // test_kinds() of specimens/kinds has them
        std::optional<double> axial_strain_rate;  // 1/s; or:
        std::optional<double> rate_tolerance;
        double max_axial_strain = 0.0;
        double strength_drop = 0.0;
        double stop_at_share_of_peak = 0.0;
        std::string platens;                                  // "bonded", "glued" or "frictional"
        std::optional<double> grip;                           // -, of the height; glued platens only
        std::optional<double> platen_friction_angle;          // degrees
        std::optional<double> half_angle;                     // degrees, of a jaw's arc
        std::optional<std::string> jaws;                      // "arc" if not given, "flat" or "curved"
        std::optional<double> span, pad_width;                // m
        std::optional<double> normal_stress;                  // N/m, or Pa
        std::optional<double> normal_stiffness;               // N/m2, or Pa/m
        std::optional<std::string> control;                   // "axial" if not given, or "lateral"
        std::optional<double> box_gap;                        // m
        std::optional<std::vector<double>> unload_at_strain;  // -; or:
        std::optional<std::vector<double>> unload_at_stress;  // N/m, or Pa
        std::optional<double> unload_to;                      // -, of the stress where unloading began

        bool by_lateral_strain() const { return control.value_or("axial") == "lateral"; }
        bool unloads() const { return unload_at_strain || unload_at_stress; }

        /// So many times as fast: a tolerance goes by the square of the rate it allows.
        void scale_rate(double by) {
            if (axial_strain_rate) *axial_strain_rate *= by;
            if (rate_tolerance) *rate_tolerance *= by * by;
        }
    } loading;

    struct Confinement {
        std::optional<double> pressure;   // N/m, or Pa
        std::optional<std::string> side;  ///< "membrane" or "walls"

        bool by_walls() const { return side.value_or("membrane") == "walls"; }
    } confinement;

    struct Numerics {
        std::optional<double> time_step;  // s
        double safety_factor = 0.0;
        std::int64_t threads = 1;
        std::string contact_law;
        std::string integrator;
        bool intact = false;
        bool allow_unstable = false;
    } numerics;

    struct Output {
        std::int64_t curve_rows = 0;
        std::optional<std::int64_t> frames;  ///< absent until the bodies are counted: default_frames()
        std::string frame_precision;         ///< of points: "single" or "double"
        bool slips = false;
        bool emission = false;
        double checkpoint_interval = 0.0;              // s, wall clock
        std::optional<double> out_of_plane_thickness;  // m
    } output;

    /// No key: the companions of a test are made with it. Times the damping of every material, after packing.
    double damping_scale = 1.0;
    double step_scale = 1.0;  ///< of a derived time step

    /// A smaller safety factor would leave alone a step that the bound holds below it.
    void halve_step() {
        if (numerics.time_step) *numerics.time_step *= 0.5;
        step_scale *= 0.5;
    }

    std::filesystem::path source;  ///< the case file
    std::map<std::string, std::string>
        position;  ///< "table.key" or "list[2].key" → "file:line", for keys that a file sets
    std::map<std::string, bool> table_present;  ///< "packing", "mesh", …
    std::vector<std::filesystem::path> inputs;  ///< files read so far, the case first

    bool has_table(const std::string& table) const { return table_present.contains(table); }
    bool confined() const { return loading.kind == "biaxial"; }
    /// A force beside that of the driving part does work: the curve has a column for it.
    bool pressed() const { return confined() || loading.kind == "direct_shear"; }
    /// The whole packing between platens, whose stress and strain are the rock's.
    bool uniaxial() const {
        return loading.kind == "compression" || loading.kind == "tension" || loading.kind == "biaxial";
    }
    bool coulomb_bonds() const { return bond.law == "coulomb"; }
    bool area_units() const { return material.units == "area"; }
    /// Of stresses and moduli: force over a length, or over an area.
    const char* stress_unit() const { return area_units() ? "Pa" : "N/m"; }
    /// «file:line: table.key», or «file: table.key» for a key that no file sets.
    std::string at(const std::string& key) const;
    /// A path written in the case, relative to the file that wrote it.
    std::filesystem::path resolve_path(const std::string& key, const std::string& written) const;
};

/// Of a key that needs something else in the case. @param what is missing: units = "area"
InputError key_needs(const TestCase& test, const std::string& key, const std::string& what);

/// Of a key that the rest of the case leaves no room for. @param because a sentence
InputError key_without_room(const TestCase& test, const std::string& key, const std::string& because);

/// Every file that a test of this case reads: the case, what it includes, and what its keys name.
std::vector<std::filesystem::path> files_read(const TestCase& test);

}  // namespace crackle
