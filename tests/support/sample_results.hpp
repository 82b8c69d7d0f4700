// SPDX-License-Identifier: GPL-3.0-or-later
// Folders that look like those of finished tests, made up in milliseconds: for what reads results, not for physics.
// Particles lie on a jittered triangular lattice; bonds break along one band near the peak, and its upper side moves
// off.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crackle::testing {

struct SampleTest {
    std::string kind = "compression";  ///< or tension
    std::string specimen = "circles";  ///< delaunay, voronoi
    bool failed = true;                ///< else the curve ends before it drops
    double modulus = 5.0e6;            ///< N/m
    double peak_strain = 1.0e-3;
    double larger_after_peak = 0.0;  ///< N/m, of pieces that carry again; 0: nothing is larger than the peak
    double thickness = 0.0;          ///< m, out of plane; 0: not given
    bool slips = false;              ///< recorded: more of them than breaks, most of them before the peak
    /// Acoustic events, of magnitudes as quantiles of b = 1 above -6 have them; 0: no ae.csv.
    int emission = 0;
    std::string title = "Sample test";
    int columns = 13, rows = 30;  ///< lattice sites
};

struct SampleCounts {
    int particles = 0, tension_breaks = 0, shear_breaks = 0, slips = 0;
};

/// Writes curve.csv, events.csv, slips.csv where asked for, summary.json and frames/ into `folder`, which is made.
SampleCounts write_sample_results(const std::filesystem::path& folder, const SampleTest& test);

/// Circles, Delaunay, Voronoi × tension, compression, in folders SPECIMEN-KIND of `root`; returns their names.
std::vector<std::filesystem::path> write_six_sample_results(const std::filesystem::path& root);

}  // namespace crackle::testing
