// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic compliance of rocks with persistent joint sets, by the sparse solve under uniform tractions.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "specimens/elastic/compliance.hpp"
#include "specimens/joints/joint_network.hpp"
#include "specimens/making/make_specimen.hpp"
#include "specimens/setup/bonded_specimen.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/joints/jointed_rock.hpp"
#include "tests/bench/verify/rows.hpp"

namespace crackle::verification {
namespace {

constexpr double per_degree = std::numbers::pi / 180.0;

/// Error of the moduli of a rock of circles: relative error times the joint spacing in circles. A row of circles beside
/// a joint carries less load than a row inside the rock.
constexpr double one_circle_off = 0.8;
constexpr double small_diameter = 0.5 * circles_diameter;  // m

/// 1/E in a direction, 1/Pa. @param angle rad from +x
double softness_along(const Compliance& s, double angle) {
    const double x = std::cos(angle), y = std::sin(angle);
    const double stress[3] = {x * x, y * y, x * y}, measure[3] = {x * x, y * y, x * y};
    double strain = 0.0;
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) strain += measure[a] * s[a][b] * stress[b];
    return strain;
}

Compliance compliance(const Specimen& specimen, const ResolvedCase& test, Traces traces) {
    return compliance_of(bond_alone(specimen, test.bond, test, traces), specimen.scene.domain, 0.5 * specimen.mesh_gap);
}

Joint stiffnesses(double normal, double shear) {
    Joint joint;
    joint.normal_stiffness = normal;
    joint.shear_stiffness = shear;
    return joint;
}

std::vector<ClaimRow> persistent_set_adds_its_compliance() {
    Rows rows;
    constexpr int joints = 8;
    constexpr double spacing = rock_height / joints, normal = 2e11, shear = 8e10;  // m, Pa/m
    for (const SpecimenKind kind : {SpecimenKind::voronoi, SpecimenKind::delaunay}) {
        for (const std::int64_t seed : {1, 2}) {
            ResolvedCase test = jointed_rock(kind, seed);
            add_set(test, 0.0, spacing, {0.0, 0.5 * spacing}, stiffnesses(normal, shear));
            const Specimen specimen = make_specimen(test, {});
            const Compliance jointed = compliance(specimen, test, Traces::as_they_are),
                             welded = compliance(specimen, test, Traces::as_rock);
            const std::string name = fmt::format("{}, packing {}: ", name_of(kind), seed);
            for (const double t : {0.0, 30.0, 45.0, 60.0, 90.0}) {
                const double c = std::cos(t * per_degree), s = std::sin(t * per_degree),
                             along = (90.0 - t) * per_degree;
                const double expected = softness_along(welded, along) + c * c * c * c / (normal * spacing) +
                                        s * s * c * c / (shear * spacing);
                rows.relative(name + fmt::format("E at {:.0f} degrees, Pa", t), 1.0 / softness_along(jointed, along),
                              1.0 / expected, 0.01, "reference");
            }
            rows.relative(name + "G', Pa", 1.0 / jointed[2][2], 1.0 / (welded[2][2] + 1.0 / (shear * spacing)), 0.01,
                          "reference");
            rows.shown(name + "E without joints, Pa", 1.0 / welded[1][1]);
        }
    }
    return rows.take();
}

/// The case with joints of the given stiffness, Pa/m.
ResolvedCase with_stiffness(ResolvedCase test, double stiffness) {
    for (JointSet& set : test.joints.sets) set.mechanics = stiffnesses(stiffness, stiffness);
    return test;
}

std::vector<ClaimRow> joint_among_circles_adds_its_compliance() {
    Rows rows;
    constexpr double normal = 2e11, shear = 8e10, stiff = 1e24;  // Pa/m
    for (const int joints : {8, 4, 1}) {
        const double spacing = rock_height / joints;
        ResolvedCase test = jointed_rock(SpecimenKind::circles, 1);
        auto& radii = std::get<UniformRadii>(test.packing()->sizes);
        radii = {0.5 * radii.radius_min, 0.5 * radii.radius_max};
        add_set(test, 0.0, spacing, {0.0, 0.5 * spacing}, stiffnesses(normal, shear));
        const ResolvedCase rigid = with_stiffness(test, stiff);
        const Specimen specimen = make_specimen(test, {});
        const Compliance jointed = compliance(specimen, test, Traces::as_they_are),
                         welded = compliance(make_specimen(rigid, {}), rigid, Traces::as_they_are);
        const auto compare = [&](const std::string& what, double got, double expected) {
            const std::string name =
                fmt::format("{} at a spacing of {:.3g} circles, Pa", what, spacing / small_diameter);
            rows.relative(name, got, expected, one_circle_off * small_diameter / spacing, "ragged rows");
        };
        for (const double t : {0.0, 30.0, 45.0, 60.0}) {
            const double c = std::cos(t * per_degree), s = std::sin(t * per_degree), along = (90.0 - t) * per_degree;
            const double expected =
                softness_along(welded, along) + c * c * c * c / (normal * spacing) + s * s * c * c / (shear * spacing);
            compare(fmt::format("E at {:.0f} degrees", t), 1.0 / softness_along(jointed, along), 1.0 / expected);
        }
        compare("G'", 1.0 / jointed[2][2], 1.0 / (welded[2][2] + 1.0 / (shear * spacing)));
        rows.shown(fmt::format("E along a spacing of {:.3g} circles over that with joints without compliance",
                               spacing / small_diameter),
                   welded[0][0] / jointed[0][0]);
        rows.shown(fmt::format("E across it without compliance over that of the packing, {} joints", joints),
                   compliance(specimen, test, Traces::as_rock)[1][1] / welded[1][1]);
    }
    return rows.take();
}

std::vector<ClaimRow> persistent_sets_add_up() {
    Rows rows;
    for (const SpecimenKind kind : {SpecimenKind::voronoi, SpecimenKind::delaunay}) {
        ResolvedCase test = jointed_rock(kind, 3);
        test.mesh->gap = parts::MeshGap{5e-5, {}};  // small, since cells at crossings are slender
        // Near crossings, Voronoi cells need more space than triangles.
        const std::size_t sets = kind == SpecimenKind::voronoi ? 2 : 3;
        const double spacings[] = {0.15, 0.12, 0.16}, angles[] = {0.0, 60.0, 110.0};
        const double normal[] = {2e11, 4e11, 6e11}, shear[] = {8e10, 2e11, 1e11};
        for (std::size_t k = 0; k < sets; ++k)
            add_set(test, angles[k], spacings[k], {0.31, 0.6 + 0.5 * spacings[k]}, stiffnesses(normal[k], shear[k]));
        const Specimen specimen = make_specimen(test, {});
        const Compliance jointed = compliance(specimen, test, Traces::as_they_are);
        Compliance expected = compliance(specimen, test, Traces::as_rock);
        const JointNetwork network =
            make_joints(test.joints, specimen.scene.domain, static_cast<std::size_t>(specimen.centres));
        for (std::size_t k = 0; k < sets; ++k) {
            double length = 0.0;
            for (const JointTrace& trace : network.traces) length += trace.source == k ? trace.length() : 0.0;
            // The box may contain more or less of a set than its spacing implies, so the actual length is used.
            const Compliance own =
                compliance_of_set(angles[k] * per_degree, network.area() / length, normal[k], shear[k]);
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t b = 0; b < 3; ++b) expected[a][b] += own[a][b];
        }
        const std::string name = fmt::format("{}: ", name_of(kind));
        rows.relative(name + "E along x, Pa", 1.0 / jointed[0][0], 1.0 / expected[0][0], 0.02, "reference");
        rows.relative(name + "E along y, Pa", 1.0 / jointed[1][1], 1.0 / expected[1][1], 0.02, "reference");
        rows.relative(name + "G, Pa", 1.0 / jointed[2][2], 1.0 / expected[2][2], 0.02, "reference");
    }
    return rows.take();
}

}  // namespace

