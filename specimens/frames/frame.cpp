// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/frames/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "solver/faces/face_pass.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/world/point_order.hpp"
#include "solver/world/world.hpp"
#include "specimens/observers/curve.hpp"

namespace crackle {
namespace {

/// References to the members of a frame, which are in memory or on disk.
template <class Bodies, class Forces, class States>
struct Target {
    Target(Frame& to, Bodies& its_bodies, Forces& its_forces, States& its_states)
        : frame(to), bodies(its_bodies), shear_force(its_forces), states(its_states) {}

    Frame& frame;
    Bodies& bodies;
    Forces& shear_force;
    States& states;
};

template <class T, class Value>
void generate(std::vector<T>& values, std::size_t count, const Value& value) {
    values.resize(count);
    for (std::size_t k = 0; k < count; ++k) values[k] = value(k);
}
template <class T, class Value>
void generate(ScratchArray<T>& values, std::size_t count, const Value& value) {
    values.generate(count, value);
}

/// Stores the points that touch without a bond. Values of broken bonds go to the arrays of bonds, the others to
/// Frame::loose.
void take_loose(const BondRecord& bonds, const LooseContacts& loose, const auto& target) {
    Frame& frame = target.frame;
    frame.loose.contacts.clear();
    for (std::size_t kind = 0; kind < point_kinds; ++kind) {
        for (PointIndex k = loose.kind_begin[kind]; k < loose.kind_begin[kind + 1]; ++k) {
            const LooseContact& contact = loose.contacts[k];
            const PointIndex bond = bond_of(bonds, static_cast<PointKind>(kind), contact.point);
            if (bond == bonds.points.size()) {
                frame.loose.contacts.push_back(contact);
            } else {
                target.shear_force[bond] = contact.shear_force;
                target.states[bond] = ContactState::broken_touching;
                if (!std::isnan(contact.joint_force)) frame.joint_forces.push_back({bond, contact.joint_force});
            }
        }
        frame.loose.kind_begin[kind + 1] = static_cast<PointIndex>(frame.loose.contacts.size());
    }
    std::ranges::sort(frame.joint_forces, {}, &Frame::JointForce::bond);
}

/// Stores the forces of faces. The normal force of each face is stored too, because it depends on the pressure of cells
/// and cannot be computed from positions alone.
void take_faces(const World& world, const BondRecord& bonds, const auto& target) {
    const PointIndex first = bonds.kind_begin[static_cast<std::size_t>(PointKind::bonded_face)];
    for (PointIndex bond = first; bond < bonds.kind_begin.back(); ++bond) {
        const FaceIndex k = bonds.points[bond].element_i;
        const FaceForces force = forces_of_face(world.faces, k);
        const bool holds = world.faces.broken_at[k] == no_face;
        if (!holds && force.normal == 0.0) continue;
        target.shear_force[bond] = force.shear;
        target.states[bond] = holds ? ContactState::bonded : ContactState::broken_touching;
        target.frame.joint_forces.push_back({bond, -force.normal});
    }
}

constexpr std::array<const char*, 4> pictures{"particles_", "contacts_", "cracks_", "joints_"};

std::string picture(std::size_t which, std::int64_t row) { return fmt::format("{}{:05}.vtp", pictures[which], row); }

void take(const World& world, const BondRecord& bonds, const ContactHistory& history, const CurveRow& row,
          std::int64_t row_index, const auto& target) {
    Frame& frame = target.frame;
    frame.row = row_index;
    frame.axial_strain = row.axial_strain;
    frame.axial_stress = row.axial_stress;
    frame.time = row.time;
    frame.cracks = history.cracks.size();
    generate(target.bodies, world.bodies.size(), [&](std::size_t b) -> Frame::Body {
        const BodyState& body = world.bodies.state[b];
        return {body.x, body.y, body.angle, body.vx, body.vy, body.omega};
    });
    // Bonds never form again, so a bond that is missing from the list of points is broken.
    const ContactList& points = bonds.points;
    target.shear_force.assign(points.size(), 0.0);
    target.states.assign(points.size(), ContactState::broken);
    frame.joint_forces.clear();
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        const PointIndex first = bonds.kind_begin[static_cast<std::size_t>(K)];
        const PointIndex last = bonds.kind_begin[static_cast<std::size_t>(K) + 1];
        PointIndex next = first;
        for (PointIndex k = begin; k < end; ++k) {
            // Points of this kind are sorted in two parts; the second part begins at this index.
            if (k == world.points.fours_end) next = first;
            const ContactPoint point = world.points.contact.at<K>(k);
            const auto flags = world.points.state[k].flags;
            if ((flags & point_bonded) == 0) continue;
            while (next < last && !same_point(K, points.at<K>(next), point)) ++next;
            if (next == last)
                throw std::logic_error(
                    "a bonded point is missing in the list made when loading began, or out of order there");
            target.shear_force[next] = world.points.shear_force[k];
            target.states[next] = (flags & point_slid) != 0 ? ContactState::bonded_slid : ContactState::bonded;
            if constexpr (K == PointKind::face_face)
                frame.joint_forces.push_back(
                    {next, law_of(world, k).normal_stiffness *
                               (flat_face_contact(BodyView(world), point).overlap - world.points.bond_overlap[k])});
        }
    });
    take_faces(world, bonds, target);
    take_loose(bonds, history.loose, target);
}

}  // namespace

void take_frame(const World& world, const BondRecord& bonds, const ContactHistory& history, const CurveRow& row,
                std::int64_t row_index, Frame& frame) {
    take(world, bonds, history, row, row_index, Target{frame, frame.bodies, frame.shear_force, frame.states});
}

void take_frame(const World& world, const BondRecord& bonds, const ContactHistory& history, const CurveRow& row,
                std::int64_t row_index, FrameOnDisc& frame) {
    take(world, bonds, history, row, row_index, Target{frame.rest_, frame.bodies_, frame.shear_force_, frame.states_});
}

void FrameOnDisc::put(const Frame& frame) {
    rest_ = {frame.row, frame.axial_strain, frame.axial_stress, frame.time,        {}, {},
             {},        frame.loose,        frame.cracks,       frame.joint_forces};
    const auto copy = [](const auto& values, auto& to) {
        to.generate(values.size(), [&](std::size_t k) { return values[k]; });
    };
    copy(frame.bodies, bodies_);
    copy(frame.shear_force, shear_force_);
    copy(frame.states, states_);
}

Frame FrameOnDisc::whole() {
    Frame frame = rest_;
    frame.bodies = bodies_.values();
    frame.shear_force = shear_force_.values();
    frame.states = states_.values();
    return frame;
}

std::int64_t default_frames(std::int64_t bodies, std::int64_t curve_rows) {
    constexpr std::int64_t most = 100, fewest = 20, bodies_drawn = 200'000;
    const std::int64_t shared = bodies_drawn / std::max<std::int64_t>(1, bodies);
    return std::min(std::clamp(shared, fewest, most), curve_rows);
}

std::string particles_file(std::int64_t row) { return picture(0, row); }
std::string contacts_file(std::int64_t row) { return picture(1, row); }
std::string cracks_file(std::int64_t row) { return picture(2, row); }
std::string joints_file(std::int64_t row) { return picture(3, row); }

bool is_picture(const std::string& name) {
    return name.ends_with(".vtp") &&
           std::any_of(pictures.begin(), pictures.end(), [&](const char* begin) { return name.starts_with(begin); });
}

}  // namespace crackle
