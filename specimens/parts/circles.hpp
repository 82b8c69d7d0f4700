// SPDX-License-Identifier: GPL-3.0-or-later
// What a specimen is made of: circles that are packed or read from a file, and the mesh around their centres.
// Tested by tests/specimens/case/resolve_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <variant>

#include "mesher/mesher.hpp"
#include "solver/base/names.hpp"
#include "specimens/packing/size_distribution.hpp"

namespace crackle {

/// Distribution of the radii in a packing.
enum class RadiusLaw : std::uint8_t { uniform, lognormal, sieve };
constexpr auto list_names(RadiusLaw) { return in_order("uniform", "lognormal", "sieve"); }

constexpr auto list_names(MeshKind) { return in_order("delaunay", "voronoi"); }
constexpr auto list_names(Boundary) { return in_order("domain", "seeds"); }

namespace parts {

/// A box that circles fill.
struct Box {
    double width = 0.0, height = 0.0;  // m

    bool operator==(const Box&) const = default;
};

/// A number of circles, which determines the size of the box.
struct CircleCount {
    std::int64_t count = 0;
    double height_to_width = 2.0;

    bool operator==(const CircleCount&) const = default;
};

/// The mean overlap to which circles are compressed, m.
struct MeanOverlap {
    double value = 0.0;

    bool operator==(const MeanOverlap&) const = default;
};

/// The void ratio to which circles are compressed.
struct VoidRatio {
    double value = 0.0;

    bool operator==(const VoidRatio&) const = default;
};

/// A file with a sieve curve.
struct SieveFile {
    std::filesystem::path path;

    bool operator==(const SieveFile&) const = default;
};

/// Sizes of the cells of a mesh, from which the radii follow.
struct CellDiameters {
    RadiusLaw radii = RadiusLaw::uniform;  ///< uniform or lognormal
    double mean = 0.0, spread = 0.0;       ///< equivalent diameter, m; coefficient of variation

    bool operator==(const CellDiameters&) const = default;
};

/// Request for a packing.
struct Packing {
    std::variant<Box, CircleCount> box;
    std::variant<MeanOverlap, VoidRatio> target;
    std::variant<UniformRadii, LognormalRadii, SieveFile, CellDiameters> sizes;
    std::int64_t seed = 1;

    bool operator==(const Packing&) const = default;
};

/// A file from which the particles are read.
struct ParticleFile {
    std::filesystem::path path;

    bool operator==(const ParticleFile&) const = default;
};

/// Placeholder for a gap that is derived from the number of cells once they have been counted.
struct DerivedGap {
    bool operator==(const DerivedGap&) const = default;
};

/// Gap of a mesh: the value of mesh.thick, and the depth by which each polygon is inset.
struct MeshGap {
    double thick = 0.0;           // m
    std::optional<double> inset;  ///< m; empty: half of `thick`

    /// Distance between facing edges of the inset polygons, m.
    double between_edges() const { return inset ? 2.0 * *inset : thick; }

    bool operator==(const MeshGap&) const = default;
};

/// Values of a mesh that are taken from the case without change.
struct MeshValues {
    Boundary boundary = Boundary::domain;
    bool merge_destroyed = false;

    bool operator==(const MeshValues&) const = default;
};

/// The mesh around the centres of circles.
struct Mesh : MeshValues {
    MeshKind kind = MeshKind::voronoi;
    std::variant<DerivedGap, MeshGap> gap;

    bool operator==(const Mesh&) const = default;
};

}  // namespace parts
}  // namespace crackle
