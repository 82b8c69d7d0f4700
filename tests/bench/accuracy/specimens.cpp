// SPDX-License-Identifier: GPL-3.0-or-later
// Work-precision studies of strength: packed specimens in tension, for several time steps, loading rates and rate
// tolerances. Means over packings are compared, since single peaks depend on the order in which bonds happen to break.
// Tested by tests/bench_tests/commands/bench_test.cpp.

#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "tests/bench/accuracy/accuracy.hpp"
#include "tests/bench/verify/scenes/packed_case.hpp"

namespace crackle::accuracy {
namespace {

struct Setting {
    const char* kind;  // circles, delaunay, voronoi
    SegmentLaw law;
    Integrator integrator;
    double step_share;
    double rate;       // strain rate, 1/s; has no effect if `tolerance` is positive
    double tolerance;  // rate tolerance; 0 for loading at `rate`
};

VirtualTest prepared(const Setting& s, std::int64_t seed, bool quick) {
    ResolvedCase test = verification::packed_case(seed, LoadingKind::tension, s.rate, 0.01);
    test.packing()->box = parts::CircleCount{quick ? 30 : 100, 2.0};
    if (s.tolerance > 0.0) {
        test.loading.rate = parts::RateTolerance{s.tolerance};
    }
    if (std::strcmp(s.kind, "circles") != 0) {
        verification::mesh_voronoi(test);
        test.mesh->kind = from_name<MeshKind>(s.kind).value();
    }
    test.numerics.contact_law = s.law;
    test.numerics.integrator = s.integrator;
    test.numerics.safety_factor = s.step_share;
    return prepare_test(test);
}

struct Peaks {
    std::vector<double> stress;  // peak stress of each packing, N/m
    double cpu_seconds = 0.0;
};

/// Varied values, from coarse to fine. Each time step is compared with half the finest step, at the slowest rate. Each
/// rate or tolerance is compared with a quarter of the slowest rate, at the coarsest step.
struct Sweep {
    std::vector<double> steps, rates, tolerances;
    int packings;
};

Sweep sweep_for(SegmentLaw law, bool circles, bool quick) {
    if (quick) return {{0.8, 0.4}, {0.4, 0.2}, {0.05}, 1};
    // A time step under the guide's law takes many times as long.
    if (law != SegmentLaw::rounded) return {{0.8, 0.4}, {0.4, 0.2, 0.1}, {}, 2};
    std::vector<double> rates{0.4, 0.2, 0.1, 0.05, 0.025};
    // Waves travel more slowly in circle packings, so slower rates are needed.
    if (circles) rates = {0.08, 0.04, 0.02, 0.01, 0.005, 0.0025};
    return {{0.8, 0.4, 0.2}, rates, {0.1, 0.03, 0.01, 0.003}, 4};
}

Peaks measure(const Setting& setting, int packings, bool quick) {
    Peaks peaks;
    for (std::int64_t seed = 1; seed <= packings; ++seed) {
        const VirtualTest start = prepared(setting, seed, quick);
        double peak = 0.0;
        peaks.cpu_seconds += median_cpu_seconds([&] {
            VirtualTest test = start;
            load_specimen(test);
            peak = test.state.failure.largest_stress;
        });
        peaks.stress.push_back(peak);
    }
    return peaks;
}

double distance(const Peaks& got, const Peaks& best) {
    double sum = 0.0;
    for (std::size_t k = 0; k < best.stress.size(); ++k) sum += std::abs(got.stress[k] / best.stress[k] - 1.0);
    return sum / static_cast<double>(best.stress.size());
}

std::vector<AccuracyRow> peak_stress(const char* study, const char* kind, bool quick) {
    std::vector<AccuracyRow> rows;
    for (const SegmentLaw law : {SegmentLaw::rounded, SegmentLaw::demseg}) {
        if (law != SegmentLaw::rounded && std::strcmp(kind, "circles") == 0) continue;  // laws are the same for circles
        const Sweep sweep = sweep_for(law, std::strcmp(kind, "circles") == 0, quick);
        const double coarsest = sweep.steps.front(), slowest = sweep.rates.back();
        const auto peaks = [&](Integrator integrator, double share, double rate, double tolerance) {
            return measure({kind, law, integrator, share, rate, tolerance}, sweep.packings, quick);
        };
        const Peaks fine = peaks(Integrator::leapfrog, 0.5 * sweep.steps.back(), slowest, 0.0);
        const Peaks slow = peaks(Integrator::leapfrog, coarsest, 0.25 * slowest, 0.0);
        for (const Integrator integrator : {Integrator::leapfrog, Integrator::consistent}) {
            if (law != SegmentLaw::rounded && integrator == Integrator::consistent) continue;
            const auto add = [&](const char* parameter, double value, const Peaks& got, const Peaks& best) {
                rows.push_back(
                    {study, name_of(law), name_of(integrator), parameter, value, got.cpu_seconds, distance(got, best)});
            };
            for (const double share : sweep.steps)
                add("time_step", share, peaks(integrator, share, slowest, 0.0), fine);
            for (const double rate : sweep.rates)
                add("axial_strain_rate", rate, peaks(integrator, coarsest, rate, 0.0), slow);
            if (integrator != Integrator::leapfrog) continue;
            for (const double tolerance : sweep.tolerances)
                add("rate_tolerance", tolerance, peaks(integrator, coarsest, 0.0, tolerance), slow);
        }
    }
    return rows;
}

}  // namespace

std::vector<AccuracyStudy> specimen_studies() {
    const char* error = "error of the peak stress";
    return {
        {"peak_circles", "Strength in tension: circles", error,
         [](bool quick) { return peak_stress("peak_circles", "circles", quick); }},
        {"peak_delaunay", "Strength in tension: Delaunay triangles", error,
         [](bool quick) { return peak_stress("peak_delaunay", "delaunay", quick); }},
        {"peak_voronoi", "Strength in tension: Voronoi cells", error,
         [](bool quick) { return peak_stress("peak_voronoi", "voronoi", quick); }},
    };
}

}  // namespace crackle::accuracy
