// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the output of a deck's run as a recording: frames from output.dat, cont.dat and cont2.dat, and curves
// (deck_curves.hpp).
//
// These files contain only positions and forces. Velocities are computed from consecutive frames; a chain is assumed to
// rotate by less than half a turn between them. The stress of a body is σ = -1/A Σ f ⊗ (x - x_c), symmetrised,
// compression positive. Here f are the forces on the body, including dashpots, and A is its area. For a clump, A is the
// sum of its circles' areas, as in the computation of its mass.
//
// Bonds are the contacts with a back-tension in the first frame. A bond is recognised in a later frame by its bodies,
// its back-tension and its position. The back-tension is constant until the bond breaks. Bonded points with equal
// back-tension on the same face are far apart, so their positions distinguish them.
// Tested by tests/tools/commands/view_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "solver/demseg/geometry.hpp"
#include "solver/demseg/read_outputs.hpp"
#include "specimens/recordings/cell_finder.hpp"
#include "specimens/recordings/recording.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

/// Segments of one body, joined end to end.
struct Chain {
    int id = 0;
    std::vector<Vec2> points;
    bool closed = false;
};

std::vector<Chain> joined(const std::vector<DeckSegment>& segments) {
    std::vector<Chain> chains;
    for (const DeckSegment& segment : segments) {
        if (chains.empty() || chains.back().id != segment.id) chains.push_back({segment.id, {segment.start}, false});
        chains.back().points.push_back(segment.end);
    }
    for (Chain& chain : chains) {
        const Vec2 first = chain.points.front(), last = chain.points.back();
        // The last point of a closed chain repeats the first.
        chain.closed = chain.points.size() > 3 && first.x == last.x && first.y == last.y;
        if (chain.closed) chain.points.pop_back();
    }
    return chains;
}

double direction(const Chain& chain) {
    const Vec2 first = chain.points[1] - chain.points[0];
    return correctly_rounded::atan2(first.y, first.x);
}

/// Area by the shoelace formula, m2.
double area_of(const RecordedCell& cell) {
    if (cell.radius > 0.0) return std::numbers::pi * cell.radius * cell.radius;
    if (cell.open) return 0.0;
    double twice = 0.0;
    for (std::size_t k = 0; k < cell.outline.size(); ++k)
        twice += cross(cell.outline[k], cell.outline[(k + 1) % cell.outline.size()]);
    return 0.5 * std::abs(twice);
}

struct Place {
    Vec2 centre;
    double angle = 0.0;
};

constexpr double same_tension = 1e-9;  // relative tolerance for comparing back-tensions read from text

/// Reads the frames of one run. Positions are kept to compute velocities and to count full turns: 24 bytes per cell and
/// frame.
class DeckMotion {
  public:
    DeckMotion(const fs::path& folder, std::size_t most_frames)
        : frames_(folder), chosen_(chosen_frames(frames_.heads().size(), most_frames, {})) {}

    void read_start(const fs::path& folder, Recording& recording) {
        const DeckFrames::Positions start = frames_.positions(chosen_.front());
        for (const DeckCircle& circle : start.circles)
            recording.cells.push_back({circle.id, 1, circle.radius, false, false, circle.centre, {}});
        for (const Chain& chain : joined(start.segments))
            recording.cells.push_back(
                {chain.id, 1, 0.0, !chain.closed, false, centroid(chain.points, !chain.closed), chain.points});
        add_materials_and_walls(folder, recording);
        for (const std::size_t k : chosen_) {
            const DeckFrameFile::Head& head = frames_.heads()[k];
            FrameHead shown;
            shown.time = head.time;
            shown.step = head.step;
            shown.file = fmt::format("output.dat:{}", head.line);
            recording.frames.push_back(std::move(shown));
        }
        for (const RecordedCell& cell : recording.cells) {
            ids_.push_back(cell.id);
            area_of_body_[cell.id] += area_of(cell);
        }
        finder_ = CellFinder(recording.cells);
        read_bonds(recording);
        read_breaks(folder / "events.csv", recording.results.events);
        recording.curves = read_deck_curves(folder, frames_.heads());
        frames_.require_unchanged();  // rows must belong to the same run as the frames
    }

    RecordedFrame read(std::size_t k) {
        // Velocities are mean values since the previous frame or, for the first frame, until the next one.
        const std::size_t earlier = k == 0 ? 0 : k - 1,
                          later = k == 0 ? std::min<std::size_t>(1, chosen_.size() - 1) : k;
        unwind(later);
        const std::vector<Place>&now = places_[k], &from = places_[earlier], &to = places_[later];
        const double elapsed = time(later) - time(earlier);
        RecordedFrame frame;
        for (std::size_t cell = 0; cell < now.size(); ++cell) {
            frame.ux.push_back(now[cell].centre.x - places_[0][cell].centre.x);
            frame.uy.push_back(now[cell].centre.y - places_[0][cell].centre.y);
            frame.angle.push_back(now[cell].angle - places_[0][cell].angle);
            if (later == earlier) continue;
            frame.vx.push_back((to[cell].centre.x - from[cell].centre.x) / elapsed);
            frame.vy.push_back((to[cell].centre.y - from[cell].centre.y) / elapsed);
            frame.rotation_rate.push_back((to[cell].angle - from[cell].angle) / elapsed);
        }
        add_contacts(frames_.contacts(chosen_[k]), now, frame);
        return frame;
    }

