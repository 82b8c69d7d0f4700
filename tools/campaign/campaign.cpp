// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle campaign PLAN.toml -o DIR`: a table of tests on all processors.

#include "tools/campaign/campaign.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/estimate.hpp"
#include "specimens/campaign/plan_file.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/shipped.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::tools {
namespace {

/// "3/20".
Shard shard_of(const std::string& text) {
    Shard shard;
    const char* end = text.data() + text.size();
    const auto [slash, error] = std::from_chars(text.data(), end, shard.number);
    const bool number = error == std::errc() && slash != end && *slash == '/';
    const auto [at, wrong] = number ? std::from_chars(slash + 1, end, shard.of) : std::from_chars_result{end, error};
    constexpr int most_shards = 100'000;
    if (!number || wrong != std::errc() || at != end || shard.of < 1 || shard.of > most_shards || shard.number < 1 ||
        shard.number > shard.of) {
        throw InputError(fmt::format("crackle campaign: --shard: found {:.40}, expected I/N, 1/20 to 20/20 say", text));
    }
    return shard;
}

/// "24 tests of 3 points with 4 packings".
std::string size_of(const Plan& plan) {
    return fmt::format("{} of {} with {}", counted(plan.rows.size(), "test"), counted(plan.points.size(), "point"),
                       counted(plan.packings, "packing"));
}

std::string hours(double seconds) { return spoken_time(std::max(1.0, seconds)); }

void print_estimate(const Plan& plan, const PlanEstimate& estimate, int workers) {
    fmt::print("{}: {}\n", plan.title, size_of(plan));
    for (const KindEstimate& kind : estimate.kinds) {
        fmt::print("  {:<24}{} of {:.2g} s{}\n", kind.test, counted(kind.rows, "test"), kind.seconds,
                   kind.measured ? ", as measured" : ", by `crackle test --check`");
        for (const std::string& warning : kind.warnings) fmt::print("  warning: {}: {}\n", kind.test, warning);
    }
    fmt::print("  about {} of a processor, {} with {}\n", hours(estimate.seconds), hours(estimate.seconds / workers),
               counted(std::int64_t{workers}, "worker"));
}

void print_outcome(const CampaignOutcome& outcome, const std::string& folder) {
    const CampaignProgress& p = outcome.progress;
    fmt::print("{} of {} done, {} gone wrong, {} left; {} run now in {}\n", p.done, counted(p.tests, "test"),
               p.gone_wrong, p.left, outcome.run, hours(outcome.wall_seconds));
    fmt::print("  results in {}: crackle campaign show {}\n", outcome.ledger.string(), folder);
}

}  // namespace

CommandLine describe_campaign() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("DIR"), "folder of the campaign")        //
        ("workers", po::value<int>()->value_name("N"), "processes that run tests (default: one a processor lent)")  //
        ("verify",
         "run each test at half the step and half the rate, too: the bias of every mean, with its standard error")  //
        ("retry", "run those again that have gone wrong")                                                           //
        ("shard", po::value<std::string>()->value_name("I/N"),
         "run share I of N into DIR/shards/I.sqlite; `crackle campaign gather` puts shares together")  //
        ("dry-run", "judge the plan and estimate its hours; run nothing, write nothing")               //
        ("long", "run tests although they take more than a day, or 1e10 steps")                        //
        ("keys", "list all keys of a plan");
    return {.synopses = {"crackle campaign PLAN.toml -o DIR [OPTIONS]", "crackle campaign show|gather|submit ..."},
            .description =
                "Runs a table of tests: the cases that PLAN.toml names, at all combinations of its axes, on several "
                "packings each. What came of them stands in one SQLite file, DIR/campaign.sqlite. Stopped at any "
                "moment, the same command goes on; a plan with more values or packings reuses what has been run.",
            .options = {{"options", options}},
            .operand = "PLAN.toml",
            .verbose = "seconds of a test by its kind, as estimated",
            .examples = {{"crackle campaign specimens/plans/granite.toml -o out/granite --dry-run"},
                         {"crackle campaign specimens/plans/granite.toml -o out/granite"},
                         {"crackle campaign show out/granite"},
                         {"crackle campaign plan.toml -o out/plan --verify"}},
            .notes = {"Python: pandas.read_sql('SELECT * FROM results', sqlite3.connect('DIR/campaign.sqlite'))"}};
}

