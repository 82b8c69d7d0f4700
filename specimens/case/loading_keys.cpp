// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/loading_keys.hpp"

#include "specimens/case/declare_parameter.hpp"

namespace crackle {

std::vector<Parameter> loading_keys() {
    using namespace declaring;
    return {
        CRACKLE_KEY(loading, kind, "",
                    "biaxial: compression under a confining pressure; brazilian: a disc between jaws; bending: a beam "
                    "on two supports; scb: half a disc with a notch; direct_shear: in two half boxes.")
            .one_of({"compression", "tension", "biaxial", "brazilian", "bending", "scb", "direct_shear"}),
        CRACKLE_KEY(loading, axial_strain_rate, "1/s",
                    "Platen speed over the specimen's height, in place of rate_tolerance; of other kinds the rate of "
                    "their nominal strain.")
            .above(0)
            .below(1e6),
        CRACKLE_KEY(
            loading, rate_tolerance, "",
            "Sets the platen's largest speed, by sqrt(rate_tolerance), and slows it down to 0.15 of that while the "
            "inertia error (out-of-balance of the platens, kinetic over strain energy) is above this.")
            .otherwise(0.01)
            .above(0)
            .at_most(1),
        CRACKLE_KEY(loading, max_axial_strain, "", "The test ends here if the specimen has not failed before.")
            .at_least(1e-9)
            .below(1),
        CRACKLE_KEY(loading, strength_drop, "",
                    "The strength is the first maximum of the stress that a drop of this share follows and stays for a "
                    "tenth of the strain there.")
            .above(0)
            .below(1)
            .otherwise(0.1),
        CRACKLE_KEY(loading, stop_at_share_of_peak, "",
                    "The test ends: stress below this share of its largest for a tenth of the strain there.")
            .above(0)
            .below(1)
            .otherwise(0.5),
        CRACKLE_KEY(
            loading, platens, "",
            "Bonded to the specimen by bonds like the others; glued, whose bonds never break, with those within "
            "the grips; or touching it with friction (compression only). In tension glued if not given.")
            .one_of({"bonded", "glued", "frictional"})
            .otherwise(words("bonded")),
        CRACKLE_KEY(
            loading, grip, "",
            "Share of the height at each end whose bonds never break, with glued platens; in tension 0.1 if not "
            "given, else 0.")
            .at_least(0)
            .below(0.5),
        CRACKLE_KEY(loading, platen_friction_angle, "deg", "Friction angle of frictional platens.")
            .at_least(0)
            .below(90),
        CRACKLE_KEY(loading, half_angle, "deg",
                    "brazilian: half of the arc over which a jaw that is bonded, or has jaws = \"arc\", presses; 10 if "
                    "not given.")
            .above(0)
            .at_most(30),
        CRACKLE_KEY(loading, jaws, "",
                    "brazilian with frictional platens: of the disc's own radius over the half angle, flat, or of 1.5 "
                    "times its radius; arc if not given.")
            .one_of({"arc", "flat", "curved"}),
        CRACKLE_KEY(loading, span, "m",
                    "Between the supports. bending: four times the depth if not given; scb: 0.8 of the diameter.")
            .above(0),
        CRACKLE_KEY(loading, pad_width, "m",
                    "bending, scb: of the three pads; a tenth of depth or radius if not given, at least two particles.")
            .above(0),
        CRACKLE_KEY(loading, normal_stiffness, "N/m2 or Pa/m",
                    "direct_shear: by which the normal stress grows as the upper box rises; constant if not given.")
            .at_least(0),
        CRACKLE_KEY(loading, normal_stress, "N/m or Pa", "direct_shear: that the upper box is pressed down with.")
            .at_least(0),
        CRACKLE_KEY(loading, box_gap, "m", "direct_shear: between the half boxes; two mean particles if not given.")
            .above(0),
        CRACKLE_KEY(loading, control, "",
                    "What grows steadily: axial strain, if not given, or the lateral strain of a compressed specimen, "
                    "for which the platen goes back where that breaks by itself (class II); max_axial_strain is then "
                    "the strain gone through back and forth. Needs loading by tolerance.")
            .one_of({"axial", "lateral"}),
        CRACKLE_KEY(loading, unload_at_strain, "",
                    "Axial strains, none below the one before, at each of which the specimen is unloaded and loaded "
                    "again; equal ones are cycles of one amplitude (fatigue). Every cycle's modulus, which damage "
                    "lowers, stands in summary.json. Needs loading by tolerance.")
            .above(0)
            .below(1),
        CRACKLE_KEY(loading, unload_at_stress, "N/m or Pa", "Likewise at axial stresses, in place of strains.")
            .above(0),
        CRACKLE_KEY(loading, unload_to, "", "Down to this share of the stress where unloading began; 0.1 if not given.")
            .at_least(0)
            .below(1),

        CRACKLE_KEY(confinement, pressure, "N/m or Pa",
                    "On the sides, all through the test; the platens press with the same before loading begins. Its "
                    "unit is that of stresses: Pa with material.units = \"area\".")
            .above(0),
        CRACKLE_KEY(
            confinement, side, "",
            "What presses the sides: membrane (if not given), which follows the specimen; walls, two smooth rigid "
            "plates, each with the force of the pressure on the initial height.")
            .one_of({"membrane", "walls"}),

        CRACKLE_KEY(numerics, time_step, "s", "Time step; derived from the stiffness bound if not given.").above(0),
        CRACKLE_KEY(numerics, safety_factor, "",
                    "Share of the exact stable step that a derived step takes, if the guaranteed bound allows it.")
            .above(0)
            .at_most(1)
            .otherwise(0.8),
        CRACKLE_KEY(numerics, threads, "", "Threads; results do not depend on them.")
            .at_least(1)
            .at_most(1024)
            .otherwise(whole(1)),
        CRACKLE_KEY(numerics, contact_law, "",
                    "Contact law of polygons: corner against outline, or the guide's segment against segment (with the "
                    "sum or the mean of its disc cases).")
            .one_of({"rounded", "demseg", "demseg_mean"})
            .otherwise(words("rounded")),
        CRACKLE_KEY(numerics, integrator, "",
                    "How unbonded contacts open and close: leapfrog, as the guide does, or consistent with the energy.")
            .one_of({"leapfrog", "consistent"})
            .otherwise(words("leapfrog")),
        CRACKLE_KEY(numerics, intact, "",
                    "Nothing breaks, slides or comes into contact: for comparing a run with the linear solve.")
            .otherwise(false),
        CRACKLE_KEY(numerics, allow_unstable, "", "Run a time step above the stable bound, to show the limit.")
            .otherwise(false),

        CRACKLE_KEY(output, curve_rows, "",
                    "Rows of curve.csv over max_axial_strain; peak and failure are judged by at least 2000 whatever is "
                    "written.")
            .at_least(10)
            .at_most(99998)
            .otherwise(whole(2000)),
        CRACKLE_KEY(output, frames, "",
                    "Frames over max_axial_strain, besides start, peak and end; if not given 100 up to 2000 bodies, "
                    "beyond that 200,000 over their number, at least 20 (never more than curve_rows).")
            .at_least(1)
            .at_most(99998),
        CRACKLE_KEY(output, frame_precision, "",
                    "Of the points drawn in frames: single is a hundred-millionth of the specimen and a thousandth of "
                    "an overlap, double loses nothing.")
            .one_of({"single", "double"})
            .otherwise(words("single")),
        CRACKLE_KEY(output, slips, "",
                    "Writes slips.csv: the first arrival of each back-tension bond at its Coulomb limit.")
            .otherwise(false),
        CRACKLE_KEY(
            output, emission, "",
            "Writes ae.csv: acoustic events, breaks clustered in place and time, with their moments; takes some "
            "time.")
            .otherwise(false),
        CRACKLE_KEY(output, checkpoint_interval, "s", "Wall-clock time between checkpoints.").above(0).otherwise(60.0),
        CRACKLE_KEY(output, out_of_plane_thickness, "m",
                    "Only converts what is reported: stresses in N/m over this give the _pa values, and MPa beside "
                    "them on terminal and page; if not given the _pa values are those of 1 m.")
            .above(0),
    };
}

}  // namespace crackle
