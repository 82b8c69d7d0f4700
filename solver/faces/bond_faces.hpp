// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds the polygons of a world by faces: computes the springs of every face, and the coefficients that couple faces to
// the pressures of cells.
//
// Each cell i has one reference point x_i: its seed or, if that is not given, the circumcentre of a triangle or the
// centroid of any other polygon. Let c be the midpoint of a face, n its normal from i to j, t this normal turned by +90
// degrees, and E_i the contact modulus of cell i:
//     a_i = (c - x_i)·n     a_j = (x_j - c)·n     D = a_i/E_i + a_j/E_j
//     k_n = L/D     s_i = (a_i/E_i)/D     m_i = (c - x_i)·t/(E_i D)     likewise for j
// Within one rock of contact modulus E_c, k_n is therefore E_c L/h with h = a_i + a_j. Under uniform strain every cell
// is exactly in equilibrium if κ = k_t/k_n = 1 and x_j - x_i is parallel to n on every face. This holds for Voronoi and
// Laguerre cells, and for Delaunay triangles with circumcentres. If h is less than a given fraction of its mean, this
// fraction is used instead.
//
// A driven body j counts as rigid: its faces have a_j = 0, s_i = 1 and m_i = m_j = 0. At a free side, or at a face on a
// rigid body, a reference point may lie too close to the edge or beyond it. The centroid of the cell then replaces it.
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

/// Stiffness and strength of the faces within a material.
struct FaceMaterial {
    FaceModuli moduli;
    FaceLaw law;
};

/// Law of the faces between two materials. It replaces the default, which is weaker_law() of the two materials' laws.
struct FacePair {
    std::size_t a = 0, b = 0;  ///< as in Settings::materials
    FaceLaw law;
};

/// Behaviour of the faces between cells and driven bodies.
enum class PlatenFaces {
    smooth,  ///< faces never break and have no shear stiffness
    glued,   ///< faces never break and have the cell's shear stiffness
    bonded,  ///< faces break like those within the cell's material
    rubbing  ///< faces are broken from the start and have the friction FaceBonding::platen_friction
};

/// Law with the smaller strengths of two laws, the larger moment share, and the shorter softening lengths.
FaceLaw weaker_law(const FaceLaw& a, const FaceLaw& b);

/// Input of bond_faces().
struct FaceBonding {
    std::vector<FaceMaterial> materials;  ///< in the order of Settings::materials
    std::vector<FacePair> pairs;
    double gap = 0.0;             ///< m, distance between facing edges of the mesh
    Outlines outlines;            ///< m, outlines by body before the mesh was inset; if empty, recovered from the gap
    std::vector<Vec2> reference;  ///< m, reference points by body; if empty or NaN, circumcentres or centroids are used
    PlatenFaces platens = PlatenFaces::smooth;
    double platen_friction = 0.0;  ///< tan φ of PlatenFaces::rubbing
    /// Returns whether the faces between two bodies start broken, without cohesion. If not set, all faces start intact.
    std::function<bool(BodyIndex i, BodyIndex j)> leaves;
    /// Whether loading presses open joints together. The linear solution then counts their faces as intact.
    bool pressed = false;
    /// Returns whether the face at a position between two bodies never breaks. If not set, all faces can break.
    std::function<bool(Vec2 position, BodyIndex i, BodyIndex j)> holds;
    double least_distance_share = 0.2;  ///< least distance between two reference points, relative to the mean distance
    StrengthFactors factors;
};

/// Measures of how well the reference points suit the faces.
struct FaceQuality {
    double largest_offset = 0.0;   ///< largest |(x_j - x_i)·t|/h; 0 if x_j - x_i is parallel to n on every face
    std::int64_t raised = 0;       ///< number of faces whose distance h was raised to the least distance
    std::int64_t by_centroid = 0;  ///< number of free sides and faces on rigid bodies that use the centroid
    double slowest_lag = 1.0;      ///< smallest value in any FaceLag
};

/// Bonds all polygons of a world; faces carry no force at the current positions. @param quality receives the quality of
/// the reference points; may be null @throws InputError if the world has no faces, or if a value is out of its range
Faces bond_faces(const World& world, const FaceBonding& bonding, FaceQuality* quality = nullptr);

}  // namespace crackle
