// SPDX-License-Identifier: GPL-3.0-or-later
// Creates a ledger of many tests that were never run. Measures its size on disc, and the time to add a test, to search
// for work, and to show it. build/release/tests/benchmarks/large_ledger [TESTS] [FOLDER]

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/identity.hpp"
#include "specimens/campaign/plan_file.hpp"
#include "specimens/campaign/point_table.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using namespace crackle;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr int figures = 100;  // as many as a test writes
constexpr int points = 10;

Plan dummy_plan(const std::filesystem::path& folder, int tests) {
    std::ofstream(folder / "case.toml")
        << "[packing]\ncount = 304\nradius_min = 1.333e-2\nradius_max = 2.667e-2\nmean_overlap = 7.74e-5\n"
           "[material]\ndensity = 2500.0\nnormal_stiffness = 1e7\nshear_stiffness = 2.5e6\nfriction_angle = 27.0\n"
           "[loading]\nkind = \"tension\"\nmax_axial_strain = 0.01\n";
    std::ofstream(folder / "plan.toml") << fmt::format(
        "[[test]]\ncase = \"case.toml\"\n[[axis]]\nkey = \"material.friction_angle\"\nfrom = 20\nto = 40\ncount = {}\n"
        "[packings]\ncount = {}\n",
        points, tests / points);
    return read_plan(folder / "plan.toml");
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    const int tests = words.empty() ? 100'000 : std::atoi(words[0].c_str());
    const std::filesystem::path folder = words.size() > 1 ? words[1] : "out/large_ledger";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    const Plan plan = dummy_plan(folder, tests);

    auto begun = Clock::now();
    FileHashes files;
    std::vector<std::string> identities;
    for (const PlanRow& row : plan.rows) identities.push_back(identity_of(plan.test_of(row), files));
    fmt::print("{} tests: known by their keys in {:.2f} s\n", tests, seconds_since(begun));

    CampaignOptions options;
    options.folder = folder / "out";
    std::filesystem::create_directories(options.folder);
    {
        CampaignLedger ledger = CampaignLedger::open(ledger_file(options.folder));
        begun = Clock::now();
        ledger.set_plan(plan, identities);
        fmt::print("planned in {:.2f} s\n", seconds_since(begun));
        RowResult result;
        result.state = row_done;
        begun = Clock::now();
        for (std::size_t k = 0; k < identities.size(); ++k) {
            result.identity = identities[k];
            result.figures.clear();
            for (int f = 0; f < figures; ++f)
                result.figures.emplace_back(f == 0 ? "peak_stress" : fmt::format("figure_{}", f),
                                            std::sin(static_cast<double>(k) + 0.1 * f));
            ledger.record(result, "host");
        }
        const double seconds = seconds_since(begun);
        fmt::print("{} figures each, added one by one in {:.2f} s: {:.2f} ms a test\n", figures, seconds,
                   1e3 * seconds / tests);
    }
    const auto bytes = static_cast<double>(std::filesystem::file_size(ledger_file(options.folder)));
    fmt::print("{:.1f} MB, {:.0f} bytes a test\n", bytes / 1e6, bytes / tests);
    begun = Clock::now();
    const CampaignOutcome again = run_campaign(plan, options);
    fmt::print("the same command finds {} left in {:.2f} s\n", again.progress.left, seconds_since(begun));
    begun = Clock::now();
    const auto shown = summarise(CampaignLedger::read(again.ledger).results(), {"peak_stress"});
    fmt::print("{} points with their means in {:.2f} s\n", shown.size(), seconds_since(begun));
    std::filesystem::remove_all(folder);
    return 0;
}
