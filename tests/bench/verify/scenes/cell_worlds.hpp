// SPDX-License-Identifier: GPL-3.0-or-later
// Worlds of cells that faces can bond: boxes of Voronoi cells or triangles, with platens below and above on request,
// and squares in a row. Tested by tests/solver/faces/find_faces_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "mesher/mesher.hpp"
#include "solver/faces/bond_faces.hpp"
#include "solver/faces/face_pass.hpp"
#include "solver/stepping/build_world.hpp"

namespace crackle::verification {

/// A box of cells.
struct CellBox {
    MeshKind kind = MeshKind::voronoi;
    double width = 1.0, height = 1.0;  // m
    int columns = 10, rows = 10;       // their product is the number of seeds
    int lloyd = 2;                     // rounds in which each seed moves to the centroid of its cell
    double gap = 1e-7;                 // m; so small that the inset removes no edge
    bool platens = false;
    unsigned seed = 1;
};

/// A world of cells, with the seed of each body (unset for platens).
struct CellWorld {
    World world;
    std::vector<Vec2> seeds;
    std::vector<BodyIndex> platens;  // below, above
};

inline Point centroid_of(std::span<const Point> outline) {
    double area = 0.0;
    Point sum;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Point &a = outline[k], &b = outline[(k + 1) % outline.size()];
        const double twice = cross(a, b);
        area += 3.0 * twice;
        sum.x += twice * (a.x + b.x);
        sum.y += twice * (a.y + b.y);
    }
    return {sum.x / area, sum.y / area};
}

/// Seeds of a box: random positions, spread more evenly by Lloyd rounds.
inline std::vector<Point> seeds_of(const CellBox& box) {
    std::mt19937 random(box.seed);
    const auto number = [&] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
    std::vector<Point> seeds;
    for (int n = 0; n < box.rows * box.columns; ++n) {
        const double x = box.width * number();
        seeds.push_back({x, box.height * number()});
    }
    for (int round = 0; round < box.lloyd; ++round) {
        const Mesh mesh = make_mesh(seeds, {0.0, box.width, 0.0, box.height}, {});
        for (const Cell& cell : mesh.cells)
            seeds[static_cast<std::size_t>(cell.centre)] = centroid_of(mesh.outline(cell));
    }
    return seeds;
}

inline Material any_material(double density = 1.0) {
    Material material;
    material.density = density;
    material.normal_stiffness = 1.0;
    material.shear_stiffness = 0.0;
    return material;
}

/// Builds the world of a mesh. @param seeds of the cells with Cell::centre >= 0
inline CellWorld world_of(const CellBox& box, const Mesh& mesh, const std::vector<Point>& seeds, int materials = 1) {
    Scene scene;
    for (int m = 0; m < materials; ++m) scene.materials.push_back(any_material());
    const double margin = 2.0 * std::max(box.width, box.height);
    scene.domain = {-margin, box.width + margin, -margin, box.height + margin, {false, false, false, false}};
    scene.time_step = 1e-9;
    scene.allow_unstable = true;
    int id = 0;
    std::vector<Vec2> by_id(1);
    for (const Cell& cell : mesh.cells) {
        std::vector<Vec2> outline;
        for (const Point& corner : mesh.outline(cell)) outline.push_back({corner.x, corner.y});
        const Point seed = cell.centre >= 0 ? seeds[static_cast<std::size_t>(cell.centre)] : Point{};
        ++id;
        scene.add_chain_body(id, id % materials, outline, true);
        by_id.push_back({seed.x, seed.y});
    }
    if (box.platens) {
        const double half = 0.5 * box.gap, thick = 0.1 * box.height;
        for (const double y : {-thick, box.height}) {
            const std::vector<Vec2> outline{{-half, y + half},
                                            {box.width + half, y + half},
                                            {box.width + half, y + thick - half},
                                            {-half, y + thick - half}};
            Control control;
            control.body = static_cast<int>(scene.add_chain_body(++id, 0, outline, true));
            control.x.drive = control.y.drive = control.rotation.drive = Drive::velocity;
            scene.controls.push_back(control);
            by_id.push_back({});
        }
    }
    CellWorld result{build_world(scene), {}, {}};
    result.platens.assign(box.platens ? 2 : 0, 0);
    for (BodyIndex b = 0; b < result.world.bodies.size(); ++b) {
        const int own = result.world.bodies.names[b].id;
        result.seeds.push_back(by_id[static_cast<std::size_t>(own)]);
        if (box.platens && own > id - 2) result.platens[static_cast<std::size_t>(own - (id - 1))] = b;
    }
    return result;
}

/// Meshes a box and builds its world.
inline CellWorld build_box(const CellBox& box, int materials = 1) {
    const std::vector<Point> seeds = seeds_of(box);
    MeshRequest request;
    request.kind = box.kind;
    request.mesh_gap = box.gap;
    request.merge_destroyed = true;
    return world_of(box, make_mesh(seeds, {0.0, box.width, 0.0, box.height}, request), seeds, materials);
}

/// Squares of side 1 m in a row from the origin along x, without gaps.
inline Mesh squares_in_a_row(int count) {
    Mesh mesh;
    for (int n = 0; n < count; ++n) {
        mesh.cells.push_back({static_cast<std::uint32_t>(mesh.corners.size()), 4, n});
        for (const Point corner : {Point{0.0, 0.0}, Point{1.0, 0.0}, Point{1.0, 1.0}, Point{0.0, 1.0}})
            mesh.corners.push_back({corner.x + n, corner.y});
    }
    return mesh;
}

/// Computes the forces of the faces of a world, without those of contact points.
inline void compute_face_forces(World& world) {
    std::ranges::fill(world.bodies.force, BodyForce{});
    add_face_forces(world);
}

/// A rock with E = 1 Pa and the given ratios, which never fails.
inline FaceBonding elastic_rock(const CellWorld& cells, double gap, double poissons_ratio, double shear_ratio,
                                double correction = 0.0) {
    FaceBonding bonding;
    bonding.materials.assign(cells.world.settings.materials.size(),
                             {face_moduli(1.0, poissons_ratio, shear_ratio, correction), {}});
    bonding.gap = gap;
    bonding.reference = cells.seeds;
    return bonding;
}

}  // namespace crackle::verification
