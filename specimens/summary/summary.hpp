// SPDX-License-Identifier: GPL-3.0-or-later
// All results of a test in one struct, which is written to summary.json. Each quantity is declared once, with unit and
// meaning.
// Tested by tests/tools/readme_test.py and tests/specimens/summary/summary_test.cpp.
#pragma once

#include "specimens/summary/damage_figures.hpp"
#include "specimens/summary/run_figures.hpp"
#include "specimens/summary/strength_figures.hpp"

namespace crackle {

/// The results of a test.
CRACKLE_FIGURES(
    Summary, (Description, about), (Strength, strength), (NominalFigures, nominal), (Validity, validity),
    (ConfinementFigures, confinement), (CrackingFigures, cracking),
    (List<CycleFigures>, cycles, unlisted, "unloading and reloading cycles, in the order in which they occurred"),
    (DamageFigures, damage),
    (Stated<RosesByKind>, crack_rose, "",
     "directions of cracks between particles, by kind, up to the peak and after it. Each broken bonded contact point "
     "is weighted by the length of its part of the face between two bodies. Directions are from 0 to 180 degrees, "
     "counter-clockwise from the horizontal"),
    (JointedFigures, jointed),
    (Stated<EmissionFigures>, emission, "",
     "acoustic events of ae.csv (bond breaks grouped by place and time): counts of finished events, and the parameters "
     "that define an event",
     "only with `output.emission = true`. Null if the specimen transmits no shear waves. The key `window` is "
     "meaningful only with physical masses and light damping"),
    (Stated<BValueFigures>, b_value, "",
     "b-value of the moment magnitudes: log10 of the number of events above magnitude M decreases by b per unit of M",
     "null if `emission` is null. One test often has too few events; `crackle plot OUT... --what emission` pools "
     "several tests"),
    (Stated<EnergyShares>, energy_at_peak, "-",
     "distribution of the work done on the specimen up to the peak: `work` is in J, the other keys are fractions of it",
     "strain and kinetic energy are changes since loading began. The sum of the fractions differs from 1 by the "
     "imbalance of the energy account (see energy_closing_error) and the contact law's loss"),
    (Stated<EnergyShares>, energy_at_end, "-",
     "distribution of the work done on the specimen up to the end of the test, with the same keys as in "
     "`energy_at_peak`"),
    (SpecimenFigures, specimen), (NumericsFigures, numerics),
    (Stated<ErrorsByFigure>, numerical_errors, "-",
     "relative numerical errors. time_step and rate: change of the quantity at half the time step and at half the "
     "loading rate. damping: change at half or double the damping. These come from `crackle test --verify` and are "
     "null if its runs are missing or became unstable. energy_closing: imbalance of the energy account divided by the "
     "platens' work. resolution: error due to the spacing of rows. stated: sqrt(resolution^2 + s^2), where s is the "
     "larger of 3 rate and 2.92 sqrt(2) standard deviations among the test and its runs with half the time step and "
     "half the rate. It covers the error in 90 of 100 tests if these runs are independent. youngs_modulus: stated is "
     "the residual of the linear solution. post_peak_difference: mean difference of stress after the peak, divided by "
     "the peak stress; bond breakage is chaotic there, so it is not an error due to time step or rate"),
    (Flag, peak_converged, "",
     "whether the peaks at half the time step and at half the loading rate agree with that of the test (same branch). "
     "It is null if these runs are missing or the specimen did not fail",
     "if the peaks are on the same branch, the peak stress changes by at most 3 % and the peak strain by at most 10 %"),
    (Stated<PackingFigures>, packing, "",
     "state of the packing before bonding. The stresses of the packing assume that every contact has the normal "
     "stiffness of [material], or its contact_modulus if units = \"area\"",
     "only for packings made for the test"),
    (Aside<std::vector<MineralFigures>>, minerals, "",
     "area fraction and number of grains of each mineral, in case order", "only for rocks of several minerals"),
    (FrameFiles, frames),
    (Number, out_of_plane_thickness, "m",
     "thickness used to convert reported stresses to Pa; it does not affect the test. Null if not given: keys with "
     "`_pa` then refer to a thickness of 1 m"),
    (Aside<std::vector<std::string>>, notices, unlisted,
     "warnings about properties of the test that may make its results unreliable or surprising"),
    (RunFigures, run), (Aside<Table<std::string>>, columns, unlisted, "unit and meaning of each column of curve.csv"),
    (Aside<Table<std::string>>, units, unlisted, "unit and meaning of each key above"),
    (Aside<Table<FileFigures>>, files, unlisted,
     "length and hash of each of `curve.csv`, `events.csv`, `slips.csv` and `ae.csv` that exists, and of `checkpoint`, "
     "as they were when the test ended"));

}  // namespace crackle
