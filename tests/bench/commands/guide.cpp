// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle-bench guide`: tests the guide's rock on many packings and compares each of the guide's numbers with the
// results.
// Tested by tests/bench_tests/commands/bench_test.cpp.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/files/replace_file.hpp"
#include "tests/bench/commands/bench.hpp"
#include "tests/bench/guide/experiments.hpp"
#include "tests/bench/guide/page.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/shipped.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;
using studies::as_shipped;
using studies::elastic_test;
using studies::GuideTest;
using Words = std::vector<std::string>;

struct Selection {
    std::int64_t packings = 20;
    Words laws{"rounded", "demseg", "demseg_mean"};
    std::vector<std::int64_t> strength_packings{5, 0, 0};    // one number per law
    std::vector<std::int64_t> experiment_packings{3, 2, 0};  // elastic, loaded circles, loaded triangles
    Words experiments;                                       // empty: all
};

void check_counts(const char* option, const std::vector<std::int64_t>& counts, std::int64_t most) {
    for (const std::int64_t count : counts) {
        if (count < 0 || count > most)
            throw InputError(
                fmt::format("crackle-bench guide: {}: found {}, expected 0 to {}, the packings", option, count, most));
    }
}

/// A single number applies to all places. If there are fewer numbers than places, the last one applies to the rest.
std::vector<std::int64_t> spread_counts(std::vector<std::int64_t> counts, std::size_t places, const char* option) {
    if (counts.size() > places)
        throw InputError(fmt::format("crackle-bench guide: {}: found {} numbers, expected at most {}", option,
                                     counts.size(), places));
    counts.resize(places, counts.back());
    return counts;
}

Selection selection_of(const po::variables_map& given) {
    Selection selection;
    const bool quick = given.contains("quick");
    selection.packings = given.contains("packings") ? given["packings"].as<std::int64_t>() : quick ? 2 : 20;
    if (selection.packings < 1)
        throw InputError(
            fmt::format("crackle-bench guide: --packings: found {}, expected a whole number >= 1", selection.packings));
    if (given.contains("laws")) selection.laws = given["laws"].as<Words>();
    for (const std::string& law : selection.laws) {
        if (law != "rounded" && law != "demseg" && law != "demseg_mean")
            throw InputError(
                fmt::format("crackle-bench guide: --laws: found '{}', expected rounded, demseg or demseg_mean", law));
        if (std::count(selection.laws.begin(), selection.laws.end(), law) > 1)
            throw InputError(fmt::format("crackle-bench guide: --laws: found '{}' twice, expected each law once", law));
    }
    const auto counts = [&](const char* option, std::vector<std::int64_t> otherwise, std::size_t places) {
        const std::string name = fmt::format("--{}", option);
        if (quick) return std::vector<std::int64_t>(places, 0);
        if (given.contains(option)) {
            otherwise = given[option].as<std::vector<std::int64_t>>();
            check_counts(name.c_str(), otherwise, selection.packings);
        }
        for (std::int64_t& count : otherwise) count = std::min(count, selection.packings);
        if (otherwise.size() > places && !given.contains(option)) otherwise.resize(places);
        return spread_counts(std::move(otherwise), places, name.c_str());
    };
    if (given.contains("experiments")) selection.experiments = given["experiments"].as<Words>();
    for (const std::string& name : selection.experiments) {
        const auto& all = studies::guide_experiments();
        if (std::none_of(all.begin(), all.end(), [&](const auto& one) { return one.name == name; })) {
            Words known;
            for (const auto& one : all) known.push_back(one.name);
            throw InputError(fmt::format("crackle-bench guide: --experiments: found '{}', expected some of {}", name,
                                         fmt::join(known, ", ")));
        }
    }
    selection.strength_packings = counts("strength-packings", selection.strength_packings, selection.laws.size());
    selection.experiment_packings = counts("experiment-packings", selection.experiment_packings, 3);
    return selection;
}

/// List of planned tests without repetition, since tests of circles serve all laws.
class TestList {
  public:
    void add(const GuideTest& test) {
        if (std::find(tests_.begin(), tests_.end(), test) == tests_.end()) tests_.push_back(test);
    }
    std::vector<GuideTest> take() { return std::move(tests_); }

  private:
    std::vector<GuideTest> tests_;
};

// The guide states no tensile strength for its Voronoi specimen.
const std::vector<std::pair<const char*, const char*>> loaded_tests{{"circles", "tension"},
                                                                    {"circles", "compression"},
                                                                    {"delaunay", "tension"},
                                                                    {"delaunay", "compression"},
                                                                    {"voronoi", "compression"}};

