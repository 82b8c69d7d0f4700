// SPDX-License-Identifier: GPL-3.0-or-later
// How a test is loaded: its kind, the parts that hold and drive the specimen, the rate, and the pressure on the sides.
// Tested by tests/specimens/case/resolve_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "solver/base/names.hpp"
#include "specimens/case/kinds/test_kind.hpp"

namespace crackle {

/// How platens hold the specimen.
enum class PlatenKind : std::uint8_t { bonded, glued, frictional };
constexpr auto list_names(PlatenKind) { return in_order("bonded", "glued", "frictional"); }

/// Shape of the jaws of a Brazilian test.
enum class JawShape : std::uint8_t { arc, flat, curved };
constexpr auto list_names(JawShape) { return in_order("arc", "flat", "curved"); }

/// The strain that is increased at a steady rate.
enum class LoadingControl : std::uint8_t { axial, lateral };
constexpr auto list_names(LoadingControl) { return in_order("axial", "lateral"); }

/// What applies the confining pressure to the sides.
enum class ConfiningSide : std::uint8_t { membrane, walls };
constexpr auto list_names(ConfiningSide) { return in_order("membrane", "walls"); }

namespace parts {

/// A steady rate of the axial strain, 1/s.
struct StrainRate {
    double value = 0.0;

    bool operator==(const StrainRate&) const = default;
};

/// A tolerance of the inertia error, which controls the rate.
struct RateTolerance {
    double value = 0.0;

    bool operator==(const RateTolerance&) const = default;
};

/// Strains or stresses at which the specimen is unloaded and reloaded.
struct Unloading {
    bool by_strain = false;
    std::vector<double> at;  ///< strains, or stresses in N/m or Pa; empty: no unloading
    double to = 0.1;         ///< unloading ends at this fraction of the stress at which it began

    bool operator==(const Unloading&) const = default;
};

/// The shape that is cut from the packing.
struct Shape {
    std::optional<double> diameter;  ///< m; empty: the largest that is possible
    std::optional<double> notch;     ///< m; empty: no notch (bending), or half the radius (scb)

    bool operator==(const Shape&) const = default;
};

/// Values of a loading that are taken from the case without change.
struct LoadingValues {
    LoadingKind kind = LoadingKind::compression;
    double max_axial_strain = 0.0;
    double strength_drop = 0.0;
    double stop_at_share_of_peak = 0.0;
    PlatenKind platens = PlatenKind::bonded;
    std::optional<double> span;       ///< m; empty: the default for the kind of test
    std::optional<double> pad_width;  ///< m; empty: derived from the size of the specimen and of its particles
    std::optional<double> box_gap;    ///< m; empty: twice the mean particle size

    bool operator==(const LoadingValues&) const = default;
};

/// How the specimen is loaded.
struct Loading : LoadingValues {
    std::variant<StrainRate, RateTolerance> rate;
    double grip = 0.0;                   ///< fraction of the height at each end; 0 unless platens are glued
    double platen_friction_angle = 0.0;  // friction angle of frictional platens, degrees
    double half_angle = 10.0;            // degrees; half the angle spanned by a jaw's arc; 10 for ISRM's jaws
    JawShape jaws = JawShape::arc;
    double normal_stress = 0.0;     // N/m, or Pa
    double normal_stiffness = 0.0;  // N/m2, or Pa/m
    LoadingControl control = LoadingControl::axial;
    Unloading unloading;

    /// The steady rate of the axial strain, 1/s; null if a tolerance controls the rate.
    const double* axial_strain_rate() const {
        const auto* given = std::get_if<StrainRate>(&rate);
        return given == nullptr ? nullptr : &given->value;
    }
    /// The tolerance of the inertia error; null if the rate is given.
    const double* rate_tolerance() const {
        const auto* given = std::get_if<RateTolerance>(&rate);
        return given == nullptr ? nullptr : &given->value;
    }
    /// Whether the lateral strain, instead of the axial strain, increases at a steady rate.
    bool by_lateral_strain() const { return control == LoadingControl::lateral; }
    /// Whether the specimen is unloaded and reloaded.
    bool unloads() const { return !unloading.at.empty(); }

    /// Multiplies the loading rate by `by`. The rate tolerance is multiplied by `by` squared, because it is
    /// proportional to the square of the rate.
    void scale_rate(double by) {
        if (auto* given = std::get_if<StrainRate>(&rate)) given->value *= by;
        if (auto* given = std::get_if<RateTolerance>(&rate)) given->value *= by * by;
    }

    bool operator==(const Loading&) const = default;
};

/// Pressure on the sides throughout the test.
struct Confinement {
    double pressure = 0.0;  // N/m, or Pa
    ConfiningSide side = ConfiningSide::membrane;

    /// Whether walls, instead of a membrane, press on the sides.
    bool by_walls() const { return side == ConfiningSide::walls; }

    bool operator==(const Confinement&) const = default;
};

}  // namespace parts
}  // namespace crackle
