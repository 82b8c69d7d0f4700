// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities in summary.json on what was tested, strength, moduli, validity, confinement, cracking and cycles.
// Tested by tests/tools/readme_test.py and tests/specimens/summary/summary_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/parts/resolved_case.hpp"
#include "specimens/summary/figure.hpp"

namespace crackle {

/// What was tested, and how the test ended.
CRACKLE_FIGURES(
    Description, (Text, title, unlisted, "title of the case, used as the heading of the report"),
    (Stated<LoadingKind>, kind, unlisted, "kind of test, as in `loading.kind`"),
    (Stated<SpecimenKind>, specimen, unlisted, "type of specimen: `circles`, `delaunay` or `voronoi`"),
    (Stated<PlatenKind>, platens, unlisted, "how the platens hold the specimen: `bonded`, `glued` or `frictional`"),
    (Stated<BondLaw>, bond_law, unlisted, "bond law: `back_tension`, `coulomb` or `face`"),
    (Stated<StiffnessUnits>, material_units, unlisted,
     "what the material's stiffness and strengths refer to: `point` (a contact point) or `area` (the area "
     "of a face); with `area`, stresses are already in Pa"),
    (Flag, failed, unlisted,
     "whether the specimen has failed, so that its peak is final: after the peak, the stress stayed lower than the "
     "peak by more than the fraction `loading.strength_drop`. The drop lasted for a tenth of the strain at the peak "
     "and for at least ten rows (of at least 2000), or the test ended by failure"),
    (Flag, interrupted, unlisted, "whether the test was interrupted before its end and can be resumed"),
    (Word, ended_by, unlisted,
     "reason why the test ended: `failure`, `max_axial_strain`, `caller` (a callback in Python), `interrupt` or "
     "`instability`. `failure` means that the stress stayed below the fraction `loading.stop_at_share_of_peak` of its "
     "largest value, over the same strain and number of rows as for `failed`"),
    (Text, note, unlisted, "only if the specimen has not failed: explains to which stress the peak and moduli refer"));

/// Counts within the window of the initial tangent.
CRACKLE_FIGURES(TangentWindow, (Count, rows, "", "number of rows of the curve in the window"),
                (Number, strain_to, "-", "axial strain at the end of the window"),
                (Count, bonds_broken, "", "number of bonded contact points that broke in the window"),
                (Count, points_sliding, "",
                 "number of contact points at the Coulomb limit at the end of the window, as in curve.csv"),
                (Count, contacts_gained, "",
                 "increase in the number of unbonded contact points that touch, over the window"));

/// Peak and moduli.
CRACKLE_FIGURES(
    Strength,
    (Stress, peak_stress, "N/m", "strength of the specimen, positive in the direction of loading",
     "the peak is the first maximum of the axial stress that is followed by a lasting drop of more than the fraction "
     "`loading.strength_drop`"),
    (Stress, peak_stress_so_far, "N/m",
     "largest axial stress, positive in the direction of loading; replaces `peak_stress` if the specimen has not "
     "failed"),
    (Number, peak_strain, "-", "axial strain at the peak stress, positive in the direction of loading"),
    (Number, peak_strain_so_far, "-",
     "axial strain at the largest axial stress, positive in the direction of loading; replaces `peak_strain` if the "
     "specimen has not failed"),
    (Stress, largest_stress, "N/m", "largest axial stress of the whole test, positive in the direction of loading",
     "a notice is given if this stress occurs after the peak"),
    (Number, strain_at_largest_stress, "-",
     "axial strain at the largest axial stress of the whole test, positive in the direction of loading"),
    (Stress, youngs_modulus, "N/m",
     "Young's modulus at small strain, from a linear solution (sparse solve) with all bonds intact, no sliding and "
     "bonded platens",
     "null in tests without platens"),
    (Number, poissons_ratio, "-", "Poisson's ratio at small strain, from the same linear solution as youngs_modulus"),
    (Stress, gauge_modulus, "N/m",
     "stress divided by the strain of the axial gauge length, from the same linear solution as youngs_modulus",
     "null if an end of the gauge length has no particles"),
    (Stress, initial_tangent_modulus, "N/m",
     "slope of axial stress against axial strain, by linear regression from the start to a twentieth of the strain at "
     "the peak"),
    (Number, initial_poissons_ratio, "-",
     "Poisson's ratio by linear regression over the rows of initial_tangent_modulus"),
    (Stated<TangentWindow>, initial_tangent_window, "",
     "counts in the window over which initial_tangent_modulus is fitted"),
    (Stress, tangent_modulus_50, "N/m",
     "slope of axial stress against axial strain, by linear regression from 40 % to 60 % of the peak stress"),
    (Number, tangent_50_poissons_ratio, "-",
     "Poisson's ratio by linear regression over the rows of tangent_modulus_50"),
    (Stress, average_modulus, "N/m",
     "slope of axial stress against axial strain, by linear regression over the straightest part of the curve before "
     "the peak that spans 30 % of the peak stress"),
    (Number, average_poissons_ratio, "-", "Poisson's ratio by linear regression over the rows of average_modulus"),
    (Stress, secant_modulus_50, "N/m",
     "secant modulus, from the first row of the curve to the row that first reaches half the peak stress"),
    (Number, secant_50_poissons_ratio, "-",
     "ratio of lateral to axial strain between the two rows of secant_modulus_50, positive if the specimen widens in "
     "compression or narrows in tension"),
    (Stress, post_peak_modulus, "N/m",
     "slope of axial stress against axial strain after the peak, by linear regression from 90 % to 60 % of the peak "
     "stress; it is negative",
     "null if the stress has not fallen to 60 % of the peak, if the fall has fewer than three rows, or if the "
     "regression line rises"),
    (Number, brittleness_index, "-",
     "brittleness index (M - E)/M, with M = post_peak_modulus and E = youngs_modulus: 1 if the stress drops at once, "
     "and larger if it falls more slowly",
     "null if E or M is null"));

/// Definitions of stress and strain for a test without platens, and results derived from its peak.
CRACKLE_FIGURES(
    NominalFigures,
    (Number, stress_section, "m", "length by which the force on the driving part is divided to obtain the axial stress",
     "only for kinds of test without platens; this also applies to the following keys up to `dilation_end`"),
    (Number, strain_length, "m",
     "length by which the displacement of the driving part is divided to obtain the axial strain"),
    (Number, peak_force, "N", "force on the driving part at the peak, for a thickness of 1 m"),
    (Number, peak_force_so_far, "N",
     "largest force on the driving part, for a thickness of 1 m; replaces `peak_force` if the specimen has not failed"),
    (Stress, nominal_modulus, "N/m",
     "axial stress divided by axial strain at small strain, both as defined for this kind of test, from a linear "
     "solution (sparse solve)"),
    (Number, span, "m", "distance between the supports"),
    (Number, notch, "m", "length of the notch",
     "only for notched specimens; this also applies to the following keys up to `fracture_toughness`"),
    (Number, notch_over_particle, "-", "length of the notch divided by the square root of the mean particle area"),
    (Number, fracture_toughness, "N/m sqrt(m)",
     "stress intensity factor K_I at the largest stress, by the linear elastic formula for this shape of specimen"),
    (Number, fracture_toughness_so_far, "N/m sqrt(m)",
     "the same so far; replaces `fracture_toughness` if the specimen has not failed"),
    (Stress, normal_stress, "N/m",
     "normal stress on the upper half of the shear box when shearing began, positive in compression",
     "only for direct shear tests; this also applies to the following keys up to `dilation_end`"),
    (Stress, normal_stress_at_peak, "N/m",
     "normal stress on the upper half of the shear box at the peak, including the increase caused by the rise of this "
     "half",
     "only for tests with `loading.normal_stiffness`"),
    (Stress, normal_stress_at_peak_so_far, "N/m",
     "normal stress on the upper half of the shear box at the largest shear stress; replaces `normal_stress_at_peak` "
     "if the specimen has not failed"),
    (Stress, normal_stress_end, "N/m", "normal stress on the upper half of the shear box at the end of the test"),
    (Stress, residual_stress, "N/m", "residual shear stress: the mean over the last tenth of the strain",
     "null unless the test ended by reaching `loading.max_axial_strain`"),
    (Number, dilation_angle_at_peak, "deg",
     "dilation angle at the peak: arctangent of the slope of rise against shear displacement of the upper half box. "
     "The slope is found by linear regression over the rows whose strain is within a tenth of that at the peak"),
    (Number, dilation_end, "m", "rise of the upper half box at the end of the test, positive if the joint opens"));

/// A condition that must hold for a valid test, and whether it does.
CRACKLE_FIGURES(JudgedClaim, (Word, claim, unlisted, "condition for a valid test"),
                (Flag, holds, unlisted, "whether the condition holds; null if unknown"),
                (Word, found, unlisted, "values on which the judgement is based"));

/// Whether the test measures what it is meant to measure.
CRACKLE_FIGURES(Validity,
                (Flag, valid, unlisted,
                 "whether every condition in `validity` holds; null if one of them is unknown and none is violated"),
                (Aside<std::vector<JudgedClaim>>, validity, unlisted,
                 "conditions that must hold for the test to measure what it is meant to measure"));

/// The membrane of a confined test.
CRACKLE_FIGURES(MembraneFigures,
                (Count, points, "",
                 "number of points of the membrane at the end of the test, including those on platens"),
                (Count, wrapped, "",
                 "number of times the membrane was wrapped around the specimen, which happens when a piece becomes too "
                 "long and when the neighbour list is rebuilt"),
                (Number, area_jumps, "m2",
                 "sum of the changes of the enclosed area caused by wrapping the membrane; these changes do no work"),
                (Count, open, "",
                 "number of times the membrane could not be wrapped because the specimen had separated"),
                (Number, work, "J",
                 "work done by the membrane on the specimen: pressure times the decrease of the area enclosed between "
                 "the platens"));

/// Pressure on the sides.
CRACKLE_FIGURES(
    ConfinementFigures,
    (Stress, confining_pressure, "N/m", "pressure on the sides of the specimen",
     "only for biaxial tests; this also applies to the following keys up to `membrane`"),
    (Stress, deviator_stress, "N/m", "deviator stress at the peak: peak_stress minus confining_pressure"),
    (Stress, deviator_stress_so_far, "N/m",
     "largest axial stress minus confining_pressure; replaces `deviator_stress` if the specimen has not failed"),
    (Stated<ConfiningSide>, confining_side, "",
     "how the pressure is applied to the sides: by a `membrane`, or by `walls` (rigid plates, each pressed with a "
     "force equal to the pressure times the initial height)"),
    (Stated<MembraneFigures>, membrane, "",
     "membrane around the specimen: chains of points on its particles, with pressure on the straight pieces between "
     "them"));

/// Crack initiation stresses by other definitions.
CRACKLE_FIGURES(
    OtherInitiation,
    (Number, lateral_compliance, "N/m",
     "axial stress beyond which the lateral strain grows at more than 1.2 times its elastic rate nu/E. Up to the "
     "largest area strain, it is the stress at which the lateral strain is farthest below a line of that slope"),
    (Number, first_percent, "N/m",
     "axial stress at which the number of broken bonds reaches 1 % of its value at the peak"),
    (Number, count_break, "N/m",
     "axial stress at which the slope of the number of broken bonds against stress changes, by a fit of "
     "two lines up to 80 % of the peak stress",
     "null if there are fewer than ten bursts of bond breakage in this range"),
    (List<double>, count_interval, "N/m",
     "lower and upper ends of the 95 % confidence interval of count_break, by resampling the bursts of "
     "bond breakage"),
    (Number, crack_strain, "N/m",
     "axial stress at which the inelastic area strain, area strain - (1 - nu) stress/E, leaves a band of three "
     "standard deviations about its initial mean and stays outside until crack damage. Mean and deviation are those of "
     "the rows below a quarter of the peak"),
    (Number, lateral_strain, "N/m",
     "axial stress at which the curve of lateral strain against stress is farthest from its chord between "
     "the start and the largest area strain"),
    (Number, spread, "N/m", "difference between the largest and the smallest of all six crack initiation stresses"));

/// Stresses at which cracks form and coalesce, in a compression test.
CRACKLE_FIGURES(
    CrackingFigures,
    (Stress, crack_initiation_stress, "N/m",
     "crack initiation stress: axial stress beyond which the lateral strain exceeds the elastic one, nu stress/E. The "
     "excess is fitted by a parabola that begins at this stress, up to the largest area strain",
     "only for compression tests; this also applies to all keys of `crack_initiation` and `crack_damage`. Null if the "
     "specimen has no side particles, or if its area strain is largest among the first ten rows"),
    (Number, crack_initiation_error, "N/m",
     "error of crack_initiation_stress: its distance from crack_initiation.lateral_compliance"),
    (Number, crack_initiation_over_peak, "-", "crack_initiation_stress divided by the peak stress"),
    (Stated<OtherInitiation>, crack_initiation, "N/m",
     "crack initiation stresses by five other definitions, and the spread of all six",
     "a definition that cannot be evaluated is null"),
    (Stress, crack_damage_stress, "N/m",
     "crack damage stress: middle of the range of axial stresses up to the peak in which the area strain is within 2 % "
     "of its largest value",
     "null under the same conditions as crack_initiation_stress"),
    (Number, crack_damage_error, "N/m",
     "error of crack_damage_stress: half the width of the range of stresses of which it is the middle"),
    (Number, crack_damage_reversal, "N/m",
     "axial stress at the largest area strain up to the peak; the peak stress if the specimen's area decreased up to "
     "the peak"),
    (Number, crack_damage_strain, "-", "axial strain at which crack_damage_stress is first reached"),
    (Number, crack_damage_over_peak, "-", "crack_damage_stress divided by the peak stress"));

/// One cycle of unloading and reloading.
CRACKLE_FIGURES(
    CycleFigures, (Number, strain, "-", "axial strain at which unloading starts"),
    (Number, stress, "N/m", "axial stress at which unloading starts, positive in the direction of loading"),
    (Number, low_strain, "-", "smallest axial strain of the cycle, at which unloading ends"),
    (Number, low_stress, "N/m", "axial stress at low_strain, positive in the direction of loading"),
    (Number, modulus, "N/m",
     "secant modulus on unloading: change in axial stress divided by change in axial strain, from the start to the end "
     "of unloading",
     "equal to youngs_modulus if nothing has broken, slid or come into contact; modulus_error and permanent_strain are "
     "then 0. If more than 0.5 % of the bonds broke during the unloading, the specimen failed: modulus, Poisson's "
     "ratio, modulus_error, damage and permanent_strain are then null"),
    (Number, poissons_ratio, "-",
     "Poisson's ratio on unloading: change in lateral strain divided by change in axial strain; positive if the "
     "specimen widens in compression or narrows in tension",
     "null for kinds of test without platens"),
    (Number, modulus_error, "-",
     "upper bound on the relative error of the modulus due to inertia. It is half the stress difference between the "
     "two platens, summed over the start and the end of unloading, divided by the change in axial stress"),
    (Number, damage, "-",
     "damage 1 - modulus/youngs_modulus (or 1 - modulus/nominal_modulus for kinds of test without platens)",
     "0 if no bond has broken"),
    (Number, permanent_strain, "-",
     "permanent strain low_strain - low_stress/modulus, which would remain at zero stress"),
    (Number, loss, "J",
     "work that is not recovered in the cycle: the area of the hysteresis loop times the specimen's section and length",
     "null if the cycle is not finished"));

}  // namespace crackle
