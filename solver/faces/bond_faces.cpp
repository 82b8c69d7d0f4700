// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/faces/bond_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/faces/broken_face.hpp"
#include "solver/geometry/across_joint.hpp"

namespace crackle {
namespace {

bool is_rigid(const World& world, BodyIndex b) {
    const BodyInertia& inertia = world.bodies.inertia[b];
    return inertia.inverse_mass_x == 0.0 || inertia.inverse_mass_y == 0.0 || inertia.inverse_moment == 0.0;
}

Vec2 circumcentre(const std::vector<Vec2>& corners) {
    const Vec2 a = corners[1] - corners[0], b = corners[2] - corners[0];
    const double scale = 0.5 / cross(a, b), aa = dot(a, a), bb = dot(b, b);
    return corners[0] + scale * Vec2{b.y * aa - a.y * bb, a.x * bb - b.x * aa};
}

}  // namespace

FaceLaw weaker_law(const FaceLaw& a, const FaceLaw& b) {
    FaceLaw law;
    law.tensile_strength = std::min(a.tensile_strength, b.tensile_strength);
    law.cohesion = std::min(a.cohesion, b.cohesion);
    law.friction = std::min(a.friction, b.friction);
    law.knee = std::min(a.knee, b.knee);
    law.friction_beyond = std::min({a.friction_beyond, b.friction_beyond, law.friction});
    law.moment_share = std::max(a.moment_share, b.moment_share);
    law.residual_friction = std::min(a.residual_friction, b.residual_friction);
    law.residual_cohesion = std::min(a.residual_cohesion, b.residual_cohesion);
    law.softening_slip = std::min(a.softening_slip, b.softening_slip);
    law.residual_tensile_strength = std::min(a.residual_tensile_strength, b.residual_tensile_strength);
    law.softening_opening = std::min(a.softening_opening, b.softening_opening);
    law.damping_ratio = std::min(a.damping_ratio, b.damping_ratio);
    return law;
}

namespace {

/// Law of the faces on a joint. @param law law of the faces in the rock
FaceLaw law_across(FaceLaw law, const Joint& joint) {
    if (joint.friction_angle) law.friction = law.residual_friction = friction_coefficient(*joint.friction_angle);
    if (joint.residual_friction_angle)
        law.residual_friction = std::min(friction_coefficient(*joint.residual_friction_angle), law.friction);
    law.tensile_strength = joint.tensile_strength.value_or(joint.strength_factor * law.tensile_strength);
    law.cohesion = joint.cohesion.value_or(joint.strength_factor * law.cohesion);
    // The failure envelope of a joint is a straight line, without a knee.
    law.knee = std::numeric_limits<double>::infinity();
    law.residual_cohesion = joint.residual_cohesion.value_or(std::min(law.residual_cohesion, law.cohesion));
    law.softening_slip = joint.softening_slip.value_or(law.softening_slip);
    law.residual_tensile_strength = std::min(law.residual_tensile_strength, law.tensile_strength);
    return law;
}

/// Finds the faces of a world, and computes their springs, laws and initial states.
class Bonder {
  public:
    Bonder(const World& world, const FaceBonding& bonding)
        : world_(world),
          bonding_(bonding),
          outlines_(bonding.outlines.empty() ? outlines_before_inset(world, bonding.gap) : bonding.outlines),
          net_(find_faces(outlines_)) {
        if (net_.faces.empty())
            throw InputError(
                fmt::format("faces: found no edges of polygons that face each other, expected at least one pair; check "
                            "that the gap of the mesh is {:.6g} m",
                            bonding.gap));
        if (bonding.materials.size() != world.settings.materials.size())
            throw InputError(fmt::format("faces: found {} materials, expected {}, as in the scene",
                                         bonding.materials.size(), world.settings.materials.size()));
        if (!(bonding.least_distance_share > 0.0 && bonding.least_distance_share <= 1.0))
            throw InputError(
                fmt::format("faces: least distance between reference points, divided by the mean distance: found "
                            "{:.6g}, expected a number > 0 and <= 1",
                            bonding.least_distance_share));
        for (BodyIndex b = 0; b < world.bodies.size(); ++b) centres_.push_back(reference_of(b));
        least_distance_ = bonding.least_distance_share * mean_distance();
    }