  private:
    double time(std::size_t k) const { return frames_.heads()[chosen_[k]].time; }

    /// Fills places_ up to chosen frame k. Angles of chains are known only modulo a full turn. The value nearest to the
    /// angle in the previous output is used, whether or not that output is a chosen frame. Between chosen frames, a
    /// body may therefore rotate by more than half a turn.
    void unwind(std::size_t k) {
        constexpr double turn = 2.0 * std::numbers::pi;
        while (places_.size() <= k) {
            const std::size_t wanted = chosen_[places_.size()];
            for (std::size_t output = places_.empty() ? wanted : chosen_[places_.size() - 1] + 1; output <= wanted;
                 ++output) {
                std::vector<Place> now = places(output);
                for (std::size_t cell = 0; cell < now.size() && !last_.empty(); ++cell) {
                    if (finder_.is_circle(ids_[cell])) continue;
                    now[cell].angle -= turn * std::round((now[cell].angle - last_[cell].angle) / turn);
                }
                last_ = std::move(now);
            }
            places_.push_back(last_);
        }
    }

    std::vector<Place> places(std::size_t output) const {
        const DeckFrames::Positions positions = frames_.positions(output);
        std::vector<Place> all;
        std::vector<int> ids;
        for (const DeckCircle& circle : positions.circles) {
            all.push_back({circle.centre, circle.angle});
            ids.push_back(circle.id);
        }
        for (const Chain& chain : joined(positions.segments)) {
            all.push_back({centroid(chain.points, !chain.closed), direction(chain)});
            ids.push_back(chain.id);
        }
        if (ids != ids_) {
            const DeckFrameFile::Head& head = frames_.heads()[output];
            throw InputError(
                fmt::format("output.dat:{}: found bodies in the frame of step {} that differ from those in the first "
                            "frame; outputs of different runs cannot be shown as one run",
                            head.line, head.step));
        }
        return all;
    }

    void add_materials_and_walls(const fs::path& folder, Recording& recording) const {
        for (const char* name : {"new_in_gm.dat", "in_gm.dat"}) {
            const fs::path file = folder / name;
            if (!fs::exists(file) || read_geometry_mode(file) != 1) continue;
            const Scene scene = read_geometry(file);
            recording.walls = {scene.domain.x1, scene.domain.x2, scene.domain.y1, scene.domain.y2};
            std::unordered_map<int, int> material_of;
            for (const Body& body : scene.bodies) material_of[body.id] = body.material + 1;
            for (RecordedCell& cell : recording.cells) {
                if (const auto found = material_of.find(cell.id); found != material_of.end())
                    cell.material = found->second;
            }
            return;
        }
    }

    std::int32_t cell_of(int id, Vec2 place) const {
        if (id < 0) return recorded_walls[static_cast<std::size_t>(-id - 1)];
        const std::int32_t cell = finder_.find(id, place);
        if (cell < 0) throw InputError(fmt::format("cont.dat: found body {}, which is not in output.dat", id));
        return cell;
    }

    /// The ids of the two bodies in ascending order. Their order in the file may change when a run is resumed from text
    /// files.
    static std::pair<int, int> pair_of(const DeckContact& contact) { return std::minmax(contact.id, contact.other); }

    void read_bonds(Recording& recording) {
        for (const DeckContact& contact : frames_.contacts(chosen_.front())) {
            if (contact.back_tension == 0.0) continue;
            bonds_of_[pair_of(contact)].push_back(bonds_.size());
            bonds_.push_back(
                {cell_of(contact.id, contact.place), cell_of(contact.other, contact.place), contact.place});
            tensions_.push_back(contact.back_tension);
        }
        recording.bonds = bonds_;
    }

    void read_breaks(const fs::path& file, NumberTable& events) const {
        const DeckBreaks& breaks = frames_.breaks();
        if (breaks.table.empty()) return;
        events = break_table(file, breaks.table, {"time", "x", "y", "body_i", "body_j", "mode", "last_of_interface"},
                             "run the deck again", breaks.names_line);
        for (const char* name : {"body_i", "body_j"}) {
            for (const double id : *events.find(name)) {
                if (!area_of_body_.contains(static_cast<int>(id)))
                    throw InputError(fmt::format("{}: found body {}, which is not in output.dat", file.string(), id));
            }
        }
    }

