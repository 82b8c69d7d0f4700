// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities in summary.json on damage: broken bonds, fragments, crack directions, joints, acoustic emission and
// energies.
// Tested by tests/tools/readme_test.py and tests/specimens/summary/summary_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/summary/figure.hpp"

namespace crackle {

/// Rosin-Rammler distribution of fragment sizes.
CRACKLE_FIGURES(
    FragmentLaw,
    (Number, size, "m",
     "size parameter of the Rosin-Rammler distribution: a fraction 1/e of the area lies in larger fragments",
     "null if the distribution is fitted to fewer than five fragments, or if their sizes are all equal or spread too "
     "widely"),
    (Number, exponent, "-", "exponent of the Rosin-Rammler distribution; it is larger if the sizes are more uniform",
     "null if `size` is null"),
    (Count, fragments, "", "number of fragments to which the distribution is fitted"));

/// The largest crack: the largest group of connected broken bonds.
CRACKLE_FIGURES(
    LargestCrack,
    (Count, bonds, "",
     "number of broken bonds in the largest crack; broken bonds with a particle in common belong to the same crack"),
    (Count, of_platen, "", "number of broken bonds in the largest crack that joined a particle to a platen"),
    (Number, height, "m",
     "mean initial height of the bonds of the largest crack above the lower face of the specimen"));

/// Broken bonds and the fragments that remain.
CRACKLE_FIGURES(
    DamageFigures, (Count, bonds_broken, "", "number of bonded contact points that broke"),
    (Count, bonds_broken_after_sliding, "",
     "number of bonded contact points that reached their Coulomb limit before they broke"),
    (Count, bonds_broken_in_shear, "",
     "number of bonded contact points that broke in shear, as defined by `mode` in events.csv. Back-tension bonds "
     "seldom break in shear: such a bond breaks when its overlap vanishes, and its Coulomb limit vanishes with the "
     "overlap; see bonds_broken_after_sliding"),
    (Count, bonds_broken_in_tension, "",
     "number of bonded contact points that broke in tension, as defined by `mode` in events.csv"),
    (Count, bonds_broken_in_shear_to_peak, "", "number of bonded contact points that broke in shear up to the peak"),
    (Count, bonds_broken_in_tension_to_peak, "",
     "number of bonded contact points that broke in tension up to the peak"),
    (Count, interfaces_lost, "", "number of initially bonded pairs of bodies that have no intact bond left"),
    (Number, area_strain_peak, "-",
     "area strain at the peak: axial strain minus lateral strain, with shortening and widening counted as positive; it "
     "is positive if the specimen's area has decreased",
     "null if the specimen has no side particles, or in tests without platens"),
    (Number, area_strain_end, "-",
     "area strain at the end of the test, defined as for area_strain_peak; it includes particles that have come off "
     "the sides",
     "null if the specimen has no side particles, or in tests without platens"),
    (Count, fragments, "",
     "number of fragments at the end: groups of particles connected by intact bonds. A particle without bonds counts "
     "as a fragment, even if it was never bonded"),
    (Number, largest_fragment_share, "-", "area of the largest fragment as a fraction of the area of all particles"),
    (Number, fragment_size_median, "m",
     "D50: half of the particles' area belongs to fragments with an equivalent diameter sqrt(4 area/pi) of at most "
     "this size"),
    (Stated<FragmentLaw>, fragment_rosin_rammler, "",
     "Rosin-Rammler distribution, in which fragments larger than x make up the fraction exp(-(x/size)^exponent) of the "
     "area. It is fitted by maximum likelihood to the fragments with at least twice the mean particle area"),
    (Word, failed_at, "",
     "location of the largest crack: `platen` if at least half of its bonds joined particles to a platen, `grip` if it "
     "lies within a grip, otherwise `gauge`",
     "null if no bond has broken, and in tests without platens"),
    (Stated<LargestCrack>, largest_crack, "", "size and position of the largest crack",
     "null if no bond has broken, and in tests without platens"));

/// Directions of cracks of one kind.
CRACKLE_FIGURES(
    RoseFigures,
    (Count, cracks, "", "number of broken bonded contact points of this kind, excluding those at platens",
     "`*` is tension_to_peak, shear_to_peak, tension_after or shear_after; tension and shear are defined by `mode` in "
     "events.csv"),
    (Number, length, "m",
     "total length of the cracks of this kind: the parts of faces at which bonded points of this kind broke"),
    (Number, direction, "degrees",
     "mean direction of the cracks, computed from doubled angles, because a crack and the same crack turned by 180 "
     "degrees have the same direction",
     "null if there are no cracks; resultant and rayleigh are then null as well"),
    (Number, resultant, "-",
     "length of the mean vector of the doubled angles: 0 if the directions cancel, 1 if all cracks are parallel"),
    (Number, rayleigh, "-",
     "probability that independent cracks without a preferred direction have at least this resultant (Rayleigh's "
     "test)"),
    (List<double>, lengths, "m", "total crack length in each of 18 bins of 10 degrees, starting at 0 degrees"));

/// Directions of cracks by kind, up to the peak and after it.
CRACKLE_FIGURES(RosesByKind, (Stated<RoseFigures>, tension_to_peak), (Stated<RoseFigures>, shear_to_peak),
                (Stated<RoseFigures>, tension_after), (Stated<RoseFigures>, shear_after));

/// State of joints at one moment.
CRACKLE_FIGURES(JointMotion,
                (Number, failed_share, "-",
                 "length of the faces that have lost all their bonds, divided by the length of the faces that were "
                 "bonded initially",
                 "null if no face was bonded initially (open joints)"),
                (Number, opening, "m",
                 "mean opening along the face normals since loading began, weighted by face length, positive if the "
                 "faces separate; it includes the deformation of the contact springs"),
                (Number, slip, "m",
                 "mean slip along the faces since loading began, weighted by face length; positive if an observer "
                 "looking across the face sees the far side move to the left"),
                (Number, largest_opening, "m", "largest opening of any single face"),
                (Number, largest_slip, "m", "signed slip of the face whose slip is largest in magnitude"));

/// State of a single trace, or of all traces of one [[joint_set]] or [[trace]].
CRACKLE_FIGURES(JointFigures, (Word, source, "", "name of the joint set or trace"),
                (Number, length, "m", "total length of the traces inside the box of the specimen"),
                (Count, faces, "", "number of faces between bodies that lie on the traces"),
                (Number, length_of_faces, "m", "total length of the faces that lie on the traces",
                 "a face that several traces share is counted for only one of them"),
                (Number, bonded_share, "-", "fraction of length_of_faces that was bonded when loading began"),
                (Stated<JointMotion>, at_peak, "",
                 "state of the faces at the peak, or at the largest stress if the specimen has not failed"),
                (Stated<JointMotion>, at_end, "",
                 "state of the faces at the end of the test, with the same keys as at_peak"),
                (Count, traces, "", "number of traces that belong to the joint set or trace"));

/// Bond breaks on and off joints, and the motion of joints.
CRACKLE_FIGURES(
    JointedFigures,
    (Count, bonds_broken_on_joints, "",
     "number of bonded contact points on joint traces that broke up to the end of the test, for jointed specimens"),
    (Count, bonds_broken_in_rock, "",
     "number of bonded contact points off the joint traces that broke up to the end of the test"),
    (Count, bonds_broken_on_joints_to_peak, "",
     "number of bonded contact points on joint traces that broke up to the peak"),
    (Count, bonds_broken_in_rock_to_peak, "",
     "number of bonded contact points off the joint traces that broke up to the peak"),
    (List<JointFigures>, joints, unlisted,
     "list with one entry for each [[joint_set]] and [[trace]]: the combined state of its traces"),
    (Aside<std::vector<JointFigures>>, traces, unlisted,
     "list with one entry for each trace, in the order of the trace indices (from 0), with the same keys as in "
     "`joints`"));

/// Acoustic events.
CRACKLE_FIGURES(
    EmissionFigures, (Count, events, "", "number of acoustic events, equal to the number of rows of ae.csv"),
    (Number, opening, "-",
     "fraction of events with an opening source (R of ae.csv above 30) among those that have a moment"),
    (Number, shear, "-",
     "fraction of events with a shear source (R of ae.csv from -30 to 30) among those that have a moment"),
    (Number, closing, "-",
     "fraction of events with a closing (implosive) source (R of ae.csv below -30) among those that have a moment"),
    (Count, without_moment, "",
     "number of events that have no moment or magnitude because no force around the source changed"),
    (Number, largest_magnitude, "-", "largest moment magnitude Mw of all events"),
    (Number, radius, "m", "radius of the source region of a single break, equal to the mean particle diameter"),
    (Number, window, "s",
     "time after a single break within which another break may join the same event: `radius` divided by half the shear "
     "wave speed"),
    (Number, shear_wave_speed, "m/s",
     "shear wave speed sqrt(G/density), with G = E/(2 (1 + nu)) from youngs_modulus and poissons_ratio, or with G from "
     "a mean-field estimate if these are unknown"),
    (Word, speed_from, "",
     "how the shear modulus is obtained: `moduli` if it follows from youngs_modulus and poissons_ratio, `mean field` "
     "if these are unknown",
     "the mean-field estimate assumes that all bonds deform in one uniform pure shear, and omits bonds to platens; it "
     "is an upper bound on G of the specimen without these bonds"),
    (Number, density, "kg/m2", "mass per area of the specimen, including its pores"),
    (Number, damping_ratio, "-", "ratio of the normal dashpot to critical damping, averaged over the bonds"));

/// b-value for a magnitude of completeness found by another method.
CRACKLE_FIGURES(OtherBValue, (Number, b, "-", "b-value for the magnitude of completeness given here"),
                (Count, events, "", "number of events above the magnitude of completeness given here"),
                (Number, completeness, "-",
                 "magnitude of completeness (Mw), chosen so that the magnitudes of larger events come closest to a "
                 "straight frequency-magnitude line"));

/// b-value of the moment magnitudes.
CRACKLE_FIGURES(BValueFigures,
                (Number, b, "-", "b-value by maximum likelihood (Aki), corrected for bias",
                 "null if fewer than 50 events exceed the magnitude of completeness; error, interval and straight are "
                 "then null as well"),
                (Number, error, "-", "standard error of b (Shi & Bolt)"),
                (List<double>, interval, "-",
                 "lower and upper ends of the 95 % confidence interval of b, valid if the magnitudes follow a straight "
                 "frequency-magnitude line"),
                (Count, events, "", "number of events above the magnitude of completeness, from which b is estimated"),
                (Flag, few, "", "whether b is estimated from fewer than 200 events"),
                (Number, completeness, "-",
                 "magnitude of completeness Mw by the method of maximum curvature: the middle of the fullest bin of "
                 "width 0.1, plus 0.2"),
                (Flag, straight, "",
                 "whether the magnitudes are consistent with a straight frequency-magnitude line in the "
                 "Kolmogorov-Smirnov test at the 5 % level; if not, b has little meaning"),
                (Stated<OtherBValue>, least_distance, "",
                 "b-value for another magnitude of completeness, chosen so that the magnitudes of larger events come "
                 "closest to a straight frequency-magnitude line. No error is stated, because this choice and b depend "
                 "on the same events"));

/// Parts of the work done on the specimen that were stored or dissipated.
CRACKLE_FIGURES(EnergyShares,
                (Number, work, "J", "total work done on the specimen: platen_work plus confinement_work of curve.csv"),
                (Number, strain, "-", "change of the strain energy in contacts, as a fraction of the work"),
                (Number, kinetic, "-", "change of the kinetic energy, as a fraction of the work"),
                (Number, friction, "-", "energy dissipated by sliding, as a fraction of the work"),
                (Number, fracture, "-", "energy dissipated by broken bonds, as a fraction of the work"),
                (Number, dashpot, "-", "energy dissipated in dashpots, as a fraction of the work"));

}  // namespace crackle
