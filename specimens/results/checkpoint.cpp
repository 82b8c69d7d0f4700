// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/checkpoint.hpp"

#include <fmt/format.h>

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>

#include <algorithm>
#include <istream>
#include <type_traits>

#include "solver/base/checked_input.hpp"
#include "solver/base/errors.hpp"
#include "solver/base/fields.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/read_pieces.hpp"
#include "solver/files/watching_buffer.hpp"
#include "solver/world/checkpoint.hpp"
#include "solver/world/point_order.hpp"
#include "specimens/results/sha256.hpp"

namespace crackle {

// Version of the layout; increase it whenever a stored field changes.
constexpr const char* checkpoint_version = "20";
constexpr std::size_t hash_digits = 64;

/// Enumerations that a checkpoint stores by name.
template <class Kind>
concept KeptByName = std::is_same_v<Kind, LoadingKind> || std::is_same_v<Kind, SpecimenKind>;

template <class Archive, KeptByName Kind>
void save(Archive& archive, const Kind& kind) {
    archive(std::string(name_of(kind)));
}

template <class Archive, KeptByName Kind>
void load(Archive& archive, Kind& kind) {
    std::string name;
    archive(name);
    const auto unknown = static_cast<Kind>(table_of_names<Kind>.size());  // refused by setup_is_whole()
    kind = from_name<Kind>(name).value_or(unknown);
}

}  // namespace crackle

// Replaces cereal's default, which stores enumerations as numbers.
template <class Archive, crackle::KeptByName Kind>
struct cereal::specialize<Archive, Kind, cereal::specialization::non_member_load_save> {};

