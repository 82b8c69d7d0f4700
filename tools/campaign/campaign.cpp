// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle campaign PLAN.toml -o DIR`: runs the tests of a plan on all processors.

#include "tools/campaign/campaign.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/estimate.hpp"
#include "specimens/campaign/plan_file.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/printable.hpp"
#include "tools/terminal/shipped.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::tools {
namespace {

/// Parses a shard such as "3/20".
Shard shard_of(const std::string& text) {
    Shard shard;
    const char* end = text.data() + text.size();
    const auto [slash, error] = std::from_chars(text.data(), end, shard.number);
    const bool number = error == std::errc() && slash != end && *slash == '/';
    const auto [at, wrong] = number ? std::from_chars(slash + 1, end, shard.of) : std::from_chars_result{end, error};
    constexpr int most_shards = 100'000;
    if (!number || wrong != std::errc() || at != end || shard.of < 1 || shard.of > most_shards || shard.number < 1 ||
        shard.number > shard.of) {
        throw InputError(
            fmt::format("crackle campaign: --shard: found {:.40}, expected I/N, for example 1/20 to 20/20", text));
    }
    return shard;
}

/// Size of a plan as text, for example "24 tests of 3 points with 4 packings".
std::string size_of(const Plan& plan) {
    return fmt::format("{} of {} with {}", counted(plan.rows.size(), "test"), counted(plan.points.size(), "point"),
                       counted(plan.packings, "packing"));
}

std::string hours(double seconds) { return spoken_time(std::max(1.0, seconds)); }

void print_estimate(const Plan& plan, const PlanEstimate& estimate, int workers) {
    print_out("{}: {}\n", plan.title, size_of(plan));
    for (const KindEstimate& kind : estimate.kinds) {
        print_out("  {:<24}{} of {:.2g} s each{}\n", kind.test, counted(kind.rows, "test"), kind.seconds,
                  kind.measured ? ", as measured" : ", estimated by `crackle test --check`");
        for (const std::string& warning : kind.warnings) print_out("  warning: {}: {}\n", kind.test, warning);
    }
    print_out("  about {} of processor time, {} with {}\n", hours(estimate.seconds), hours(estimate.seconds / workers),
              counted(std::int64_t{workers}, "worker"));
}

void print_outcome(const CampaignOutcome& outcome, const std::string& folder) {
    const CampaignProgress& p = outcome.progress;
    print_out("{} of {} done, {}, {} left; this command ran {} in {}\n", p.done, counted(p.tests, "test"),
              spoken_wrong(p.gone_wrong, p.failures), p.left, outcome.run, hours(outcome.wall_seconds));
    print_out("  results in {}: crackle campaign show {}\n", outcome.ledger.string(), folder);
}

/// Estimates the cost of a plan, and runs nothing. @param folder the campaign's folder, or empty @return exit code
int estimate(const Plan& plan, const std::filesystem::path& folder, int workers, Messages& messages) {
    TestHooks checking;
    checking.interrupted = interrupted;
    if (messages.progress().shown())
        checking.working = [&](const std::string& what) {
            messages.progress().draw({.detail = "estimating: " + what});
        };
    const std::filesystem::path file = ledger_file(folder);
    const bool known = !folder.empty() && is_file(file);
    const std::optional<CampaignLedger> ledger = known ? std::optional(CampaignLedger::read(file)) : std::nullopt;
    const PlanEstimate found = estimate_plan(plan, ledger ? &*ledger : nullptr, checking);
    messages.make_room();
    print_estimate(plan, found, workers);
    return exit_done;
}

CampaignHooks hooks_for(Messages& messages) {
    CampaignHooks hooks;
    hooks.interrupted = interrupted;
    hooks.told = [&messages](const std::string& text) { messages.notice(text); };
    if (!messages.progress().shown()) return hooks;
    hooks.progress = [&messages](const CampaignProgress& p) {
        messages.progress().draw(
            {.share = static_cast<double>(p.tests - p.left) / static_cast<double>(std::max<std::int64_t>(1, p.tests)),
             .rate = p.tests_per_second,
             .unit = "tests",
             .seconds_left = p.seconds_left,
             .detail = fmt::format("{} of {} done, {} without a result", p.done, p.tests, p.gone_wrong)});
    };
    return hooks;
}

}  // namespace

