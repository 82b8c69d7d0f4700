// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/setup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "solver/base/correctly_rounded.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/world/point_order.hpp"

namespace crackle {
namespace {

double mean_x(const World& world, const std::vector<BodyIndex>& bodies) {
    double sum = 0.0;
    for (const BodyIndex b : bodies) sum += world.bodies.state[b].x;
    return sum / static_cast<double>(bodies.size());
}

void note_start_of_driver(TestSetup& setup, const World& world) {
    const BodyState& driver = world.bodies.state[setup.top];
    setup.top_start = setup.axis == 1 ? driver.y : driver.x;
    setup.top_height = driver.y;
}

/// Side particles with centres in the middle half of the height, away from the platens. For kinds of test that define
/// regions, all particles in them.
std::vector<BodyIndex> gauge(const World& world, const std::vector<int>& ids, const Domain& domain, bool uniaxial) {
    std::unordered_map<int, BodyIndex> index;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) index[world.bodies.info(b).id] = static_cast<BodyIndex>(b);
    const double middle = 0.5 * (domain.y1 + domain.y2);
    const double quarter = 0.25 * (domain.y2 - domain.y1);
    std::vector<BodyIndex> bodies;
    for (const int id : ids) {
        const BodyIndex b = index.at(id);
        if (!uniaxial || std::abs(world.bodies.state[b].y - middle) <= quarter) bodies.push_back(b);
    }
    return bodies;
}

double mean_y(const World& world, const std::vector<BodyIndex>& bodies) {
    double sum = 0.0;
    for (const BodyIndex b : bodies) sum += world.bodies.state[b].y;
    return sum / static_cast<double>(bodies.size());
}

// Fraction of the height left out of the axial gauge length at each end if there are no grips.
constexpr double outer_share = 0.1;

/// Finds the particles with centres within half a mean particle size of the gauge's ends.
void find_axial_gauge(TestSetup& setup, const World& world, double outer) {
    const double size = std::sqrt(setup.width * setup.height / static_cast<double>(setup.particles));
    const double bottom = setup.low_end + outer * setup.height, top = setup.low_end + (1.0 - outer) * setup.height;
    std::vector<bool> carries(world.bodies.size(), false);  // unbonded bodies move independently and are excluded
    for (const BodyPair& bond : setup.bonds.pairs) carries[bond.body_i] = carries[bond.body_j] = true;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        if (setup.is_platen(b) || !carries[b]) continue;
        if (std::abs(world.bodies.state[b].y - bottom) <= 0.5 * size) setup.gauge_bottom.push_back(b);
        if (std::abs(world.bodies.state[b].y - top) <= 0.5 * size) setup.gauge_top.push_back(b);
    }
    if (setup.gauge_bottom.empty() || setup.gauge_top.empty()) return;
    setup.gauge_height = mean_y(world, setup.gauge_top) - mean_y(world, setup.gauge_bottom);
}