    Faces bond() {
        const std::size_t materials = bonding_.materials.size();
        for (std::size_t b = 0; b < materials; ++b)
            for (std::size_t a = 0; a <= b; ++a)
                faces_.laws.push_back(weaker_law(bonding_.materials[a].law, bonding_.materials[b].law));
        for (const FacePair& pair : bonding_.pairs) faces_.laws[pair_number(pair.a, pair.b)] = pair.law;
        for (const FaceLaw& law : faces_.laws) check_face_law(law);
        for (const FaceMaterial& material : bonding_.materials) {
            FaceLaw platen;
            if (bonding_.platens == PlatenFaces::bonded) platen = material.law;
            if (bonding_.platens == PlatenFaces::rubbing) platen.residual_friction = bonding_.platen_friction;
            platen.damping_ratio = material.law.damping_ratio;
            faces_.laws.push_back(platen);
        }
        first_held_law_ = faces_.laws.size();
        for (std::size_t n = 0; n < first_held_law_; ++n) {
            FaceLaw held;
            held.damping_ratio = faces_.laws[n].damping_ratio;
            if (bonding_.holds) faces_.laws.push_back(held);
        }
        for (SharedFace face : net_.faces) {
            if (is_rigid(world_, face.i) && is_rigid(world_, face.j)) continue;
            add(face);
        }
        faces_.springs.assign(faces_.size());
        faces_.place.assign(faces_.size());
        for (FaceIndex k = 0; k < faces_.size(); ++k) {
            faces_.springs.set(k, springs_[k]);
            faces_.place.set(k, places_[k]);
        }
        set_pressures();
        list_faces();
        faces_.broken_at.assign(faces_.size(), no_face);
        for (FaceIndex k = 0; k < faces_.size(); ++k)
            if (starts_broken(k)) leave_broken(k);
        faces_.motion.assign(faces_.size());
        if (faces_.has_pressure) {
            faces_.dilation_i.assign(faces_.size(), 0.0);
            faces_.dilation_j.assign(faces_.size(), 0.0);
        }
        faces_.force.assign(faces_.size(), {});
        if (std::ranges::any_of(faces_.laws, [](const FaceLaw& law) { return law.damping_ratio > 0.0; })) {
            faces_.dashpots.assign(faces_.size());
            for (FaceIndex k = 0; k < faces_.size(); ++k) faces_.dashpots.set(k, dashpots_of(k));
            faces_.dashpot_force.assign(faces_.size());
        }
        set_lags();
        return std::move(faces_);
    }

    const FaceQuality& quality() const { return quality_; }

  private:
    const FaceModuli& moduli_of(BodyIndex b) const {
        return bonding_.materials[world_.bodies.names[b].material].moduli;
    }

    Vec2 reference_of(BodyIndex b) const {
        if (!bonding_.reference.empty() && !std::isnan(bonding_.reference[b].x)) return bonding_.reference[b];
        return outlines_[b].size() == 3 ? circumcentre(outlines_[b]) : net_.cells[b].centroid;
    }

    double mean_distance() const {
        double sum = 0.0;
        std::size_t count = 0;
        for (const SharedFace& face : net_.faces) {
            if (is_rigid(world_, face.i) || is_rigid(world_, face.j)) continue;
            sum += dot(centres_[face.j] - centres_[face.i], face.normal);
            ++count;
        }
        return count > 0 ? sum / static_cast<double>(count) : 0.0;
    }

    /// Reference point of a cell with respect to a free side, or to a face on a rigid body.
    Vec2 reference_at_side(BodyIndex b, Vec2 middle, Vec2 normal) {
        if (dot(middle - centres_[b], normal) > 0.5 * least_distance_) return centres_[b];
        ++quality_.by_centroid;
        return net_.cells[b].centroid;
    }

    FaceSprings springs_with_rigid(BodyIndex cell, Vec2 middle, Vec2 outwards, double length, bool cell_is_i) {
        const FaceModuli& moduli = moduli_of(cell);
        const double distance = dot(middle - reference_at_side(cell, middle, outwards), outwards);
        const double normal = moduli.contact * length / distance;
        return {normal,
                bonding_.platens != PlatenFaces::smooth ? moduli.shear_ratio * normal : 0.0,
                length,
                cell_is_i ? 1.0 : 0.0,
                cell_is_i ? 0.0 : 1.0,
                0.0,
                0.0};
    }

    FaceSprings springs_between(const SharedFace& face) {
        const FaceModuli &in_i = moduli_of(face.i), &in_j = moduli_of(face.j);
        const Vec2 to_i = face.middle - centres_[face.i], to_j = face.middle - centres_[face.j];
        const double a_i = dot(to_i, face.normal), a_j = -dot(to_j, face.normal), h = a_i + a_j;
        const Vec2 along = perpendicular(face.normal);
        const double soft_i = 1.0 / in_i.contact, soft_j = 1.0 / in_j.contact;
        double compliance = a_i * soft_i + a_j * soft_j;
        if (h < least_distance_) {
            ++quality_.raised;
            compliance = 0.5 * least_distance_ * (soft_i + soft_j);
        } else {
            quality_.largest_offset =
                std::max(quality_.largest_offset, std::abs(dot(to_i, along) - dot(to_j, along)) / h);
        }
        const double ratio = (soft_i + soft_j) / (soft_i / in_i.shear_ratio + soft_j / in_j.shear_ratio);
        const double normal = face.length / compliance;
        return {normal,
                ratio * normal,
                face.length,
                a_i * soft_i / compliance,
                a_j * soft_j / compliance,
                dot(to_i, along) * soft_i / compliance,
                dot(to_j, along) * soft_j / compliance};
    }

