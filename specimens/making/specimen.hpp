// SPDX-License-Identifier: GPL-3.0-or-later
// The specimen of a test: bodies in their domain before they are bonded, from a packing or a particle file, as circles
// or meshed into polygons.
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/joints/joint_trace.hpp"
#include "specimens/kinds/test_kind.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/making/minerals.hpp"

namespace crackle {

struct Specimen {
    Scene scene;       ///< bodies, materials, domain; all velocities 0, no gravity, no controls
    std::string kind;  ///< "circles", "delaunay" or "voronoi" (polygons from a file: delaunay if all are triangles)
    bool polygons = false;
    double mesh_thick = 0.0;           ///< m, mesh.thick given or derived, where meshed here
    double mesh_gap = 0.0;             ///< m, gap between neighbouring polygons; 0 for circles
    Shape shape;                       ///< what was cut from the packing
    double width = 0.0, height = 0.0;  ///< m, of the shape; of the whole packing those of the domain
    double area = 0.0;                 ///< m2, of the shape
    double particle = 0.0;             ///< m, mean size: of a cell the root of its area, of a circle its diameter
    std::vector<std::pair<std::string, double>> packing;  ///< its figures by name; empty for a particle file
    double mean_radius = 0.0;                             ///< m, of the circles (of the centres, where meshed)
    std::int64_t segments = 0;                            ///< edges of all polygons
    std::int64_t centres = 0;            ///< circles the polygons were meshed from; 0 if not meshed here
    std::vector<SpecimenTrace> traces;   ///< by number
    std::vector<MineralShare> minerals;  ///< in the case's order; empty of a rock of one material
    int platen_material = 0;             ///< index into scene.materials: [material]'s
    /// Ids of the bodies on the side faces: circles that overlap the wall, polygons with an edge on the face; or of
    /// those in the shape's regions.
    std::vector<int> left_ids, right_ids;
    std::vector<std::string> notices;  ///< what a user should know
};

/// Names under which hooks.made() gets the circles, which polygons were meshed from where there are any; the polygons.
inline constexpr const char* circles_file = "specimen_circles.dat";
inline constexpr const char* polygons_file = "specimen_polygons.dat";

/// The circles alone, of a case with [packing]: from hooks.keep_packing where it is given.
/// @throws InputError for what cannot be packed, naming the case's key; TestInterrupted
Packing packing_of(const TestCase& test, const TestHooks& hooks);

/// Makes or reads the specimen that the case describes.
/// @throws InputError for what cannot be read, packed, meshed or tested, naming the case's key; TestInterrupted.
Specimen make_specimen(const TestCase& test, const TestHooks& hooks);

}  // namespace crackle