void record_bonds(TestSetup& setup, const World& world) {
    double overlap = 0.0, tension = 0.0, tensile = 0.0, cohesion = 0.0;
    setup.bonds.pairs.reserve(static_cast<std::size_t>(world.bonds.initial));
    setup.bond_overlaps.reserve(static_cast<std::size_t>(world.bonds.initial));
    const bool own_shares = !world.points.stiffness_share.empty();
    struct BondOfKind {
        ContactPoint point;
        double overlap;
        float share;
    };
    std::vector<BondOfKind> of_kind;
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        of_kind.clear();
        for (PointIndex k = begin; k < end; ++k) {
            const ContactPoint point = world.points.contact[k];
            const PointState& state = world.points.state[k];
            if ((state.flags & point_touching) != 0) ++setup.contacts_initial;
            if ((state.flags & point_bonded) == 0) continue;
            const ContactLaw law = law_of(world, k);
            const double bond_overlap = world.points.bond_overlap[k];
            of_kind.push_back(
                {point, bond_overlap, own_shares ? static_cast<float>(share_of_stiffness(world, k)) : 1.0F});
            if (setup.bond_facts().strengths_are_given && (state.flags & point_held) == 0) {
                tensile += law.tensile_strength;
                cohesion += law.cohesion;
            }
            const double back_tension = law.normal_stiffness * bond_overlap;
            overlap += world.points.bond_overlap[k];
            tension += back_tension;
        }
        std::ranges::sort(of_kind, {}, [](const BondOfKind& one) { return key_of(K, one.point); });
        for (const BondOfKind& one : of_kind) {
            setup.bonds.push_back(K, one.point);
            setup.bond_overlaps.push_back(one.overlap);
            if (own_shares) setup.bond_shares.push_back(one.share);
        }
        setup.bond_kind_begin[static_cast<std::size_t>(K) + 1] = static_cast<PointIndex>(setup.bonds.size());
    });
    if (setup.bonds.empty()) return;
    setup.mean_bond_overlap = overlap / static_cast<double>(setup.bonds.size());
    setup.mean_back_tension = tension / static_cast<double>(setup.bonds.size());
    setup.mean_back_tension_interface = tension / static_cast<double>(world.bonds.interfaces_initial);
    const auto breakable = static_cast<double>(world.bonds.initial - world.bonds.held);
    if (setup.bond_facts().strengths_are_given && breakable > 0.0) {
        setup.mean_tensile_strength = tensile / breakable;
        setup.mean_cohesion = cohesion / breakable;
    }
}

}  // namespace

BodyState placed_body(const World& world, const TestSetup& setup, BodyIndex b, double x, double y, double angle) {
    BodyState body{x, y, 0.0, 0.0, 0.0, {0.0, 0.0}, angle};
    if (world.bodies.info(b).single_circle) {
        body.shape[0] = world.bodies.state[b].shape[0];  // the radius, which never changes
        return body;
    }
    const double turn = angle - setup.start[b].angle;
    body.shape[0] = correctly_rounded::cos(turn);
    body.shape[1] = correctly_rounded::sin(turn);
    return body;
}

double TestSetup::axial_strain(const World& world) const {
    const double now = axis == 1 ? world.bodies.state[top].y : world.bodies.state[top].x;
    return (compression ? top_start - now : now - top_start) / length;  // avoids -0 at the start
}

double TestSetup::lateral_strain(const World& world) const {
    if (axis == 0) return (world.bodies.state[top].y - top_height) / height;
    if (gauge_length == 0.0) return std::numeric_limits<double>::quiet_NaN();
    return (mean_x(world, right) - mean_x(world, left)) / gauge_length - 1.0;
}

double TestSetup::median_lateral_strain(const World& world) const {
    const auto moved = [&](const std::vector<BodyIndex>& side) {
        std::vector<double> ways;
        ways.reserve(side.size());
        for (const BodyIndex b : side) ways.push_back(world.bodies.state[b].x - start[b].x);
        const auto half = ways.begin() + std::ssize(ways) / 2;
        std::ranges::nth_element(ways, half);
        return *half;
    };
    if (gauge_length == 0.0) return std::numeric_limits<double>::quiet_NaN();
    return (moved(right) - moved(left)) / gauge_length;
}

double TestSetup::gauge_strain(const World& world) const {
    if (gauge_height == 0.0) return std::numeric_limits<double>::quiet_NaN();
    const double growth = (mean_y(world, gauge_top) - mean_y(world, gauge_bottom)) / gauge_height - 1.0;
    return compression ? 0.0 - growth : growth;  // avoids -0 at the start
}

PartForces forces_on_parts(const World& world, const TestSetup& setup) {
    const auto on = [&](BodyIndex part) {
        const BodyForce& force = world.bodies.force[part];
        return setup.axis == 1 ? force.fy : force.fx;
    };
    PartForces forces;
    for (const SetupPart& part : setup.parts) {
        if (part.wall) continue;
        (part.body == setup.top ? forces.driver : forces.supports) += on(part.body);
    }
    return forces;
}

