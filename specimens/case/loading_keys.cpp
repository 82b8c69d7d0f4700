// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/loading_keys.hpp"

#include "specimens/case/declare_parameter.hpp"

namespace crackle {

std::vector<Parameter> loading_keys() {
    using namespace declaring;
    return {
        CRACKLE_KEY(loading, kind, "",
                    "biaxial: compression under a confining pressure; brazilian: a disc between jaws; bending: a beam "
                    "on two supports; scb: half a disc with a notch; direct_shear: a block in two half boxes."),
        CRACKLE_KEY(loading, axial_strain_rate, "1/s",
                    "Platen speed divided by the specimen's height, in place of rate_tolerance; for tests without "
                    "platens, the rate of their nominal strain.")
            .above(0)
            .below(1e6),
        CRACKLE_KEY(
            loading, rate_tolerance, "",
            "Tolerance for the inertia error, which is measured by the imbalance of the platen forces and the ratio of "
            "kinetic to strain energy. The platen's largest speed is proportional to the square root of the tolerance. "
            "While the error exceeds the tolerance, the platen slows down, to as little as 0.15 of that speed.")
            .otherwise(0.01)
            .above(0)
            .at_most(1),
        CRACKLE_KEY(loading, max_axial_strain, "",
                    "Strain at which the test ends if the specimen has not failed before.")
            .at_least(1e-9)
            .below(1),
        CRACKLE_KEY(loading, strength_drop, "",
                    "The strength is the first maximum of stress after which the stress stays lower by more than this "
                    "fraction for a tenth of the strain at the maximum.")
            .above(0)
            .below(1)
            .otherwise(0.1),
        CRACKLE_KEY(loading, stop_at_share_of_peak, "",
                    "The test ends once the stress stays below this fraction of its largest value for a tenth of the "
                    "strain at that value.")
            .above(0)
            .below(1)
            .otherwise(0.5),
        CRACKLE_KEY(loading, platens, "",
                    "How platens hold the specimen. bonded: by bonds like all others; glued: by unbreakable bonds, as "
                    "within the grips; frictional: by friction (compression only). In tension, glued if not given.")
            .otherwise(PlatenKind::bonded),
        CRACKLE_KEY(loading, grip, "",
                    "Fraction of the height at each end within which bonds never break, with glued platens. If not "
                    "given: 0.1 in tension, otherwise 0.")
            .at_least(0)
            .below(0.5),
        CRACKLE_KEY(loading, platen_friction_angle, "deg", "Friction angle of frictional platens.")
            .at_least(0)
            .below(90),
        CRACKLE_KEY(loading, half_angle, "deg",
                    "brazilian: half the angle of the arc on which a bonded jaw, or a jaw with jaws = \"arc\", "
                    "presses; 10 if not given.")
            .above(0)
            .at_most(30),
        CRACKLE_KEY(loading, jaws, "",
                    "brazilian with frictional platens: shape of the jaws, which is arc (with the disc's radius, over "
                    "half_angle on each side), flat, or curved (with 1.5 times the disc's radius); arc if not given."),
        CRACKLE_KEY(
            loading, span, "m",
            "Distance between the supports. If not given: four times the depth (bending), 0.8 of the diameter (scb).")
            .above(0),
        CRACKLE_KEY(loading, pad_width, "m",
                    "bending, scb: width of the three pads. If not given: a tenth of the depth or radius, but at least "
                    "the size of two particles.")
            .above(0),
        CRACKLE_KEY(loading, normal_stiffness, "N/m2 or Pa/m",
                    "direct_shear: increase of the normal stress per unit rise of the upper box; 0 if not given.")
            .at_least(0),
        CRACKLE_KEY(loading, normal_stress, "N/m or Pa", "direct_shear: normal stress on the upper box.").at_least(0),
        CRACKLE_KEY(loading, box_gap, "m",
                    "direct_shear: gap between the half boxes; twice the mean particle size if not given.")
            .above(0),
        CRACKLE_KEY(loading, control, "",
                    "Strain that increases at a steady rate: axial (if not given), or lateral, in compression. Under "
                    "lateral control, the platen moves back when the specimen would otherwise fail of its own accord "
                    "(class II), and max_axial_strain limits the cumulative axial strain, loading and unloading "
                    "together. Needs rate_tolerance."),
        CRACKLE_KEY(loading, unload_at_strain, "",
                    "Axial strains, in ascending order, at each of which the specimen is unloaded and reloaded; "
                    "repeated values give cycles of the same amplitude (fatigue). summary.json contains the modulus of "
                    "each cycle, which decreases with damage. Needs rate_tolerance.")
            .above(0)
            .below(1),
        CRACKLE_KEY(loading, unload_at_stress, "N/m or Pa",
                    "Axial stresses at which the specimen is unloaded and reloaded, in place of strains.")
            .above(0),
        CRACKLE_KEY(loading, unload_to, "",
                    "Fraction of the stress at the start of unloading at which unloading ends; 0.1 if not given.")
            .at_least(0)
            .below(1),

        CRACKLE_KEY(confinement, pressure, "N/m or Pa",
                    "Pressure on the sides throughout the test; before loading begins, the platens apply the same "
                    "pressure. In Pa with material.units = \"area\".")
            .above(0),
        CRACKLE_KEY(confinement, side, "",
                    "What applies the pressure: a membrane (if not given), which follows the specimen; or walls, two "
                    "smooth rigid plates, each loaded with the pressure times the initial height."),

        CRACKLE_KEY(numerics, time_step, "s", "Time step; if not given, it is derived from the exact stable step.")
            .above(0),
        CRACKLE_KEY(numerics, safety_factor, "",
                    "Ratio of the derived time step to the exact stable step. The derived step is smaller if the "
                    "guaranteed bound requires it.")
            .above(0)
            .at_most(1)
            .otherwise(0.8),
        CRACKLE_KEY(numerics, threads, "", "Number of threads, which does not affect the results.")
            .at_least(1)
            .at_most(1024)
            .otherwise(std::int64_t{1}),
        CRACKLE_KEY(numerics, contact_law, "",
                    "Contact law of polygons: corner against outline (rounded), or segment against segment as in "
                    "DEMseg's guide, with the sum (demseg) or the mean (demseg_mean) of the overlaps of each pair.")
            .otherwise(SegmentLaw::rounded),
        CRACKLE_KEY(
            numerics, integrator, "",
            "How the opening and closing of unbonded contacts is integrated: leapfrog, as in DEMseg's guide, or "
            "consistent, which conserves energy.")
            .otherwise(Integrator::leapfrog),
        CRACKLE_KEY(
            numerics, intact, "",
            "Whether breaking, sliding and new contacts are disabled, to compare a run with the linear solution.")
            .otherwise(false),
        CRACKLE_KEY(numerics, allow_unstable, "",
                    "Whether a time step above the stable bound is accepted, for example to demonstrate the limit.")
            .otherwise(false),

        CRACKLE_KEY(output, curve_rows, "",
                    "Number of rows of curve.csv up to max_axial_strain; peak and failure are determined from at least "
                    "2000 rows, even if fewer are written.")
            .at_least(10)
            .at_most(99998)
            .otherwise(std::int64_t{2000}),
        CRACKLE_KEY(output, frames, "",
                    "Number of frames up to max_axial_strain, besides those at the start, the peak and the end. If not "
                    "given: 100 for up to 2000 bodies; for more bodies, 200,000 divided by their number, but at least "
                    "20 and at most curve_rows.")
            .at_least(1)
            .at_most(99998),
        CRACKLE_KEY(output, frame_precision, "",
                    "Precision of the points in frames: single resolves a hundred-millionth of the specimen and a "
                    "thousandth of an overlap; double is exact.")
            .otherwise(FramePrecision::single_),
        CRACKLE_KEY(
            output, slips, "",
            "Whether slips.csv is written, which records when each back-tension bond first reaches its Coulomb limit.")
            .otherwise(false),
        CRACKLE_KEY(output, emission, "",
                    "Whether ae.csv is written, which lists acoustic events (bond breaks clustered in place and time) "
                    "with their moments; this takes some time.")
            .otherwise(false),
        CRACKLE_KEY(output, checkpoint_interval, "s", "Wall-clock time between checkpoints.").above(0).otherwise(60.0),
        CRACKLE_KEY(output, out_of_plane_thickness, "m",
                    "Used only to convert reported numbers: stresses in N/m are divided by this thickness for the _pa "
                    "values, and for values in MPa in the terminal and on the page. If not given, the _pa values are "
                    "for a thickness of 1 m.")
            .above(0),
    };
}

}  // namespace crackle
