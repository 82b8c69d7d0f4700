// SPDX-License-Identifier: GPL-3.0-or-later
// Saves and loads the complete state of a world as bytes, with cereal's binary archive. It includes the neighbour list
// and the edge that each contact point faced last, so that a restarted run performs exactly the same arithmetic.

#include "solver/world/checkpoint.hpp"

#include <fmt/format.h>

#include <xxhash.h>
#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/vector.hpp>

#include <algorithm>
#include <cstdint>
#include <istream>
#include <memory>
#include <sstream>
#include <utility>

#include "solver/base/checked_input.hpp"
#include "solver/base/errors.hpp"
#include "solver/base/fields.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/read_pieces.hpp"
#include "solver/files/watching_buffer.hpp"

namespace crackle {

// Increment this number when a field is added to a group, removed or moved.
constexpr std::uint32_t checkpoint_version = 27;
constexpr std::uint64_t checkpoint_magic = 0x454c4b4341524321ULL;  // "!CRACKLE"

template <class Archive>
void serialize(Archive& archive, World& world) {
    World::groups(world, [&](const char* /*name*/, auto& group) { archive(group); });
    // Faces come last in the file, so that worlds without faces write nothing for them.
    if constexpr (Archive::is_saving::value) {
        if (world.faces.size() > 0) archive(world.faces);
    } else {
        if (archive.left() > 0) archive(world.faces);
    }
}

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

World load_world(std::istream& in, std::streamoff end, const std::string& name, const char* remedy) {
    constexpr std::streamoff head = sizeof checkpoint_magic + sizeof checkpoint_version, tail = sizeof(XXH64_hash_t);
    const std::streamoff begin = in.tellg();
    if (!in || end - begin < head + tail)
        throw InputError(fmt::format("{}: found {} bytes, expected a crackle checkpoint", name, in ? end - begin : 0));
    std::uint64_t magic = 0;
    std::uint32_t version = 0;
    const std::string damaged =
        fmt::format("{}: found a truncated or damaged checkpoint, expected a complete one", name);
    CheckedInput(in, end, damaged)(magic, version);
    if (magic != checkpoint_magic)
        throw InputError(fmt::format("{}: found other data, expected a crackle checkpoint", name));
    if (version != checkpoint_version) {
        throw InputError(
            fmt::format("{}: found checkpoint version {}, expected {}; {}", name, version, checkpoint_version, remedy));
    }
    // The hash is verified before any length in the data is used.
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(), &XXH3_freeState);
    XXH3_64bits_reset(hash.get());
    const auto add = [&](std::string_view piece) { XXH3_64bits_update(hash.get(), piece.data(), piece.size()); };
    XXH64_hash_t noted = 0;
    const bool read = read_pieces(in, begin, end - tail, add) && in.read(reinterpret_cast<char*>(&noted), tail);
    refuse_failed(in, name);
    if (!read || XXH3_64bits_digest(hash.get()) != noted) throw InputError(damaged);
    in.seekg(begin + head);
    World world;
    CheckedInput archive(in, end - tail, damaged);
    archive(world);
    world.workers.marks.resize(world.bodies.size());
    set_threads(world, 1);
    return world;
}

