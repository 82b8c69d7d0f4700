// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/setup.hpp"

#include <cmath>

namespace crackle {
namespace {

TestedSpecimen tested(const Specimen& specimen, const Domain& domain) {
    TestedSpecimen tested;
    tested.kind = specimen.kind;
    tested.polygons = specimen.polygons;
    tested.width = specimen.width;
    tested.height = specimen.height;
    tested.area = specimen.area;
    tested.middle = 0.5 * (domain.x1 + domain.x2);
    tested.middle_height = 0.5 * (domain.y1 + domain.y2);
    tested.low_end = domain.y1;
    if (specimen.shape.notch) tested.notch = specimen.shape.notch->tip.y - domain.y1;
    tested.mesh_gap = specimen.mesh_gap;
    tested.particles = static_cast<std::int64_t>(specimen.scene.bodies.size());
    return tested;
}

// Fraction of the height left out of the axial gauge length at each end if there are no grips.
constexpr double outer_share = 0.1;

void find_axial_gauge(TestSetup& setup, const World& world, double outer) {
    const TestedSpecimen& s = setup.specimen;
    std::vector<bool> carries(world.bodies.size(), false);  // unbonded bodies move independently and are excluded
    for (const BodyPair& bond : setup.bonds.points.pairs) carries[bond.body_i] = carries[bond.body_j] = true;
    std::vector<BodyIndex> bodies;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b)
        if (carries[b] && !setup.apparatus.is_platen(b)) bodies.push_back(b);
    setup.gauges.find_ends(world, bodies, s.low_end + outer * s.height, s.low_end + (1.0 - outer) * s.height,
                           std::sqrt(s.width * s.height / static_cast<double>(s.particles)));
}

}  // namespace

double TestSetup::lateral_strain(const World& world) const {
    if (apparatus.axis == 0) return (world.bodies.state[apparatus.top].y - apparatus.top_height) / specimen.height;
    return gauges.lateral_strain(world);
}

double TestSetup::gauge_strain(const World& world) const {
    const double growth = gauges.axial_growth(world);
    return apparatus.compression ? 0.0 - growth : growth;  // avoids -0 at the start
}

TestSetup record_setup(const World& world, const Specimen& specimen, const Platens& platens, LoadingKind kind,
                       double grip) {
    TestSetup setup;
    setup.specimen = tested(specimen, world.settings.domain);
    setup.apparatus = place_apparatus(world, platens, kind);
    setup.bonds = record_bonds(world, specimen.traces, grip * specimen.height);
    setup.origin = {specimen.segments, specimen.centres, specimen.notices, specimen.packing, specimen.minerals};
    setup.stable_time_step = world.stepping.exact_step;
    setup.stable_time_step_proved =
        world.stepping.exact_step_proved && world.settings.segment_law == SegmentLaw::rounded;
    setup.time_step_bound = world.stepping.step_bound;
    const bool uniaxial = setup.apparatus.uniaxial;
    setup.gauges.find_sides(world, specimen, uniaxial);
    const bool has_sides = uniaxial || !specimen.left_ids.empty() || !specimen.right_ids.empty();
    if (has_sides && (setup.gauges.left.empty() || setup.gauges.right.empty()))
        setup.origin.notices.push_back(
            "the lateral strain is not measured, because one or both side faces have no particles in the middle half "
            "of the height");
    if (uniaxial) find_axial_gauge(setup, world, grip > 0.0 ? grip : outer_share);
    return setup;
}

void strains_begin_at(TestSetup& setup, const World& world) {
    setup.apparatus.strains_begin_at(world);
    setup.gauges.strains_begin_at(world);
}

}  // namespace crackle
