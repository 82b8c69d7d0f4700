// SPDX-License-Identifier: GPL-3.0-or-later
// in_bc.dat, for a deck of two circles.

#include "solver/demseg/boundary.hpp"

#include "solver/demseg/deck_reader.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::deck_boundary(std::string_view bytes) {
    DeckReader reader("in_bc.dat", std::string(bytes));
    const BoundaryConditions boundary = read_boundary(reader);
    Scene scene;
    scene.add_circle_body(1, 0, {});
    scene.add_circle_body(2, 0, {});
    apply_controls(boundary, scene);
}
