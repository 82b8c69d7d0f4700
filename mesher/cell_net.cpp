// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/cell_net.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/inset.hpp"

namespace crackle {
namespace {

// Smallest sine of the turning angle at a corner of a convex cell.
constexpr double least_turn = 1e-3;

double turn(Point a, Point b, Point c) { return cross(Point{b.x - a.x, b.y - a.y}, Point{c.x - b.x, c.y - b.y}); }

}  // namespace

int CellNet::corner_at(Point p) {
    const auto [found, is_new] = numbers_.try_emplace({p.x, p.y}, static_cast<int>(places_.size()));
    if (is_new) {
        places_.push_back(p);
        around_.emplace_back();
    }
    return found->second;
}

int CellNet::add(Loop made) {
    const int number = static_cast<int>(loops_.size());
    for (const int corner : made.corners) around_[static_cast<std::size_t>(corner)].insert(number);
    loops_.push_back(std::move(made));
    each_square(box_of(loops_.back()),
                [&](std::int64_t i, std::int64_t j) { cells_at_.add(i, j, static_cast<std::size_t>(number)); });
    return number;
}

CellNet::Box CellNet::box_of(const Loop& l) const {
    Box box{place(l.corners[0]), place(l.corners[0])};
    for (const int corner : l.corners) {
        const Point p = place(corner);
        box.first = {std::min(box.first.x, p.x), std::min(box.first.y, p.y)};
        box.second = {std::max(box.second.x, p.x), std::max(box.second.y, p.y)};
    }
    return {{box.first.x - margin_, box.first.y - margin_}, {box.second.x + margin_, box.second.y + margin_}};
}

std::set<int> CellNet::cells_near(const Box& box) const {
    std::set<int> cells;
    each_square(box, [&](std::int64_t i, std::int64_t j) {
        cells_at_.each_at(i, j, [&](std::size_t cell) { cells.insert(static_cast<int>(cell)); });
    });
    return cells;
}

void CellNet::replace(int cell, Loop made) {
    for (const int corner : loop(cell).corners) around_[static_cast<std::size_t>(corner)].erase(cell);
    for (const int corner : made.corners) around_[static_cast<std::size_t>(corner)].insert(cell);
    loop(cell) = std::move(made);
}

void CellNet::insert_into(int u, int v, int corner) {
    const std::set<int> cells = around(u);
    for (const int cell : cells) {
        Loop made = loop(cell);
        for (std::size_t k = 0; k < made.size(); ++k) {
            const int a = made.corners[k], b = made.corners[made.next(k)];
            if (!((a == u && b == v) || (a == v && b == u))) continue;
            const auto at = static_cast<std::ptrdiff_t>(k) + 1;
            made.corners.insert(made.corners.begin() + at, corner);
            made.traces.insert(made.traces.begin() + at, made.traces[k]);
            replace(cell, std::move(made));
            break;
        }
    }
}

bool CellNet::on_trace(int corner) const {
    for (const int cell : around(corner)) {
        const Loop& l = loop(cell);
        for (std::size_t k = 0; k < l.size(); ++k)
            if ((l.corners[k] == corner || l.corners[l.next(k)] == corner) && l.traces[k] >= 0) return true;
    }
    return false;
}

bool CellNet::move_to(int corner, Point target) {
    const Point before = place(corner);
    places_[static_cast<std::size_t>(corner)] = target;
    for (const int cell : around(corner)) {
        if (convex(loop(cell))) continue;
        places_[static_cast<std::size_t>(corner)] = before;
        return false;
    }
    return true;
}

bool CellNet::inside(const Loop& l, Point p) const {
    for (std::size_t k = 0; k < l.size(); ++k)
        if (turn(place(l.corners[k]), place(l.corners[l.next(k)]), p) < 0.0) return false;
    return true;
}

bool CellNet::convex(const Loop& l) const {
    double turned_forward = 0.0;
    for (std::size_t k = 0; k < l.size(); ++k) {
        const Point a = place(l.corners[l.before(k)]), b = place(l.corners[k]), c = place(l.corners[l.next(k)]);
        const double lengths = distance(a, b) * distance(b, c), turned = turn(a, b, c);
        const bool ahead = dot(Point{b.x - a.x, b.y - a.y}, Point{c.x - b.x, c.y - b.y}) > 0.0;
        const bool flat = ahead && std::abs(turned) <= near_ * distance(a, c);
        if (lengths == 0.0 || (!flat && turned < least_turn * lengths)) return false;
        turned_forward += turned;
    }
    return turned_forward > 0.0;
}

double CellNet::area(const Loop& l) const {
    std::vector<Point> outline;
    outline.reserve(l.size());
    for (const int corner : l.corners) outline.push_back(place(corner));
    return polygon_area(outline);
}

Loop CellNet::together(const Loop& a, const Loop& b) {
    std::map<std::pair<int, int>, std::size_t> of_b;
    for (std::size_t k = 0; k < b.size(); ++k) of_b[{b.corners[b.next(k)], b.corners[k]}] = k;
    std::vector<char> shared(a.size(), 0);
    for (std::size_t k = 0; k < a.size(); ++k) {
        const auto found = of_b.find({a.corners[k], a.corners[a.next(k)]});
        if (found == of_b.end()) continue;
        if (a.traces[k] >= 0) return {};
        shared[k] = 1;
    }
    Loop made;
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (shared[a.before(k)] == 0 || shared[k] != 0) continue;  // find the first edge after the shared ones
        if (!made.corners.empty()) return {};                      // the cells share two separate chains of edges
        std::size_t i = k;
        for (; shared[i] == 0; i = a.next(i)) {
            made.corners.push_back(a.corners[i]);
            made.traces.push_back(a.traces[i]);
        }
        const int turning = a.corners[i], end = a.corners[k];
        auto j = static_cast<std::size_t>(std::find(b.corners.begin(), b.corners.end(), turning) - b.corners.begin());
        for (; b.corners[j] != end; j = b.next(j)) {
            made.corners.push_back(b.corners[j]);
            made.traces.push_back(b.traces[j]);
        }
    }
    return made;
}