    void add(const SharedFace& face) {
        const bool rigid_i = is_rigid(world_, face.i), rigid_j = is_rigid(world_, face.j);
        const auto material = [&](BodyIndex b) -> std::size_t { return world_.bodies.names[b].material; };
        faces_.bodies.push_back({face.i, face.j});
        springs_.push_back(rigid_j   ? springs_with_rigid(face.i, face.middle, face.normal, face.length, true)
                           : rigid_i ? springs_with_rigid(face.j, face.middle, -1.0 * face.normal, face.length, false)
                                     : springs_between(face));
        std::size_t law = rigid_i || rigid_j ? world_.settings.pair_count() + material(rigid_i ? face.j : face.i)
                                             : pair_number(material(face.i), material(face.j));
        if (bonding_.holds && bonding_.holds(face.middle, face.i, face.j)) law += first_held_law_;
        faces_.law.push_back(static_cast<std::uint16_t>(law));
        faces_.strength_share.push_back(
            bonding_.factors.between(world_.bodies.names[face.i].id, world_.bodies.names[face.j].id));
        const BodyState &i = world_.bodies.state[face.i], &j = world_.bodies.state[face.j];
        // Rotates a vector into a body's frame.
        const auto in_frame = [](const BodyState& body, Vec2 v) {
            return Vec2{body.shape[0] * v.x + body.shape[1] * v.y, body.shape[0] * v.y - body.shape[1] * v.x};
        };
        double aperture = 0.0;
        const std::int32_t number = rigid_i || rigid_j || world_.settings.joints.empty()
                                        ? no_joint
                                        : joint_of_face(world_, face.i, face.j, bonding_.gap);
        parted_.push_back(false);
        if (number != no_joint) {
            const Joint& joint = world_.settings.joints[static_cast<std::size_t>(number)];
            if (law < first_held_law_) faces_.law.back() = law_of_joint(number, law);
            soften(springs_.back(), joint, face);
            parted_.back() = !joint.bonded;
            aperture = joint.aperture;
        }
        places_.push_back({in_frame(i, face.normal), in_frame(j, face.normal),
                           in_frame(i, face.middle - Vec2{i.x, i.y}),
                           in_frame(j, face.middle + aperture * face.normal - Vec2{j.x, j.y}), j.angle - i.angle});
    }

    /// Index of the law of the faces on a joint. @param law index of the law of the faces in the rock
    std::uint16_t law_of_joint(std::int32_t number, std::size_t law) {
        const auto [entry, is_new] = joint_laws_.try_emplace({number, law}, faces_.laws.size());
        if (is_new) {
            faces_.laws.push_back(
                law_across(faces_.laws[law], world_.settings.joints[static_cast<std::size_t>(number)]));
            check_face_law(faces_.laws.back());
        }
        return static_cast<std::uint16_t>(entry->second);
    }

    /// Adds the springs of a joint in series with the springs of a face.
    void soften(FaceSprings& springs, const Joint& joint, const SharedFace& face) {
        const auto left = [&](double own, const std::optional<double>& per_length) {
            return per_length && own > 0.0 ? 1.0 / (1.0 + own / (*per_length * springs.length)) : 1.0;
        };
        const double normal = left(springs.normal, joint.normal_stiffness),
                     shear = left(springs.shear, joint.shear_stiffness);
        // Under the pressure of its cells, a joint opens or closes in the same way as a free side moves.
        const double yields = (1.0 - normal) * springs.length * springs.length / springs.normal;
        in_joint_.resize(world_.bodies.size(), 0.0);
        in_joint_[face.i] += springs.share_i * springs.share_i * yields;
        in_joint_[face.j] += springs.share_j * springs.share_j * yields;
        springs.share_i *= normal, springs.share_j *= normal;
        springs.skew_i *= shear, springs.skew_j *= shear;
        springs.normal *= normal, springs.shear *= shear;
    }

