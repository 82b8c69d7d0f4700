// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/lattices.hpp"

#include <cmath>
#include <numbers>

#include "solver/base/correctly_rounded.hpp"
#include "specimens/making/materials.hpp"

namespace crackle {

Scene triangular_lattice(int columns, int rows, double radius, double overlap, const Material& material) {
    Scene scene = open_scene(material);
    const double spacing = 2.0 * radius - overlap;
    int id = 0;
    for (int row = 0; row < rows; ++row) {
        const bool odd = row % 2 == 1;
        for (int column = 0; column < columns - (odd ? 1 : 0); ++column) {
            const Vec2 centre{spacing * (column + (odd ? 0.5 : 0.0)), spacing * 0.5 * std::sqrt(3.0) * row};
            scene.add_circle_body(++id, 0, {centre, radius, 0.0});
        }
    }
    return scene;
}

Scene square_lattice(int columns, int rows, double radius, double overlap, const Material& material) {
    Scene scene = open_scene(material);
    const double spacing = 2.0 * radius - overlap;
    int id = 0;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column)
            scene.add_circle_body(++id, 0, {{spacing * column, spacing * row}, radius, 0.0});
    }
    return scene;
}

Scene disc_chain(int count, double radius, double spacing, const Material& material) {
    Scene scene = open_scene(material);
    for (int k = 0; k < count; ++k) scene.add_circle_body(k + 1, 0, {{spacing * k, 0.0}, radius, 0.0});
    return scene;
}

Scene honeycomb(int columns, int rows, double apothem, double thick, const Material& material) {
    Scene scene = open_scene(material);
    scene.thick = thick;
    const double corner = (apothem - 0.5 * thick) * 2.0 / std::sqrt(3.0);
    int id = 0;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const Vec2 centre{2.0 * apothem * (column + (row % 2 == 1 ? 0.5 : 0.0)), std::sqrt(3.0) * apothem * row};
            std::vector<Vec2> outline;
            for (int k = 0; k < 6; ++k) {
                const double angle = std::numbers::pi * (1.0 / 6.0 + k / 3.0);
                outline.push_back(centre + corner * Vec2{correctly_rounded::cos(angle), correctly_rounded::sin(angle)});
            }
            scene.add_chain_body(++id, 0, outline, true);
        }
    }
    return scene;
}

}  // namespace crackle
