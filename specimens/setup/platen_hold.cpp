// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/platen_hold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <limits>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/measure/point_view.hpp"

namespace crackle {
namespace {

struct BondedFace {
    int bonds = 0;
    double from = std::numeric_limits<double>::infinity(), to = -from;  // m, extent of the bonded particles

    double length() const { return bonds > 0 ? to - from : 0.0; }
};

BondedFace hold_of(const World& world, const TestSetup& setup, BodyIndex platen) {
    BondedFace hold;
    for (const BodyPair& bond : setup.bonds.points.pairs) {
        if (bond.body_i != platen && bond.body_j != platen) continue;
        ++hold.bonds;
        const BodyIndex particle = bond.body_i == platen ? bond.body_j : bond.body_i;
        const std::vector<Vec2> places = element_positions(world, particle);
        const std::uint32_t first = world.bodies.info(particle).first_element;
        for (std::uint32_t e = 0; e < places.size(); ++e) {
            const double radius =
                setup.specimen.polygons ? 0.0 : element_of(BodyView(world), particle, first + e).radius;
            hold.from = std::min(hold.from, places[e].x - radius);
            hold.to = std::max(hold.to, places[e].x + radius);
        }
    }
    return hold;
}

/// Width of a part's face along x, m.
double face_width(const World& world, const SetupPart& part) {
    const std::vector<Vec2> corners = element_positions(world, part.body);
    const auto [least, most] =
        std::minmax_element(corners.begin(), corners.begin() + part.face, [](Vec2 a, Vec2 b) { return a.x < b.x; });
    return most->x - least->x;
}

/// Whether the specimen connects its parts through bonds or through open joints that touch under pressure.
bool connected(const World& world, const TestSetup& setup) {
    boost::disjoint_sets_with_storage<> pieces(world.bodies.size());
    for (const BodyPair& bond : setup.bonds.points.pairs) pieces.union_set(bond.body_i, bond.body_j);
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points.state[k].flags & point_closed) == 0) continue;
        pieces.union_set(world.points.contact.pairs[k].body_i, world.points.contact.pairs[k].body_j);
    }
    return std::ranges::all_of(setup.apparatus.parts, [&](const SetupPart& part) {
        return part.wall || pieces.find_set(part.body) == pieces.find_set(setup.apparatus.top);
    });
}

void check_part_hold(const World& world, const TestSetup& setup, const Places& places) {
    const TestKind& kind = test_kind(setup.apparatus.kind);
    for (const SetupPart& part : setup.apparatus.parts) {
        const double width = face_width(world, part);
        const BondedFace hold = hold_of(world, setup, part.body);
        if (hold.length() >= min_platen_hold * width) continue;
        const std::string found =
            hold.bonds == 0 ? "found no particle that reaches"
                            : fmt::format("found {} bonded points over {:.3g} m of", hold.bonds, hold.length());
        throw InputError(
            fmt::format("{}: {} the {}, {:.3g} m wide, expected bonds over half of this width; make this part wider or "
                        "the particles smaller, or {}",
                        places.at(CaseKey::loading_kind), found,
                        part.body == setup.apparatus.top ? kind.driver : kind.support, width,
                        setup.bonds.facts().by_faces ? "hold the specimen with loading.platens = \"frictional\""
                        : setup.bonds.facts().bonds_across_gaps
                            ? "let the bonds bridge a larger gap (bond.range, bond.gap)"
                            : fmt::format("use bond.law = {}, whose bonds can bridge gaps (bond.range, bond.gap)",
                                          laws_with(&BondLawFacts::bonds_across_gaps))));
    }
}

}  // namespace

void check_platen_hold(const World& world, const TestSetup& setup, const Platens& platens, const Places& places) {
    if (!setup.apparatus.uniaxial) check_part_hold(world, setup, places);
    for (const BodyIndex platen : {setup.apparatus.bottom, setup.apparatus.top}) {
        if (!setup.apparatus.uniaxial) break;
        const BondedFace hold = hold_of(world, setup, platen);
        if (hold.length() >= min_platen_hold * setup.specimen.width) continue;
        const bool lower = platen == setup.apparatus.bottom;
        throw InputError(
            fmt::format("{}: found {} bonded points over {:.3g} m of the {:.3g} m wide specimen at the {} platen (face "
                        "at y = {:.6g} m), expected them to reach over half of it; circles must overlap the domain's "
                        "face, polygons end flat half the meshing thickness inside it (mesh.boundary = \"domain\")",
                        places.at(CaseKey::bond_thick), hold.bonds, hold.length(), setup.specimen.width,
                        lower ? "lower" : "upper", lower ? platens.bottom_y : platens.top_y));
    }
    if (!connected(world, setup)) {
        throw InputError(fmt::format(
            "{}: found {} bonds, none of which join the lower and the upper platen, expected a specimen in one "
            "piece; {}",
            places.at(CaseKey::bond_thick), setup.bonds.points.size(),
            world.settings.joints.empty() ? "polygons bond where bond.thick is larger than the gap between them"
                                          : "an open joint across the specimen holds it together only if its faces "
                                            "touch, that is, without an aperture"));
    }
}

}  // namespace crackle