    /// Index of the bond to which a contact belongs, among the bonds not yet assigned to a contact; empty if the
    /// contact was not bonded in the first frame.
    std::optional<std::size_t> bond_of(const DeckContact& contact, const std::vector<Place>& now,
                                       const std::vector<bool>& found) const {
        const auto candidates = bonds_of_.find(pair_of(contact));
        if (contact.back_tension == 0.0 || candidates == bonds_of_.end()) return std::nullopt;
        const bool several = candidates->second.size() > 1;
        std::optional<std::size_t> nearest;
        double least = std::numeric_limits<double>::infinity();
        for (const std::size_t bond : candidates->second) {
            const double change = std::abs(contact.back_tension - tensions_[bond]);
            if (found[bond] || !(change <= same_tension * std::abs(tensions_[bond]))) continue;
            const double way = several ? norm(contact.place - carried(bonds_[bond], now)) : 0.0;
            if (!(way < least)) continue;
            least = way;
            nearest = bond;
        }
        return nearest;
    }

    /// Current position of a bond, which is assumed to move with the first of its two cells.
    Vec2 carried(const RecordedBond& bond, const std::vector<Place>& now) const {
        const Place &cell = now[static_cast<std::size_t>(bond.i)],
                    &start = places_[0][static_cast<std::size_t>(bond.i)];
        const Vec2 arm = bond.place - start.centre;
        const double turn = cell.angle - start.angle;
        const double c = correctly_rounded::cos(turn), s = correctly_rounded::sin(turn);
        return cell.centre + Vec2{c * arm.x - s * arm.y, s * arm.x + c * arm.y};
    }

    void add_contacts(const std::vector<DeckContact>& contacts, const std::vector<Place>& now,
                      RecordedFrame& frame) const {
        struct Stress {
            double xx = 0.0, yy = 0.0, xy = 0.0;
        };
        std::unordered_map<int, Stress> stress_of;  // stress of each body multiplied by its area
        const auto load = [&](std::int32_t cell, Vec2 place, Vec2 force) {
            if (cell < 0) return;
            const auto at = static_cast<std::size_t>(cell);
            const Vec2 arm = place - now[at].centre;
            Stress& stress = stress_of[ids_[at]];
            stress.xx -= force.x * arm.x;
            stress.yy -= force.y * arm.y;
            stress.xy -= 0.5 * (force.x * arm.y + force.y * arm.x);
        };
        std::vector<bool> found(bonds_.size());
        frame.normal_force.assign(bonds_.size(), 0.0);
        frame.shear_force.assign(bonds_.size(), 0.0);
        frame.state.assign(bonds_.size(), static_cast<double>(BondState::broken));
        for (const DeckContact& contact : contacts) {
            const std::int32_t i = cell_of(contact.id, contact.place), j = cell_of(contact.other, contact.place);
            load(i, contact.place, contact.force);
            load(j, contact.place, -1.0 * contact.force);
            if (const std::optional<std::size_t> bond = bond_of(contact, now, found)) {
                found[*bond] = true;
                frame.normal_force[*bond] = contact.normal_force;
                frame.shear_force[*bond] = contact.shear_force;
                frame.state[*bond] = static_cast<double>(BondState::intact);
                continue;
            }
            frame.contacts.i.push_back(i);
            frame.contacts.j.push_back(j);
            frame.contacts.x.push_back(contact.place.x);
            frame.contacts.y.push_back(contact.place.y);
            frame.contacts.normal_force.push_back(contact.normal_force);
            frame.contacts.shear_force.push_back(contact.shear_force);
        }
        for (const int id : ids_) {
            const Stress stress = stress_of[id];
            const double area = area_of_body_.at(id);
            frame.stress_xx.push_back(area > 0.0 ? stress.xx / area : 0.0);
            frame.stress_yy.push_back(area > 0.0 ? stress.yy / area : 0.0);
            frame.stress_xy.push_back(area > 0.0 ? stress.xy / area : 0.0);
        }
    }

    DeckFrames frames_;
    std::vector<std::size_t> chosen_;
    std::vector<int> ids_;  // ids of cells
    std::unordered_map<int, double> area_of_body_;
    CellFinder finder_{{}};
    std::vector<RecordedBond> bonds_;
    std::vector<double> tensions_;  // back-tension of each bond
    // Indices of bonds, by the ids of their two bodies.
    std::map<std::pair<int, int>, std::vector<std::size_t>> bonds_of_;
    std::vector<Place> last_;                 // positions in the last output that was read
    std::vector<std::vector<Place>> places_;  // positions in each chosen frame, computed as needed
};

}  // namespace

Recording read_deck_recording(const fs::path& folder, std::size_t most_frames) {
    Recording recording;
    recording.kind = Recording::Kind::deck;
    recording.path = fs::weakly_canonical(folder);
    recording.name = recording.path.filename().string();
    recording.mean_velocities = true;
    const auto motion = std::make_shared<DeckMotion>(folder, most_frames);
    motion->read_start(folder, recording);
    recording.frame = [motion](std::size_t k) { return motion->read(k); };
    return recording;
}

}  // namespace crackle