namespace {

constexpr std::int64_t most_steps = 1'000'000'000'000'000;  // sums of a few values of this size stay far below overflow

/// Whether `count` entries starting at index `first` lie within an array of `size` entries.
bool within(std::size_t first, std::size_t count, std::size_t size) { return first <= size && count <= size - first; }

bool flat_faces_are_whole(const World& world) {
    const Bodies& b = world.bodies;
    if (b.flat_faces.empty()) return b.first_flat_face.empty();
    const auto traces = std::ssize(world.settings.trace_joints);
    return b.first_flat_face.size() == b.size() + 1 && b.first_flat_face.front() == 0 &&
           b.first_flat_face.back() == b.flat_faces.size() && std::ranges::is_sorted(b.first_flat_face) &&
           std::ranges::all_of(b.flat_faces, [&](const FlatFace& face) {
               return face.body < b.size() && face.side >= 0 && face.side < 2 * traces;
           });
}

/// Whether all enumerations in a world have values that this program knows.
bool words_are_known(const World& world) {
    const Settings& s = world.settings;
    return s.driven_contacts <= DrivenContacts::all && s.segment_law <= SegmentLaw::demseg_mean &&
           s.integrator <= Integrator::consistent && is_known(s.bond_law) && s.units <= StiffnessUnits::area &&
           std::ranges::all_of(world.bodies.controls, [](const ControlState& control) {
               return std::ranges::all_of(control.dof,
                                          [](const DofControl& dof) { return dof.drive <= Drive::displacement; });
           });
}

bool bodies_are_whole(const World& world) {
    const Bodies& b = world.bodies;
    const std::size_t n = b.size();
    const auto may_be_absent = [n](const auto& values) { return values.empty() || values.size() == n; };
    const NeighbourList& list = world.list;
    if (b.inertia.size() != n || b.force.size() != n || b.names.size() != n || list.size_rank.size() != n ||
        !may_be_absent(b.last_force) || !may_be_absent(b.push_bound) || !may_be_absent(list.own_half_skins) ||
        !may_be_absent(list.reference) || !may_be_absent(world.account.opening_defects) ||
        !(b.segments.empty() || b.segments.size() == b.elements.size()) ||
        !(b.element_sides.empty() || b.element_sides.size() == b.elements.size()))
        return false;
    if (n > 0 && world.stepping.limiting_body >= n) return false;
    if (list.valid && (list.reference.size() != n || list.reference_angles.size() != b.shapes.size())) return false;
    if (world.settings.integrator == Integrator::consistent &&
        (b.last_force.size() != n || b.push_bound.size() != n || world.account.opening_defects.size() != n))
        return false;
    return std::ranges::all_of(b.names,
                               [&](const BodyName& name) {
                                   return name.material < world.settings.materials.size() &&
                                          (name.shape == no_shape || name.shape < b.shapes.size());
                               }) &&
           std::ranges::all_of(b.shapes,
                               [&](const BodyShape& shape) {
                                   return within(shape.first_element, shape.element_count, b.elements.size()) &&
                                          within(shape.first_piece, shape.piece_count, b.pieces.size());
                               }) &&
           std::ranges::all_of(
               b.pieces,
               [&](const Piece& piece) { return within(piece.first_edge, piece.edge_count, b.edges.size()); }) &&
           std::ranges::all_of(b.edges,
                               [n](const Edge& edge) { return edge.outline_of == no_body || edge.outline_of < n; }) &&
           std::ranges::all_of(b.controls, [n](const ControlState& control) { return control.body < n; }) &&
           std::ranges::all_of(b.element_sides, [traces = std::ssize(world.settings.trace_joints)](
                                                    TraceSide side) { return side >= no_side && side < 2 * traces; }) &&
           flat_faces_are_whole(world) &&
           std::ranges::all_of(list.size_rank, [n](std::uint32_t rank) { return rank < n; });
}

bool points_are_whole(const World& world) {
    const Points& points = world.points;
    const std::size_t count = points.size();
    if (!are_kinds_of(points.kind_begin, count) || points.fours_end > count || points.root_mass.size() != count ||
        !(points.force.empty() || points.force.size() == count))
        return false;
    bool whole = points.contact.parts.size() == count - points.kind_begin[1];
    visit_remembered(points, [&](const auto& values, Remembered remembered) {
        whole = whole && values.size() == (keeps(world, remembered) ? count : 0);
    });
    if (!whole) return false;
    for (std::size_t kind = 0; kind < point_kinds; ++kind) {
        for (PointIndex k = points.kind_begin[kind]; k < points.kind_begin[kind + 1]; ++k) {
            if (!is_point_of(world, static_cast<PointKind>(kind), points.contact[k]) ||
                points.state[k].law >= world.settings.laws.size())
                return false;
        }
    }
    return std::ranges::all_of(world.bonds.events,
                               [&](const BreakEvent& event) { return is_point_of(world, event.kind, event.point); });
}

bool faces_are_whole(const World& world) {
    const Faces& f = world.faces;
    const std::size_t n = world.bodies.size(), count = f.size();
    if (count == 0) return true;
    const auto of_all = [count](const auto& values) { return values.size() == count; };
    const auto may_be_absent = [&](const auto& values) { return values.size() == 0 || of_all(values); };
    const auto columns = [](const auto& values) { return values.numbers.size() == values.width * values.count; };
    if (!columns(f.place) || !columns(f.springs) || !columns(f.motion) || !columns(f.dashpots) ||
        !columns(f.dashpot_force))
        return false;
    const bool sizes = of_all(f.place) && of_all(f.springs) && of_all(f.law) && of_all(f.strength_share) &&
                       of_all(f.broken_at) && of_all(f.motion) && of_all(f.force) && may_be_absent(f.dashpots) &&
                       may_be_absent(f.dashpot_force) && may_be_absent(f.dilation_i) && may_be_absent(f.dilation_j) &&
                       f.first_face.size() == n + 1 && f.cells.size() == n && f.face_ends.size() == 2 * count &&
                       (f.whole_share.empty() || f.whole_share.size() == world.points.size());
    return sizes && f.first_face.front() == 0 && f.first_face.back() == f.face_ends.size() &&
           std::ranges::is_sorted(f.first_face) &&
           std::ranges::all_of(f.bodies, [n](const BodyPair& pair) { return pair.body_i < n && pair.body_j < n; }) &&
           std::ranges::all_of(f.face_ends, [count](std::uint32_t end) { return end / 2 < count; }) &&
           std::ranges::all_of(f.law, [&](std::uint16_t law) { return law < f.laws.size(); }) &&
           std::ranges::all_of(f.broken_at,
                               [&](FaceIndex broken) { return broken == no_face || broken < f.broken.size(); }) &&
           std::ranges::all_of(f.broken, [count](const BrokenFace& face) { return face.face < count; }) &&
           std::ranges::all_of(f.hand_over, [&](const HandOver& one) {
               return one.face < count && one.begin <= one.end && one.end <= world.points.size();
           });
}

bool membrane_is_whole(const World& world) {
    const Membrane& m = world.membrane;
    const std::size_t n = world.bodies.size(), count = m.points.size();
    const bool between = m.bottom < n && m.top < n, around = m.bottom == no_body && m.top == no_body;
    // Each chain has at least its two end points.
    const bool chains = count == 0 || around || (m.left_end >= 2 && count >= 2 && m.left_end <= count - 2);
    return (between || around) && chains &&
           std::ranges::all_of(m.points, [n](const MembranePoint& point) { return point.body < n; });
}

}  // namespace

