// SPDX-License-Identifier: GPL-3.0-or-later
// The engine as `crackle test` runs it, timed: bonds, friction, dashpots, platens, curve, events and frames on.
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
    std::string kind = "circles";  ///< circles, delaunay, voronoi
    std::int64_t count = 304;      ///< circles, of which polygons are meshed; met within a few
    int threads = 1;
    double seconds = 2.0;  ///< of stepping, at least
};

struct TimedTest {
    std::int64_t particles = 0, steps = 0, bonds = 0, list_builds = 0;
    double step_seconds = 0.0;           ///< wall clock of the stepping loop, observers and files included
    double contacts_per_particle = 0.0;  ///< bonded points; those with platens included
    double bytes_per_particle = 0.0;     ///< peak resident set while stepping less an empty process; 0: unknown

    double rate() const { return static_cast<double>(particles) * static_cast<double>(steps) / step_seconds; }
};

/// Material of all timed specimens: the guide's rock.
Material timed_rock();

/// Discs on a shaken triangular lattice, about 2.2 contacts a disc, in a box that they touch; ids row by row.
Scene timed_discs(std::int64_t count);

/// Makes the specimen's particle file and case in `folder` and bonds it. Loaded there, it has a curve row every 100
/// steps, more than `seconds` of them on any machine, and nothing breaks.
VirtualTest bond_timed_test(const TimedSpecimen& specimen, const std::filesystem::path& folder);

/// Loads such a test until `seconds` have gone, with files.
/// @param empty_process resident bytes of this process before anything was made
TimedTest time_test(const TimedSpecimen& specimen, const std::filesystem::path& folder, std::size_t empty_process,
                    Profile* profile = nullptr);

}  // namespace crackle::throughput
