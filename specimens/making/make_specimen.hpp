// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the specimen of a test in stages: circles (packed_circles.hpp), the cut (cut_shape.hpp), the mesh
// (meshed_cells.hpp), minerals and joints.
// Tested by tests/specimens/making/specimen_test.cpp.
#pragma once

#include "specimens/making/hooks.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// Packs or reads the particles, cuts the shape of the test, and meshes it if the case requests a mesh.
/// @throws InputError that names the case's key if the specimen cannot be read, packed, meshed or tested;
/// TestInterrupted
Specimen make_specimen(const parts::Particles& particles, const parts::Procedure& test, const TestHooks& hooks);
/// The specimen of a case. @throws as the overload above
inline Specimen make_specimen(const ResolvedCase& test, const TestHooks& hooks) {
    return make_specimen(test, test, hooks);
}

}  // namespace crackle
