// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/minerals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "solver/base/errors.hpp"
#include "solver/files/file_kind.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/table_reader.hpp"
#include "specimens/making/label_image.hpp"

namespace crackle {
namespace {

using Minerals = std::vector<std::size_t>;  // index of the mineral of each grain

/// Pseudo-random hash of an integer (the finaliser of SplitMix64).
std::uint64_t scattered(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

/// Visits the grains in a pseudo-random order that depends only on seed and ids. Each grain gets the mineral with the
/// largest missing area. No fraction then deviates by more than one grain, because a mineral gets a grain only while
/// area is missing.
Minerals drawn(const Scene& scene, std::int64_t case_seed, const std::vector<double>& areas,
               std::vector<double> lacking) {
    const std::uint64_t seed = scattered(static_cast<std::uint64_t>(case_seed));
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    for (std::size_t b = 0; b < areas.size(); ++b)
        order.emplace_back(scattered(seed ^ static_cast<std::uint64_t>(scene.bodies[b].id)), b);
    std::sort(order.begin(), order.end());
    Minerals minerals(areas.size());
    for (const auto& [key, b] : order) {
        const auto most = std::max_element(lacking.begin(), lacking.end());
        *most -= areas[b];
        minerals[b] = static_cast<std::size_t>(most - lacking.begin());
    }
    return minerals;
}

/// Assigns the first mineral to the largest grains, the next to smaller ones, and so on. A grain is assigned by the
/// middle of its area, so no boundary between minerals deviates by more than half a grain.
Minerals by_size(const Scene& scene, const std::vector<double>& areas, const std::vector<double>& asked) {
    std::vector<std::size_t> order(areas.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return areas[a] != areas[b] ? areas[a] > areas[b] : scene.bodies[a].id < scene.bodies[b].id;
    });
    Minerals minerals(areas.size());
    std::size_t mineral = 0;
    double filled = 0.0, border = asked[0];
    for (const std::size_t b : order) {
        while (mineral + 1 < asked.size() && filled + 0.5 * areas[b] > border) border += asked[++mineral];
        minerals[b] = mineral;
        filled += areas[b];
    }
    return minerals;
}

std::vector<std::string> names_of(const parts::Minerals& asked) {
    std::vector<std::string> names;
    names.reserve(asked.list.size());
    for (const parts::Mineral& m : asked.list) names.push_back(m.name);
    return names;
}

/// Index of a mineral given by name or by one-based number. The number of minerals if there is no such mineral.
std::size_t mineral_called(const std::vector<std::string>& names, const std::string& label) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(label.data(), label.data() + label.size(), number);
    if (error == std::errc() && end == label.data() + label.size() && number >= 1 && number <= names.size())
        return number - 1;
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), label) - names.begin());
}

Minerals read_labels(const std::filesystem::path& file, const std::vector<std::string>& names, const Places& places,
                     std::size_t grains) {
    if (!is_there(file)) {
        throw InputError(fmt::format("{}: found no file {}, expected labels; check the path",
                                     places.at(CaseKey::minerals_labels), file.string()));
    }
    const std::string text = read_text(file, most_bytes_of_table);
    refuse_foreign(file.string(), text, "a list of labels: one line per grain with the name or number of a mineral");
    Minerals minerals;
    TableReader labels(file.string(), text, TableReader::Form::words);
    while (labels.next()) {
        const std::string label(labels.values().front());
        minerals.push_back(mineral_called(names, label));
        if (minerals.back() < names.size()) continue;
        throw InputError(fmt::format("{}:{}: label: found \"{:.40}\", expected a mineral: {}, or a number from 1",
                                     file.string(), labels.line(), label, fmt::join(names, ", ")));
    }
    if (minerals.size() != grains) {
        throw InputError(
            fmt::format("{}: found {} labels in {}, expected {}, one per grain in the order of the "
                        "grains in the specimen file; correct the file",
                        places.at(CaseKey::minerals_labels), minerals.size(), file.string(), grains));
    }
    return minerals;
}