int exit_code_of(std::int64_t gone_wrong, std::int64_t failures) {
    if (failures > 0) return exit_system_fails;
    return gone_wrong > 0 ? exit_claim_fails : exit_done;
}

CommandLine describe_campaign() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("DIR"), "folder of the campaign")  //
        ("workers", po::value<int>()->value_name("N"),
         "number of processes that run tests (default: one per available processor)")  //
        ("verify",
         "also run each test at half the time step and at half the rate, to report the bias of every mean with its "
         "standard error")                                                                                          //
        ("retry", "repeat tests that ended without a result because of their case (refused, unstable, timed out)")  //
        ("shard", po::value<std::string>()->value_name("I/N"),
         "run only share I of N of the tests, and write the results to DIR/shards/I.sqlite; `crackle campaign gather` "
         "merges the shares")                                                           //
        ("dry-run", "check the plan and estimate its run time; run and write nothing")  //
        ("long", "run the tests even if they take more than a day, or 1e10 steps")      //
        ("keys", "list all keys of a plan");
    return {.synopses = {"crackle campaign PLAN.toml -o DIR [OPTIONS]", "crackle campaign show|gather|submit ..."},
            .description =
                "Runs a table of tests: the cases that PLAN.toml names, at all combinations of its axes, on several "
                "packings each. All results are written to one SQLite file, DIR/campaign.sqlite. A campaign can be "
                "stopped at any moment; run the same command again to resume it. If values or packings are added to "
                "the plan, finished tests are reused. Exit code 1: some tests ended without a result because of their "
                "case. Exit code 4: some tests ended with a system error (out of memory, too many open files, a killed "
                "worker); run the same command again to repeat them.",
            .options = {{"options", options}},
            .operand = "PLAN.toml",
            .verbose = "estimated duration of each kind of test",
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
        print_text(describe_plan_keys());
        return exit_done;
    }
    if (given.operands.empty())
        throw InputError("crackle campaign: found no PLAN.toml, expected one (see crackle campaign --help)");
    const bool dry = values.contains("dry-run");
    if (!dry && !values.contains("output"))
        throw InputError("crackle campaign: found no -o, expected -o DIR, the folder for the campaign");
    const auto asked = values.contains("workers") ? std::optional(values["workers"].as<int>()) : std::nullopt;
    const int workers = workers_of_machine(asked, "crackle campaign");
    watch_interrupts();
    end_unheard(words_of_resumable);
    const Plan plan = read_plan(given_or_shipped(given.operands.front()), values.contains("verify"));
    const std::filesystem::path folder =
        values.contains("output") ? output_folder(values["output"].as<std::string>()) : std::filesystem::path();
    try {
        if (dry) return estimate(plan, folder, workers, messages);
        CampaignOptions options;
        options.folder = folder;
        options.workers = workers;
        if (values.contains("shard")) options.shard = shard_of(values["shard"].as<std::string>());
        options.retry = values.contains("retry");
        options.endless = values.contains("long");
        messages.stage(fmt::format("{}, {}", size_of(plan), counted(std::int64_t{workers}, "worker")));
        const CampaignOutcome outcome = run_campaign(plan, options, hooks_for(messages));
        messages.make_room();
        if (!messages.quiet()) print_outcome(outcome, folder);
        if (outcome.progress.failures > 0) {
            report_error(fmt::format("{}: {} ended with a system error ({}); run the same command again to repeat them",
                                     folder.string(), counted(outcome.progress.failures, "test"), outcome.failure));
        }
        if (!outcome.interrupted) return exit_code_of(outcome.progress.gone_wrong, outcome.progress.failures);
    } catch (const TestInterrupted&) {
        messages.make_room();
    }
    if (!messages.hosted()) report_error(words_of_resumable);
    return exit_interrupted;
}

const std::vector<Command>& campaign_studies() {
    static const std::vector<Command> all{
        {"show", "prints statistics over the packings of each point: mean, scatter and interval",
         describe_campaign_show, campaign_show},
        {"gather", "merges the shares of a campaign", describe_campaign_gather, campaign_gather},
        {"submit", "runs a campaign in shares with Slurm", describe_campaign_submit, campaign_submit},
    };
    return all;
}

}  // namespace crackle::tools
