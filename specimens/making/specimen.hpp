// SPDX-License-Identifier: GPL-3.0-or-later
// The specimen of a test before it is bonded: bodies in their domain, from a packing or a particle file. The bodies are
// circles, or polygons meshed from circles or read from the file.
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/joints/joint_trace.hpp"
#include "specimens/kinds/test_kind.hpp"
#include "specimens/making/minerals.hpp"
#include "specimens/parts/rock.hpp"

namespace crackle {

/// Kind of bodies. Polygons from a file count as delaunay if all are triangles.
enum class SpecimenKind : std::uint8_t { circles, delaunay, voronoi };
constexpr auto list_names(SpecimenKind) { return in_order("circles", "delaunay", "voronoi"); }

/// A specimen that is not bonded yet: its scene, and how it was made.
struct Specimen {
    Scene scene;  ///< bodies, materials, domain; all velocities 0, no gravity, no controls
    SpecimenKind kind = SpecimenKind::circles;
    bool polygons = false;
    /// mesh.thick as given or derived, m; 0 if the specimen was not meshed from circles.
    double mesh_thick = 0.0;
    double mesh_gap = 0.0;  ///< m, gap between neighbouring polygons; 0 for circles
    Shape shape;            ///< the shape that was cut from the packing
    /// Size of the tested shape, m; the size of the domain if the whole packing is tested.
    double width = 0.0, height = 0.0;
    double area = 0.0;      ///< area of the tested shape, m2
    double particle = 0.0;  ///< mean particle size, m: square root of a cell's area, or circle diameter
    std::vector<std::pair<std::string, double>>
        packing;                        ///< quantities that describe the packing, by name; empty for a particle file
    double mean_radius = 0.0;           ///< mean radius, m, of the circles, or of the circles that were meshed
    std::int64_t segments = 0;          ///< number of edges of all polygons
    std::int64_t centres = 0;           ///< number of circles from which polygons were meshed; 0 if none were meshed
    std::vector<SpecimenTrace> traces;  ///< ordered by index
    parts::Material material;           ///< material of the rock
    parts::Minerals mineral_parts;      ///< minerals of the rock, if it has any
    /// Minerals in the order in which the case lists them; empty for a rock with a single material.
    std::vector<MineralShare> minerals;
    /// The centre around which each Voronoi cell was formed, m, by body of the scene; NaN for triangles, and for cells
    /// that traces have cut. Empty if no polygons were meshed.
    std::vector<Vec2> cell_centres;
    int platen_material = 0;  ///< index of [material] in scene.materials
    /// Ids of the bodies at the left and right faces: circles that overlap the wall, or polygons with an edge on the
    /// face. For kinds of test that define regions, the bodies in Shape::left and Shape::right.
    std::vector<int> left_ids, right_ids;
    std::vector<std::string> notices;  ///< remarks for the user
};

/// Names passed to hooks.made(): for the circles, including circles that are meshed, and for the polygons.
inline constexpr const char* circles_file = "specimen_circles.dat";
inline constexpr const char* polygons_file = "specimen_polygons.dat";

}  // namespace crackle
