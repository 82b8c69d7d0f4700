// SPDX-License-Identifier: GPL-3.0-or-later
// Input for bonding a specimen by faces (bond.law = "face", solver/faces): laws of its minerals, reference points of
// its cells, and the faces of platens and grips.
// Tested by tests/specimens/setup/face_bonds_test.cpp.
#pragma once

#include "solver/faces/bond_faces.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/parts/rock.hpp"
#include "specimens/setup/platen.hpp"

namespace crackle {

/// The request to bond the faces of a world made from a specimen. Platens that are not bonded have no faces.
/// @param gap  distance between facing edges, m
FaceBonding face_bonding_of(const World& world, const Specimen& specimen, const parts::Bonds& bonds, PlatenKind platens,
                            double gap);

}  // namespace crackle