namespace crackle {
namespace {

/// Whether a point is a valid contact point between two bodies, as all bonds and contacts of a specimen are.
bool is_between_bodies(const World& world, std::size_t kind, const ContactPoint& point) {
    return static_cast<PointKind>(kind) != PointKind::element_wall &&
           is_point_of(world, static_cast<PointKind>(kind), point);
}

bool setup_is_whole(const TestSetup& setup, const World& world) {
    const std::size_t n = world.bodies.size(), bonds = setup.bonds.points.size();
    const auto is_body = [n](BodyIndex body) { return body < n; };
    const auto is_part = [&](const SetupPart& part) {
        return is_body(part.body) && part.face <= world.bodies.info(part.body).element_count;
    };
    const auto are_bodies = [&](const std::vector<BodyIndex>& bodies) { return std::ranges::all_of(bodies, is_body); };
    const auto is_face = [&](const TraceFace& face) {
        return is_body(face.i) && is_body(face.j) && face.trace >= 0 && face.trace < std::ssize(setup.bonds.traces);
    };
    const auto is_face_number = [&](std::int32_t face) {
        return face >= -1 && face < std::ssize(setup.bonds.trace_faces);
    };
    if (!is_known(setup.apparatus.kind) || !is_known(setup.specimen.kind) || !is_known(setup.bonds.law) ||
        setup.apparatus.axis < 0 || setup.apparatus.axis > 1 || !is_body(setup.apparatus.bottom) ||
        !is_body(setup.apparatus.top) || setup.apparatus.parts.empty() ||
        !std::ranges::all_of(setup.apparatus.parts, is_part) || !are_bodies(setup.gauges.left) ||
        !are_bodies(setup.gauges.right) || !are_bodies(setup.gauges.bottom) || !are_bodies(setup.gauges.top) ||
        setup.bonds.start.size() != n || setup.bonds.overlaps.size() != bonds ||
        !(setup.bonds.shares.empty() || setup.bonds.shares.size() == bonds) ||
        !(setup.bonds.face_of_bond.empty() || setup.bonds.face_of_bond.size() == bonds) ||
        !std::ranges::all_of(setup.bonds.trace_faces, is_face) ||
        !std::ranges::all_of(setup.bonds.face_of_bond, is_face_number) ||
        !are_kinds_of(setup.bonds.kind_begin, bonds) ||
        setup.bonds.points.parts.size() != bonds - setup.bonds.kind_begin[1] || setup.specimen.particles < 0 ||
        setup.specimen.particles > static_cast<std::int64_t>(n))
        return false;
    for (std::size_t number = 0; number < bond_kinds; ++number) {
        const auto kind = static_cast<PointKind>(number);
        const auto key = [&](PointIndex bond) { return key_of(kind, setup.bonds.points[bond]); };
        for (PointIndex bond = setup.bonds.kind_begin[number]; bond < setup.bonds.kind_begin[number + 1]; ++bond) {
            if (!is_between_bodies(world, number, setup.bonds.points[bond]) ||
                (bond > setup.bonds.kind_begin[number] && !(key(bond - 1) < key(bond))))
                return false;
        }
        if (kind == PointKind::bonded_face) break;
        for (PointIndex k = world.points.kind_begin[number]; k < world.points.kind_begin[number + 1]; ++k) {
            if ((world.points.state[k].flags & point_bonded) != 0 &&
                bond_of(setup.bonds, kind, world.points.contact[k]) == bonds)
                return false;
        }
    }
    return true;
}

bool loose_are_whole(const LooseContacts& loose, const World& world) {
    if (!are_kinds_of(loose.kind_begin, loose.contacts.size())) return false;
    for (std::size_t kind = 0; kind < point_kinds; ++kind) {
        for (PointIndex k = loose.kind_begin[kind]; k < loose.kind_begin[kind + 1]; ++k) {
            if (!is_between_bodies(world, kind, loose.contacts[k].point)) return false;
        }
    }
    return true;
}

bool frame_is_whole(const Frame& frame, const TestState& state, const TestSetup& setup, const World& world) {
    if (frame.row < 0) return frame.row == -1;
    const std::size_t bonds = setup.bonds.points.size();
    return frame.row < std::ssize(state.rows) && frame.bodies.size() == world.bodies.size() &&
           frame.shear_force.size() == bonds && frame.states.size() == bonds &&
           std::ranges::all_of(frame.states, [](ContactState one) { return one <= ContactState::loose; }) &&
           loose_are_whole(frame.loose, world) && frame.cracks <= state.history.cracks.size() &&
           std::ranges::all_of(frame.joint_forces,
                               [bonds](const Frame::JointForce& force) { return force.bond < bonds; });
}

bool state_is_whole(const TestState& state, const TestSetup& setup, const World& world) {
    const std::size_t n = world.bodies.size(), bonds = setup.bonds.points.size();
    const auto is_row = [&](std::int64_t row) { return row >= 0 && row < std::ssize(state.rows); };
    const auto is_row_or_none = [&](std::int64_t row) { return row == -1 || is_row(row); };
    const auto is_whole = [&](const OpenEvent& open) {
        return std::ranges::all_of(open.bodies, [n](BodyIndex body) { return body < n; }) &&
               std::ranges::is_sorted(open.bodies) &&
               std::ranges::all_of(open.before, [&](const EarlierForce& earlier) {
                   return is_point_of(world, earlier.kind, earlier.point);
               });
    };
    const FailureTracker& failure = state.failure;
    return is_row_or_none(failure.peak_row) && is_row_or_none(failure.largest_row) &&
           is_row_or_none(failure.drop.row) && is_row_or_none(failure.collapse.row) &&
           std::ranges::all_of(state.history.cracks, [bonds](const Crack& crack) { return crack.bond < bonds; }) &&
           loose_are_whole(state.history.loose, world) && frame_is_whole(state.peak_frame, state, setup, world) &&
           std::ranges::all_of(state.frames, [&](const FrameEntry& frame) { return is_row(frame.row); }) &&
           state.next_frame >= 0 && state.path.unloaded >= 0 &&
           (state.faces_at_peak.empty() || state.faces_at_peak.size() == setup.bonds.trace_faces.size()) &&
           std::ranges::all_of(state.emission.open, is_whole);
}

}  // namespace

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

TestCheckpoint load_test(std::istream& in, const std::string& name) {
    const std::string title = checkpoint_title;
    const std::streamoff length = length_of_stream(in);
    std::string line;
    constexpr std::size_t longest_line = 64;
    for (char letter = 0; line.size() < longest_line && in.get(letter) && letter != '\n';) line += letter;
    refuse_failed(in, name);
    if (!in || !line.starts_with(title) || line.size() == longest_line) {
        throw InputError(fmt::format(
            "{}: found other data, expected a crackle test checkpoint; run the test again with --force", name));
    }
    const std::string version = line.substr(title.size());
    if (version != checkpoint_version) {
        throw InputError(fmt::format(
            "{}: found checkpoint version {}, expected {}; resume with the crackle that wrote it, or run the "
            "test again with --force",
            name, version, checkpoint_version));
    }
    const std::string damaged = fmt::format(
        "{}: found a truncated or damaged checkpoint, expected a complete one; run the test again with --force", name);
    const std::streamoff begin = in.tellg(), end = length - static_cast<std::streamoff>(hash_digits);
    Sha256 hash;
    std::string digits(hash_digits, ' ');
    const bool whole = begin <= end && read_pieces(in, 0, end, [&](std::string_view piece) { hash.add(piece); }) &&
                       in.read(digits.data(), static_cast<std::streamsize>(hash_digits)) && digits == hash.digits();
    refuse_failed(in, name);
    if (!whole) throw InputError(damaged);
    in.seekg(begin);
    TestCheckpoint checkpoint;
    CheckedInput archive(in, end, damaged);
    archive(checkpoint.case_hash, checkpoint.setup, checkpoint.state);
    checkpoint.world = load_world(in, end, name);
    require_whole(checkpoint.world, name);
    if (!setup_is_whole(checkpoint.setup, checkpoint.world) ||
        !state_is_whole(checkpoint.state, checkpoint.setup, checkpoint.world)) {
        throw InputError(
            fmt::format("{}: found parts that do not belong together, expected a checkpoint as crackle wrote it; run "
                        "the test again "
                        "with --force",
                        name));
    }
    return checkpoint;
}

}  // namespace crackle
