// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of test: what is cut from the packing, which parts hold and drive it, what its force and displacement mean.
//
//   compression, tension, biaxial  the whole packing between two platens (specimens/setup/platen.hpp)
//   brazilian                      a disc between two jaws                                              brazilian.cpp
//   bending                        a beam on two supports, pressed at midspan, with or without a notch  bending.cpp
//   scb                            half a disc with a notch on two supports (semi-circular bend)        scb.cpp
//   direct_shear                   a block in two half boxes, the upper one pressed and drawn along direct_shear.cpp
//
// Of every kind: stress = force of the specimen on the driving part, along its way, over `section`; axial strain = way
// of the driving part over `length`. Both are nominal: the formulas that each file gives turn them into the strengths
// that the field knows. A kind is one file and a row of test_kinds().
// Tested by tests/specimens/kinds/test_kind_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/case/test_case.hpp"

namespace crackle {

/// A straight cut: polygons that it parts are not bonded across it, circles that it runs through are taken away.
struct Notch {
    Vec2 mouth, tip;  // m

    /// Whether the way from a to b crosses it.
    bool parts(Vec2 a, Vec2 b) const;
    double distance(Vec2 place) const;  ///< m, of a place from it
};

/// Where bodies are whose distance is the lateral gauge length.
struct Region {
    double x1 = 0.0, x2 = 0.0, y1 = 0.0, y2 = 0.0;  // m

    bool holds(Vec2 p) const { return p.x >= x1 && p.x <= x2 && p.y >= y1 && p.y <= y2; }
};

/// What of a packing is tested.
struct Shape {
    std::vector<Vec2> outline;  ///< convex, counter-clockwise; empty: the whole packing
    std::optional<Notch> notch;
    std::optional<Region> left, right;  ///< where the sides are whose distance is measured; absent: side faces, or none
    double width = 0.0, height = 0.0;   // m

    bool whole() const { return outline.empty() && !notch; }
    /// Whether a place lies inside; of the whole packing every place does.
    bool holds(Vec2 place) const;
};

/// A rigid body that holds the specimen or drives it. A degree of freedom without a drive follows the specimen.
struct LoadingPart {
    std::vector<Vec2> corners;  ///< counter-clockwise, those of its face first
    std::uint32_t face = 2;     ///< corners of the face, which is all that is drawn
    DofControl x, y, rotation;
};

/// What holds and drives a specimen, and what is read from it.
struct Apparatus {
    std::vector<LoadingPart> parts;      ///< the last one drives
    int axis = 1;                        ///< of its way: 0 x, 1 y
    double section = 0.0, length = 0.0;  // m
    double normal_force = 0.0;           ///< N, on the driving part across its way, towards the specimen
    double normal_spring = 0.0;          ///< N/m, by which it grows as that part goes the other way
    double stress_intensity = 0.0;       ///< sqrt(m): K_I over the nominal stress; 0 without a notch
    double span = 0.0;                   ///< m, between supports; 0 without
};

/// A corner, or a circle, of the specimen: what comes nearer than its reach touches it.
struct SurfacePoint {
    Vec2 place;          // m
    double reach = 0.0;  // m
};

/// What a kind goes by.
struct KindRequest {
    const TestCase& test;
    Domain packing;                          ///< the box of the packing
    double particle = 0.0;                   ///< m, mean size: of a cell the root of its area, of a circle its diameter
    double offset = 0.0;                     ///< m, from a face of the packing to that of a part which is bonded to it
    double cut_offset = 0.0;                 ///< m, likewise from an outline that was cut
    std::vector<SurfacePoint> surface = {};  ///< of the specimen, which parts that are not bonded just touch

    [[noreturn]] void refuse(const std::string& key, const std::string& found, const std::string& expected,
                             const std::string& remedy) const;
};

struct TestKind {
    const char* name;
    bool compression;  ///< the driving part moves against its axis
    bool uniaxial;     ///< stress and strain are those of the rock: moduli, thresholds and the like are defined
    /// What is cut from the packing, before bodies are known.
    Shape (*shape)(const KindRequest&);
    /// None of the uniaxial kinds, which have platens.
    Apparatus (*apparatus)(const KindRequest&, const Shape&);
};

const std::vector<TestKind>& test_kinds();
/// @throws std::out_of_range of a name that is none
const TestKind& test_kind(const std::string& name);
/// Their names, in the order in which they are told.
std::vector<std::string> test_kind_names();

/// m; the largest that the packing has room for where the case gives none
double disc_diameter(const KindRequest& request);
/// rad, half of the arc over which a jaw presses
double half_angle(const KindRequest& request);
/// m, of the pads that hold and press a beam or half a disc
double pad_width(const KindRequest& request);

/// A pad with a flat face of this width, centred at x. @param y of its face @param up whether the specimen lies above
LoadingPart flat_pad(double x, double y, double width, bool up);

// The kinds' own files.
Shape whole_packing(const KindRequest& request);
Shape brazilian_shape(const KindRequest& request);
Apparatus brazilian_apparatus(const KindRequest& request, const Shape& shape);
Shape bending_shape(const KindRequest& request);
Apparatus bending_apparatus(const KindRequest& request, const Shape& shape);
Shape scb_shape(const KindRequest& request);
Apparatus scb_apparatus(const KindRequest& request, const Shape& shape);
Apparatus direct_shear_apparatus(const KindRequest& request, const Shape& shape);

/// f(a/W) of a notched beam in three-point bending, S = 4W: K_I = P S/W^1.5 f (ASTM E399), 0 < a/W < 1; of a thickness
/// of 1.
double notched_beam_factor(double ratio);
/// Y' of half a disc: K_I = Y' P sqrt(πa)/(2R) (Kuruppu et al., Rock Mech. Rock Eng. 47, 2014).
/// @param ratio a/R, 0.4 to 0.6 @param half_span s/2R, 0.5 to 0.8
double semicircle_factor(double ratio, double half_span);
/// Stress at the centre of a disc over 2P/(πD): uniform pressure over an arc of half angle α on either side (Hondros,
/// Aust. J. Appl. Sci. 10, 1959): (sin 2α - α)/sin α.
double brazilian_factor(double alpha);

}  // namespace crackle
