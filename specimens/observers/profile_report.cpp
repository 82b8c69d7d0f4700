// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/profile_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace crackle {
namespace {

struct PhaseName {
    const char* name;
    const char* meaning;
};

// In the order of Phase.
constexpr std::array<PhaseName, phase_count> phase_names{{
    {"broad_phase", "rebuilds: pairs of bodies that come near each other"},
    {"listing", "rebuilds: their contact points, with what the old list remembers"},
    {"step_bound", "bound on the stable step, at rebuilds and new contacts"},
    {"force", "contact points: geometry and force, by blocks"},
    {"gather", "the blocks' forces added to their bodies"},
    {"bookkeeping", "breaks, losses, driven bodies"},
    {"integrate", "kick and drift"},
    {"observe", "curve rows, breaks, peak"},
    {"write", "files; waiting for frames, which another thread draws"},
    {"check", "health of the run"},
    {"rate", "platen speed, loading by tolerance"},
}};

}  // namespace

nlohmann::ordered_json profile_report(const Profile& profile, std::int64_t particles, std::int64_t steps,
                                      double step_seconds) {
    const double sampled = profile.geometry_sampled.seconds;
    // The samples are no part of a run without a profile.
    const double total = step_seconds - sampled;
    const double particle_steps = static_cast<double>(particles) * static_cast<double>(steps);
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    const auto add = [&](const char* name, const char* meaning, double seconds, std::int64_t calls) {
        rows.push_back({{"phase", name},
                        {"seconds", seconds},
                        {"share", seconds / total},
                        {"calls", calls},
                        {"ns_per_particle_step", 1e9 * seconds / particle_steps},
                        {"meaning", meaning}});
    };
    double named = 0.0;
    for (std::size_t p = 0; p < phase_count; ++p) {
        const Profile::Spent& spent = profile.phases[p];
        add(phase_names[p].name, phase_names[p].meaning, spent.seconds, spent.calls);
        named += spent.seconds;
        if (static_cast<Phase>(p) != Phase::force) continue;
        const auto samples = static_cast<double>(profile.geometry_sampled.calls);
        add("  narrow_phase", "of that the geometry alone, sampled",
            samples > 0.0 ? sampled / samples * static_cast<double>(profile.force_passes) : 0.0,
            profile.geometry_sampled.calls);
    }
    add("rest", "between the phases", total - named, 0);
    return {{"step_seconds", total},
            {"steps", steps},
            {"force_passes", profile.force_passes},
            {"points_per_particle", static_cast<double>(profile.point_steps) / particle_steps},
            {"force_ns_per_point", 1e9 * profile.of(Phase::force).seconds /
                                       static_cast<double>(std::max<std::int64_t>(1, profile.point_steps))},
            {"phases", rows}};
}

std::string profile_table(const nlohmann::ordered_json& report) {
    std::string text = fmt::format(
        "  where the time went: {:.3g} s of stepping, {} steps, {:.3g} listed contact points a particle, {:.3g} ns a "
        "point\n  {:<16}{:>10}{:>8}{:>10}{:>14}\n",
        report["step_seconds"].get<double>(), report["steps"].get<std::int64_t>(),
        report["points_per_particle"].get<double>(), report["force_ns_per_point"].get<double>(), "phase", "seconds",
        "share", "calls", "ns/particle");
    for (const auto& row : report["phases"]) {
        text += fmt::format("  {:<16}{:>10.4f}{:>7.1f}%{:>10}{:>14.2f}  {}\n", row["phase"].get<std::string>(),
                            row["seconds"].get<double>(), 100.0 * row["share"].get<double>(),
                            row["calls"].get<std::int64_t>(), row["ns_per_particle_step"].get<double>(),
                            row["meaning"].get<std::string>());
    }
    return text;
}

}  // namespace crackle
