// SPDX-License-Identifier: GPL-3.0-or-later
// Generates folders like those of finished tests in milliseconds, for tests of programs that read results.
// Particles are on an irregular triangular lattice; bonds break along one band near the peak, and the part above it
// moves away.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crackle::testing {

struct SampleTest {
    std::string kind = "compression";  ///< compression or tension
    std::string specimen = "circles";  ///< circles, delaunay or voronoi
    bool failed = true;                ///< otherwise the curve ends before the stress drops
    double modulus = 5.0e6;            ///< N/m
    double peak_strain = 1.0e-3;
    double larger_after_peak = 0.0;  ///< N/m, largest stress of fragments after the peak; 0 if none exceeds the peak
    double thickness = 0.0;          ///< m, out of plane; 0 if not given
    bool slips = false;              ///< whether slips are recorded; there are more slips than breaks, most of them
                                     ///< before the peak
    /// Number of acoustic events, whose magnitudes are quantiles of the law with b = 1 above -6; 0 for no ae.csv.
    int emission = 0;
    std::string title = "Sample test";
    int columns = 13, rows = 30;  ///< number of lattice sites
};

struct SampleCounts {
    int particles = 0, tension_breaks = 0, shear_breaks = 0, slips = 0;
};

/// Creates `folder` and writes curve.csv, events.csv, summary.json, frames/ and, if requested, slips.csv.
SampleCounts write_sample_results(const std::filesystem::path& folder, const SampleTest& test);

/// Writes results of circles, Delaunay and Voronoi in tension and compression to folders SPECIMEN-KIND of `root`;
/// returns their names.
std::vector<std::filesystem::path> write_six_sample_results(const std::filesystem::path& root);

}  // namespace crackle::testing
