// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds the polygons of a world by faces: reference points, shares and springs of every face, and pressures of cells.
//
// Each cell has one reference point x_i: its seed, or else the circumcentre of a triangle and the centroid of another
// polygon. With c the midpoint of a face, n from i to j, t the normal turned by +90 degrees, and the cells' moduli E_c:
//     a_i = (c - x_i)·n     a_j = (x_j - c)·n     D = a_i/E_i + a_j/E_j
//     k_n = L/D     s_i = (a_i/E_i)/D     m_i = (c - x_i)·t/(E_i D)     likewise for j
// so that k_n = E_c L/h in one rock, h = a_i + a_j. Uniform strain balances every cell exactly if κ = 1 and x_j - x_i
// is along n on every face (Voronoi, Laguerre, Delaunay with circumcentres). h is at least a fraction of its mean.
//
// A driven body is rigid: its faces have a_j = 0, s_i = 1 and no skew. At a rigid body and at a free side, where the
// reference point lies too close or beyond, the centroid takes its place.
// Source: solver/MODEL.md 5.5. Tested by tests/solver/faces/bond_faces_test.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/faces/find_faces.hpp"
#include "solver/scene/bond_strength.hpp"
#include "solver/world/faces.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// What faces need of a material.
struct FaceMaterial {
    FaceModuli moduli;
    FaceLaw law;
};

/// The law of the faces between two materials, in place of the smaller strengths of both.
struct FacePair {
    std::size_t a = 0, b = 0;  ///< as in Settings::materials
    FaceLaw law;
};

/// How faces of driven bodies behave.
enum class PlatenFaces {
    smooth,  ///< they hold, without shear stiffness
    glued,   ///< they hold, with the cell's shear stiffness
    bonded,  ///< they break like faces within the cell's material
    rubbing  ///< they press and rub with the friction of FaceBonding::platen_friction
};

/// The smaller strengths of two laws, the larger moment share, and the shorter softening.
FaceLaw weaker_law(const FaceLaw& a, const FaceLaw& b);

/// Request for the faces of a world.
struct FaceBonding {
    std::vector<FaceMaterial> materials;  ///< as in Settings::materials; two materials have the smaller strengths
    std::vector<FacePair> pairs;
    double gap = 0.0;             ///< m, distance between facing edges of the mesh
    Outlines outlines;            ///< m, by body, before the inset; recovered from the gap if empty
    std::vector<Vec2> reference;  ///< m, by body; where NaN, or if empty, circumcentres and centroids
    PlatenFaces platens = PlatenFaces::smooth;
    double platen_friction = 0.0;  ///< tan φ of PlatenFaces::rubbing
    /// Whether the faces between two bodies start broken, without cohesion. If not set, all are intact.
    std::function<bool(BodyIndex i, BodyIndex j)> leaves;
    /// Whether the face at a position between two bodies never breaks. If not set, all can break.
    std::function<bool(Vec2 position, BodyIndex i, BodyIndex j)> holds;
    double least_distance_share = 0.2;  ///< least distance of two reference points, relative to the mean
    StrengthFactors factors;
};

/// How well the reference points suit the faces.
struct FaceQuality {
    double largest_offset = 0.0;   ///< largest |(x_j - x_i)·t|/h: the share of the shear strain that errs
    std::int64_t raised = 0;       ///< number of faces whose h was raised to the least distance
    std::int64_t by_centroid = 0;  ///< number of sides and faces of rigid bodies that use the centroid
    double slowest_lag = 1.0;      ///< smallest share of FaceLag
};

/// Bonds all polygons of a world at their current positions, without force. @param quality receives the quality, if
/// given @throws InputError if the world has no faces, or if a value is out of its range
Faces bond_faces(const World& world, const FaceBonding& bonding, FaceQuality* quality = nullptr);

}  // namespace crackle
