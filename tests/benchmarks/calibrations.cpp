// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrates rocks of circles with known keys from simulated laboratory results. It shows how often the stated
// intervals contain the true keys, how large the errors of the means are, and the cost. NLopt's CRS2, which uses no
// knowledge of rocks, runs on the same targets. Prints the lines of results/calibrations.md.
//   build/release/tests/benchmarks/calibrations [ROCKS] [FOLDER]

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlopt.hpp>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/machine/processors_lent.hpp"
#include "specimens/calibration/calibrate.hpp"
#include "specimens/calibration/measurements.hpp"
#include "specimens/campaign/axis.hpp"

namespace {

using namespace crackle;
namespace fs = std::filesystem;

constexpr int fit = 12, polish = 40, fresh = 24, laboratory = 24;
constexpr std::int64_t laboratory_seed = 5001;
const int workers = processors_lent();

struct Known {
    const char* key;
    const char* of;
    double from, to;           ///< bounds of the search
    double smallest, largest;  ///< range for the true rocks
};
constexpr Known keys[]{
    {"material.contact_modulus", "", 2e9, 300e9, 10e9, 80e9},
    {"material.stiffness_ratio", "", 1.0, 12.0, 1.8, 4.5},
    {"material.tensile_strength", "", 0.5e6, 200e6, 4e6, 40e6},
    {"material.cohesion", "material.tensile_strength", 0.6, 8.0, 1.0, 3.5},
};
constexpr std::size_t key_count = std::size(keys);

struct Figure {
    const char *test, *name;
};
constexpr Figure figures[]{{"compression", "youngs_modulus"},
                           {"compression", "poissons_ratio"},
                           {"compression", "peak_stress"},
                           {"tension", "peak_stress"}};
constexpr std::size_t figure_count = std::size(figures);

void write_cases(const fs::path& folder) {
    for (const auto& [kind, strain] : {std::pair("compression", 0.03), std::pair("tension", 0.01)})
        std::ofstream(folder / fmt::format("{}.toml", kind)) << fmt::format(
            "[packing]\ncount = 300\nradius_min = 1.0e-3\nradius_max = 1.66e-3\nmean_overlap = 2.0e-6\n"
            "[material]\ndensity = 2600.0\nunits = \"area\"\ncontact_modulus = 2e10\nstiffness_ratio = 2.5\n"
            "friction_angle = 30.0\nresidual_friction_angle = 20.0\ntensile_strength = 1e7\ncohesion = 2e7\n"
            "damping_ratio = 0.2\n[bond]\nlaw = \"coulomb\"\nrange = 0.1\nstrength_distribution = \"weibull\"\n"
            "strength_cv = 0.3\nstrength_seed = 1\n[loading]\nkind = \"{}\"\nmax_axial_strain = {}\n",
            kind, strain);
}

Rock rock_of(const fs::path& folder, const std::vector<double>& values, const std::vector<double>& errors) {
    {
        std::ofstream out(folder / "rock.toml");
        out << "title = \"circles\"\n[[test]]\ncase = \"compression.toml\"\n[[test]]\ncase = \"tension.toml\"\n";
        for (std::size_t k = 0; k < figure_count; ++k)
            out << fmt::format("[[target]]\ntest = \"{}\"\nfigure = \"{}\"\nvalue = {:.10g}\nerror = {:.6g}\n",
                               figures[k].test, figures[k].name, values[k], errors[k]);
        for (const Known& key : keys)
            out << fmt::format("[[free]]\nkey = \"{}\"\n{}from = {}\nto = {}\n", key.key,
                               *key.of == '\0' ? "" : fmt::format("of = \"{}\"\n", key.of), key.from, key.to);
        out << fmt::format("[packings]\nfit = {}\npolish = {}\nfresh = {}\n", fit, polish, fresh);
    }
    return read_rock(folder / "rock.toml");
}

/// Simulated laboratory results of a rock: means and their relative standard errors.
void measure(const fs::path& folder, const std::vector<double>& truth, std::vector<double>& means,
             std::vector<double>& errors) {
    Rock rock = rock_of(folder, std::vector<double>(figure_count, 1.0), std::vector<double>(figure_count, 0.0));
    rock.first_seed = laboratory_seed;
    Measurements tests(rock, Keep::figures, {.folder = folder / "laboratory", .workers = workers}, {});
    tests.measure({truth}, {0, laboratory});
    const Eigen::MatrixXd all = tests.figures(truth, {0, laboratory});
    means.clear();
    errors.clear();
    for (Eigen::Index k = 0; k < all.cols(); ++k) {
        const double mean = all.col(k).mean(), n = laboratory;
        means.push_back(mean);
        errors.push_back(std::sqrt((all.col(k).array() - mean).square().sum() / (n - 1.0) / n) / mean);
    }
}

/// CRS2 (Kaelo and Ali, J. Optim. Theory Appl. 130, 2006) on the same packings, until every mean is within its target's
/// tolerance. @return number of tests needed
std::int64_t by_crs2(const Rock& rock, const fs::path& folder, std::int64_t most_tests, double& worst_off) {
    std::int64_t tests = 0;
    worst_off = 1e9;
    const auto off = [&](const std::vector<double>& x) {
        std::vector<double> values;
        for (std::size_t k = 0; k < x.size(); ++k) values.push_back(rock.free[k].to_value(x[k]));
        Measurements here(rock, Keep::figures, {.folder = folder / "crs2", .workers = workers}, {});
        try {
            here.measure({values}, {0, fit});
        } catch (const InputError&) {  // no specimen failed
            tests += static_cast<std::int64_t>(fit * rock.tests.size());
            return 1e6;
        }
        tests += static_cast<std::int64_t>(fit * rock.tests.size());
        const Eigen::MatrixXd all = here.figures(values, {0, fit});
        double sum = 0.0, most = 0.0;
        for (Eigen::Index t = 0; t < all.cols(); ++t) {
            const Target& target = rock.targets[static_cast<std::size_t>(t)];
            const double far = std::log(all.col(t).mean() / target.value) / std::log1p(target.tolerance);
            if (!std::isfinite(far)) return 1e6;  // some specimens did not fail
            sum += far * far;
            most = std::max(most, std::abs(far));
        }
        worst_off = std::min(worst_off, most);
        return sum;
    };
    std::vector<double> low, high, x;
    for (const FreeKey& free : rock.free) {
        low.push_back(free.to_variable(free.from));
        high.push_back(free.to_variable(free.to));
        x.push_back(free.to_variable(free.start));
    }
    nlopt::opt search(nlopt::GN_CRS2_LM, static_cast<unsigned>(x.size()));
    std::function<double(const std::vector<double>&)> function = off;
    search.set_min_objective(
        [](const std::vector<double>& at, std::vector<double>&, void* data) {
            return (*static_cast<std::function<double(const std::vector<double>&)>*>(data))(at);
        },
        &function);
    search.set_lower_bounds(low);
    search.set_upper_bounds(high);
    nlopt::srand(1);
    search.set_stopval(1.0);  // the sum is below 1 only if each is within its tolerance
    search.set_maxeval(static_cast<int>(most_tests / static_cast<std::int64_t>(fit * rock.tests.size())));
    double least = 0.0;
    search.optimize(x, least);
    return tests;
}

}  // namespace