bool is_point_of(const World& world, PointKind kind, const ContactPoint& point) {
    const Bodies& bodies = world.bodies;
    const std::size_t n = bodies.size();
    const auto is_face = [&](BodyIndex body, std::uint32_t face) {
        return face < bodies.flat_faces.size() && bodies.flat_faces[face].body == body;
    };
    const auto is_element = [&](BodyIndex body, std::uint32_t element) {
        return bodies.names[body].shape == no_shape ? element == own_circle : element < bodies.elements.size();
    };
    if (static_cast<int>(kind) >= bond_kinds || point.body_i >= n) return false;
    if (kind == PointKind::bonded_face) return point.body_j < n && point.element_i < world.faces.size();
    if (kind == PointKind::face_face)
        return is_face(point.body_i, point.element_i) && is_face(point.body_j, point.feature_j);
    if (!is_element(point.body_i, point.element_i)) return false;
    if (kind == PointKind::element_wall) return point.body_j < world.settings.domain.wall_present.size();
    if (point.body_j >= n) return false;
    if (kind == PointKind::element_outline) return point.feature_j < bodies.edges.size();
    return is_element(point.body_j, point.feature_j);
}

bool are_kinds_of(std::span<const PointIndex> kind_begin, std::size_t count) {
    return kind_begin.front() == 0 && kind_begin.back() == count && std::ranges::is_sorted(kind_begin);
}

void require_whole(const World& world, const std::string& name) {
    const Settings& settings = world.settings;
    const std::size_t laws = settings.first_joint_law() + settings.joints.size() * settings.pair_count();
    const auto is_joint = [&](std::int32_t joint) { return joint >= -1 && joint < std::ssize(settings.joints); };
    if (std::ranges::all_of(settings.trace_joints, is_joint) && world.stepping.steps >= 0 &&
        world.stepping.steps <= most_steps && settings.laws.size() == laws && words_are_known(world) &&
        bodies_are_whole(world) && points_are_whole(world) && membrane_is_whole(world) && faces_are_whole(world))
        return;
    throw InputError(
        fmt::format("{}: found parts that do not belong together, expected a checkpoint as crackle wrote it", name));
}

World load_world(std::string bytes, const std::string& name, const char* remedy) {
    std::istringstream in(std::move(bytes), std::ios::binary);
    return load_world(in, length_of_stream(in), name, remedy);
}

}  // namespace crackle
