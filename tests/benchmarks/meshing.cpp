// SPDX-License-Identifier: GPL-3.0-or-later
// Meshing against its yardstick: from random seeds to inset polygons, over CGAL's bare insertion of the same points.
// Both in turn, in processor time of the thread; `over_insertion` is the median of the pairs' quotients, whatever else
// the machine does. Arguments: seeds, gap in millionths of the mean spacing.

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <vector>

#include "mesher/mesher.hpp"

namespace crackle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;  // as the mesher's
using BarePoints = std::vector<Kernel::Point_2>;

constexpr Rectangle unit_square{0.0, 1.0, 0.0, 1.0};

/// Processor time of this thread so far, s.
double processor_time() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<Seed> random_seeds(std::int64_t count) {
    std::mt19937_64 random(1);
    const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<Seed> seeds(static_cast<std::size_t>(count));
    for (Seed& seed : seeds) {
        seed.x = uniform();
        seed.y = uniform();
    }
    return seeds;
}

double time_of_insertion(const BarePoints& points) {
    const double start = processor_time();
    CGAL::Delaunay_triangulation_2<Kernel> triangulation;
    triangulation.insert(points.begin(), points.end());  // along a space-filling curve
    benchmark::DoNotOptimize(triangulation.number_of_vertices());
    return processor_time() - start;
}

double time_of_meshing(const std::vector<Seed>& seeds, const MeshRequest& request) {
    const double start = processor_time();
    const Mesh mesh = make_mesh(seeds, unit_square, request);
    benchmark::DoNotOptimize(mesh.report);
    return processor_time() - start;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void run(benchmark::State& state, MeshKind kind) {
    const std::vector<Seed> seeds = random_seeds(state.range(0));
    BarePoints points;
    for (const Seed& seed : seeds) points.emplace_back(seed.x, seed.y);
    MeshRequest request;
    request.kind = kind;
    request.thick = 1e-6 * static_cast<double>(state.range(1)) / std::sqrt(static_cast<double>(seeds.size()));
    request.merge_destroyed = true;
    std::vector<double> insertion, meshing, quotient;
    for (auto _ : state) {
        insertion.push_back(time_of_insertion(points));
        meshing.push_back(time_of_meshing(seeds, request));
        quotient.push_back(meshing.back() / insertion.back());
        state.SetIterationTime(meshing.back());
    }
    const Mesh mesh = make_mesh(seeds, unit_square, request);
    state.counters["destroyed"] = static_cast<double>(mesh.report.cells_destroyed);
    state.counters["insertion_ms"] = 1e3 * median(insertion);
    state.counters["meshing_ms"] = 1e3 * median(meshing);
    state.counters["over_insertion"] = median(quotient);
}

void voronoi(benchmark::State& state) { run(state, MeshKind::voronoi); }
void delaunay(benchmark::State& state) { run(state, MeshKind::delaunay); }

void sizes(benchmark::internal::Benchmark* made) {
    made->ArgNames({"seeds", "gap"})->UseManualTime()->Unit(benchmark::kMillisecond);
    for (const int gap : {1000, 50000}) {
        for (const int seeds : {10'000, 100'000, 1'000'000}) made->Args({seeds, gap});
    }
}
BENCHMARK(voronoi)->Apply(sizes);
BENCHMARK(delaunay)->Apply(sizes);

}  // namespace
}  // namespace crackle

BENCHMARK_MAIN();
