// SPDX-License-Identifier: GPL-3.0-or-later
// The declarations of all case keys: a key each; its value is a member of TestCase (test_case.hpp).

#include "specimens/case/parameters.hpp"

#include "solver/scene/scene.hpp"
#include "specimens/packing/packing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace crackle {
namespace {

template <class T>
struct Unwrap {
    using type = T;
    static constexpr bool optional = false;
};
template <class T>
struct Unwrap<std::optional<T>> {
    using type = T;
    static constexpr bool optional = true;
};

/// The member of a case, or of an entry of one of its lists.
template <class Member>
auto& reach(const Member& member, TestCase& c, std::size_t entry) {
    if constexpr (std::is_invocable_v<Member, TestCase&>) {
        return member(c);
    } else {
        return member(c, entry);
    }
}

/// Declares a parameter held by the member that `member` returns; its type gives the kind of value.
template <class Member>
Parameter declare(std::string table, std::string key, std::string unit, Member member, std::string sentence) {
    using Held = std::remove_cvref_t<decltype(reach(member, std::declval<TestCase&>(), 0))>;
    using T = typename Unwrap<Held>::type;
    Parameter p;
    p.table = std::move(table);
    p.key = std::move(key);
    p.unit = std::move(unit);
    p.sentence = std::move(sentence);
    p.kind = std::is_same_v<T, bool>                  ? ValueKind::flag
             : std::is_same_v<T, std::int64_t>        ? ValueKind::integer
             : std::is_same_v<T, double>              ? ValueKind::real
             : std::is_same_v<T, std::string>         ? ValueKind::text
             : std::is_same_v<T, std::vector<double>> ? ValueKind::reals
                                                      : ValueKind::text_pair;
    p.presence = Unwrap<Held>::optional ? Presence::optional : Presence::required;
    p.set = [member](TestCase& c, const CaseValue& value, std::size_t entry) {
        reach(member, c, entry) = std::get<T>(value);
    };
    p.get = [member](const TestCase& c, std::size_t entry) -> std::optional<CaseValue> {
        // It only reaches in; nothing is written.
        const Held& held = reach(member, const_cast<TestCase&>(c), entry);
        if constexpr (Unwrap<Held>::optional) {
            if (!held) return std::nullopt;
            return CaseValue(*held);
        } else {
            return CaseValue(held);
        }
    };
    if constexpr (Unwrap<Held>::optional) p.forget = [member](TestCase& c) { reach(member, c, 0).reset(); };
    return p;
}

/// Refinements of a declaration, chained behind it.
struct With {
    Parameter p;
    With above(double low) && { return p.lowest = low, p.lowest_allowed = false, std::move(*this); }
    With at_least(double low) && { return p.lowest = low, std::move(*this); }
    With below(double high) && { return p.highest = high, p.highest_allowed = false, std::move(*this); }
    With at_most(double high) && { return p.highest = high, std::move(*this); }
    With one_of(std::vector<std::string> choices) && { return p.choices = std::move(choices), std::move(*this); }
    With path() && { return p.is_path = true, std::move(*this); }
    With needed_with_table() && { return p.presence = Presence::required_with_table, std::move(*this); }
    With otherwise(CaseValue value) && {
        return p.default_value = std::move(value), p.presence = Presence::defaulted, std::move(*this);
    }
    operator Parameter() && { return std::move(p); }
};

// NOLINTBEGIN(bugprone-macro-parentheses): names of members and lists of calls
// Its versions differ on a lambda in a macro.
// clang-format off
#define CRACKLE_MEMBER(path) [](TestCase& c) -> auto& { return c.path; }
#define CRACKLE_ENTRY(list, path) [](TestCase& c, std::size_t entry) -> auto& { return c.list[entry].path; }
// clang-format on
#define CRACKLE_KEY(table, key, unit, sentence) \
    With { declare(#table, #key, unit, CRACKLE_MEMBER(table.key), sentence) }
#define CRACKLE_LIST_KEY(list, key, unit, sentence) \
    With { declare(#list, #key, unit, CRACKLE_ENTRY(list, key), sentence) }
// NOLINTEND(bugprone-macro-parentheses)

/// A number of [material] as a key of the list's entries, which hold MaterialKeys of their own.
template <class List>
Parameter owned(const Parameter& of_material, std::string table, List list) {
    Parameter p = of_material;
    p.table = std::move(table);
    p.presence = Presence::optional;
    p.default_value.reset();
    p.forget = {};
    p.set = [set = p.set, list](TestCase& c, const CaseValue& value, std::size_t entry) {
        TestCase material_alone;
        material_alone.material = list(c)[entry].own;
        set(material_alone, value, 0);
        list(c)[entry].own = material_alone.material;
    };
    p.get = [get = p.get, list](const TestCase& c, std::size_t entry) {
        TestCase material_alone;
        material_alone.material = list(c)[entry].own;
        return get(material_alone, 0);
    };
    return p;
}

/// Minerals have every number of [material], pairs of them what belongs to a contact.
void add_minerals_keys(std::vector<Parameter>& all) {
    const auto minerals = [](auto& c) -> auto& { return c.mineral; };
    const auto pairs = [](auto& c) -> auto& { return c.mineral_pair; };
    const std::vector<std::string>& of_pairs = mineral_pair_keys();
    std::vector<Parameter> own;
    for (const Parameter& p : all) {
        if (p.table != "material" || p.kind != ValueKind::real) continue;
        own.push_back(owned(p, "mineral", minerals));
        if (std::find(of_pairs.begin(), of_pairs.end(), p.key) != of_pairs.end())
            own.push_back(owned(p, "mineral_pair", pairs));
    }
    all.insert(all.end(), own.begin(), own.end());
}

std::vector<Parameter> all_parameters() {
    using Text = std::string;
    const auto whole = [](std::int64_t n) { return CaseValue(n); };
    return {
        With{declare("", "title", "", CRACKLE_MEMBER(title), "Heading of the report; the file's name if not given.")}
            .otherwise(Text()),

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
            .otherwise(Text("uniform")),
        CRACKLE_KEY(packing, radius_min, "m", "Smallest radius (uniform; cut-off of lognormal).").above(0),
        CRACKLE_KEY(packing, radius_max, "m", "Largest radius (uniform; cut-off of lognormal).").above(0),
        CRACKLE_KEY(packing, radius_median, "m", "Median radius (lognormal).").above(0),
        CRACKLE_KEY(packing, radius_log_deviation, "", "Standard deviation of ln(radius) (lognormal).").above(0),
        CRACKLE_KEY(packing, sieve, "", "Sieve curve: CSV with columns size,passing_by_mass.").path(),
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
            .otherwise(Text("domain")),
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
            .otherwise(Text("point")),
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
            .otherwise(Text("random")),
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
            .otherwise(Text("vertical")),
        CRACKLE_KEY(joints, section_trend, "deg", "Where +x of the section points: from north, clockwise.")
            .at_least(0)
            .below(360),

        CRACKLE_KEY(joints, shortest, "m",
                    "Traces that have less in the box are left out, for a mesh whose grains are larger; amounts are "
                    "reached before. None are if not given.")
            .above(0),

        CRACKLE_LIST_KEY(joint_set, name, "", "What reports, figures and results call it.").needed_with_table(),
        CRACKLE_LIST_KEY(joint_set, orientation, "",
                         "fixed: all at angle; uniform: angle within angle_deviation either way; von_mises: axial, "
                         "density ~ exp(kappa cos 2(theta - angle)); fisher: planes about dip and dip_direction, cut "
                         "by the model's section.")
            .one_of({"fixed", "uniform", "von_mises", "fisher"})
            .otherwise(Text("fixed")),
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
            .otherwise(Text("persistent")),
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
            .otherwise(Text("back_tension")),
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
            .otherwise(Text("none")),
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
            .otherwise(Text("bonded")),
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
                    "Axial strains, ascending, at each of which the specimen is unloaded and loaded again: the damage "
                    "modulus of every cycle stands in summary.json. Needs loading by tolerance.")
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
            .otherwise(Text("rounded")),
        CRACKLE_KEY(numerics, integrator, "",
                    "How unbonded contacts open and close: leapfrog, as the guide does, or consistent with the energy.")
            .one_of({"leapfrog", "consistent"})
            .otherwise(Text("leapfrog")),
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
            .otherwise(Text("single")),
        CRACKLE_KEY(output, slips, "",
                    "Writes slips.csv: the first arrival of each back-tension bond at its Coulomb limit.")
            .otherwise(false),
        CRACKLE_KEY(
            output, emission, "",
            "Writes ae.csv: acoustic events, breaks clustered in place and time, with their moments; takes some "
            "time, and needs the moduli of the linear solution.")
            .otherwise(false),
        CRACKLE_KEY(output, checkpoint_interval, "s", "Wall-clock time between checkpoints.").above(0).otherwise(60.0),
        CRACKLE_KEY(output, out_of_plane_thickness, "m",
                    "Only converts what is reported: stresses in N/m over this give the _pa values, and MPa beside "
                    "them on terminal and page; if not given the _pa values are those of 1 m.")
            .above(0),
    };
}

}  // namespace

const std::vector<Parameter>& case_parameters() {
    static const std::vector<Parameter> all = [] {
        std::vector<Parameter> declared = all_parameters();
        add_minerals_keys(declared);
        return declared;
    }();
    return all;
}

const std::vector<std::string>& mineral_pair_keys() {
    static const std::vector<std::string> keys{"normal_stiffness", "shear_stiffness",        "friction_angle",
                                               "contact_modulus",  "stiffness_ratio",        "tensile_strength",
                                               "cohesion",         "residual_friction_angle"};
    return keys;
}

std::vector<std::string> material_tables(const TestCase& test) {
    std::vector<std::string> all{"material"};
    for (std::size_t k = 0; k < test.mineral.size(); ++k) all.push_back(fmt::format("mineral[{}]", k + 1));
    for (std::size_t k = 0; k < test.mineral_pair.size(); ++k) all.push_back(fmt::format("mineral_pair[{}]", k + 1));
    return all;
}

TestCase::MaterialKeys mineral_material(const TestCase& test, std::size_t mineral) {
    TestCase material_alone;
    material_alone.material = test.material;
    for (const Parameter& own : case_parameters()) {
        if (own.table != "mineral") continue;
        const std::optional<CaseValue> value = own.get(test, mineral);
        if (!value) continue;
        for (const Parameter& p : case_parameters())
            if (p.table == "material" && p.key == own.key) p.set(material_alone, *value, 0);
    }
    return material_alone.material;
}

TestCase::MaterialKeys pair_material(const TestCase& test, std::size_t pair) {
    TestCase::MaterialKeys keys = test.mineral_pair[pair].own;
    for (auto key : {&TestCase::MaterialKeys::tensile_strength, &TestCase::MaterialKeys::cohesion,
                     &TestCase::MaterialKeys::friction_angle}) {
        if (keys.*key) continue;
        for (std::size_t k = 0; k < test.mineral.size(); ++k) {
            if (std::ranges::find(test.mineral_pair[pair].between, test.mineral[k].name) ==
                test.mineral_pair[pair].between.end())
                continue;
            const auto own = mineral_material(test, k).*key;
            if (own) keys.*key = std::min(own, keys.*key ? keys.*key : own);
        }
    }
    return keys;
}

const Parameter* find_parameter(const std::string& table, const std::string& key) {
    for (const Parameter& p : case_parameters()) {
        if (p.table == table && p.key == key) return &p;
    }
    return nullptr;
}

const std::vector<Alternatives>& case_alternatives() {
    static const std::vector<Alternatives> all{
        {{"packing.count", "packing.height_to_width"}, {"packing.width", "packing.height"}},
        {{"packing.cell_diameter", "packing.cell_spread"},
         {"packing.radius_min", "packing.radius_max", "packing.radius_median", "packing.radius_log_deviation",
          "packing.sieve"}},
        {{"packing.mean_overlap"}, {"packing.void_ratio"}},
        {{"material.damping_ratio"}, {"material.normal_damping", "material.shear_damping"}},
        {{"material.normal_stiffness", "material.shear_stiffness"},
         {"material.contact_modulus", "material.stiffness_ratio"}},
        {{"material.tensile_strength"}, {"bond.tensile_factor"}},
        {{"material.cohesion"}, {"bond.cohesion_factor"}},
        {{"loading.axial_strain_rate"}, {"loading.rate_tolerance"}},
        {{"loading.unload_at_strain"}, {"loading.unload_at_stress"}},
    };
    return all;
}

const std::vector<TableDescription>& case_tables() {
    static const std::vector<TableDescription> all{
        {"", "Top of the file."},
        {"particles", "A specimen from a file; the alternative is [packing]."},
        {"packing", "A specimen made here; the alternative is [particles]."},
        {"mesh", "Turns the circles into polygons; without it they stay circles."},
        {"material", "Of the specimen; with [particles], each key overrides the file's."},
        {"minerals", "How grains get the minerals below."},
        {"mineral", "One table a mineral; numbers that it does not give are [material]'s, which platens have.",
         [](const TestCase& c) { return c.mineral.size(); }, [](TestCase& c, std::size_t n) { c.mineral.resize(n); }},
        {"mineral_pair",
         "Contacts between two minerals, in place of springs in series and the smaller friction of the two.",
         [](const TestCase& c) { return c.mineral_pair.size(); },
         [](TestCase& c, std::size_t n) { c.mineral_pair.resize(n); }},
        {"joints", "How joint sets are drawn."},
        {"joint_set", "One table a set of joints, drawn by its laws.",
         [](const TestCase& c) { return c.joint_set.size(); },
         [](TestCase& c, std::size_t n) { c.joint_set.resize(n); }},
        {"trace", "One table a measured trace, or a file of them.", [](const TestCase& c) { return c.trace.size(); },
         [](TestCase& c, std::size_t n) { c.trace.resize(n); }},
        {"bond", "What holds the particles together, and how it breaks."},
        {"shape", "What is cut from the packing, of brazilian, bending and scb."},
        {"loading", "The kind of test, and how it is loaded: the lower platen is fixed, the upper one moves."},
        {"confinement", "Of a biaxial test."},
        {"numerics", "How it is computed."},
        {"output", "What is written."},
    };
    return all;
}

bool Parameter::accepts(double value) const {
    if (!is_a_size(value)) return false;
    if (lowest_allowed ? value < lowest : value <= lowest) return false;
    return highest_allowed ? value <= highest : value < highest;
}

std::string Parameter::expected() const {
    switch (kind) {
        case ValueKind::flag:
            return "true or false";
        case ValueKind::text:
            if (choices.empty()) return is_path ? "a file name in quotes" : "a text in quotes";
            return fmt::format("\"{}\"", fmt::join(choices, "\" or \""));
        case ValueKind::text_pair:
            return "two texts in square brackets";
        case ValueKind::integer:
        case ValueKind::real:
        case ValueKind::reals:
            break;
    }
    std::string text = kind == ValueKind::integer ? "a whole number"
                       : kind == ValueKind::reals ? "numbers in square brackets, each"
                                                  : "a number";
    if (std::isfinite(lowest)) text += fmt::format(" {} {:g}", lowest_allowed ? ">=" : ">", lowest);
    if (std::isfinite(highest))
        text += fmt::format("{} {} {:g}", std::isfinite(lowest) ? " and" : "", highest_allowed ? "<=" : "<", highest);
    if (!unit.empty()) text += " in " + unit;
    return text;
}

}  // namespace crackle
