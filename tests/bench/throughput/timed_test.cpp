// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/throughput/timed_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <optional>

#include "solver/demseg/geometry.hpp"
#include "solver/stepping/controls.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/disordered.hpp"
#include "specimens/results/files.hpp"
#include "specimens/results/output_folder.hpp"
#include "tests/bench/throughput/machine_limits.hpp"
#include "tests/bench/throughput/walls.hpp"

namespace crackle::throughput {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double mean_radius = 0.02, mean_overlap = 8e-5;  // m
constexpr double polygon_gap = 1e-3;                       // m, between polygons
constexpr double height_to_width = 2.0;
// Random displacement relative to the mean overlap; large enough that a quarter of the lattice's bonds are lost.
constexpr double shake_share = 1.2;
constexpr double steps_between_rows = 100.0;
constexpr double fewest_rows = 2000.0;  // smallest number of rows that a test measures (load_specimen.cpp)
// The first neighbour list, used for 64 steps, is wider than later ones (neighbours.cpp). At 35 ms per step, a test of
// a million circles would otherwise be timed only with this list.
constexpr std::int64_t fewest_steps = 200;
// More particle-steps per second than any machine reaches; the test must not end before the measuring time is over.
constexpr double highest_rate = 2e8;
// A hundredth of the strain at which bonds break, which is the mean overlap over the mean diameter, 2e-3.
constexpr double end_strain = 2e-5;

double rows_of(const TimedSpecimen& specimen) {
    const double steps = 1.5 * specimen.seconds * highest_rate / static_cast<double>(specimen.count);
    return std::max(fewest_rows, std::ceil(steps / steps_between_rows));
}

std::string case_text(const TimedSpecimen& specimen) {
    const bool coulomb = specimen.kind == "coulomb", pressure = specimen.kind == "pressure",
               faces = pressure || specimen.kind == "faces";
    std::string text = fmt::format(
        "[particles]\nfile = \"in_gm.dat\"\n[loading]\nkind = \"compression\"\naxial_strain_rate = 1e-6\n"
        "max_axial_strain = {}\n[numerics]\nthreads = {}\n[output]\ncurve_rows = {}\n[material]\ndamping_ratio = 0.2\n",
        end_strain, specimen.threads, rows_of(specimen));
    if (specimen.kind == "circles") return text;
    // Strengths per area are so large that nothing breaks.
    if (coulomb || faces)
        text +=
            "units = \"area\"\ntensile_strength = 1e9\ncohesion = 4e9\nfriction_angle = 40\nresidual_friction_angle = "
            "20\n";
    if (coulomb) text += "contact_modulus = 50e9\nstiffness_ratio = 1.6\n";
    // If no stiffness ratio is given, it follows from Poisson's ratio, and cells have no pressure.
    if (faces) text += "youngs_modulus = 50e9\npoissons_ratio = 0.25\nmoment_share = 0.6\n";
    if (pressure) text += "stiffness_ratio = 1.6\n";
    text += fmt::format("[mesh]\nkind = \"{}\"\nthick = {}\n[bond]\n", coulomb || faces ? "voronoi" : specimen.kind,
                        polygon_gap);
    if (coulomb || faces) text += fmt::format("law = \"{}\"\n", coulomb ? "coulomb" : "face");
    if (!faces) text += fmt::format("thick = {}\n", polygon_gap + mean_overlap);
    return text;
}

void write_particles(const fs::path& path, std::int64_t count) {
    Scene scene = timed_discs(count);
    scene.materials[0].damping_ratio.reset();  // the file cannot contain it; the case sets it
    std::ofstream out(path);
    write_geometry(out, scene);
}

}  // namespace

Material timed_rock() {
    Material rock;
    rock.density = 2500.0;
    rock.normal_stiffness = 1e7;
    rock.shear_stiffness = 2.5e6;
    rock.friction_angle = 27.0;
    rock.damping_ratio = 0.2;
    return rock;
}

Scene timed_discs(std::int64_t count) {
    DisorderedDiscs request;
    request.radius = mean_radius;
    request.mean_overlap = mean_overlap;
    request.shake = shake_share * mean_overlap;
    const double width = std::sqrt(static_cast<double>(count) / height_to_width * std::sqrt(0.75));
    request.columns = std::max(3, static_cast<int>(std::lround(width)));
    request.rows = std::max(3, static_cast<int>(std::lround(static_cast<double>(count) / (request.columns - 0.5))));
    Scene scene = disordered_discs(request, timed_rock());
    // The outermost discs overlap the walls as much as their neighbours, so that platens bond to them.
    wall_in(scene, 0.0);
    scene.domain.y1 += mean_overlap;
    scene.domain.y2 -= mean_overlap;
    return scene;
}

VirtualTest bond_timed_test(const TimedSpecimen& specimen, const fs::path& folder) {
    fs::create_directories(folder);
    write_particles(folder / "in_gm.dat", specimen.count);
    const fs::path case_path = folder / "case.toml";
    std::ofstream(case_path) << case_text(specimen);
    VirtualTest test = bond_test(read_case(case_path));
    // One row every steps_between_rows steps, with the time step found at bonding.
    const double strain_a_step = end_strain / (rows_of(specimen) * steps_between_rows);
    change_velocity(test.world, test.setup.apparatus.top, 1,
                    -strain_a_step * test.setup.specimen.height / test.world.stepping.time_step);
    return test;
}

TimedTest time_test(const TimedSpecimen& specimen, const fs::path& folder, std::size_t empty_process,
                    Profile* profile) {
    VirtualTest test = bond_timed_test(specimen, folder);
    test.world.workers.profile = profile;
    fs::remove_all(folder / "out");  // results of the previous trial
    OutputFolder output = OutputFolder::create(folder / "out", Earlier::refused, {});
    TestFiles files(output, "", test.state, {});
    const auto load_for = [&](double seconds) {
        std::optional<Clock::time_point> begun;  // set by the first step, after the first checkpoint
        const std::int64_t end = test.world.stepping.steps + fewest_steps;
        TestHooks hooks;
        hooks.interrupted = [&] {
            if (!begun) begun = Clock::now();
            return test.world.stepping.steps >= end &&
                   std::chrono::duration<double>(Clock::now() - *begun).count() >= seconds;
        };
        load_specimen(test, hooks, &files);
    };
    load_for(0.1 * specimen.seconds);
    if (profile != nullptr) *profile = {};
    reset_peak_memory();
    const double seconds_before = test.state.step_seconds;
    const std::int64_t steps_before = test.world.stepping.steps;
    load_for(specimen.seconds);

    TimedTest timed;
    timed.particles = test.setup.specimen.particles;
    timed.steps = test.world.stepping.steps - steps_before;
    timed.step_seconds = test.state.step_seconds - seconds_before;
    timed.bonds = test.world.bonds.initial;
    timed.list_builds = test.world.list.builds;
    const auto count = static_cast<double>(timed.particles);
    timed.contacts_per_particle = static_cast<double>(timed.bonds) / count;
    const std::size_t peak = peak_memory();
    if (peak > empty_process) timed.bytes_per_particle = static_cast<double>(peak - empty_process) / count;
    return timed;
}

}  // namespace crackle::throughput
