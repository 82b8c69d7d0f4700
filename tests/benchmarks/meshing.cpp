// SPDX-License-Identifier: GPL-3.0-or-later
// Time of meshing, from random centres to inset polygons, compared with CGAL's insertion of the same points alone. Both
// run in turn; the processor time of the thread is measured. `over_insertion` is the median ratio of the pairs, so that
// other load on the machine matters little. `peak_MB` is the largest growth of the resident set while one mesh is made,
// including the mesh itself. `destroyed` is the number of cells that the inset destroys and that are merged.
//
// Jointed meshes have 50 traces, two sets of 25 through the whole square. `over_plain` is the median ratio of their
// time to that for the same centres without traces. Arguments: centres, gap in thousandths of the mean spacing.

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "mesher/mesher.hpp"

namespace crackle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;  // same kernel as the mesher
using BarePoints = std::vector<Kernel::Point_2>;

constexpr Rectangle unit_square{0.0, 1.0, 0.0, 1.0};

/// Processor time of this thread so far, s.
double processor_time() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<CellCentre> random_seeds(std::int64_t count) {
    std::mt19937_64 random(1);
    const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<CellCentre> centres(static_cast<std::size_t>(count));
    for (CellCentre& seed : centres) {
        seed.x = uniform();
        seed.y = uniform();
    }
    return centres;
}

double time_of_insertion(const BarePoints& points) {
    const double start = processor_time();
    CGAL::Delaunay_triangulation_2<Kernel> triangulation;
    triangulation.insert(points.begin(), points.end());  // along a space-filling curve
    benchmark::DoNotOptimize(triangulation.number_of_vertices());
    return processor_time() - start;
}

double time_of_meshing(const std::vector<CellCentre>& centres, const MeshRequest& request) {
    const double start = processor_time();
    const Mesh mesh = make_mesh(centres, unit_square, request);
    benchmark::DoNotOptimize(mesh.report);
    return processor_time() - start;
}

/// A value of /proc/self/status in kB; 0 if it is missing.
double status_value(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double value = 0.0;
        if (word == name + ":" && status >> value) return value;
    }
    return 0.0;
}

void report_one_mesh(benchmark::State& state, const std::vector<CellCentre>& centres, const MeshRequest& request) {
    malloc_trim(0);                               // memory freed by earlier meshes would hide the growth
    std::ofstream("/proc/self/clear_refs") << 5;  // resets the peak
    const double before = status_value("VmRSS");
    const Mesh mesh = make_mesh(centres, unit_square, request);
    state.counters["peak_MB"] = (status_value("VmHWM") - before) / 1024.0;
    state.counters["destroyed"] = static_cast<double>(mesh.report.cells_destroyed);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void run(benchmark::State& state, MeshKind kind) {
    const std::vector<CellCentre> centres = random_seeds(state.range(0));
    BarePoints points;
    for (const CellCentre& seed : centres) points.emplace_back(seed.x, seed.y);
    MeshRequest request;
    request.kind = kind;
    request.mesh_gap = 1e-3 * static_cast<double>(state.range(1)) / std::sqrt(static_cast<double>(centres.size()));
    request.merge_destroyed = true;
    std::vector<double> insertion, meshing, quotient;
    for (auto _ : state) {
        insertion.push_back(time_of_insertion(points));
        meshing.push_back(time_of_meshing(centres, request));
        quotient.push_back(meshing.back() / insertion.back());
        state.SetIterationTime(meshing.back());
    }
    report_one_mesh(state, centres, request);
    state.counters["insertion_ms"] = 1e3 * median(insertion);
    state.counters["meshing_ms"] = 1e3 * median(meshing);
    state.counters["over_insertion"] = median(quotient);
}

/// One centre in each square of a lattice, so that distances are like those in a packing.
std::vector<CellCentre> apart_seeds(int across) {
    std::mt19937_64 random(1);
    const auto offset = [&random] { return 0.5 + 0.4 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5); };
    std::vector<CellCentre> centres;
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) centres.push_back({(i + offset()) / across, (j + offset()) / across});
    return centres;
}

void run_jointed(benchmark::State& state, MeshKind kind) {
    const std::vector<CellCentre> centres = apart_seeds(100);
    MeshRequest plain;
    plain.kind = kind;
    MeshRequest jointed = plain;
    for (int k = 0; k < 25; ++k) {
        const double at = (k + 0.3) / 26.0;
        jointed.traces.push_back({{0.0, at}, {1.0, at + 0.02}});
        jointed.traces.push_back({{at + 0.01, 0.0}, {at, 1.0}});
    }
    std::vector<double> with, quotient;
    for (auto _ : state) {
        const double without = time_of_meshing(centres, plain);
        with.push_back(time_of_meshing(centres, jointed));
        quotient.push_back(with.back() / without);
        state.SetIterationTime(with.back());
    }
    state.counters["meshing_ms"] = 1e3 * median(with);
    state.counters["over_plain"] = median(quotient);
}
void jointed_voronoi(benchmark::State& state) { run_jointed(state, MeshKind::voronoi); }
void jointed_delaunay(benchmark::State& state) { run_jointed(state, MeshKind::delaunay); }

void voronoi(benchmark::State& state) { run(state, MeshKind::voronoi); }
void delaunay(benchmark::State& state) { run(state, MeshKind::delaunay); }

constexpr int pairs = 7;
void sizes(benchmark::internal::Benchmark* made, std::initializer_list<int> gaps) {
    made->ArgNames({"centres", "gap"})->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(pairs);
    for (const int gap : gaps) {
        for (const int centres : {10'000, 100'000, 1'000'000}) made->Args({centres, gap});
    }
}
// Gaps that destroy no cell, and gaps that destroy a few cells in a million.
BENCHMARK(voronoi)->Apply([](auto* made) { sizes(made, {50, 100}); });
BENCHMARK(delaunay)->Apply([](auto* made) { sizes(made, {0, 1}); });
BENCHMARK(jointed_voronoi)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(pairs);
BENCHMARK(jointed_delaunay)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(pairs);

}  // namespace
}  // namespace crackle

BENCHMARK_MAIN();
