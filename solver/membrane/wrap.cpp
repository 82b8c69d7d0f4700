// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/membrane/wrap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/membrane/press.hpp"
#include "solver/neighbours/cell_grid.hpp"

namespace crackle {
namespace {

/// An obstacle around which the disc rolls: a circle, or a point on an outline.
struct Lump {
    BodyIndex body;
    double x, y;  // m, position in the body frame
    Vec2 at;      // m, position in world axes (x may be reversed)
    double radius;
};

/// Lumps of all bodies that the membrane may touch. @param mirrored whether x is reversed, so that the right side can
/// be traced like the left side
std::vector<Lump> lumps_of(const World& world, double probe, bool mirrored) {
    const Membrane& membrane = world.membrane;
    std::vector<Lump> lumps;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        if (b == membrane.bottom || b == membrane.top) continue;
        const BodyState& body = world.bodies.state[b];
        const BodyInfo info = world.bodies.info(b);
        const auto add = [&](double x, double y, double radius) {
            const Vec2 at = Vec2{body.x, body.y} + turned(body, {x, y, 0.0, 0.0});
            lumps.push_back({b, x, y, {mirrored ? -at.x : at.x, at.y}, radius});
        };
        if (info.single_circle) {
            add(0.0, 0.0, body.shape[0]);
            continue;
        }
        for (std::uint32_t e = 0; e < info.element_count; ++e) {
            const Element& from = world.bodies.elements[info.first_element + e];
            if (info.piece_count == 0) {
                add(from.x, from.y, from.radius);
                continue;
            }
            const bool last = e + 1 == info.element_count;
            add(from.x, from.y, 0.0);
            if (last && !info.closed) continue;
            const Element& to = world.bodies.elements[info.first_element + (last ? 0 : e + 1)];
            const double length = norm(Vec2{to.x - from.x, to.y - from.y});
            const double parts = std::ceil(length / probe);
            for (double k = 1.0; k < parts; ++k)
                add(std::lerp(from.x, to.x, k / parts), std::lerp(from.y, to.y, k / parts), 0.0);
        }
    }
    return lumps;
}

/// Path of the disc around the lumps. While the disc rolls around a lump, its centre moves clockwise along a circle
/// around the lump, whose radius is the sum of the two radii. Where this circle first meets the circle of another lump,
/// the centre continues along the other circle.
class Walk {
  public:
    Walk(const std::vector<Lump>& lumps, double probe) : lumps_(lumps), probe_(probe), grid_(make_grid()) {}

    /// Path of a disc from floor to ceiling. It starts at the first lump that the disc meets when it moves along the
    /// floor from the left. Lumps from which the disc returns to the floor are not part of the specimen. @return empty
    /// if the disc can pass through
    std::vector<std::size_t> from_floor(double floor, double ceiling) const {
        const double level = floor + probe_;
        double passed = -std::numeric_limits<double>::infinity();
        while (true) {
            std::optional<std::size_t> start;
            double leftmost = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < lumps_.size(); ++k) {
                const double reach = reach_of(k), rise = level - lumps_[k].at.y;
                if (std::abs(rise) > reach) continue;
                const double x = lumps_[k].at.x - std::sqrt(reach * reach - rise * rise);
                if (x > passed && x < leftmost) {
                    leftmost = x;
                    start = k;
                }
            }
            if (!start) return {};
            const Way way = walk(*start, {leftmost, level}, floor, ceiling);
            if (way.end == End::ceiling) return way.lumps;
            if (way.end != End::floor || !(way.centre.x > leftmost)) return {};
            passed = way.centre.x;
        }
    }