std::vector<studies::GuideExperiment> experiments_of(const Selection& selection) {
    std::vector<studies::GuideExperiment> chosen = studies::guide_experiments();
    std::erase_if(chosen, [&](const studies::GuideExperiment& one) {
        return !selection.experiments.empty() && std::find(selection.experiments.begin(), selection.experiments.end(),
                                                           one.name) == selection.experiments.end();
    });
    return chosen;
}

void add_experiments(TestList& list, const Selection& selection) {
    const std::vector<studies::GuideExperiment> experiments = experiments_of(selection);
    for (std::int64_t seed = 1; seed <= selection.experiment_packings[0]; ++seed) {
        for (const auto& experiment : experiments) {
            for (const std::string& law : selection.laws) {
                for (const char* specimen : {"circles", "delaunay", "voronoi"}) {
                    if (experiment.reach.holds(specimen, elastic_test))
                        list.add(studies::guide_test(experiment.name, law, specimen, elastic_test, seed));
                }
            }
        }
    }
    // Tests of Voronoi polygons take the longest, and only one row needs loaded ones.
    for (const std::string of : {"circles", "delaunay"}) {
        for (std::int64_t seed = 1; seed <= selection.experiment_packings[of == "circles" ? 1 : 2]; ++seed) {
            for (const auto& experiment : experiments) {
                for (const auto& [specimen, loading] : loaded_tests) {
                    if (of == specimen && experiment.reach.holds(specimen, loading))
                        list.add(studies::guide_test(experiment.name, selection.laws[0], specimen, loading, seed));
                }
            }
        }
    }
}

/// Tests in order of usefulness: elastic tests, then strengths packing by packing, then experiments.
std::vector<GuideTest> tests_of(const Selection& selection) {
    TestList list;
    for (std::int64_t seed = 1; seed <= selection.packings; ++seed) {
        for (const std::string& law : selection.laws) {
            for (const char* specimen : {"circles", "delaunay", "voronoi"})
                list.add(studies::guide_test(as_shipped, law, specimen, elastic_test, seed));
        }
    }
    // Tests of Voronoi polygons come last, since they take the longest and only one row needs them.
    for (const bool of_voronoi : {false, true}) {
        for (std::size_t law = 0; law < selection.laws.size(); ++law) {
            for (std::int64_t seed = 1; seed <= selection.strength_packings[law]; ++seed) {
                for (const auto& [specimen, loading] : loaded_tests) {
                    if ((std::string(specimen) == "voronoi") == of_voronoi)
                        list.add(studies::guide_test(as_shipped, selection.laws[law], specimen, loading, seed));
                }
            }
        }
    }
    add_experiments(list, selection);
    return list.take();
}

/// The command line, without options that do not affect the numbers.
std::string command_of(const po::variables_map& given, const Selection& selection) {
    std::string text = "crackle-bench guide";
    if (given.contains("quick")) text += " --quick";
    text += fmt::format(" --packings {} --laws {}", selection.packings, fmt::join(selection.laws, " "));
    if (!given.contains("quick")) {
        text += fmt::format(" --strength-packings {} --experiment-packings {}",
                            fmt::join(selection.strength_packings, " "), fmt::join(selection.experiment_packings, " "));
        if (!selection.experiments.empty())
            text += fmt::format(" --experiments {}", fmt::join(selection.experiments, " "));
    }
    if (const double factor = given["rate-factor"].as<double>(); factor != 1.0)
        text += fmt::format(" --rate-factor {:g}", factor);
    return text;
}

}  // namespace