TestSetup record_setup(const World& world, const Specimen& specimen, const Platens& platens, LoadingKind kind,
                       double grip) {
    TestSetup setup;
    setup.kind = kind;
    setup.uniaxial = test_kind(kind).uniaxial;
    setup.axis = platens.apparatus.axis;
    setup.section = platens.apparatus.section;
    setup.length = platens.apparatus.length;
    setup.stress_intensity = platens.apparatus.stress_intensity;
    setup.normal_force = platens.apparatus.normal_force;
    setup.normal_spring = platens.apparatus.normal_spring;
    setup.area = specimen.area;
    setup.middle = 0.5 * (world.settings.domain.x1 + world.settings.domain.x2);
    setup.middle_height = 0.5 * (world.settings.domain.y1 + world.settings.domain.y2);
    setup.span = platens.apparatus.span;
    if (specimen.shape.notch) setup.notch = specimen.shape.notch->tip.y - world.settings.domain.y1;
    setup.grip = grip * specimen.height;
    setup.low_end = world.settings.domain.y1;
    setup.compression = test_kind(kind).compression;
    setup.specimen = specimen.kind;
    setup.polygons = specimen.polygons;
    setup.width = specimen.width;
    setup.height = specimen.height;
    setup.bond_thick = world.settings.thick;
    setup.mesh_gap = specimen.mesh_gap;
    setup.bottom_id = platens.bottom_id;
    setup.top_id = platens.top_id;
    setup.bottom = body_of_id(world, platens.bottom_id);
    setup.top = body_of_id(world, platens.top_id);
    for (int id = platens.bottom_id; id <= platens.top_id; ++id) {
        const auto number = static_cast<std::size_t>(id - platens.bottom_id);
        const auto& parts = platens.apparatus.parts;
        const bool wall = platens.walls && id != platens.bottom_id && id != platens.top_id;
        setup.parts.push_back({body_of_id(world, id), parts.empty() ? 2 : parts[number].face, wall});
    }
    note_start_of_driver(setup, world);
    setup.particles = static_cast<std::int64_t>(specimen.scene.bodies.size());
    setup.segments = specimen.segments;
    setup.centres = specimen.centres;
    setup.stable_time_step = world.stepping.exact_step;
    setup.stable_time_step_proved =
        world.stepping.exact_step_proved && world.settings.segment_law == SegmentLaw::rounded;
    setup.time_step_bound = world.stepping.step_bound;
    setup.bond_law = world.settings.bond_law;
    setup.notices = specimen.notices;
    setup.packing = specimen.packing;
    setup.minerals = specimen.minerals;
    setup.traces = specimen.traces;
    setup.start.reserve(world.bodies.size());
    for (const BodyState& body : world.bodies.state) setup.start.push_back({body.x, body.y, body.angle});
    setup.left = gauge(world, specimen.left_ids, world.settings.domain, setup.uniaxial);
    setup.right = gauge(world, specimen.right_ids, world.settings.domain, setup.uniaxial);
    if (!setup.uniaxial && specimen.left_ids.empty() && specimen.right_ids.empty()) {
        // no lateral strain is defined
    } else if (setup.left.empty() || setup.right.empty()) {
        setup.notices.push_back("no particles at both side faces in the middle half of the height: no lateral strain");
    } else {
        setup.gauge_length = mean_x(world, setup.right) - mean_x(world, setup.left);
    }
    record_bonds(setup, world);
    if (!setup.traces.empty()) {
        setup.trace_faces = find_trace_faces(world);
        setup.bond_faces = faces_of_bonds(setup.trace_faces, setup.bonds);
    }
    if (setup.uniaxial) find_axial_gauge(setup, world, grip > 0.0 ? grip : outer_share);
    return setup;
}

void strains_begin_at(TestSetup& setup, const World& world) {
    note_start_of_driver(setup, world);
    if (setup.gauge_length > 0.0) setup.gauge_length = mean_x(world, setup.right) - mean_x(world, setup.left);
    if (setup.gauge_height > 0.0)
        setup.gauge_height = mean_y(world, setup.gauge_top) - mean_y(world, setup.gauge_bottom);
}

}  // namespace crackle
