// SPDX-License-Identifier: GPL-3.0-or-later
// Complete state of a world as bytes, through cereal's binary archive. What a restart needs is all here, the neighbour
// list and the remembered facing edges included, so that a restarted run does the very same arithmetic.

#include <fmt/format.h>

#include <xxhash.h>
#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/vector.hpp>

#include <cstring>
#include <memory>
#include <sstream>

#include "solver/base/errors.hpp"
#include "solver/base/watching_buffer.hpp"
#include "solver/world/world.hpp"

namespace crackle {

// Raise when the fields below change.
constexpr std::uint32_t checkpoint_version = 15;
constexpr std::uint64_t checkpoint_magic = 0x454c4b4341524321ULL;  // "!CRACKLE"

// NOLINTBEGIN(bugprone-macro-parentheses)
template <class Archive>
void serialize(Archive& a, Vec2& v) {
    a(v.x, v.y);
}
template <class Archive>
void serialize(Archive& a, Material& m) {
    a(m.density, m.normal_stiffness, m.shear_stiffness, m.normal_damping, m.shear_damping, m.damping_ratio,
      m.friction_angle);
}
template <class Archive>
void serialize(Archive& a, Domain& d) {
    a(d.x1, d.x2, d.y1, d.y2, d.wall_present);
}
template <class Archive>
void serialize(Archive& a, IntactOptions& o) {
    a(o.no_breaking, o.no_sliding, o.no_new_contacts);
}
template <class Archive>
void serialize(Archive& a, DofControl& c) {
    a(c.drive, c.value);
}
template <class Archive>
void serialize(Archive& a, BodyState& b) {
    a(b.x, b.y, b.vx, b.vy, b.omega, b.shape, b.angle);
}
template <class Archive>
void serialize(Archive& a, BodyInertia& i) {
    a(i.inverse_mass_x, i.inverse_mass_y, i.inverse_moment, i.mass);
}
template <class Archive>
void serialize(Archive& a, BodyForce& f) {
    a(f.fx, f.fy, f.torque);
}
template <class Archive>
void serialize(Archive& a, BodyInfo& i) {
    a(i.id, i.material, i.moment, i.reach, i.first_element, i.element_count, i.first_piece, i.piece_count,
      i.single_circle, i.closed);
}
template <class Archive>
void serialize(Archive& a, Element& e) {
    a(e.x, e.y, e.radius, e.target_reach);
}
template <class Archive>
void serialize(Archive& a, Piece& p) {
    a(p.first_edge, p.edge_count, p.closed);
}
template <class Archive>
void serialize(Archive& a, Edge& e) {
    a(e.x, e.y, e.tx, e.ty, e.length, e.cone, e.outline_of);
}
template <class Archive>
void serialize(Archive& a, ControlState& c) {
    a(c.body, c.dof, c.start, c.first_step, c.ramp_steps, c.last_force, c.last_move);
}
template <class Archive>
void serialize(Archive& a, ContactLaw& l) {
    a(l.normal_stiffness, l.shear_stiffness, l.normal_damping, l.shear_damping, l.normal_damping_ratio_term,
      l.shear_damping_ratio_term, l.friction, l.break_overlap);
}
template <class Archive>
void serialize(Archive& a, ContactPoint& p) {
    a(p.body_i, p.body_j, p.element_i, p.feature_j);
}
template <class Archive>
void serialize(Archive& a, PointState& s) {
    a(s.law, s.flags);
}
template <class Archive>
void serialize(Archive& a, PointForce& f) {
    a(f.fx, f.fy, f.torque_i, f.torque_j);
}
template <class Archive>
void serialize(Archive& a, SpringWork& w) {
    a(w.last, w.stored);
}
template <class Archive>
void serialize(Archive& a, OpeningMemory& m) {
    a(m.defect, m.extra_force, m.overlap, m.force);
}
template <class Archive>
void serialize(Archive& a, ListReference& r) {
    a(r.x, r.y, r.angle);
}
template <class Archive>
void serialize(Archive& a, World::LossBlock& b) {
    a(b.dashpot, b.friction, b.law, b.broken, b.gained);
}
template <class Archive>
void serialize(Archive& a, BreakEvent& e) {
    a(e.step, e.time, e.body_i, e.body_j, e.position, e.orientation, e.energy, e.strength, e.normal_force,
      e.shear_force, e.slid, e.shear_mode, e.last_of_interface, e.kind, e.point);
}
template <class Archive>
void serialize(Archive& a, World& w) {
    a(w.bodies, w.inertia, w.forces, w.forces_clear, w.info, w.elements, w.pieces, w.edges, w.convex_outlines,
      w.segments, w.controls, w.laws, w.materials);
    a(w.points, w.point_states, w.shear_forces, w.bond_overlaps, w.root_masses, w.kind_begin, w.fours_end,
      w.point_forces, w.keep_point_forces, w.normal_dashpot, w.shear_dashpot, w.spring_work, w.openings, w.owed,
      w.strong_normal, w.strong_shear);
    a(w.skin, w.widest_skin, w.half_skins, w.list_reference, w.turning_reach, w.some_turn, w.size_rank,
      w.largest_smaller, w.travelled, w.free_way, w.fastest, w.fastest_allowed_move, w.list_valid, w.list_step,
      w.list_builds);
    a(w.domain, w.thick, w.segment_law, w.integrator, w.gravity, w.time_step, w.drift, w.automatic_step, w.step_scale,
      w.safety_factor, w.step_bound, w.limiting_body, w.step_weights, w.weighed_bound, w.weighed_points, w.exact_step,
      w.exact_step_proved, w.step_goal, w.allow_unstable, w.has_bonds, w.ledger_on, w.intact);
    a(w.step, w.time, w.forces_current, w.kick_share, w.events, w.bonds_initial, w.bonds_broken, w.interfaces_initial,
      w.interfaces_lost);
    a(w.loss_blocks, w.points_gained, w.dashpot_loss, w.friction_loss, w.fracture_loss, w.law_loss, w.displacement_work,
      w.force_work, w.initial_energy, w.initial_energy_taken, w.largest_supply);
}
// NOLINTEND(bugprone-macro-parentheses)

void save_world(const World& world, std::ostream& out) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(), &XXH3_freeState);
    XXH3_64bits_reset(hash.get());
    WatchingBuffer buffer(out,
                          [&](std::string_view piece) { XXH3_64bits_update(hash.get(), piece.data(), piece.size()); });
    std::ostream watched(&buffer);
    cereal::BinaryOutputArchive{watched}(checkpoint_magic, checkpoint_version, world);
    watched.flush();
    if (!watched) out.setstate(std::ios::badbit);
    cereal::BinaryOutputArchive{out}(XXH3_64bits_digest(hash.get()));
}