    /// Path once around the largest group of lumps. The disc cannot pass between lumps of one group.
    std::vector<std::size_t> around() const {
        const std::vector<std::size_t> group = largest_group();
        const std::size_t start =
            *std::ranges::min_element(group, {}, [this](std::size_t k) { return lumps_[k].at.x - reach_of(k); });
        const double none = std::numeric_limits<double>::infinity();
        const Way way = walk(start, {lumps_[start].at.x - reach_of(start), lumps_[start].at.y}, -none, none);
        return way.end == End::start ? way.lumps : std::vector<std::size_t>{};
    }

  private:
    enum class End { ceiling, floor, start, nowhere };
    struct Way {
        std::vector<std::size_t> lumps;
        End end = End::nowhere;
        Vec2 centre{};  // m, centre of the disc at the end of the path
    };

    /// Calls visit(k) for the lumps whose enlarged circles may intersect the enlarged circle of a given lump.
    template <class Visit>
    void visit_near(std::size_t on, Visit&& visit) const {
        const Vec2 about = lumps_[on].at;
        const double far = reach_of(on) + longest_;
        grid_.visit(grid_.column(about.x - far), grid_.column(about.x + far), grid_.row(about.y - far),
                    grid_.row(about.y + far), [&](std::uint32_t k) {
                        if (k != on && norm(lumps_[k].at - about) < reach_of(on) + reach_of(k)) visit(k);
                    });
    }

    std::vector<std::size_t> largest_group() const {
        std::vector<std::size_t> largest;
        std::vector<bool> seen(lumps_.size(), false);
        for (std::size_t first = 0; first < lumps_.size(); ++first) {
            if (seen[first]) continue;
            std::vector<std::size_t> group{first};
            seen[first] = true;
            for (std::size_t n = 0; n < group.size(); ++n) {
                visit_near(group[n], [&](std::size_t k) {
                    if (seen[k]) return;
                    seen[k] = true;
                    group.push_back(k);
                });
            }
            if (group.size() > largest.size()) largest = std::move(group);
        }
        return largest;
    }

    double reach_of(std::size_t k) const { return lumps_[k].radius + probe_; }

    CellGrid make_grid() {
        Vec2 low = lumps_.front().at, high = low;
        for (std::size_t k = 0; k < lumps_.size(); ++k) {
            const Vec2 at = lumps_[k].at;
            low = {std::min(low.x, at.x), std::min(low.y, at.y)};
            high = {std::max(high.x, at.x), std::max(high.y, at.y)};
            longest_ = std::max(longest_, reach_of(k));
        }
        CellLayout layout;
        layout.low = low;
        const double size = 2.0 * longest_;
        const auto cells = [&](double length) {
            return static_cast<std::size_t>(std::clamp(std::ceil(length / size), 1.0, 4096.0));
        };
        layout.columns = cells(high.x - low.x);
        layout.rows = cells(high.y - low.y);
        layout.per_width = static_cast<double>(layout.columns) / std::max(high.x - low.x, size);
        layout.per_height = static_cast<double>(layout.rows) / std::max(high.y - low.y, size);
        return {layout, lumps_.size(), [this](std::size_t k) { return lumps_[k].at; }};
    }

    /// Clockwise angle from direction a to direction b, in [0, 2π).
    static double clockwise(Vec2 a, Vec2 b) {
        const double turn = correctly_rounded::atan2(b.x * a.y - b.y * a.x, dot(a, b));
        return turn < 0.0 ? turn + 2.0 * std::numbers::pi : turn;
    }

    struct Meeting {
        std::size_t lump = 0;
        Vec2 centre;  // m, centre of the disc where it meets the lump
        double turn = std::numeric_limits<double>::infinity();
        bool ceiling = false, floor = false;
    };

