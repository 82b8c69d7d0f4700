// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/neighbours/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/geometry/geometry.hpp"
#include "solver/neighbours/cell_grid.hpp"

namespace crackle {
namespace {

struct Box {
    Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
    void add(Vec2 p, double margin) {
        low = {std::min(low.x, p.x - margin), std::min(low.y, p.y - margin)};
        high = {std::max(high.x, p.x + margin), std::max(high.y, p.y + margin)};
    }
};

Box bounding_box(const World& world, std::size_t b) {
    const BodyState& body = world.bodies.state[b];
    const BodyInfo info = world.bodies.info(b);
    const BodyView bodies(world);
    Box box;
    for (std::uint32_t e = 0; e < info.element_count; ++e) {
        const Element element = element_of(bodies, b, info.first_element + e);
        box.add(centre_of(body) + turned(body, element), info.piece_count > 0 ? 0.0 : element.radius);
    }
    return box;
}

/// Grid with cells about as large as a body. Cells are larger if few bodies are spread over a wide area, so that memory
/// stays proportional to the number of bodies.
CellLayout layout_for(const World& world) {
    Box box;
    double mean_reach = 0.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        box.add(centre_of(world.bodies.state[b]), 0.0);
        mean_reach += world.bodies.info(b).reach;
    }
    const auto n = static_cast<double>(world.bodies.size());
    const double width = box.high.x - box.low.x, height = box.high.y - box.low.y;
    const double size = std::max({2.0 * mean_reach / n, std::sqrt(width * height / (2.0 * n + 64.0)),
                                  std::max(width, height) / (2.0 * n + 64.0)});
    return {box.low, 1.0 / size, 1.0 / size, static_cast<std::size_t>(width / size) + 1,
            static_cast<std::size_t>(height / size) + 1};
}

/// Bounding radii in descending order, m, followed by 0. The search for a pair starts at its larger body. It therefore
/// extends only as far as required by the bounding radius of the next smaller body.
std::vector<double> reaches_by_rank(const World& world) {
    std::vector<double> reaches(world.bodies.size() + 1, 0.0);
    for (std::size_t b = 0; b < world.bodies.size(); ++b) reaches[world.list.size_rank[b]] = world.bodies.info(b).reach;
    return reaches;
}

}  // namespace

std::vector<std::uint64_t> near_pairs(const World& world) {
    const PhaseTimer timer(world.workers.profile, Phase::broad_phase);
    const CellGrid grid(layout_for(world), world.bodies.size(),
                        [&](std::size_t b) { return centre_of(world.bodies.state[b]); });
    const auto& own = world.list.own_half_skins;
    const double widest = own.empty() ? world.list.half_skin : *std::ranges::max_element(own);
    const std::vector<double> reaches = reaches_by_rank(world);
    std::vector<std::uint64_t> pairs;
    pairs.reserve(4 * world.bodies.size());
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const Box box = bounding_box(world, b);
        const std::uint32_t rank = world.list.size_rank[b];
        const double margin = reaches[rank + 1] + world.settings.thick + world.list.half_skin_of(b) + widest;
        Box search;
        search.add(box.low, margin);
        search.add(box.high, margin);
        const BodyState& body = world.bodies.state[b];
        const std::size_t left = grid.column(search.low.x), right = grid.column(search.high.x);
        const std::size_t low = grid.row(search.low.y), high = grid.row(search.high.y);
        grid.visit(left, right, low, high, [&](BodyIndex other) {
            const std::uint32_t rank_of_other = world.list.size_rank[other];
            if (rank_of_other <= rank) return;
            const BodyState& partner = world.bodies.state[other];
            const double reach =
                reaches[rank_of_other] + world.settings.thick + skin_between(world, static_cast<BodyIndex>(b), other);
            const double dx = partner.x - body.x, dy = partner.y - body.y;
            const double limit = reaches[rank] + reach;
            if (dx * dx + dy * dy > limit * limit) return;
            const double bx = std::max({box.low.x - partner.x, partner.x - box.high.x, 0.0});
            const double by = std::max({box.low.y - partner.y, partner.y - box.high.y, 0.0});
            if (bx * bx + by * by > reach * reach) return;
            const auto self = static_cast<std::uint64_t>(b);
            pairs.push_back(self < other ? (self << 32) | other : (static_cast<std::uint64_t>(other) << 32) | self);
        });
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace crackle
