// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/specimen_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "specimens/case/declare_parameter.hpp"
#include "specimens/packing/packing.hpp"

namespace crackle {

namespace {

using namespace declaring;

/// Names of all bond laws, each with its meaning.
std::string meanings_of_laws() {
    std::string meanings;
    for (const std::string& name : names_of<BondLaw>())
        meanings += fmt::format(" {}: {}.", name, facts_of(*from_name<BondLaw>(name)).meaning);
    return meanings.substr(1);
}

/// Keys of [material] for the constants of bonds.
std::vector<Parameter> bond_constant_keys() {
    std::vector<Parameter> keys;
    for (const BondConstant& c : all_bond_constants()) {
        const auto member = [given = c.given](TestCase& test) -> auto& { return test.material.*given; };
        With key{declare("material", c.key, c.is_angle ? "deg" : "N or Pa", member, c.meaning)};
        keys.push_back(c.is_angle ? std::move(key).at_least(0).below(90) : std::move(key).above(0));
    }
    return keys;
}

/// Keys of [material] for the constants of faces.
std::vector<Parameter> face_constant_keys() {
    std::vector<Parameter> keys;
    for (const FaceConstant& c : face_constants) {
        const auto member = [given = c.given](TestCase& test) -> auto& { return test.material.*given; };
        With key{declare("material", c.key, c.unit, member, c.meaning)};
        keys.push_back(std::move(key).at_least(0).below(c.below));
    }
    return keys;
}

}  // namespace

std::vector<Parameter> specimen_keys() {
    std::vector<Parameter> keys{
        With{declare("", "title", "", CRACKLE_MEMBER(title), "Heading of the report; the file's name if not given.")}
            .otherwise(std::string()),

        CRACKLE_KEY(particles, file, "", "Particle file in the layout of DEMseg's in_gm.dat (mode 1).")
            .path()
            .needed_with_table(),

        CRACKLE_KEY(packing, width, "m", "Width of the box.").above(0),
        CRACKLE_KEY(packing, height, "m", "Height of the box.").above(0),
        CRACKLE_KEY(packing, count, "", "Number of circles, in place of width and height.")
            .at_least(static_cast<double>(min_packing_circles))
            .at_most(static_cast<double>(max_packing_circles)),
        CRACKLE_KEY(packing, height_to_width, "", "Ratio of height to width of the box, with count; 2 if not given.")
            .above(0),
        CRACKLE_KEY(packing, sizes, "", "Distribution of the radii.").otherwise(RadiusLaw::uniform),
        CRACKLE_KEY(packing, radius_min, "m", "Smallest radius of uniform sizes, or lower cut-off of lognormal sizes.")
            .above(0),
        CRACKLE_KEY(packing, radius_max, "m", "Largest radius of uniform sizes, or upper cut-off of lognormal sizes.")
            .above(0),
        CRACKLE_KEY(packing, radius_median, "m", "Median radius (lognormal).").above(0),
        CRACKLE_KEY(packing, radius_log_deviation, "", "Standard deviation of ln(radius) (lognormal).").above(0),
        CRACKLE_KEY(packing, sieve, "", "File with the sieve curve, a table with the columns size and passing_by_mass.")
            .path(),
        CRACKLE_KEY(packing, cell_diameter, "m",
                    "Mean of the cells' equivalent diameters sqrt(4 area/pi), gaps included. With [mesh], this can be "
                    "given in place of the radii, which are then derived.")
            .above(0),
        CRACKLE_KEY(packing, cell_spread, "", "Coefficient of variation of the cells' diameters, with cell_diameter.")
            .above(0)
            .at_most(1),
        CRACKLE_KEY(packing, mean_overlap, "m", "Mean overlap, over all contacts, to which the circles are compressed.")
            .above(0),
        CRACKLE_KEY(packing, void_ratio, "",
                    "Void ratio to which the circles are compressed, in place of mean_overlap.")
            .above(0),
        CRACKLE_KEY(packing, seed, "", "Seed of the random numbers; the same seed gives the same packing.")
            .at_least(0)
            .otherwise(std::int64_t{1}),

        CRACKLE_KEY(mesh, kind, "", "Kind of polygons that are made from the circles' centres.").needed_with_table(),
        CRACKLE_KEY(mesh, thick, "m",
                    "Gap between neighbouring polygons. If not given: twice inset, or, with coulomb bonds, 0.02 times "
                    "the mean cell size sqrt(width height/cells).")
            .above(0),
        CRACKLE_KEY(mesh, inset, "m", "Depth by which each polygon is inset; thick/2 if not given.").at_least(0),
        CRACKLE_KEY(mesh, boundary, "",
                    "Where the outer faces lie: on the flat boundary of the domain, or at the outermost centres.")
            .otherwise(Boundary::domain),
        CRACKLE_KEY(mesh, merge_destroyed, "", "Whether a cell that the inset destroys is merged into a neighbour.")
            .otherwise(false),

        CRACKLE_KEY(material, density, "kg/m2", "Density as mass per unit area of the model.").above(0),
        CRACKLE_KEY(material, normal_stiffness, "N/m", "Normal stiffness k_n of a contact point.").above(0),
        CRACKLE_KEY(material, shear_stiffness, "N/m", "Shear stiffness k_s of a contact point.").at_least(0),
        CRACKLE_KEY(material, friction_angle, "deg", "Friction angle; mu = tan(angle).").at_least(0).below(90),
        CRACKLE_KEY(material, damping_ratio, "",
                    "Damping ratio h of every contact point. A packing without any damping key gets 0.2384, at which a "
                    "particle that vibrates on its contacts loses 95 % of its energy per period.")
            .at_least(0),
        CRACKLE_KEY(material, normal_damping, "N s/m",
                    "Coefficient of the normal dashpot of a contact point, in place of damping_ratio.")
            .at_least(0),
        CRACKLE_KEY(material, shear_damping, "N s/m",
                    "Coefficient of the shear dashpot of a contact point, in place of damping_ratio.")
            .at_least(0),

        CRACKLE_KEY(material, units, "",
                    "What stiffness and strengths refer to: a contact point (N/m, N), or the area of a face (Pa), "
                    "which makes them independent of the grain size.")
            .otherwise(StiffnessUnits::point),
        CRACKLE_KEY(material, contact_modulus, "Pa",
                    "Contact modulus E_c in area units: a face of length L between centroids a distance l apart has "
                    "k_n = E_c L/l.")
            .above(0),
        CRACKLE_KEY(material, stiffness_ratio, "", "Ratio of normal to shear stiffness, k_n/k_s, in area units.")
            .above(0),
        CRACKLE_KEY(minerals, assign, "",
                    "How grains get their minerals: at random until the area shares are met; by size, where the "
                    "largest grains get the mineral listed first; from a file of labels; from an image.")
            .otherwise(MineralAssignment::random),
        CRACKLE_KEY(minerals, seed, "", "Seed of the random assignment; the same seed gives the same assignment.")
            .at_least(0)
            .otherwise(std::int64_t{1}),
        CRACKLE_KEY(minerals, labels, "",
                    "Text file with a line per grain, in the order of the grains in the specimen file: the mineral's "
                    "name, or its number from 1. Empty lines and lines that begin with # are skipped.")
            .path(),
        CRACKLE_KEY(minerals, image, "",
                    "PNG file laid over the box; a grain gets the mineral that most of its pixels have.")
            .path(),

        CRACKLE_LIST_KEY(mineral, name, "", "Name of the mineral in [[mineral_pair]], labels and results.")
            .needed_with_table(),
        CRACKLE_LIST_KEY(mineral, area_share, "",
                         "Share of the area of all grains; one mineral may omit the key and gets the remaining area.")
            .above(0)
            .at_most(1),
        CRACKLE_LIST_KEY(mineral, colour, "", "Colour in the image, \"#rrggbb\"."),

        CRACKLE_LIST_KEY(
            mineral_pair, between, "",
            "Names of the two minerals; the same name twice means contacts between grains of that mineral.")
            .needed_with_table(),

        CRACKLE_KEY(joints, seed, "", "Seed of the joint sets; the same seed gives the same traces.")
            .at_least(0)
            .otherwise(std::int64_t{1}),
        CRACKLE_KEY(joints, section, "",
                    "Plane of the model, for orientation = \"fisher\": a vertical section with +y up, or a horizontal "
                    "one seen from above.")
            .otherwise(JointSection::vertical),
        CRACKLE_KEY(joints, section_trend, "deg", "Direction of the section's +x axis, clockwise from north.")
            .at_least(0)
            .below(360),

        CRACKLE_KEY(joints, shortest, "m",
                    "Length of the shortest trace that is kept. Traces with a shorter part in the box are left out, "
                    "because grains are larger, but still count towards the amounts. If not given: the mean spacing of "
                    "the grains, or 0 if traces are generated without grains.")
            .above(0),
        CRACKLE_KEY(
            joints, snap, "m",
            "Tolerance for cleaning traces: nodes closer than half the tolerance are merged, and points within a "
            "quarter of it of a straight line are removed. No point moves farther than the tolerance. 0 leaves "
            "traces unchanged. If not given: a fifth of the mean spacing of the grains, or 0 if traces are "
            "generated without grains.")
            .at_least(0),

        CRACKLE_LIST_KEY(joint_set, name, "", "Name of the set in reports, figures and results.").needed_with_table(),
        CRACKLE_LIST_KEY(joint_set, orientation, "",
                         "Distribution of orientations. fixed: all at angle; uniform: within angle_deviation of angle; "
                         "von_mises: axial, density ~ exp(kappa cos 2(theta - angle)); fisher: planes about dip and "
                         "dip_direction, cut by the model's section.")
            .otherwise(JointOrientation::fixed),
        CRACKLE_LIST_KEY(joint_set, angle, "deg", "Mean angle of the traces, counter-clockwise from +x.")
            .at_least(-360)
            .at_most(360),
        CRACKLE_LIST_KEY(joint_set, angle_deviation, "deg", "Half the range of angles, for orientation = \"uniform\".")
            .above(0)
            .at_most(90),
        CRACKLE_LIST_KEY(joint_set, kappa, "", "Concentration of angles, for orientation = \"von_mises\".")
            .at_least(1e-3)
            .at_most(1e6),
        CRACKLE_LIST_KEY(joint_set, dip, "deg", "Dip of the mean plane, from the horizontal.").at_least(0).at_most(90),
        CRACKLE_LIST_KEY(joint_set, dip_direction, "deg", "Dip direction of the mean plane, clockwise from north.")
            .at_least(0)
            .at_most(360),
        CRACKLE_LIST_KEY(joint_set, fisher_k, "", "Concentration of the planes' normals about the mean normal.")
            .at_least(1e-3)
            .at_most(1e6),
        CRACKLE_LIST_KEY(
            joint_set, length, "",
            "Distribution of lengths. persistent: through the whole box; gaps: lines on which joints (mean "
            "length_mean) and rock bridges (mean gap_mean) alternate, each uniform within its deviation; "
            "fixed; uniform: within length_deviation; lognormal; exponential; power_law: density ~ l^-length_exponent "
            "from length_min to length_max.")
            .otherwise(JointLength::persistent),
        CRACKLE_LIST_KEY(joint_set, length_mean, "m", "Mean length of a trace, before the box cuts it.").above(0),
        CRACKLE_LIST_KEY(joint_set, length_deviation, "m",
                         "Half the range of lengths (uniform, gaps), or their standard deviation (lognormal).")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, length_min, "m", "Length of the shortest trace, for length = \"power_law\".")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, length_max, "m", "Length of the longest trace, for length = \"power_law\".")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, length_exponent, "", "Exponent of the power law, for length = \"power_law\".")
            .at_least(-10)
            .at_most(10),
        CRACKLE_LIST_KEY(joint_set, gap_mean, "m",
                         "Mean length of the rock bridges between traces on a line, for length = \"gaps\".")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, gap_deviation, "m", "Half the range of the lengths of rock bridges.").above(0),
        CRACKLE_LIST_KEY(joint_set, number, "", "Amount: number of traces in the box.").at_least(1).at_most(100000),
        CRACKLE_LIST_KEY(
            joint_set, p10, "1/m",
            "Amount: number of traces per length of scan line, averaged over all lines along scan_line in the box.")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, p20, "1/m2", "Amount: number of midpoints of traces per area.").above(0),
        CRACKLE_LIST_KEY(joint_set, p21, "m/m2",
                         "Amount: length of traces per area; the last trace is shortened to meet it.")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, spacing, "m",
                         "Amount: mean distance between lines, perpendicular to the mean direction; for length = "
                         "\"persistent\" and \"gaps\".")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, scan_line, "deg",
                         "Direction of the scan line of P10; perpendicular to the mean direction if not given.")
            .at_least(-360)
            .at_most(360),
        CRACKLE_LIST_KEY(joint_set, spacing_law, "",
                         "Distribution of the distances between lines; uniform: within spacing_deviation of spacing; "
                         "fixed if not given."),
        CRACKLE_LIST_KEY(joint_set, spacing_deviation, "m",
                         "Half the range of distances (uniform), or their standard deviation (lognormal).")
            .above(0),
        CRACKLE_LIST_KEY(joint_set, through, "m",
                         "x and y of a point on one of the lines, with spacing; chosen at random if not given."),

        CRACKLE_LIST_KEY(trace, name, "",
                         "Name of the trace in reports, figures and results; its number or its file if not given."),
        CRACKLE_LIST_KEY(trace, points, "m", "x1, y1, x2, y2, ...: one trace of straight segments, in place of file."),
        CRACKLE_LIST_KEY(
            trace, file, "",
            "Measured traces: .csv with the columns trace,x,y (a line per point) or x1,y1,x2,y2 (a line per straight "
            "trace); .dxf (R12: lines and polylines); any other: a line per trace, x1 y1 x2 y2 ...")
            .path(),
        CRACKLE_LIST_KEY(trace, layer, "", "Layer of a DXF file to read; all layers are read if not given."),
        CRACKLE_LIST_KEY(trace, scale, "m", "Length of one unit of the file; 1 if not given.").above(0),
        CRACKLE_LIST_KEY(trace, offset, "m", "x and y that are added to a file's coordinates after scaling."),

        CRACKLE_KEY(bond, law, "", meanings_of_laws()).otherwise(BondLaw::back_tension),
        CRACKLE_KEY(bond, thick, "m",
                    "Thickness of segments when bonds are made. For polygons with back-tension it must exceed "
                    "mesh.thick, by the overlap with which they bond. For polygons with coulomb bonds it is mesh.thick "
                    "if not given. Circles bond with the overlaps they have; for them it only affects where the "
                    "platens' centre lines are drawn, and is a tenth of the mean radius if not given.")
            .above(0),
        CRACKLE_KEY(
            bond, gap, "m",
            "Polygons with coulomb bonds: corners across a gap of at most this width are bonded as well, and the gap "
            "is kept. A twentieth of bond.thick if not given, for corners that overhang after the inset.")
            .at_least(0),
        CRACKLE_KEY(bond, range, "",
                    "Circles with coulomb bonds: pairs whose gap is below this fraction of their mean radius are "
                    "bonded as well.")
            .at_least(0)
            .at_most(1)
            .otherwise(0.0),
        CRACKLE_KEY(bond, tensile_factor, "",
                    "Tensile strength as a multiple of the back-tension averaged over all bonds, in place of "
                    "material.tensile_strength.")
            .above(0),
        CRACKLE_KEY(
            bond, cohesion_factor, "",
            "Cohesion as a multiple of the back-tension averaged over all bonds, in place of material.cohesion.")
            .above(0),
        CRACKLE_KEY(bond, strength_distribution, "",
                    "Distribution of a random factor, with mean 1, by which the tensile strength and cohesion of each "
                    "pair of particles are multiplied.")
            .otherwise(StrengthDistribution::none),
        CRACKLE_KEY(bond, strength_cv, "",
                    "Coefficient of variation of the random strength factor (at most 0.7555 for normal).")
            .above(0)
            .at_most(2),
        CRACKLE_KEY(bond, strength_seed, "", "Seed of the random strength factor.").at_least(0),

        CRACKLE_KEY(shape, diameter, "m",
                    "Diameter of the disc, or half disc, that is cut from the packing (brazilian, scb); the largest "
                    "possible if not given.")
            .above(0),
        CRACKLE_KEY(shape, notch, "m",
                    "Length of a notch that starts from the lower face at midspan. No bonds are made across the notch, "
                    "and circles on it are removed. If not given: no notch (bending), half the radius (scb).")
            .above(0),
    };
    const auto last = std::ranges::find(keys, "material.stiffness_ratio", &Parameter::full_key);
    std::vector<Parameter> constants = bond_constant_keys();
    std::ranges::move(face_constant_keys(), std::back_inserter(constants));
    std::ranges::move(constants, std::inserter(keys, last + 1));
    return keys;
}

}  // namespace crackle