std::vector<Claim> joint_compliance_claims() {
    constexpr const char* group = "Joints";
    return {
        {.name = "persistent_set_adds_its_compliance",
         .group = group,
         .statement = "with one persistent set 1/E_a = 1/E + cos⁴t/(K_n S) + sin²t cos²t/(K_s S) and 1/G' = 1/G + "
                      "1/(K_s S), where t is the angle between the load and the joints' normal",
         .check = persistent_set_adds_its_compliance,
         .note = "E and G are those of the same mesh with welded traces, and S is the height over 8 joints. Sparse "
                 "solve under uniform tractions."},
        {.name = "joint_among_circles_adds_its_compliance",
         .group = group,
         .statement = "a joint among circles adds its compliance as well, with an error of up to 0.8 of a circle over "
                      "the spacing",
         .check = joint_among_circles_adds_its_compliance,
         .note = "With flat faces (solver/MODEL.md 5.4). E and G are those with joints of K = 1e24 Pa/m. Circles carry "
                 "loads by force chains, so rows next to a soft joint carry less, most of all along the joint."},
        {.name = "persistent_sets_add_up",
         .group = group,
         .statement =
             "compliances of several persistent sets add to that of the rock, S + Σ Rᵀ diag(1/K_n S, 1/K_s S) R",
         .check = persistent_sets_add_up,
         .note = "Three sets that cross; the spacing S of a set is the area over the length of its traces."},
    };
}

}  // namespace crackle::verification
