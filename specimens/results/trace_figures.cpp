// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/trace_figures.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "specimens/measures/trace_motion.hpp"

namespace crackle {
namespace {

JointMotion motion_of(const TraceMotion& motion) {
    const auto mean = [&](double value) { return motion.length > 0.0 ? value : NAN; };
    return {motion.failed / motion.bonded, mean(motion.opening), mean(motion.slip), mean(motion.largest_opening),
            mean(motion.largest_slip)};
}

}  // namespace

JointedFigures trace_figures(const BondRecord& bonds, const TestState& state, const World& world) {
    const std::vector<Crack>& cracks = state.history.cracks;
    const bool has_peak = state.failure.peak_row >= 0;
    const auto to_peak = static_cast<std::size_t>(state.breaks_in_shear_to_peak + state.breaks_in_tension_to_peak);
    const auto cracks_to_peak = std::span(cracks).first(to_peak);
    const std::int64_t on_traces = breaks_on_traces(bonds, cracks);
    const std::int64_t on_traces_to_peak = breaks_on_traces(bonds, cracks_to_peak);
    const auto entry = [&](const std::string& source, double length, const TraceMotion& peak, const TraceMotion& end) {
        const auto at_peak = has_peak ? std::optional(motion_of(peak)) : std::nullopt;
        return JointFigures{source,  length,         end.faces, end.length, end.bonded / end.length,
                            at_peak, motion_of(end), {}};
    };
    const std::vector<TraceMotion> at_end = trace_motions(bonds, places_of_faces(world, bonds), cracks);
    const std::vector<TraceMotion> at_peak =
        has_peak ? trace_motions(bonds, state.faces_at_peak, cracks_to_peak) : std::vector<TraceMotion>(at_end.size());
    std::vector<JointFigures> traces, sources;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < bonds.traces.size(); ++k) {
        const SpecimenTrace& trace = bonds.traces[k];
        traces.push_back(entry(trace.source, trace.length, at_peak[k], at_end[k]));
        if (std::ranges::find(names, trace.source) == names.end()) names.push_back(trace.source);
    }
    for (const std::string& name : names) {
        TraceMotion peak, end;
        double length = 0.0;
        std::int64_t count = 0;
        for (std::size_t k = 0; k < bonds.traces.size(); ++k) {
            if (bonds.traces[k].source != name) continue;
            ++count;
            length += bonds.traces[k].length;
            peak.add(at_peak[k]);
            end.add(at_end[k]);
        }
        sources.push_back(entry(name, length, peak, end));
        sources.back().traces = count;
    }
    return {on_traces,         std::ssize(cracks) - on_traces,
            on_traces_to_peak, static_cast<std::int64_t>(to_peak) - on_traces_to_peak,
            sources,           traces};
}

}  // namespace crackle
