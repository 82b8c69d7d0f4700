// SPDX-License-Identifier: GPL-3.0-or-later
// The declarations of all keys of summary.json, a line a key. New keys are declared here; summary.cpp gives them
// values.
// Tested by tests/tools/readme_test.py.

#include "specimens/results/summary.hpp"

namespace crackle {
namespace {

std::vector<SummaryKey> all_summary_keys() {
    constexpr bool unlisted = false;  // not in `units`
    constexpr bool listed = true, converted = true;
    return {
        {{"title", "", "heading of the report, the case's"}, unlisted},
        {{"kind", "", "`tension` or `compression`"}, unlisted},
        {{"specimen", "", "`circles`, `delaunay` or `voronoi`"}, unlisted},
        {{"platens", "", "`bonded`, `glued` or `frictional`"}, unlisted},
        {{"bond_law", "", "`back_tension` or `coulomb`"}, unlisted},
        {{"material_units", "", "`point` or `area`; with `area` stresses are in Pa as they are"}, unlisted},
        {{"failed", "",
          "whether the peak is known: the stress stayed below it by more than the share `loading.strength_drop` for a "
          "tenth of the strain there, and for ten of at least 2000 rows over `loading.max_axial_strain`; also where "
          "the "
          "test ended by failure"},
         unlisted},
        {{"interrupted", "", "whether it was stopped before its end, and can be gone on with"}, unlisted},
        {{"ended_by", "",
          "`failure` (the stress stayed as long below `loading.stop_at_share_of_peak` of its largest), "
          "`max_axial_strain`, `interrupt` or `instability`"},
         unlisted},
        {{"note", "", "only while it has not failed: what peak and moduli refer to"}, unlisted},

        {{"peak_stress", "N/m", "positive in the sense of the test",
          "the strength: the first maximum that a drop of `loading.strength_drop` follows"},
         listed,
         converted},
        {{"peak_stress_so_far", "N/m", "positive in the sense of the test",
          "the largest, in place of it while the specimen has not failed"},
         listed,
         converted},
        {{"peak_strain", "-", "positive in the sense of the test", "axial, at the peak"}},
        {{"peak_strain_so_far", "-", "positive in the sense of the test",
          "in place of it while the specimen has not failed"}},
        {{"largest_stress", "N/m", "positive in the sense of the test",
          "of the whole test; where it comes after the peak a notice says so"},
         listed,
         converted},
        {{"strain_at_largest_stress", "-", "positive in the sense of the test"}},
        {{"youngs_modulus", "N/m", "small strain, all bonds intact and sticking, platens bonded (sparse solve)"},
         listed,
         converted},
        {{"poissons_ratio", "-", "small strain, as youngs_modulus"}},
        {{"gauge_modulus", "N/m", "small strain: stress over the strain of the axial gauge length",
          "null where an end of it has no particles"},
         listed,
         converted},
        {{"initial_tangent_modulus", "N/m", "regression over the first twentieth of the strain at peak"},
         listed,
         converted},
        {{"initial_poissons_ratio", "-", "over the same rows"}},
        {{"initial_tangent_window", "", "counts within the window; points_sliding at its end"}},
        {{"initial_tangent_window.rows", "", "rows of the curve"}},
        {{"initial_tangent_window.strain_to", "-", "axial strain at its end"}},
        {{"initial_tangent_window.bonds_broken", "", "bonded points"}},
        {{"initial_tangent_window.points_sliding", "",
          "contact points at the Coulomb limit at its end, as in curve.csv"}},
        {{"initial_tangent_window.contacts_gained", "", "points touching without a bond, more than at its beginning"}},
        {{"tangent_modulus_50", "N/m", "regression from 40 % to 60 % of the peak"}, listed, converted},
        {{"tangent_50_poissons_ratio", "-", "over the same rows"}},

        {{"bonds_broken", "", "bonded points"}},
        {{"bonds_broken_after_sliding", "", "bonded points that had been at their Coulomb limit before they broke"}},
        {{"bonds_broken_in_shear", "",
          "bonded points, by the larger force in the last step at half their strength or more: hardly any, for a bond "
          "breaks where its overlap is gone and its Coulomb limit with it; see bonds_broken_after_sliding"}},
        {{"bonds_broken_in_tension", "", "bonded points, the others"}},
        {{"bonds_broken_in_shear_to_peak", "", "those of them that broke up to the row of the peak"}},
        {{"bonds_broken_in_tension_to_peak", "", "likewise"}},
        {{"interfaces_lost", "", "pairs whose last bond has broken"}},
        {{"area_strain_peak", "-",
          "axial less lateral strain, shortening and widening positive: positive where the specimen's area shrinks",
          "at the peak"}},
        {{"area_strain_end", "-", "likewise, side particles that have come off included", "at the end"}},
        {{"fragments", "",
          "groups of particles that intact bonds join, at the end; a particle that nothing holds is one, one that "
          "nothing held from the start too"}},
        {{"largest_fragment_share", "-", "of the particles' area"}},

        {{"initial_width", "m", "", "of the domain the specimen was made in"}},
        {{"initial_height", "m", "", "likewise"}},
        {{"particles", "", "bodies without platens"}},
        {{"seeds", "", "circles the polygons were meshed from", "where the test meshed them"}},
        {{"segments", "", "edges of all polygons", "of specimens of polygons"}},
        {{"bond_thick", "m", "segment thickness at bonding"}},
        {{"contacts_initial", "", "contact points when loading begins"}},
        {{"bonds_initial", "", "bonded points"}},
        {{"interfaces_initial", "", "bonded pairs of bodies"}},
        {{"mean_back_tension", "N", "over bonded points"}},
        {{"mean_back_tension_interface", "N", "summed over the points of an interface"}},
        {{"mean_bond_overlap", "m", "over bonded points"}},
        {{"mean_tensile_strength", "N", "over bonded points that can break, random factors included",
          "of coulomb bonds"}},
        {{"mean_cohesion", "N", "likewise", "of coulomb bonds"}},
        {{"bonds_unbreakable", "", "bonded points of glued platens and within grips"}},
        {{"grip", "m", "depth at each end whose bonds never break"}},
        {{"failed_at", "",
          "where the largest crack lies: platen, half of its bonds or more being a platen's; grip; or gauge",
          "null where no bond has broken"}},
        {{"largest_crack", "", "counts of its bonds, and where it lies", "likewise"}},
        {{"largest_crack.bonds", "", "broken bonded points that share particles, the most of them", "likewise"}},
        {{"largest_crack.of_platen", "", "of these between a particle and a platen", "likewise"}},
        {{"largest_crack.height", "m", "mean height of its bonds at the start, above the specimen's lower face",
          "likewise"}},
        {{"platen_bottom_id", "", "id in events.csv and frames"}},
        {{"platen_top_id", "", "id in events.csv and frames"}},

        {{"rate_tolerance", "-",
          "of out-of-balance and kinetic over strain energy: sets the largest rate, and what slows it down",
          "loading by tolerance only"}},
        {{"axial_strain_rate", "1/s", "mean of the test", "likewise"}},
        {{"axial_strain_rate_range", "1/s", "slowest and fastest", "likewise"}},
        {{"strain_share_above_tolerance", "-",
          "share of the strain gone through while the inertia error was above the tolerance", "likewise"}},
        {{"wave_transit_time", "s", "height/sqrt(E/density)", "likewise"}},
        {{"axial_strain_rate", "1/s", "", "as given, without a tolerance"}},
        {{"viscous_stress_share", "-",
          "stress of the dashpots when loading by tolerance begins, over the largest stress", "null at a given rate"}},
        {{"axial_strain_end", "-", "positive in the sense of the test"}},
        {{"energy_closing_error", "-", "over the platens' work, at the end"}},
        {{"energy_lost_to_contact_law", "-",
          "over the platens' work: left in springs of the guide's law when contacts ended (negative: made by it)",
          "under `numerics.contact_law` `demseg` and `demseg_mean`"}},
        {{"platen_out_of_balance", "-", "largest difference of the platens' stresses up to the peak, over the peak"}},
        {{"time_step", "s", "at the end; shorter where new contacts need it"}},
        {{"time_step_mean", "s", "over the test"}},
        {{"stable_time_step", "s",
          "exact limit when bonds were made: 4M - 2dt C - dt^2 K positive definite, by Cholesky"}},
        {{"stable_time_step", "s",
          "a bound when bonds were made: exact for the symmetric majorant of the law's unsymmetric stiffness",
          "under `demseg` and `demseg_mean`"}},
        {{"stable_time_step", "s", "when bonds were made; a bound, too large a specimen for the exact limit",
          "beyond 100,000 free bodies"}},
        {{"time_step_over_stable", "-",
          "share of it taken at the end; at most numerics.safety_factor, less where the guaranteed bound is smaller"}},
        {{"time_step_bound", "s",
          "guaranteed stable below without an eigenvalue solve, kept up as contacts open and close; when loading "
          "began"}},
        {{"steps", "", "time steps"}},
        {{"simulated_time", "s", "", "since loading began"}},
        {{"list_builds", "", "times the neighbour list was built"}},
        {{"seed", "", "of the packing", "null of a particle file"}},

        {{"numerical_errors", "-",
          "relative. time_step, rate, damping: change at half the step, half the rate, half or double the damping "
          "(crackle test --verify; null: not run, or unstable); energy_closing: over the platens' work; resolution: by "
          "the spacing of the rows; stated: of resolution and the larger of 3 rate and 2.92 sqrt(2) standard "
          "deviations of the test, its half step and its half rate, the root of the sum of squares (90 of 100, were "
          "they independent); youngs_modulus: a sparse "
          "solve, its residual. post_peak_difference: mean difference of stress from the peak on, over the peak; "
          "breaks there are chaotic, so it is no error of step or rate"}},
        {{"numerical_errors.*.time_step", "-",
          "of youngs_modulus, peak_stress and peak_strain: change at half the step; 0 of a solve"}},
        {{"numerical_errors.*.rate", "-", "change at half the rate; 0 of a solve"}},
        {{"numerical_errors.*.energy_closing", "-", "energy_closing_error without its sign; null of a solve"}},
        {{"numerical_errors.*.damping", "-", "larger change at half and double the damping; 0 of a solve"}},
        {{"numerical_errors.*.resolution", "-",
          "by the spacing of the rows: what the row before the peak differs by; 0 of a solve"}},
        {{"numerical_errors.*.stated", "-", "the error to report, see numerical_errors"}},
        {{"numerical_errors.companions.*.peak_stress", "N/m",
          "with --verify, of half_time_step, half_rate, half_damping and double_damping: peak, or largest stress so "
          "far"}},
        {{"numerical_errors.companions.*.peak_strain", "-", "the strain there"}},
        {{"numerical_errors.companions.*.ended_by", "", "as of the test"}},
        {{"numerical_errors.companions.*.steps", "", "time steps"}},
        {{"numerical_errors.companions.*.time_step", "s", "mean of its run"}},
        {{"numerical_errors.companions.*.axial_strain_rate", "1/s", "mean of its run"}},
        {{"numerical_errors.companions.*.damping", "-", "of its contacts, over the test's"}},
        {{"numerical_errors.companions.*.post_peak_difference", "-",
          "mean over the rows from the peak to the earlier end of the two: difference of its stress there, between its "
          "rows, "
          "over the peak"}},
        {{"peak_converged", "",
          "whether the peak at half the step and half the rate lies on the same branch; null: not run, or no failure",
          "on the same branch: stress within 3 %, strain within 10 %"}},

        {{"packing", "",
          "before bonding: mean_overlap in m over circles, bottom and top wall; stress_x, stress_y in N/m; anisotropy "
          "|sx - sy|/(sx + sy); unbalanced: largest force on a circle over the mean contact force; the rest counts and "
          "ratios",
          "of a packing made by the test"}},
        {{"packing.void_ratio", "-", "area of the box less that of the circles, over that of the circles"}},
        {{"packing.mean_overlap", "m", "over contacts between circles and with bottom and top wall"}},
        {{"packing.coordination", "-", "twice the contacts between circles over the circles"}},
        {{"packing.coordination_of_carrying", "-",
          "the same with those on walls, over the circles that touch something"}},
        {{"packing.floating", "", "circles without any contact"}},
        {{"packing.stress_x", "N/m", "mean of the two side walls, compression positive"}},
        {{"packing.stress_y", "N/m", "mean of bottom and top wall, compression positive"}},
        {{"packing.anisotropy", "-", "|sx - sy|/(sx + sy)"}},
        {{"packing.unbalanced", "-", "largest force on a circle over the mean contact force"}},
        {{"packing.radius_scale", "-", "radii made over radii drawn; 1 with a count"}},
        {{"packing.cell_diameter", "m", "mean of the cells' equivalent diameters sqrt(4 area/pi), gaps included",
          "of one meshed by the test"}},
        {{"packing.cell_spread", "-", "their coefficient of variation", "likewise"}},

        {{"minerals", "", "in the order of the case: area shares and grains", "of a rock of several minerals"}},
        {{"minerals[].name", "", "the case's"}},
        {{"minerals[].area_share", "-", "asked, of the area of all grains",
          "null of labels or an image where the case asks for none"}},
        {{"minerals[].area_share_reached", "-", "of the grains that have it: discs, or polygons as meshed"}},
        {{"minerals[].grains", "", "bodies that have it"}},

        {{"frame_start", "", "file of the particles at the start"}, unlisted},
        {{"frame_peak", "", "at the peak, or the largest stress so far"}, unlisted},
        {{"frame_end", "", "at the end"}, unlisted},
        {{"out_of_plane_thickness", "m",
          "converts what is reported and nothing else; null: not given, `_pa` is that of 1 m"}},
        {{"notices", "", "sentences about what may surprise in these numbers"}, unlisted},
        {{"version", "", "of crackle"}, unlisted},
        {{"compiler", "", "its version"}, unlisted},
        {{"command", "", "that ran the test"}, unlisted},
        {{"threads", "", "", "results do not depend on them"}},
        {{"wall_seconds", "s", "whole process"}},
        {{"step_seconds", "s", "stepping loop with rebuilds, breaks and observers"}},
        {{"particle_steps_per_second", "1/s", "particles times steps over step_seconds"}},
        {{"profile", "", "where the stepping loop's time went, s of wall clock; force_ns_per_point over listed points",
          "with --profile"}},
        {{"profile.step_seconds", "s", "of the loop, without the samples that the profile takes"}},
        {{"profile.steps", "", "time steps"}},
        {{"profile.force_passes", "", "times the forces of all points were computed"}},
        {{"profile.points_per_particle", "-", "listed contact points, mean over the steps"}},
        {{"profile.force_ns_per_point", "ns", "force pass, a listed contact point"}},
        {{"profile.phases[].phase", "", "name of a phase"}},
        {{"profile.phases[].seconds", "s", "wall clock"}},
        {{"profile.phases[].share", "-", "of step_seconds"}},
        {{"profile.phases[].calls", "", "times it was entered"}},
        {{"profile.phases[].ns_per_particle_step", "ns", "seconds over particles times steps"}},
        {{"profile.phases[].meaning", "", "what the phase does"}},
        {{"columns", "", "unit and meaning of each column of curve.csv"}, unlisted},
        {{"units", "", "unit and meaning of the keys above"}, unlisted},
    };
}

}  // namespace

const std::vector<SummaryKey>& summary_keys() {
    static const std::vector<SummaryKey> all = all_summary_keys();
    return all;
}

}  // namespace crackle
