// SPDX-License-Identifier: GPL-3.0-or-later
// Times the engine as used by `crackle test`, with bonds, friction, dashpots, platens, curve, events and frames.
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "solver/world/profile.hpp"
#include "solver/world/world.hpp"
#include "specimens/loading/virtual_test.hpp"

namespace crackle::throughput {

struct TimedSpecimen {
    /// circles, delaunay, voronoi; or Voronoi cells with stiffnesses per area that are bonded by points (coulomb), by
    /// faces (faces), or by faces with pressures of the cells (pressure)
    std::string kind = "circles";
    std::int64_t count = 304;  ///< number of circles, from which polygons are meshed; the actual number differs
                               ///< slightly
    int threads = 1;
    double seconds = 2.0;  ///< smallest duration of the stepping loop
};

struct TimedTest {
    std::int64_t particles = 0, steps = 0, bonds = 0, list_builds = 0;
    double step_seconds = 0.0;           ///< wall-clock time of the stepping loop, including observers and files
    double contacts_per_particle = 0.0;  ///< number of bonded points or faces per particle, including those at platens
    double bytes_per_particle = 0.0;     ///< peak resident set while stepping, minus that of an empty process; 0 if
                                         ///< unknown

    double rate() const { return static_cast<double>(particles) * static_cast<double>(steps) / step_seconds; }
};

/// Material of all timed specimens: that of the guide's rock.
Material timed_rock();

/// Discs on a randomly displaced triangular lattice with about 2.2 contacts per disc, in a box whose walls they touch;
/// ids are assigned row by row.
Scene timed_discs(std::int64_t count);

/// Writes the specimen's particle file and case to `folder` and bonds the specimen. When loaded there, it has a curve
/// row every 100 steps, takes more than `seconds` on any machine, and nothing breaks.
VirtualTest bond_timed_test(const TimedSpecimen& specimen, const std::filesystem::path& folder);

/// Loads a test made by bond_timed_test() for `specimen.seconds` and writes its files.
/// @param empty_process resident set of this process before anything was allocated, bytes
TimedTest time_test(const TimedSpecimen& specimen, const std::filesystem::path& folder, std::size_t empty_process,
                    Profile* profile = nullptr);

}  // namespace crackle::throughput