int main(int count, char** words) {
    const int rocks = count > 1 ? std::atoi(words[1]) : 10;
    const fs::path folder = count > 2 ? fs::path(words[2]) : fs::temp_directory_path() / "crackle_calibrations";
    fmt::print(
        "| rock | true keys | found | covered | largest miss of a mean, % (allowed) | tests | processor, s |\n"
        "| --- | --- | --- | --- | --- | --- | --- |\n");
    const auto shares = design_points(Sequence::halton, static_cast<std::size_t>(rocks), key_count);
    int whole = 0, single = 0, reached = 0;
    std::pair<std::vector<double>, std::vector<double>> targets;  // targets of the first rock
    for (int r = 0; r < rocks; ++r) {
        const fs::path own = folder / fmt::format("rock{}", r + 1);
        fs::create_directories(own);
        write_cases(own);
        std::vector<double> truth, means, errors;
        for (std::size_t k = 0; k < key_count; ++k)
            truth.push_back(keys[k].smallest *
                            std::pow(keys[k].largest / keys[k].smallest, shares[static_cast<std::size_t>(r)][k]));
        measure(own, truth, means, errors);
        const Rock rock = rock_of(own, means, errors);
        if (r == 0) targets = {means, errors};
        const CalibrationOutcome outcome = calibrate(rock, {.folder = own / "calibration", .workers = workers});
        std::string known, found;
        int covered = 0;
        for (std::size_t k = 0; k < key_count; ++k) {
            const FoundKey& key = outcome.keys[k];
            known += fmt::format("{}{:.3g}", k == 0 ? "" : ", ", truth[k]);
            found += fmt::format("{}{:.3g} ({:.3g} to {:.3g})", k == 0 ? "" : ", ", key.value, key.low, key.high);
            covered += key.low <= truth[k] && truth[k] <= key.high ? 1 : 0;
        }
        const auto worst = std::max_element(outcome.targets.begin(), outcome.targets.end(),
                                            [](const ReachedTarget& a, const ReachedTarget& b) {
                                                return std::abs(a.off) / a.limit < std::abs(b.off) / b.limit;
                                            });
        single += covered;
        whole += covered == static_cast<int>(key_count) ? 1 : 0;
        reached += outcome.all_reached() ? 1 : 0;
        fmt::print("| {} | {} | {} | {} of {} | {:+.1f} ({:.1f}) | {} | {:.0f} |\n", r + 1, known, found, covered,
                   key_count, 100.0 * worst->off, 100.0 * worst->limit, outcome.tests, outcome.processor_seconds);
        std::fflush(stdout);
    }
    fmt::print(
        "\n{} of {} rocks have all keys within their intervals, {} of {} keys; {} of {} reach all targets on fresh "
        "packings\n",
        whole, rocks, single, rocks * static_cast<int>(key_count), reached, rocks);
    std::fflush(stdout);
    const fs::path first = folder / "rock1";
    const Rock rock = rock_of(first, targets.first, targets.second);
    double off = 0.0;
    const std::int64_t tests = by_crs2(rock, first, 12'000, off);
    fmt::print("Rock 1 by CRS2: {} tests to means within {:.2f} of their tolerances\n", tests, off);
    return 0;
}