    /// The next lump that the disc meets while rolling around the lump `on`. @param from the lump from which the disc
    /// came
    Meeting next(std::size_t on, std::size_t from, Vec2 centre, double floor, double ceiling) const {
        const Vec2 about = lumps_[on].at, now = centre - about;
        const double reach = reach_of(on);
        Meeting first;
        const auto consider = [&](Meeting one, bool departing) {
            one.turn = clockwise(now, one.centre - about);
            // Do not count the current contact with the previous lump again.
            if (departing && one.turn > 2.0 * std::numbers::pi - least_turn) one.turn = 0.0;
            if (departing && one.turn < least_turn) return;
            if (one.turn < first.turn) first = one;
        };
        const auto level = [&](double y, bool is_ceiling) {
            const double rise = y - about.y;
            if (!(std::abs(rise) <= reach)) return;
            const double half = std::sqrt(reach * reach - rise * rise);
            for (const double side : {-half, half}) {
                Meeting one;
                one.centre = {about.x + side, y};
                (is_ceiling ? one.ceiling : one.floor) = true;
                consider(one, !is_ceiling);  // the disc may still be at the floor, where its path starts
            }
        };
        level(ceiling - probe_, true);
        level(floor + probe_, false);
        visit_near(on, [&](std::size_t k) {
            const Vec2 apart = lumps_[k].at - about;
            const double other = reach_of(k), distance = norm(apart);
            if (distance == 0.0) return;
            // The circles intersect twice; the disc meets this intersection first.
            const double along = (distance * distance + reach * reach - other * other) / (2.0 * distance);
            const double square = reach * reach - along * along;
            if (square < 0.0) return;  // one circle lies inside the other
            const Vec2 unit = (1.0 / distance) * apart;
            const Vec2 across{-unit.y, unit.x};
            for (const double side : {-1.0, 1.0}) {
                Meeting one;
                one.lump = k;
                one.centre = about + along * unit + side * std::sqrt(square) * across;
                consider(one, k == from);
            }
        });
        return first;
    }

    Way walk(std::size_t start, Vec2 centre, double floor, double ceiling) const {
        const bool closed = !std::isfinite(ceiling);
        Way way{{start}, End::nowhere, centre};
        std::size_t on = start, from = start;
        const std::size_t most = 4 * lumps_.size();  // the path visits a lump at most once per neighbour
        for (std::size_t step = 0; step < most; ++step) {
            const Meeting met = next(on, from, way.centre, floor, ceiling);
            const Vec2 about = lumps_[on].at;
            if (closed && on == start && way.lumps.size() > 1 &&
                clockwise(way.centre - about, centre - about) <= met.turn) {
                way.lumps.pop_back();  // the last entry repeats the first
                way.end = End::start;
                return way;
            }
            if (!std::isfinite(met.turn)) return way;
            way.centre = met.centre;
            if (met.ceiling || met.floor) {
                way.end = met.ceiling ? End::ceiling : End::floor;
                return way;
            }
            from = on;
            on = met.lump;
            way.lumps.push_back(on);
        }
        return way;
    }

    static constexpr double least_turn = 1e-9;  // rad

    const std::vector<Lump>& lumps_;
    double probe_, longest_ = 0.0;  // m
    CellGrid grid_;
};

/// Height of the face of a platen that touches the specimen, m: the upper face of the lower platen, and vice versa.
double face_of(const World& world, BodyIndex platen, bool lower) {
    const BodyInfo info = world.bodies.info(platen);
    double face = lower ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    for (std::uint32_t e = info.first_element; e < info.first_element + info.element_count; ++e) {
        const double y = world.bodies.elements[e].y;
        face = lower ? std::max(face, y) : std::min(face, y);
    }
    return world.bodies.state[platen].y + face;
}

MembranePoint point_of(const Lump& lump) { return {lump.body, lump.x, lump.y, 0.0}; }

MembranePoint on_platen(const World& world, BodyIndex platen, Vec2 place) {
    const BodyState& body = world.bodies.state[platen];
    return {platen, place.x - body.x, place.y - body.y, 0.0};
}

