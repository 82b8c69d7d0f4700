// SPDX-License-Identifier: GPL-3.0-or-later
// One virtual test, resolved: a part for each stage, with all values final. read_case() makes it; a program that links
// the libraries may also fill it in.
//
// Units: any consistent set; the supplied cases use SI. The model is strictly 2D: stiffnesses, stresses and moduli are
// in N/m.
// Tested by tests/specimens/case/resolve_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/joints/joint_request.hpp"
#include "specimens/parts/circles.hpp"
#include "specimens/parts/loading.hpp"
#include "specimens/parts/rock.hpp"
#include "specimens/places/places.hpp"

namespace crackle {

/// Floating-point precision of the coordinates in frames.
enum class FramePrecision : std::uint8_t { single_, double_ };
constexpr auto list_names(FramePrecision) { return in_order("single", "double"); }

namespace parts {

/// How the test is computed.
struct Numerics {
    std::optional<double> time_step;  ///< s; empty: derived from the stiffness, with the safety factor
    double safety_factor = 0.8;
    int threads = 1;
    SegmentLaw contact_law = SegmentLaw::rounded;
    Integrator integrator = Integrator::leapfrog;
    bool intact = false;
    bool allow_unstable = false;

    bool operator==(const Numerics&) const = default;
};

/// What the test writes.
struct Output {
    std::int64_t curve_rows = 2000;
    std::optional<std::int64_t> frames;  ///< empty: default_frames() for the number of bodies
    FramePrecision frame_precision = FramePrecision::single_;
    bool slips = false;
    bool emission = false;
    double checkpoint_interval = 60.0;  // s, wall clock
    /// Thickness to which reported stresses are converted, m; empty: 1 m.
    std::optional<double> out_of_plane_thickness;

    bool operator==(const Output&) const = default;
};

/// The particles of a test: their source, mesh, material, minerals and joints.
struct Particles {
    std::variant<Packing, ParticleFile> source;
    std::optional<Mesh> mesh;  ///< empty: the test uses the particles as they are
    Material material;
    Minerals minerals;
    JointRequest joints;
    double damping_scale = 1.0;  ///< factor on the damping of every material, applied after packing

    /// The requested packing; null if the particles are read from a file.
    const Packing* packing() const { return std::get_if<Packing>(&source); }
    /// The requested packing, for changes.
    Packing* packing() { return std::get_if<Packing>(&source); }
    /// Whether stiffness and strengths are given per area, in Pa.
    bool area_units() const { return material.units == StiffnessUnits::area; }
    /// Unit of stresses and moduli: force per length, or force per area.
    const char* stress_unit() const { return area_units() ? "Pa" : "N/m"; }

    bool operator==(const Particles&) const = default;
};

/// How particles are held, driven and stepped.
struct Procedure {
    Shape shape;
    Loading loading;
    std::optional<Confinement> confinement;
    Numerics numerics;
    double step_scale = 1.0;  ///< factor on the derived time step
    Places places;

    /// Halves the time step. Halving the safety factor might not halve it, because other bounds may limit it.
    void halve_step() {
        if (numerics.time_step) *numerics.time_step *= 0.5;
        step_scale *= 0.5;
    }

    /// Pressure on the sides, N/m or Pa; 0 without confinement.
    double pressure() const { return confinement ? confinement->pressure : 0.0; }
    /// Whether a pressure acts on the sides.
    bool confined() const { return test_kind(loading.kind).confined; }
    /// Whether a pressure or normal force does work in addition to the driving part; the curve then has a column for
    /// this work.
    bool pressed() const { return test_kind(loading.kind).pressed(); }
    /// Whether the whole packing lies between platens, so that stress and strain describe the rock.
    bool uniaxial() const { return test_kind(loading.kind).uniaxial; }
    /// «file:line: table.key» for errors. @param key  the value that is wrong
    std::string at(CaseKey key) const { return places.at(key); }

    bool operator==(const Procedure&) const = default;
};

}  // namespace parts

/// One virtual test. Its parts do not depend on the form in which they were written; each stage uses the parts that it
/// needs.
struct ResolvedCase : parts::Particles, parts::Procedure {
    std::string title;
    parts::Bonds bond;
    parts::Output output;
    std::vector<std::filesystem::path> case_files;  ///< the case file and the files that it includes
    std::vector<std::filesystem::path> data_files;  ///< files named by the parts of the case

    bool operator==(const ResolvedCase&) const = default;
};

/// All files that a test of this case reads: the case, the files it includes, and the files named by its parts.
std::vector<std::filesystem::path> files_read(const ResolvedCase& test);

}  // namespace crackle