CommandLine describe_bench_guide() {
    po::options_description options;
    const auto numbers = [](const char* name) {
        return po::value<std::vector<std::int64_t>>()->multitoken()->value_name(name);
    };
    options.add_options()("packings", po::value<std::int64_t>()->value_name("N"),
                          "number of packings, with seeds from 1 (default 20; quick: 2)")  //
        ("laws", po::value<Words>()->multitoken()->value_name("LAW"),
         "contact laws of polygons (default rounded demseg demseg_mean)")  //
        ("strength-packings", numbers("N"),
         "packings that are also loaded until they fail, a number per law (default 5 0 0, since the guide's law needs "
         "small steps)")  //
        ("experiment-packings", numbers("N"),
         "packings of the experiments: elastic, loaded circles, loaded triangles (default 3 2 0)")  //
        ("experiments", po::value<Words>()->multitoken()->value_name("NAME"),
         "only these experiments (default all)")  //
        ("rate-factor", po::value<double>()->value_name("X")->default_value(1.0, "1"),
         "load X times as fast as shipped")  //
        ("minutes", po::value<double>()->value_name("X"),
         "stop after this time; the page shows the results so far")  //
        ("jobs", po::value<int>()->value_name("N")->default_value(2),
         "number of tests in parallel, each on one thread")  //
        ("cases", po::value<std::string>()->value_name("DIR")->default_value("specimens/guide_rock"),
         "folder of the shipped cases")                                                                               //
        ("output,o", po::value<std::string>()->value_name("DIR")->default_value("out/guide"), "folder for the page")  //
        ("quick", "two packings, no loading, no experiments");
    Choices experiments{"experiments", {}};
    for (const auto& one : studies::guide_experiments()) experiments.words.push_back(one.name);
    return {.synopses = {"crackle-bench guide [OPTIONS]"},
            .description =
                "Tests the guide's rock on many packings and compares each of the guide's numbers with our mean and "
                "standard deviation. For each row outside, experiments show what changes it.\n\n"
                "Writes guide.md, guide.csv and cache/ with a file per test into DIR. The same command continues a "
                "stopped run, and a larger one uses the existing results. After a change of the engine, remove cache/.",
            .options = {{"options", options}},
            .choices = {{"laws", {"rounded", "demseg", "demseg_mean"}}, experiments},
            .verbose = "each finished test",
            .examples = {{"crackle-bench guide --quick"},
                         {"crackle-bench guide --strength-packings 5 1 0 --minutes 30 -o out/guide"},
                         {"crackle-bench guide --laws rounded --strength-packings 20 --experiment-packings 3 3"}},
            .notes = {"exit codes: 0 done, 2 bad input, 130 interrupted (the page shows the results so far)"}};
}

int bench_guide(const Invocation& invocation) {
    const auto begun = std::chrono::steady_clock::now();
    const po::variables_map& given = invocation.values;
    Messages& messages = invocation.messages;
    const Selection selection = selection_of(given);
    const fs::path folder = given["output"].as<std::string>();
    studies::EnsembleOptions ensemble;
    ensemble.cases = given_or_shipped(given["cases"].as<std::string>());
    ensemble.cache = folder / "cache";
    ensemble.rate_factor = given["rate-factor"].as<double>();
    ensemble.jobs = given["jobs"].as<int>();
    if (!(ensemble.rate_factor > 0.0) || !(ensemble.rate_factor < 1e3))
        throw InputError(fmt::format("crackle-bench guide: --rate-factor: found {}, expected a number > 0 and < 1000",
                                     ensemble.rate_factor));
    if (ensemble.jobs < 1 || ensemble.jobs > 1024)
        throw InputError(fmt::format("crackle-bench guide: --jobs: found {}, expected 1 to 1024", ensemble.jobs));
    const std::vector<GuideTest> tests = tests_of(selection);
    for (const GuideTest& test : tests)
        static_cast<void>(studies::guide_case(test, ensemble));  // refuses an invalid case before any test runs

    watch_interrupts();
    studies::EnsembleHooks hooks;
    const double minutes = given.contains("minutes") ? given["minutes"].as<double>() : 1e9;
    hooks.interrupted = [&] {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun;
        return interrupted() || spent.count() > 60.0 * minutes;
    };
    if (messages.verbose() || messages.progress().shown()) {
        messages.progress().begin("testing", static_cast<double>(tests.size()), "tests");
        hooks.progress = [&messages](std::size_t done, std::size_t all, const GuideTest& last) {
            messages.detail(fmt::format("{} of {}: {}", done, all, last.name()));
            messages.progress().count(static_cast<double>(done), fmt::format("last {}", last.name()));
        };
    }
    const studies::GuideResults results = studies::run_guide_tests(tests, ensemble, hooks);
    messages.make_room();

    const studies::GuidePage page{command_of(given, selection), selection.laws, selection.packings,
                                  ensemble.rate_factor, tests.size() - results.size()};
    const std::string text = studies::guide_page(page, results);
    replace_file(folder / "guide.csv", studies::guide_csv(page, results));
    replace_file(folder / "guide.md", text);
    std::cout << text;
    if (!interrupted()) return exit_done;
    report_error("interrupted; run the same command again to resume");
    return exit_interrupted;
}

}  // namespace crackle::tools
