// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/cell_bodies.hpp"

#include <vector>

namespace crackle {

void add_cell_bodies(Scene& scene, const Mesh& mesh, std::span<const int> centre_materials) {
    std::vector<Vec2> outline;
    int id = 0;
    for (const Cell& cell : mesh.cells) {
        outline.clear();
        for (const Point& corner : mesh.outline(cell)) outline.push_back({corner.x, corner.y});
        int seed = cell.centre;
        for (const int corner : cell.centres) seed = seed < 0 ? corner : seed;
        // A triangle has no seed if all its corners lie on faces of the domain.
        const int material = seed < 0 ? centre_materials.front() : centre_materials[static_cast<std::size_t>(seed)];
        scene.add_chain_body(++id, material, outline, true);
    }
}

}  // namespace crackle