    void set_pressures() {
        std::vector<double> side = in_joint_;  // Σ L h_b/E_c
        side.resize(world_.bodies.size(), 0.0);
        for (const FreeSide& free : net_.sides) {
            if (is_rigid(world_, free.body)) continue;
            const Vec2 from = reference_at_side(free.body, free.middle, free.normal);
            side[free.body] += free.length * dot(free.middle - from, free.normal) / moduli_of(free.body).contact;
        }
        faces_.cells.resize(world_.bodies.size());
        for (BodyIndex b = 0; b < world_.bodies.size(); ++b) {
            const double modulus = moduli_of(b).pressure;
            if (is_rigid(world_, b) || modulus == 0.0 || net_.cells[b].area == 0.0) continue;
            faces_.cells[b].per_area = modulus / (net_.cells[b].area + modulus * side[b]);
            faces_.has_pressure = true;
        }
    }

    void list_faces() {
        faces_.first_face.assign(world_.bodies.size() + 1, 0);
        for (const BodyPair& pair : faces_.bodies) {
            ++faces_.first_face[pair.body_i + 1];
            ++faces_.first_face[pair.body_j + 1];
        }
        for (std::size_t b = 1; b < faces_.first_face.size(); ++b) faces_.first_face[b] += faces_.first_face[b - 1];
        faces_.face_ends.resize(2 * faces_.size());
        std::vector<std::uint32_t> next(faces_.first_face.begin(), faces_.first_face.end() - 1);
        for (FaceIndex k = 0; k < faces_.size(); ++k) {
            faces_.face_ends[next[faces_.bodies[k].body_i]++] = 2 * k;
            faces_.face_ends[next[faces_.bodies[k].body_j]++] = 2 * k + 1;
        }
    }

    FaceDashpots dashpots_of(FaceIndex k) const {
        const double twice_ratio = 2.0 * faces_.law_of(k).damping_ratio;
        // The inverse of the effective mass is 1/m_i + 1/m_j; a rigid body contributes 0.
        const auto inverse = [&](BodyIndex b, bool of_moment) {
            const BodyInertia& inertia = world_.bodies.inertia[b];
            return is_rigid(world_, b) ? 0.0 : of_moment ? inertia.inverse_moment : inertia.inverse_mass_x;
        };
        const BodyPair& pair = faces_.bodies[k];
        const double mass = inverse(pair.body_i, false) + inverse(pair.body_j, false);
        const double moment = inverse(pair.body_i, true) + inverse(pair.body_j, true);
        const FaceSprings& springs = faces_.springs[k];
        return {twice_ratio * std::sqrt(springs.normal / mass), twice_ratio * std::sqrt(springs.shear / mass),
                twice_ratio * std::sqrt(springs.moment() / moment)};
    }

    bool starts_broken(FaceIndex k) const {
        const auto& [i, j] = faces_.bodies[k];
        if (parted_[k] || (bonding_.leaves && bonding_.leaves(i, j))) return true;
        return bonding_.platens == PlatenFaces::rubbing && (is_rigid(world_, i) || is_rigid(world_, j));
    }

    void leave_broken(FaceIndex k) {
        BrokenFace face;
        face.face = k;
        face.closed_joint = bonding_.pressed && parted_[k];
        face.last.half_lap = 0.5 * faces_.springs[k].length;
        faces_.broken_at[k] = static_cast<FaceIndex>(faces_.broken.size());
        faces_.broken.push_back(face);
    }

    void set_lags() {
        for (FaceIndex k = 0; k < faces_.size(); ++k) {
            const LagWeights w(faces_.springs[k]);
            faces_.cells[faces_.bodies[k].body_i].lag_weight += w.normal_i + w.shear_i;
            faces_.cells[faces_.bodies[k].body_j].lag_weight += w.normal_j + w.shear_j;
        }
        for (FaceIndex k = 0; k < faces_.size(); ++k) {
            const FaceLag lag = lag_of(faces_, k);
            quality_.slowest_lag = std::min({quality_.slowest_lag, lag.pressure, lag.slip});
        }
    }

    const World& world_;
    const FaceBonding& bonding_;
    Outlines outlines_;
    FaceNet net_;
    std::vector<Vec2> centres_;
    double least_distance_ = 0.0;
    // Index of the first law for faces that never break; there is one such law for each earlier law.
    std::size_t first_held_law_ = 0;
    std::vector<FaceSprings> springs_;
    std::vector<FacePlace> places_;
    std::vector<bool> parted_;  // for each face: whether it lies on an open joint
    // For each cell, m²/Pa: change of area in its joints per unit of pressure; empty without joints.
    std::vector<double> in_joint_;
    std::map<std::pair<std::int32_t, std::size_t>, std::size_t> joint_laws_;
    Faces faces_;
    FaceQuality quality_;
};

}  // namespace

Faces bond_faces(const World& world, const FaceBonding& bonding, FaceQuality* quality) {
    Bonder bonder(world, bonding);
    Faces faces = bonder.bond();
    if (quality != nullptr) *quality = bonder.quality();
    return faces;
}

}  // namespace crackle
