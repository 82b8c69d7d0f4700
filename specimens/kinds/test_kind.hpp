// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of test. A kind defines the tested part of the packing, the parts that hold and drive it, and how force and
// displacement become stress and strain.
//
//   compression, tension, biaxial   the whole packing between two platens (specimens/setup/platen.hpp)  platens.cpp
//   brazilian                       a disc between two jaws                                              brazilian.cpp
//   bending                         a beam on two supports, pressed at midspan, with or without a notch  bending.cpp
//   scb                             half a disc with a notch on two supports (semi-circular bend)        scb.cpp
//   direct_shear                    a block in two half boxes; the upper is pressed and moved along    direct_shear.cpp
//
// For every kind, stress is the force that the driving part exerts on the specimen, divided by `section`; it is
// positive in the direction of travel of the driving part. Axial strain is the displacement of the driving part divided
// by `length`. Both are nominal values; the formulas in the file of each kind convert them to the usual strengths. Each
// kind consists of one file and one row in specimens/case/kinds/test_kind.hpp.
// Tested by tests/specimens/kinds/test_kind_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/case/kinds/test_kind.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// A straight cut: polygons on opposite sides are not bonded to each other, and circles that it crosses are removed.
struct Notch {
    Vec2 mouth, tip;  // m

    /// Whether the notch crosses the segment from a to b.
    bool parts(Vec2 a, Vec2 b) const;
    double distance(Vec2 place) const;  ///< distance from a point to the notch, m
};

/// A rectangle that contains the bodies defining one end of the lateral gauge length.
struct Region {
    double x1 = 0.0, x2 = 0.0, y1 = 0.0, y2 = 0.0;  // m

    /// Whether a point lies in the rectangle.
    bool holds(Vec2 p) const { return p.x >= x1 && p.x <= x2 && p.y >= y1 && p.y <= y2; }
};

/// The tested part of a packing.
struct Shape {
    std::vector<Vec2> outline;  ///< convex, counter-clockwise; empty if the whole packing is tested
    std::optional<Notch> notch;
    std::optional<Region> left,
        right;  ///< regions whose bodies define the ends of the lateral gauge; if absent, the side
    ///< faces define them, or there is no gauge
    double width = 0.0, height = 0.0;  // m

    /// Whether the whole packing is tested.
    bool whole() const { return outline.empty() && !notch; }
    /// Area, m2. @param box  the box of the packing
    double area(const Domain& box) const;
    /// Whether a point lies inside the shape; always true for the whole packing.
    bool holds(Vec2 place) const;
};

/// A rigid body that holds or drives the specimen. A degree of freedom that is not driven follows the specimen.
struct LoadingPart {
    std::vector<Vec2> corners;  ///< counter-clockwise; the corners of the face come first
    std::uint32_t face = 2;     ///< number of corners on the face; only the face is plotted
    DofControl x, y, rotation;
};

/// The parts that hold and drive a specimen, and the dimensions used to evaluate their forces.
struct Apparatus {
    std::vector<LoadingPart> parts;      ///< the last part is the driving part
    int axis = 1;                        ///< axis along which the driving part moves: 0 is x, 1 is y
    double section = 0.0, length = 0.0;  // m
    /// Normal force on the driving part, N, perpendicular to its direction of travel and towards the specimen.
    double normal_force = 0.0;
    double normal_spring =
        0.0;  ///< N/m; increase of the normal force per displacement of the driving part away from the specimen
    double stress_intensity = 0.0;  ///< K_I divided by the nominal stress, sqrt(m); 0 without a notch
    double span = 0.0;              ///< distance between the supports, m; 0 without supports
};

/// A corner or circle of the specimen. The face of a part touches it if the distance is less than `reach`.
struct SurfacePoint {
    Vec2 place;          // m
    double reach = 0.0;  // m
};

/// Input from which a kind derives the specimen's shape and the apparatus.
struct KindRequest {
    const parts::Procedure& test;
    Domain packing;           ///< the box of the packing
    double particle = 0.0;    ///< m, mean particle size: square root of a cell's area, or diameter of a circle
    double offset = 0.0;      ///< m, distance from a face of the packing to the face of a bonded part
    double cut_offset = 0.0;  ///< m, distance from a cut outline to the face of a bonded part
    std::vector<SurfacePoint> surface =
        {};  ///< surface points of the specimen; parts that are not bonded are placed so that they just touch it

    /// Refuses a value of the case. @throws InputError «file:line: key: found X, expected Y; remedy», always
    [[noreturn]] void refuse(CaseKey key, const std::string& found, const std::string& expected,
                             const std::string& remedy) const;
};

/// Diameter of the disc, m. @param room  default diameter, m: the largest disc that fits into the packing
double disc_diameter(const KindRequest& request, double room);
/// Half the angle of the arc over which a jaw presses, rad.
double half_angle(const KindRequest& request);
/// Width of the pads that support and load the specimen, m. @param size  depth of a beam or radius of a half disc, m
double pad_width(const KindRequest& request, double size);

/// A pad with a flat face of the given width, centred at x.
/// @param y  position of the face
/// @param up  whether the specimen lies above the pad
LoadingPart flat_pad(double x, double y, double width, bool up);

/// Reason why pads and boxes may not be frictional.
inline constexpr const char* bonded_parts = "pads and boxes are bonded to the specimen";

/// The shape that keeps the whole packing.
Shape whole_packing(const KindRequest& request);

/// f(a/W) of a beam with a notch of length a in three-point bending with S = 4W, for unit thickness: K_I = P S/W^1.5 f
/// (ASTM E399).
/// @param ratio  a/W, above 0 and below 1
double notched_beam_factor(double ratio);
/// Y' of a notched half disc: K_I = Y' P sqrt(πa)/(2R) (Kuruppu et al., Rock Mech. Rock Eng. 47, 2014).
/// @param ratio  a/R, 0.4 to 0.6 @param half_span  s/(2R), 0.5 to 0.8
double semicircle_factor(double ratio, double half_span);
/// Ratio of the stress at the centre of a disc to 2P/(πD), for uniform pressure on two opposite arcs of half angle α
/// (Hondros, Aust. J. Appl. Sci. 10, 1959): (sin 2α - α)/sin α.
double brazilian_factor(double alpha);

}  // namespace crackle