// Relative difference between pixel width and height above which the image is probably distorted by mistake.
constexpr double stretch_to_mention = 0.02;

Minerals read_image(const Scene& scene, const parts::GrainImage& asked, const std::vector<std::string>& names,
                    const Places& places, std::vector<std::string>& notices) {
    const LabelImage image(asked.path, asked.colours, names, places.at(CaseKey::minerals_image));
    const Domain& domain = scene.domain;
    const double stretch = (domain.y2 - domain.y1) / image.height() / ((domain.x2 - domain.x1) / image.width()) - 1.0;
    if (std::abs(stretch) > stretch_to_mention) {
        notices.push_back(fmt::format(
            "{} of {} x {} pixels is stretched over the box of {:.4g} m x {:.4g} m: a pixel is {:.3g} times as high "
            "as wide",
            asked.name, image.width(), image.height(), domain.x2 - domain.x1, domain.y2 - domain.y1, 1.0 + stretch));
    }
    Minerals minerals;
    for (const Body& body : scene.bodies) minerals.push_back(image.label_of(scene, body));
    return minerals;
}

Minerals minerals_of(const Scene& scene, const parts::Minerals& asked, const Places& places,
                     const std::vector<double>& areas, const std::vector<double>& asked_areas,
                     std::vector<std::string>& notices) {
    if (const auto* labels = std::get_if<parts::GrainLabels>(&asked.assign))
        return read_labels(labels->path, names_of(asked), places, areas.size());
    if (const auto* image = std::get_if<parts::GrainImage>(&asked.assign))
        return read_image(scene, *image, names_of(asked), places, notices);
    if (const auto* random = std::get_if<parts::RandomGrains>(&asked.assign))
        return drawn(scene, random->seed, areas, asked_areas);
    return by_size(scene, areas, asked_areas);
}

}  // namespace

std::vector<MineralShare> assign_minerals(Scene& scene, const parts::Minerals& asked, const Places& places,
                                          std::vector<std::string>& notices) {
    std::vector<double> areas;
    for (const Body& body : scene.bodies) {
        const double density = scene.materials[static_cast<std::size_t>(body.material)].density;
        areas.push_back(mass_properties(scene, body).mass / density);
    }
    const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
    std::vector<double> asked_areas;
    asked_areas.reserve(asked.list.size());
    for (const parts::Mineral& m : asked.list) asked_areas.push_back(all * m.share);
    const Minerals minerals = minerals_of(scene, asked, places, areas, asked_areas, notices);

    std::vector<MineralShare> shares;
    for (const parts::Mineral& m : asked.list) {
        std::optional<double> share = m.asked;
        if (!share && asked.by_share()) share = all * m.share / all;
        shares.push_back({m.name, share, 0.0, 0});
    }
    for (std::size_t b = 0; b < minerals.size(); ++b) {
        scene.bodies[b].material = static_cast<int>(minerals[b]);
        shares[minerals[b]].reached += areas[b] / all;
        ++shares[minerals[b]].grains;
    }
    // Only differences larger than the largest grain are reported; they occur with labels and images.
    const double grain = *std::max_element(areas.begin(), areas.end()) / all;
    for (const MineralShare& m : shares) {
        if (m.grains == 0) notices.push_back(fmt::format("no grain is made of {}", m.name));
        if (m.asked && std::abs(m.reached - *m.asked) > grain)
            notices.push_back(
                fmt::format("{} has {:.3g} of the grain area; the case requests {:.3g}", m.name, m.reached, *m.asked));
    }
    return shares;
}

std::string mineral_shares_text(const std::vector<MineralShare>& shares) {
    std::vector<std::string> parts;
    parts.reserve(shares.size());
    for (const MineralShare& m : shares) {
        parts.push_back(fmt::format("{} {:.4g} of the area{} in {} grains", m.name, m.reached,
                                    m.asked ? fmt::format(" (asked {:.4g})", *m.asked) : "", m.grains));
    }
    return fmt::format("minerals: {}", fmt::join(parts, ", "));
}

}  // namespace crackle
