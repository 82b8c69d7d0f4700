// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/profile_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace crackle {
namespace {

struct PhaseName {
    const char* name;
    const char* meaning;
};

// Names and meanings, in the order of the enumerators of Phase.
constexpr std::array<PhaseName, phase_count> phase_names{{
    {"broad_phase", "finding pairs of nearby bodies, when the neighbour list is rebuilt"},
    {"listing", "listing the contact points of nearby bodies, with values carried over from the old list"},
    {"step_bound", "computing the bound on the stable time step, at rebuilds and when contacts form"},
    {"force", "geometry and forces of contact points; one call per block of points"},
    {"gather", "adding the forces of each block to its bodies"},
    {"bookkeeping", "recording bond breakage, losses and the work of driven bodies"},
    {"integrate", "updating velocities and positions (kick and drift)"},
    {"observe", "recording curve rows, bond breakage and the peak"},
    {"write", "writing files and waiting for frames that another thread draws"},
    {"check", "checking that the run is valid"},
    {"rate", "adapting the platen speed to the error tolerance"},
}};

}  // namespace

ProfileFigures profile_report(const Profile& profile, std::int64_t particles, std::int64_t steps, double step_seconds) {
    const double sampled = profile.geometry_sampled.seconds;
    // Timing samples are only taken in a profiled run, so their cost is subtracted.
    const double total = step_seconds - sampled;
    const double particle_steps = static_cast<double>(particles) * static_cast<double>(steps);
    const auto point_steps = static_cast<double>(profile.point_steps);
    ProfileFigures report{total,
                          steps,
                          profile.force_passes,
                          point_steps / particle_steps,
                          1e9 * profile.of(Phase::force).seconds / std::max(1.0, point_steps),
                          {}};
    std::vector<PhaseFigures>& rows = report.phases.begin_table();
    const auto add = [&](const char* name, const char* meaning, double seconds, std::int64_t calls) {
        rows.push_back({name, seconds, seconds / total, calls, 1e9 * seconds / particle_steps, meaning});
    };
    double named = 0.0;
    for (std::size_t p = 0; p < phase_count; ++p) {
        const Profile::Spent& spent = profile.phases[p];
        add(phase_names[p].name, phase_names[p].meaning, spent.seconds, spent.calls);
        named += spent.seconds;
        if (static_cast<Phase>(p) != Phase::force) continue;
        const auto samples = static_cast<double>(profile.geometry_sampled.calls);
        add("  narrow_phase", "part of `force` spent on geometry, estimated by sampling",
            samples > 0.0 ? sampled / samples * static_cast<double>(profile.force_passes) : 0.0,
            profile.geometry_sampled.calls);
    }
    add("rest", "time outside the other phases", total - named, 0);
    return report;
}

std::string profile_table(const ProfileFigures& report) {
    std::string text = fmt::format(
        "  where the time went: {:.3g} s in the stepping loop, {} steps, {:.3g} listed contact points per particle, "
        "{:.3g} ns per point\n  {:<16}{:>10}{:>8}{:>10}{:>14}\n",
        report.step_seconds.or_nan(), report.steps.value_or(0), report.points_per_particle.or_nan(),
        report.force_ns_per_point.or_nan(), "phase", "seconds", "share", "calls", "ns/particle");
    for (const PhaseFigures& row : *report.phases) {
        text += fmt::format("  {:<16}{:>10.4f}{:>7.1f}%{:>10}{:>14.2f}  {}\n", row.phase.value_or(""),
                            row.seconds.or_nan(), 100.0 * row.share.or_nan(), row.calls.value_or(0),
                            row.ns_per_particle_step.or_nan(), row.meaning.value_or(""));
    }
    return text;
}

}  // namespace crackle
