// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/specimen_keys.hpp"

#include "specimens/case/declare_parameter.hpp"
#include "specimens/packing/packing.hpp"

namespace crackle {

std::vector<Parameter> specimen_keys() {
    using namespace declaring;
    return {
        With{declare("", "title", "", CRACKLE_MEMBER(title), "Heading of the report; the file's name if not given.")}
            .otherwise(words("")),

        CRACKLE_KEY(particles, file, "", "Particle file in the layout of DEMseg's in_gm.dat (mode 1).")
            .path()
            .needed_with_table(),

        CRACKLE_KEY(packing, width, "m", "Width of the box.").above(0),
        CRACKLE_KEY(packing, height, "m", "Height of the box.").above(0),
        CRACKLE_KEY(packing, count, "", "Number of circles, in place of width and height.")
            .at_least(static_cast<double>(min_packing_circles))
            .at_most(static_cast<double>(max_packing_circles)),
        CRACKLE_KEY(packing, height_to_width, "", "Height over width of the box, with count; 2 if not given.").above(0),
        CRACKLE_KEY(packing, sizes, "", "Distribution of the radii.")
            .one_of({"uniform", "lognormal", "sieve"})
            .otherwise(words("uniform")),
        CRACKLE_KEY(packing, radius_min, "m", "Smallest radius (uniform; cut-off of lognormal).").above(0),
        CRACKLE_KEY(packing, radius_max, "m", "Largest radius (uniform; cut-off of lognormal).").above(0),
        CRACKLE_KEY(packing, radius_median, "m", "Median radius (lognormal).").above(0),
        CRACKLE_KEY(packing, radius_log_deviation, "", "Standard deviation of ln(radius) (lognormal).").above(0),
        CRACKLE_KEY(packing, sieve, "", "Sieve curve: a table with the columns size and passing_by_mass.").path(),
        CRACKLE_KEY(packing, cell_diameter, "m",
                    "With [mesh], in place of radii: mean of the cells' equivalent diameters sqrt(4 area/pi), gaps "
                    "included; the circles' radii follow.")
            .above(0),
        CRACKLE_KEY(packing, cell_spread, "", "With it: coefficient of variation of these diameters.")
            .above(0)
            .at_most(1),
        CRACKLE_KEY(packing, mean_overlap, "m", "Mean overlap of all contacts to compress to.").above(0),
        CRACKLE_KEY(packing, void_ratio, "", "Void ratio to compress to, in place of mean_overlap.").above(0),
        CRACKLE_KEY(packing, seed, "", "Seed of the random numbers; the same seed gives the same packing.")
            .at_least(0)
            .otherwise(whole(1)),

        CRACKLE_KEY(mesh, kind, "", "Polygons made from the circles' centres.")
            .one_of({"delaunay", "voronoi"})
            .needed_with_table(),
        CRACKLE_KEY(mesh, thick, "m",
                    "Gap between neighbouring polygons; with coulomb bonds 0.02 of the mean cell size sqrt(width "
                    "height/cells) if not given, or twice inset.")
            .above(0),
        CRACKLE_KEY(mesh, inset, "m", "Depth by which each polygon is inset; thick/2 if not given.").at_least(0),
        CRACKLE_KEY(mesh, boundary, "", "Outer faces: flat on the domain, or where the outermost centres lie.")
            .one_of({"domain", "seeds"})
            .otherwise(words("domain")),
        CRACKLE_KEY(mesh, merge_destroyed, "", "Merge a cell that the inset destroys into a neighbour.")
            .otherwise(false),

        CRACKLE_KEY(material, density, "kg/m2", "Density, per unit thickness.").above(0),
        CRACKLE_KEY(material, normal_stiffness, "N/m", "Normal stiffness k_n of a contact point.").above(0),
        CRACKLE_KEY(material, shear_stiffness, "N/m", "Shear stiffness k_s of a contact point.").at_least(0),
        CRACKLE_KEY(material, friction_angle, "deg", "Friction angle; mu = tan(angle).").at_least(0).below(90),
        CRACKLE_KEY(material, damping_ratio, "",
                    "Damping ratio h of every contact point; of a packing without any damping key 0.2384, with which a "
                    "particle ringing on its contacts loses 95 % of its energy a period.")
            .at_least(0),
        CRACKLE_KEY(material, normal_damping, "N s/m", "Normal dashpot, in place of damping_ratio.").at_least(0),
        CRACKLE_KEY(material, shear_damping, "N s/m", "Shear dashpot, in place of damping_ratio.").at_least(0),

        CRACKLE_KEY(material, units, "",
                    "What stiffness and strengths are given for: a contact point (N/m, N), or the area of a face (Pa), "
                    "which its points share, so that neither depends on the size of the grains.")
            .one_of({"point", "area"})
            .otherwise(words("point")),
        CRACKLE_KEY(material, contact_modulus, "Pa",
                    "E_c of area units: a face of length L between centroids at the distance l has k_n = E_c L/l.")
            .above(0),
        CRACKLE_KEY(material, stiffness_ratio, "", "k_n over k_s, in area units.").above(0),
        CRACKLE_KEY(material, tensile_strength, "N or Pa",
                    "Of a bond with law = \"coulomb\": N a point, in area units Pa.")
            .above(0),
        CRACKLE_KEY(
            material, cohesion, "N or Pa",
            "Shear strength of a bond without normal force, likewise; at least friction times tensile_strength.")
            .above(0),
        CRACKLE_KEY(material, residual_friction_angle, "deg",
                    "Of contacts without a bond with law = \"coulomb\", at most friction_angle, which is the bonds'; "
                    "friction_angle if not given.")
            .at_least(0)
            .below(90),

        CRACKLE_KEY(minerals, assign, "",
                    "Which grain has which mineral: drawn until the areas are as asked; by size, the largest grains "
                    "the mineral listed first; from a file of labels; from an image.")
            .one_of({"random", "size", "labels", "image"})
            .otherwise(words("random")),
        CRACKLE_KEY(minerals, seed, "", "Seed of the random assignment; the same seed gives the same grains.")
            .at_least(0)
            .otherwise(whole(1)),
        CRACKLE_KEY(minerals, labels, "",
                    "Text file with a line a grain, in the order of the specimen's file: the mineral's name, or its "
                    "number from 1; lines that are empty or begin with # are skipped.")
            .path(),
        CRACKLE_KEY(minerals, image, "", "PNG file laid over the box; a grain has the mineral of most of its pixels.")
            .path(),

        CRACKLE_LIST_KEY(mineral, name, "", "What [[mineral_pair]], labels and results call it.").needed_with_table(),
        CRACKLE_LIST_KEY(mineral, area_share, "",
                         "Share of all grains' area; one mineral may leave it out and has the rest.")
            .above(0)
            .at_most(1),
        CRACKLE_LIST_KEY(mineral, colour, "", "Colour in the image, \"#rrggbb\"."),

        CRACKLE_LIST_KEY(mineral_pair, between, "",
                         "Names of two minerals; of one twice for contacts among its grains.")
            .needed_with_table(),

        CRACKLE_KEY(joints, seed, "", "Seed of the joint sets; the same seed gives the same traces.")
            .at_least(0)
            .otherwise(whole(1)),
        CRACKLE_KEY(joints, section, "",
                    "The plane of the model, for orientation = \"fisher\": a vertical section, +y up, or a horizontal "
                    "one seen from above.")
            .one_of({"vertical", "horizontal"})
            .otherwise(words("vertical")),
        CRACKLE_KEY(joints, section_trend, "deg", "Where +x of the section points: from north, clockwise.")
            .at_least(0)
            .below(360),

        CRACKLE_KEY(joints, shortest, "m",
                    "Traces that have less in the box are left out, for grains that are larger; amounts are "
                    "reached before. If not given the mean spacing of the grains, and none where traces are "
                    "drawn alone.")
            .above(0),
        CRACKLE_KEY(joints, snap, "m",
                    "Nodes of traces that are nearer than half of it are brought together, and traces lose points "
                    "within a quarter of it of a straight line; nothing moves further than this. 0: traces stay as "
                    "they are. If not given a fifth of the mean spacing of the grains, and 0 where traces are drawn "
                    "alone.")
            .at_least(0),

        CRACKLE_LIST_KEY(joint_set, name, "", "What reports, figures and results call it.").needed_with_table(),
        CRACKLE_LIST_KEY(joint_set, orientation, "",
                         "fixed: all at angle; uniform: angle within angle_deviation either way; von_mises: axial, "
                         "density ~ exp(kappa cos 2(theta - angle)); fisher: planes about dip and dip_direction, cut "
                         "by the model's section.")
            .one_of({"fixed", "uniform", "von_mises", "fisher"})
            .otherwise(words("fixed")),
        CRACKLE_LIST_KEY(joint_set, angle, "deg", "Of the traces (their mean), from +x, counter-clockwise.")
            .at_least(-360)
            .at_most(360),
        CRACKLE_LIST_KEY(joint_set, angle_deviation, "deg", "Half the range of orientation = \"uniform\".")
            .above(0)
            .at_most(90),
        CRACKLE_LIST_KEY(joint_set, kappa, "", "Concentration of orientation = \"von_mises\".")
            .at_least(1e-3)
            .at_most(1e6),
        CRACKLE_LIST_KEY(joint_set, dip, "deg", "Of the mean plane, from the horizontal.").at_least(0).at_most(90),
        CRACKLE_LIST_KEY(joint_set, dip_direction, "deg", "Where the mean plane dips to: from north, clockwise.")
            .at_least(0)
            .at_most(360),
        CRACKLE_LIST_KEY(joint_set, fisher_k, "", "Concentration of the planes' normals about the mean one.")
            .at_least(1e-3)
            .at_most(1e6),
        CRACKLE_LIST_KEY(
            joint_set, length, "",
            "persistent: through the whole box; gaps: along a line length_mean of joint, then gap_mean of "
            "rock (each within its deviation, uniform); fixed; uniform: within length_deviation; "
            "lognormal; exponential; power_law: density ~ l^-length_exponent from length_min to length_max.")
            .one_of({"persistent", "gaps", "fixed", "uniform", "lognormal", "exponential", "power_law"})
            .otherwise(words("persistent")),
        CRACKLE_LIST_KEY(joint_set, length_mean, "m", "Mean length of a trace, before the box cuts it.").above(0),
        CRACKLE_LIST_KEY(joint_set, length_deviation, "m",
                         "uniform, gaps: half the range; lognormal: standard deviation.")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, length_min, "m", "Shortest trace of a power law.").above(0),
        CRACKLE_LIST_KEY(joint_set, length_max, "m", "Longest trace of a power law.").above(0),
        CRACKLE_LIST_KEY(joint_set, length_exponent, "", "Of a power law.").at_least(-10).at_most(10),
        CRACKLE_LIST_KEY(joint_set, gap_mean, "m", "Rock bridge between two traces of a line, length = \"gaps\".")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, gap_deviation, "m", "Half the range of gaps.").above(0),
        CRACKLE_LIST_KEY(joint_set, number, "", "Amount: traces in the box.").at_least(1).at_most(100000),
        CRACKLE_LIST_KEY(joint_set, p10, "1/m",
                         "Amount: traces per length of scan line, the mean over all lines along scan_line in the box.")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, p20, "1/m2", "Amount: traces' midpoints per area.").above(0),
        CRACKLE_LIST_KEY(joint_set, p21, "m/m2",
                         "Amount: length of traces per area; the last trace is shortened to meet it.")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, spacing, "m",
                         "Amount: mean distance between lines, square to the mean direction; of length = "
                         "\"persistent\" and \"gaps\".")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, scan_line, "deg",
                         "Direction that P10 counts along; square to the mean direction if not given.")
            .at_least(-360)
            .at_most(360),
        CRACKLE_LIST_KEY(joint_set, spacing_law, "",
                         "Of distances between lines; uniform within spacing_deviation; fixed if not given.")
            .one_of({"fixed", "uniform", "exponential", "lognormal"}),
        CRACKLE_LIST_KEY(joint_set, spacing_deviation, "m", "uniform: half the range; lognormal: standard deviation.")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, through, "m",
                         "x and y of a point on one line, with spacing; at random if not given."),

        CRACKLE_LIST_KEY(trace, name, "",
                         "What reports, figures and results call it; its number or its file if not given."),
        CRACKLE_LIST_KEY(trace, points, "m", "x1, y1, x2, y2, ...: one trace of straight pieces; or file."),
        CRACKLE_LIST_KEY(trace, file, "",
                         "Measured traces: .csv with columns trace,x,y (a line a point) or x1,y1,x2,y2 (a line a "
                         "straight trace); .dxf (R12: lines and polylines); any other: a trace a line, x1 y1 x2 y2 ...")
            .path(),
        CRACKLE_LIST_KEY(trace, layer, "", "Of a DXF file: reads this layer alone; all if not given."),
        CRACKLE_LIST_KEY(trace, scale, "m", "Length of a unit of the file; 1 if not given.").above(0),
        CRACKLE_LIST_KEY(trace, offset, "m", "x and y that are added to a file's places, scaled before."),

        CRACKLE_KEY(bond, law, "",
                    "back_tension: the overlap at bonding is the strength, as the guide has it. coulomb: tensile "
                    "strength, cohesion and friction of the material's own.")
            .one_of({"back_tension", "coulomb"})
            .otherwise(words("back_tension")),
        CRACKLE_KEY(bond, thick, "m",
                    "Segment thickness at bonding: polygons with back-tension need more than mesh.thick, the excess is "
                    "the overlap that bonds them; with coulomb bonds mesh.thick if not given; circles bond at the "
                    "overlaps they have (a tenth of the mean radius if not given, "
                    "which changes nothing but where the platens' centre lines are drawn).")
            .above(0),
        CRACKLE_KEY(
            bond, gap, "m",
            "Polygons with coulomb bonds: corners whose gap is at most this are bonded, too, each at its own; a "
            "twentieth of bond.thick if not given, for the corners that overhang after the inset.")
            .at_least(0),
        CRACKLE_KEY(bond, range, "",
                    "Circles with coulomb bonds: pairs whose gap is below this share of their mean radius bond, too.")
            .at_least(0)
            .at_most(1)
            .otherwise(0.0),
        CRACKLE_KEY(bond, tensile_factor, "",
                    "Tensile strength as a factor of the back-tension averaged over all bonds, in place of "
                    "material.tensile_strength.")
            .above(0),
        CRACKLE_KEY(bond, cohesion_factor, "", "Cohesion, likewise, in place of material.cohesion.").above(0),
        CRACKLE_KEY(bond, strength_distribution, "",
                    "Of a random factor, one each pair of particles, on tensile strength and cohesion; mean 1.")
            .one_of({"none", "normal", "lognormal", "weibull"})
            .otherwise(words("none")),
        CRACKLE_KEY(bond, strength_cv, "", "Its coefficient of variation (normal: at most 0.7555).")
            .above(0)
            .at_most(2),
        CRACKLE_KEY(bond, strength_seed, "", "Its seed.").at_least(0),

        CRACKLE_KEY(shape, diameter, "m",
                    "Of the disc, or half disc, that is cut from the packing (brazilian, scb): the largest that there "
                    "is if not given.")
            .above(0),
        CRACKLE_KEY(shape, notch, "m",
                    "Length of a notch from the lower face at midspan: bonds that it crosses are not made, circles on "
                    "it are taken away. bending: none if not given; scb: half of the radius.")
            .above(0),
    };
}

}  // namespace crackle