int campaign(const Invocation& given) {
    const po::variables_map& values = given.values;
    Messages& messages = given.messages;
    if (values.contains("keys")) {
        expect_alone("crackle campaign", given, "keys");
        std::cout << describe_plan_keys();
        return exit_done;
    }
    if (given.operands.empty())
        throw InputError("crackle campaign: found no PLAN.toml, expected one (see crackle campaign --help)");
    const bool dry = values.contains("dry-run");
    if (!dry && !values.contains("output"))
        throw InputError("crackle campaign: found no -o, expected -o DIR, a folder for the campaign");
    const auto asked = values.contains("workers") ? std::optional(values["workers"].as<int>()) : std::nullopt;
    const int workers = workers_of_machine(asked, "crackle campaign");
    watch_interrupts();
    const Plan plan = read_plan(given_or_shipped(given.operands.front()), values.contains("verify"));
    const std::string folder = values.contains("output") ? values["output"].as<std::string>() : "";
    TestHooks checking;
    checking.interrupted = interrupted;
    if (messages.progress().shown())
        checking.working = [&](const std::string& what) {
            messages.progress().draw({.detail = "estimating: " + what});
        };
    try {
        if (dry) {
            const std::filesystem::path file = ledger_file(folder);
            const bool known = !folder.empty() && is_file(file);
            const std::optional<CampaignLedger> ledger =
                known ? std::optional(CampaignLedger::read(file)) : std::nullopt;
            const PlanEstimate estimate = estimate_plan(plan, ledger ? &*ledger : nullptr, checking);
            messages.make_room();
            print_estimate(plan, estimate, workers);
            return exit_done;
        }
        CampaignOptions options;
        options.folder = folder;
        options.workers = workers;
        if (values.contains("shard")) options.shard = shard_of(values["shard"].as<std::string>());
        options.retry = values.contains("retry");
        options.endless = values.contains("long");
        CampaignHooks hooks;
        hooks.interrupted = interrupted;
        hooks.told = [&](const std::string& text) { messages.notice(text); };
        if (messages.progress().shown()) {
            hooks.progress = [&](const CampaignProgress& p) {
                messages.progress().draw(
                    {.share = static_cast<double>(p.tests - p.left) /
                              static_cast<double>(std::max<std::int64_t>(1, p.tests)),
                     .rate = p.tests_per_second,
                     .unit = "tests",
                     .seconds_left = p.seconds_left,
                     .detail = fmt::format("{} of {} done, {} gone wrong", p.done, p.tests, p.gone_wrong)});
            };
        }
        messages.stage(fmt::format("{}, {}", size_of(plan), counted(std::int64_t{workers}, "worker")));
        const CampaignOutcome outcome = run_campaign(plan, options, hooks);
        messages.make_room();
        if (!messages.quiet()) print_outcome(outcome, folder);
        if (!outcome.interrupted) return exit_done;
    } catch (const TestInterrupted&) {
        messages.make_room();
    }
    if (!messages.hosted()) report_error("interrupted; the same command goes on");
    return exit_interrupted;
}

const std::vector<Command>& campaign_studies() {
    static const std::vector<Command> all{
        {"show", "what the packings of each point say: mean, scatter, interval", describe_campaign_show, campaign_show},
        {"gather", "puts the shares of a campaign together", describe_campaign_gather, campaign_gather},
        {"submit", "has Slurm run a campaign in shares", describe_campaign_submit, campaign_submit},
    };
    return all;
}

}  // namespace crackle::tools
