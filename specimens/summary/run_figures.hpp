// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities in summary.json that describe the specimen, the numerics and the run.
// Tested by tests/tools/readme_test.py and tests/specimens/summary/summary_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "specimens/summary/figure.hpp"

namespace crackle {

/// The specimen when loading began.
CRACKLE_FIGURES(
    SpecimenFigures, (Number, initial_width, "m", "initial width of the specimen's domain"),
    (Number, initial_height, "m", "initial height of the specimen's domain"),
    (Count, particles, "", "number of particles in the specimen, without platens"),
    (Count, seeds, "", "number of circles from which the polygons were meshed",
     "only if the polygons were meshed for the test"),
    (Count, segments, "", "total number of polygon edges", "only for specimens of polygons"),
    (Number, bond_thick, "m",
     "thickness of the polygons' edges (segments) when bonds were made, equal to `bond.thick`"),
    (Count, contacts_initial, "", "number of contact points that touched when loading began"),
    (Count, bonds_initial, "", "number of bonded contact points when loading began"),
    (Count, interfaces_initial, "", "number of bonded pairs of bodies when loading began"),
    (Number, mean_back_tension, "N", "initial back-tension of a bonded contact point, averaged over all of them"),
    (Number, mean_back_tension_interface, "N",
     "initial back-tension of a bonded pair of bodies (the sum over its contact points), averaged over all pairs"),
    (Number, mean_bond_overlap, "m", "initial overlap of a bonded contact point, averaged over all of them"),
    (Number, mean_tensile_strength, "N",
     "tensile strength averaged over the bonded contact points that can break, including random factors",
     "only for coulomb bonds; this also applies to mean_cohesion"),
    (Number, mean_cohesion, "N",
     "cohesion averaged over the bonded contact points that can break, including random factors"),
    (Count, bonds_unbreakable, "",
     "number of bonded contact points that cannot break: those of glued platens and those within grips"),
    (Number, grip, "m", "depth of the region at each end of the specimen in which bonds never break"),
    (Count, platen_bottom_id, "", "id of the lower platen (or first support) in events.csv and frames"),
    (Count, platen_top_id, "", "id of the upper platen (or driving part) in events.csv and frames"));

/// Loading rates, time steps and force and energy balances.
CRACKLE_FIGURES(
    NumericsFigures,
    (Number, rate_tolerance, "-",
     "tolerance of the inertia error, which is the out-of-balance of the platens or the ratio of kinetic to strain "
     "energy. The largest loading rate is derived from the tolerance, and loading slows down when the error exceeds it",
     "only if the loading rate is controlled by a tolerance; this also applies to the following keys up to "
     "`wave_transit_time`"),
    (NumberBySense, axial_strain_rate, "1/s",
     "mean axial strain rate of the test: cumulative axial strain (loading and unloading together) divided by time",
     "if the loading rate is controlled by a tolerance",
     {{"axial strain rate given in the case; the mean rate if a callback took control of the platen speed",
       "if the case gives the loading rate"}}),
    (List<double>, axial_strain_rate_range, "1/s", "smallest and largest axial strain rate during the test"),
    (Number, strain_share_above_tolerance, "-",
     "fraction of the cumulative axial strain over which the inertia error exceeded rate_tolerance",
     "if a callback took control of the platen speed, only the strain before that moment counts"),
    (Number, wave_transit_time, "s", "time that a wave takes to cross the specimen: height/sqrt(E/density)"),
    (Number, viscous_stress_share, "-",
     "stress carried by dashpots when loading begins, divided by the largest stress; both without the confining "
     "pressure",
     "null if the case gives the loading rate"),
    (Number, axial_strain_end, "-", "axial strain at the end of the test, positive in the direction of loading"),
    (Number, energy_closing_error, "-",
     "imbalance of the energy account at the end of the test, divided by the platens' work"),
    (Number, energy_lost_to_contact_law, "-",
     "energy left in springs of the DEMseg guide's contact law when contacts separated, divided by the platens' work; "
     "negative if the law created energy",
     "only if `numerics.contact_law` is `demseg` or `demseg_mean`"),
    (Number, platen_out_of_balance, "-",
     "largest difference between the stresses on the two platens up to the peak, divided by the peak stress"),
    (Number, time_step, "s",
     "time step at the end of the test; shorter than the initial one if new contacts required it"),
    (Number, time_step_mean, "s", "mean time step of the test"),
    (NumberBySense, stable_time_step, "s",
     "exact stability limit of the time step when the bonds were made. Below it, 4M - 2dt C - dt^2 K is positive "
     "definite, as a Cholesky factorisation shows; M, C and K are the mass, damping and stiffness matrices",
     "",
     {{"bound on the stable time step when the bonds were made. It is exact for the symmetric matrix that bounds the "
       "contact law's unsymmetric stiffness",
       "if `numerics.contact_law` is `demseg` or `demseg_mean`"},
      {"stable time step when the bonds were made, at most 2 % below the exact limit, for the matrix is too large to "
       "factorise",
       "for specimens with more than 100,000 free bodies, or 10,000 bonded by faces"}}),
    (Number, time_step_over_stable, "-",
     "time_step divided by stable_time_step. Unless numerics.time_step is given, it is at most "
     "numerics.safety_factor, and smaller if time_step_bound requires a shorter step"),
    (Number, time_step_bound, "s",
     "largest time step with guaranteed stability, found without an eigenvalue solve and updated as contacts open and "
     "close; the value given is that at the start of loading"),
    (Count, steps, "", "number of time steps"), (Number, simulated_time, "s", "simulated time since loading began"),
    (Count, list_builds, "", "number of times the neighbour list was built"),
    (Aside<std::int64_t>, seed, "", "random seed of the packing", "null if the particles were read from a file"));

/// Relative errors of one quantity.
CRACKLE_FIGURES(
    ErrorFigures,
    (Number, time_step, "-", "relative change of the quantity at half the time step",
     "the quantities are youngs_modulus, peak_stress and peak_strain, and in compression tests also "
     "crack_initiation_stress and crack_damage_stress. 0 for youngs_modulus, which comes from a linear solution"),
    (Number, rate, "-", "relative change of the quantity at half the loading rate", "0 for youngs_modulus"),
    (Number, energy_closing, "-", "absolute value of energy_closing_error", "null for youngs_modulus"),
    (Number, damping, "-", "larger of the relative changes of the quantity at half and at double the damping",
     "0 for youngs_modulus"),
    (Number, resolution, "-",
     "relative error due to the spacing of rows: difference between the row that defines the quantity and the row "
     "before it",
     "0 for youngs_modulus"),
    (Number, stated, "-", "relative error to report with the quantity, defined under numerical_errors"));

/// Results of a companion run, which is another run of the same specimen.
CRACKLE_FIGURES(
    CompanionFigures,
    (Number, peak_stress, "N/m",
     "peak stress of the companion run, or its largest stress if the specimen has not failed",
     "`*` is half_time_step, half_rate, half_damping or double_damping; only with --verify"),
    (Number, peak_strain, "-", "axial strain at the peak stress of the companion run"),
    (Word, ended_by, "", "reason why the companion run ended, with the same values as `ended_by`"),
    (Count, steps, "", "number of time steps"), (Number, time_step, "s", "mean time step of the companion run"),
    (Number, axial_strain_rate, "1/s", "mean axial strain rate of the companion run"),
    (Number, damping, "-", "contact damping of the companion run, divided by that of the test"),
    (Number, post_peak_difference, "-",
     "mean absolute difference between the stresses of the companion run and the test after the test's peak, divided "
     "by the peak stress. Stresses are interpolated between rows, up to the strain at which the first of the two runs "
     "ended"),
    (Number, crack_initiation_stress, "N/m", "crack initiation stress of the companion run, for compression tests"),
    (Number, crack_damage_stress, "N/m", "crack damage stress of the companion run, for compression tests"));

/// Relative errors of several quantities, and the companion runs from which they are estimated.
CRACKLE_FIGURES(ErrorsByFigure, (Stated<ErrorFigures>, youngs_modulus), (Stated<ErrorFigures>, peak_stress),
                (Stated<ErrorFigures>, peak_strain), (Stated<ErrorFigures>, crack_initiation_stress),
                (Stated<ErrorFigures>, crack_damage_stress), (Stated<Table<CompanionFigures>>, companions));

/// The packing before bonding.
CRACKLE_FIGURES(PackingFigures,
                (Number, void_ratio, "-",
                 "area of the box minus the total area of the circles, divided by the total area of the circles"),
                (Number, mean_overlap, "m",
                 "mean overlap of the contacts between circles and of those with the bottom and top walls"),
                (Number, coordination, "-",
                 "coordination number: twice the number of contacts between circles, divided by the number of circles"),
                (Number, coordination_of_carrying, "-",
                 "coordination number of the circles that touch something, including their contacts with walls"),
                (Number, floating, "", "number of circles without any contact"),
                (Number, stress_x, "N/m", "mean stress on the two side walls, positive in compression"),
                (Number, stress_y, "N/m", "mean stress on the bottom and top walls, positive in compression"),
                (Number, anisotropy, "-",
                 "anisotropy of the packing's stresses: |stress_x - stress_y|/(stress_x + stress_y)"),
                (Number, unbalanced, "-", "largest unbalanced force on any circle, divided by the mean contact force"),
                (Number, radius_scale, "-",
                 "factor by which the randomly drawn radii were multiplied to fill the box; 1 if the case gives the "
                 "number of circles"),
                (Number, cell_diameter, "m",
                 "equivalent diameter sqrt(4 area/pi) of the meshed cells, including gaps, averaged over the cells",
                 "only for specimens meshed for the test; this also applies to cell_spread"),
                (Number, cell_spread, "-", "coefficient of variation of the cells' equivalent diameters"));

/// Area fraction and number of grains of one mineral.
CRACKLE_FIGURES(MineralFigures, (Word, name, "", "name of the mineral in the case"),
                (Number, area_share, "-", "fraction of the total grain area that the case requests for the mineral",
                 "null if labels or an image assign the minerals and the case states no fraction"),
                (Number, area_share_reached, "-",
                 "fraction of the total grain area that the mineral has in the specimen"),
                (Count, grains, "", "number of grains of the mineral"));

/// Files of the frames at the start, at the peak and at the end.
CRACKLE_FIGURES(FrameFiles, (Text, frame_start, unlisted, "name of the particle file of the first frame"),
                (Text, frame_peak, unlisted,
                 "name of the particle file at the peak, or at the largest stress if the specimen has not failed"),
                (Text, frame_end, unlisted, "name of the particle file of the last frame"));

/// Time of one phase of the stepping loop.
CRACKLE_FIGURES(PhaseFigures, (Word, phase, "", "name of the phase"),
                (Number, seconds, "s", "wall-clock time spent in the phase"),
                (Number, share, "-", "fraction of step_seconds spent in the phase"),
                (Count, calls, "", "number of times the phase was entered"),
                (Number, ns_per_particle_step, "ns", "wall-clock time spent in the phase per particle and time step"),
                (Word, meaning, "", "description of the phase"));

/// Time of the stepping loop, by phase.
CRACKLE_FIGURES(ProfileFigures,
                (Number, step_seconds, "s",
                 "wall-clock time of the stepping loop, without the time spent on the timing samples of the profile"),
                (Count, steps, "", "number of time steps"),
                (Count, force_passes, "", "number of times the forces at all contact points were computed"),
                (Number, points_per_particle, "-",
                 "number of listed contact points per particle, averaged over the steps"),
                (Number, force_ns_per_point, "ns",
                 "wall-clock time of a computation of all forces, divided by the number of listed contact points"),
                (List<PhaseFigures>, phases));

/// The program and its speed.
CRACKLE_FIGURES(
    RunFigures, (Text, version, unlisted, "version of crackle"), (Text, compiler, unlisted, "compiler and its version"),
    (Text, command, unlisted, "command line that started the test"),
    (Aside<std::int64_t>, threads, "", "number of threads; results do not depend on it"),
    (Aside<double>, wall_seconds, "s", "wall-clock time of the whole test, including earlier runs if it was resumed"),
    (Aside<double>, step_seconds, "s",
     "wall-clock time of the stepping loop, including neighbour list rebuilds, bond breakage and observers"),
    (Aside<double>, particle_steps_per_second, "1/s",
     "number of particles times number of time steps, divided by step_seconds"),
    (Aside<ProfileFigures>, profile, "", "wall-clock time of the stepping loop, by phase", "only with --profile"));

/// Length and hash of a file.
CRACKLE_FIGURES(FileFigures, (Count, bytes, unlisted, "length of the file in bytes"),
                (Word, xxh3, unlisted,
                 "XXH3 hash (64 bits) of the file as 16 hexadecimal digits, as printed by `xxhsum -H3`"));

}  // namespace crackle