std::string save_world(const World& world) {
    std::ostringstream out(std::ios::binary);
    save_world(world, out);
    return std::move(out).str();
}

World load_world(const std::string& bytes, const std::string& name) {
    constexpr std::size_t head = sizeof checkpoint_magic + sizeof checkpoint_version, tail = sizeof(XXH64_hash_t);
    std::uint64_t magic = 0;
    std::uint32_t version = 0;
    if (bytes.size() < head + tail)
        throw InputError(fmt::format("{}: found {} bytes, expected a crackle checkpoint", name, bytes.size()));
    std::istringstream in(bytes, std::ios::binary);
    cereal::BinaryInputArchive archive(in);
    archive(magic, version);
    if (magic != checkpoint_magic)
        throw InputError(fmt::format("{}: found other data, expected a crackle checkpoint", name));
    if (version != checkpoint_version) {
        throw InputError(
            fmt::format("{}: found checkpoint version {}, expected {}; run the test again with this crackle", name,
                        version, checkpoint_version));
    }
    // Judged before a single length in it is believed.
    XXH64_hash_t hash = 0;
    std::memcpy(&hash, bytes.data() + bytes.size() - tail, tail);
    if (XXH3_64bits(bytes.data(), bytes.size() - tail) != hash)
        throw InputError(fmt::format("{}: found a truncated or damaged checkpoint, expected a complete one", name));
    World world;
    archive(world);
    world.threads = 1;
    world.marks.resize(world.bodies.size());
    world.thread_blocks.assign(1, 0);
    return world;
}

void set_threads(World& world, int threads) {
    if (threads < 1 || threads > 1024) throw InputError(fmt::format("threads: found {}, expected 1 to 1024", threads));
    world.threads = threads;
    world.thread_blocks.assign(static_cast<std::size_t>(threads), 0);
    world.sweep.valid = false;
}

}  // namespace crackle
