// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>

#include "solver/base/errors.hpp"
#include "solver/base/watching_buffer.hpp"
#include "specimens/results/sha256.hpp"

namespace crackle {

// Names the layout; the number is raised whenever a field below changes.
constexpr const char* checkpoint_title = "crackle test checkpoint ";
constexpr const char* checkpoint_version = "10";
constexpr std::size_t hash_digits = 64;

// The archive is given one member after the other: structs have padding, whose bytes are nobody's.
template <class Archive>
void serialize(Archive& a, Vec2& v) {
    a(v.x, v.y);
}
template <class Archive>
void serialize(Archive& a, CurveRow& r) {
    a(r.axial_strain, r.axial_stress, r.stress_top, r.stress_bottom, r.lateral_strain, r.bonds_broken, r.kinetic_energy,
      r.strain_energy, r.time, r.step, r.interfaces_lost, r.points_sliding, r.dashpot_loss, r.friction_loss,
      r.fracture_loss, r.platen_work, r.energy_error, r.contacts_gained);
}
template <class Archive>
void serialize(Archive& a, FailureTracker& f) {
    a(f.share_of_peak, f.peak_stress, f.peak_strain, f.peak_row, f.below_since, f.below_row, f.failed);
}
template <class Archive>
void serialize(Archive& a, Frame::Body& b) {
    a(b.x, b.y, b.angle, b.vx, b.vy, b.omega);
}
template <class Archive>
void serialize(Archive& a, ContactPoint& p) {
    a(p.body_i, p.body_j, p.element_i, p.feature_j);
}
template <class Archive>
void serialize(Archive& a, LooseContact& c) {
    a(c.point, c.shear_force, c.since);
}
template <class Archive>
void serialize(Archive& a, LooseContacts& c) {
    a(c.contacts, c.kind_begin);
}
template <class Archive>
void serialize(Archive& a, Crack& c) {
    a(c.time, c.energy, c.orientation, c.bond, c.shear_mode);
}
template <class Archive>
void serialize(Archive& a, ContactHistory& h) {
    a(h.cracks, h.loose);
}
template <class Archive>
void serialize(Archive& a, Frame& f) {
    a(f.row, f.axial_strain, f.axial_stress, f.time, f.bodies, f.shear_force, f.states, f.loose, f.cracks);
}
template <class Archive>
void serialize(Archive& a, FrameEntry& f) {
    a(f.row, f.axial_strain, f.time);
}
template <class Archive>
void serialize(Archive& a, StartPlace& p) {
    a(p.x, p.y, p.angle);
}
template <class Archive>
void serialize(Archive& a, Bond& b) {
    a(b.point, b.overlap);
}
template <class Archive>
void serialize(Archive& a, RateRule& r) {
    a(r.tolerance, r.transit_time, r.first_strain, r.stress_floor, r.energy_floor, r.kinetic_per_rate);
}
template <class Archive>
void serialize(Archive& a, RateState& r) {
    a(r.rate, r.out_of_balance, r.largest_stress, r.kinetic_share, r.next_look, r.slowest, r.fastest, r.strain_above);
}
template <class Archive>
void serialize(Archive& a, TestSetup& s) {
    a(s.compression, s.specimen, s.polygons, s.width, s.height, s.bond_thick, s.mesh_thick, s.bottom_id, s.top_id,
      s.bottom, s.top, s.top_start, s.left, s.right, s.gauge_length, s.particles, s.segments, s.seeds,
      s.contacts_initial, s.mean_bond_overlap, s.mean_back_tension, s.mean_back_tension_interface, s.stable_time_step,
      s.stable_time_step_proved, s.time_step_bound, s.rate_rule, s.start, s.bonds, s.bond_kind_begin, s.notices,
      s.packing);
}
template <class Archive>
void serialize(Archive& a, TestState& s) {
    a(s.rows, s.failure, s.history, s.peak_frame, s.frames, s.next_frame, s.rate, s.breaks_in_shear,
      s.breaks_in_tension, s.breaks_after_sliding, s.ended_by, s.youngs_modulus, s.poissons_ratio, s.modulus_residual,
      s.curve_bytes, s.events_bytes, s.wall_seconds, s.step_seconds, s.command);
}

void save_test(std::ostream& out, const std::string& case_hash, const TestSetup& setup, const TestState& state,
               const World& world) {
    Sha256 hash;
    WatchingBuffer buffer(out, [&](std::string_view piece) { hash.add(piece); });
    std::ostream watched(&buffer);
    watched << checkpoint_title << checkpoint_version << '\n';
    cereal::BinaryOutputArchive{watched}(case_hash, setup, state);
    save_world(world, watched);
    watched.flush();
    if (!watched) out.setstate(std::ios::badbit);
    out << hash.digits();
}

TestCheckpoint load_test(const std::string& bytes, const std::string& name) {
    const std::string title = checkpoint_title;
    const std::size_t line_end = bytes.find('\n');
    if (!bytes.starts_with(title) || line_end == std::string::npos) {
        throw InputError(fmt::format(
            "{}: found other data, expected a crackle test checkpoint; run the test again with --force", name));
    }
    const std::string version = bytes.substr(title.size(), line_end - title.size());
    if (version != checkpoint_version) {
        throw InputError(fmt::format(
            "{}: found checkpoint version {}, expected {}; resume with the crackle that wrote it, or run the "
            "test again with --force",
            name, version, checkpoint_version));
    }
    const std::size_t begin = line_end + 1;
    const std::size_t end = std::max(begin + hash_digits, bytes.size()) - hash_digits;
    if (bytes.compare(end, hash_digits, sha256(std::string_view(bytes).substr(0, end))) != 0) {
        throw InputError(
            fmt::format("{}: found a truncated or damaged checkpoint, expected a complete one; run the test again with "
                        "--force",
                        name));
    }
    TestCheckpoint checkpoint;
    std::istringstream in(bytes, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(begin));
    cereal::BinaryInputArchive archive(in);
    archive(checkpoint.case_hash, checkpoint.setup, checkpoint.state);
    const auto world_begin = static_cast<std::size_t>(in.tellg());
    checkpoint.world = load_world(bytes.substr(world_begin, end - world_begin), name);
    return checkpoint;
}

}  // namespace crackle
