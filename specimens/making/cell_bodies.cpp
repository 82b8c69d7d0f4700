// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/cell_bodies.hpp"

#include <vector>

namespace crackle {

void add_cell_bodies(Scene& scene, const Mesh& mesh, std::span<const int> seed_materials) {
    std::vector<Vec2> outline;
    int id = 0;
    for (const Cell& cell : mesh.cells) {
        outline.clear();
        for (const Point& corner : mesh.outline(cell)) outline.push_back({corner.x, corner.y});
        int seed = cell.seed;
        for (const int corner : cell.seeds) seed = seed < 0 ? corner : seed;
        // A triangle between three points of the faces has no seed.
        const int material = seed < 0 ? seed_materials.front() : seed_materials[static_cast<std::size_t>(seed)];
        scene.add_chain_body(++id, material, outline, true);
    }
}

}  // namespace crackle