Loop CellNet::part_of(const Loop& l, std::size_t begin, std::size_t end) {
    Loop made;
    made.centre = l.centre;
    for (std::size_t k = begin; k != end; k = l.next(k)) {
        made.corners.push_back(l.corners[k]);
        made.traces.push_back(l.traces[k]);
    }
    made.corners.push_back(l.corners[end]);
    made.traces.push_back(-1);
    return made;
}

template <class Use>
void CellNet::each_union(int piece, Use use) const {
    const Loop& l = loop(piece);
    for (std::size_t k = 0; k < l.size(); ++k) {
        const int u = l.corners[k], v = l.corners[l.next(k)];
        if (l.traces[k] >= 0) continue;
        for (const int cell : around(u)) {
            if (cell == piece || !around(v).contains(cell)) continue;
            Loop both = together(l, loop(cell));
            if (both.size() >= 3) use(cell, both, distance(place(u), place(v)));
        }
    }
}

int CellNet::join(int piece) {
    double longest = 0.0;
    Loop best;
    int best_cell = -1;
    each_union(piece, [&](int cell, Loop& both, double length) {
        if (length <= longest || !convex(both)) return;
        best = std::move(both);
        best_cell = cell;
        longest = length;
    });
    if (best_cell < 0) return -1;
    best.centre = loop(best_cell).centre;
    replace(best_cell, std::move(best));
    replace(piece, {});
    return best_cell;
}

bool CellNet::divide_again(int piece, double least_area) {
    double largest = least_area;
    Loop own, others;
    int best_cell = -1;
    each_union(piece, [&](int cell, const Loop& both, double /*length*/) {
        for (std::size_t j = 2; j < both.size(); ++j) {
            for (std::size_t i = 0; i + 1 < j; ++i) {
                Loop one = part_of(both, i, j), other = part_of(both, j, i);
                if (std::min(one.size(), other.size()) < 3 || !convex(one) || !convex(other)) continue;
                const double smaller = std::min(area(one), area(other));
                if (smaller <= largest) continue;
                largest = smaller;
                best_cell = cell;
                own = std::move(one);
                others = std::move(other);
            }
        }
    });
    if (best_cell < 0) return false;
    own.centre = loop(piece).centre;
    others.centre = loop(best_cell).centre;
    replace(piece, std::move(own));
    replace(best_cell, std::move(others));
    return true;
}

}  // namespace crackle