/// Membrane points of one side of the specimen, from the lower platen upwards; empty if the disc can pass through.
std::vector<MembranePoint> side(const World& world, bool mirrored) {
    const Membrane& membrane = world.membrane;
    const std::vector<Lump> lumps = lumps_of(world, membrane.probe, mirrored);
    if (lumps.empty()) return {};
    const double floor = face_of(world, membrane.bottom, true), ceiling = face_of(world, membrane.top, false);
    const std::vector<std::size_t> way = Walk(lumps, membrane.probe).from_floor(floor, ceiling);
    if (way.empty()) return {};
    const auto x_of = [&](std::size_t k) { return mirrored ? -lumps[k].at.x : lumps[k].at.x; };
    const double probe = 2.0 * membrane.probe;
    std::vector<MembranePoint> points{on_platen(world, membrane.bottom, {x_of(way.front()), floor})};
    double before = 0.0;  // m, radius of the previous lump
    for (std::size_t n = 0; n < way.size(); ++n) {
        points.push_back(point_of(lumps[way[n]]));
        points.back().longest = before + lumps[way[n]].radius + probe;
        before = lumps[way[n]].radius;
    }
    points.push_back(on_platen(world, membrane.top, {x_of(way.back()), ceiling}));
    points.back().longest = before + probe;
    return points;
}

/// The points in reverse order; each piece keeps its `longest` value.
std::vector<MembranePoint> reversed(std::vector<MembranePoint> points) {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) points[k].longest = points[k + 1].longest;
    std::ranges::reverse(points);
    return points;
}

bool find_points(World& world) {
    Membrane& membrane = world.membrane;
    if (membrane.top == no_body) {
        const std::vector<Lump> lumps = lumps_of(world, membrane.probe, false);
        if (lumps.empty()) return false;
        const std::vector<std::size_t> way = Walk(lumps, membrane.probe).around();
        if (way.size() < 3) return false;
        membrane.points.clear();
        for (std::size_t n = 0; n < way.size(); ++n) {
            const Lump &lump = lumps[way[n]], &before = lumps[way[(n + way.size() - 1) % way.size()]];
            membrane.points.push_back(point_of(lump));
            membrane.points.back().longest = before.radius + lump.radius + 2.0 * membrane.probe;
        }
        return true;
    }
    std::vector<MembranePoint> left = side(world, false), right = side(world, true);
    if (left.empty() || right.empty()) return false;
    right = reversed(std::move(right));
    membrane.left_end = left.size();
    membrane.points = std::move(left);
    membrane.points.insert(membrane.points.end(), right.begin(), right.end());
    return true;
}

void wrap_membrane(World& world) {
    Membrane& membrane = world.membrane;
    const double before = membrane.known ? membrane_area(world) : 0.0;
    if (membrane.known) {  // account for the work of the old chain up to now
        const double work = -membrane.pressure * (before - membrane.area);
        membrane.work += work;
        world.account.force_work += work;
        membrane.area = before;
    }
    membrane.list_builds = world.list.builds;
    membrane.parted = false;
    if (!find_points(world)) {
        ++membrane.open;
        return;
    }
    ++membrane.wrapped;
    const double area = membrane_area(world);
    if (membrane.known) membrane.jumped += area - before;
    membrane.area = area;
}

}  // namespace

void update_membrane(World& world) {
    const Membrane& membrane = world.membrane;
    if (membrane.parted || membrane.list_builds != world.list.builds) wrap_membrane(world);
}

void add_membrane(World& world, double pressure, double probe, BodyIndex bottom, BodyIndex top) {
    Membrane& membrane = world.membrane;
    membrane = {};
    membrane.pressure = pressure;
    membrane.probe = probe;
    membrane.bottom = bottom;
    membrane.top = top;
    wrap_membrane(world);
    if (membrane.points.empty()) {
        throw InputError(fmt::format(
            "membrane: found gaps that let a disc of radius {:.3g} m pass through the specimen, expected sides that "
            "are closed to it; pack the specimen more densely",
            probe));
    }
    velocities_changed(world);
}

}  // namespace crackle
