// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle campaign submit PLAN.toml -o DIR --shards N` and `crackle campaign gather DIR`: runs a campaign in shares.
// Tested by tests/tools/campaign/campaign_test.cpp.

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/estimate.hpp"
#include "specimens/campaign/plan_file.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/campaign/campaign.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/terminal/printable.hpp"
#include "tools/terminal/shipped.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;

/// Runs `sbatch SCRIPT`, which prints the job id. @throws InputError if sbatch is missing or refuses the script
void call_sbatch(const fs::path& script) {
    std::string program = "sbatch", file = script.string();
    char* words[] = {program.data(), file.data(), nullptr};
    pid_t process = 0;
    const int reason = ::posix_spawnp(&process, "sbatch", nullptr, nullptr, words, environ);
    if (reason != 0) {
        fail_reading(reason,
                     fmt::format("sbatch: cannot be run ({}), expected Slurm's sbatch; submit {} on the cluster",
                                 std::strerror(reason), file));
    }
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw InputError(fmt::format("sbatch: found no job number for {}, expected one; see its messages above", file));
}

}  // namespace

CommandLine describe_campaign_submit() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("DIR"), "folder of the campaign")  //
        ("shards", po::value<int>()->value_name("N"),
         "number of shares (default: shares of about five minutes of work)")  //
        ("workers", po::value<int>()->value_name("N")->default_value(1),
         "worker processes per share, all on one node")  //
        ("verify", "the same as for crackle campaign")   //
        ("retry", "the same as for crackle campaign")    //
        ("dry-run", "print the script; write and submit nothing");
    return {.synopses = {"crackle campaign submit PLAN.toml -o DIR [--shards N] [OPTIONS]"},
            .description =
                "Writes DIR/shards/submit.sh, an array job of Slurm with one task per share, and submits it with "
                "sbatch. The job's time limit follows from measured or estimated durations of the tests. When the job "
                "has ended, `crackle campaign gather DIR` merges the shares. With GNU parallel, Snakemake or ssh, use "
                "`crackle campaign --shard` instead. DIR must be accessible from all nodes.",
            .options = {{"options", options}},
            .operand = "PLAN.toml",
            .examples = {{"crackle campaign submit plan.toml -o out/plan --shards 20 --dry-run"},
                         {"crackle campaign submit plan.toml -o out/plan --shards 20"},
                         {"crackle campaign gather out/plan"}}};
}

int campaign_submit(const Invocation& given) {
    const po::variables_map& values = given.values;
    if (given.operands.empty()) throw InputError("crackle campaign submit: found no PLAN.toml, expected one");
    if (!values.contains("output"))
        throw InputError("crackle campaign submit: found no -o, expected -o DIR, the folder for the campaign");
    const fs::path plan_file = given_or_shipped(given.operands.front());
    const Plan plan = read_plan(plan_file, values.contains("verify"));
    BatchRequest request;
    request.program = fs::read_symlink("/proc/self/exe");
    request.plan = fs::absolute(plan_file).lexically_normal();
    request.folder = fs::absolute(output_folder(values["output"].as<std::string>())).lexically_normal();
    request.workers = values["workers"].as<int>();
    if (request.workers < 1)
        throw InputError(fmt::format("crackle campaign submit: --workers: found {}, expected >= 1", request.workers));
    check_campaign_folder(request.folder, plan);
    const fs::path file = ledger_file(request.folder);
    const std::optional<CampaignLedger> ledger =
        is_file(file) ? std::optional(CampaignLedger::read(file)) : std::nullopt;
    request.seconds = estimate_plan(plan, ledger ? &*ledger : nullptr).seconds;
    const double worth = std::ceil(request.seconds / least_work_a_shard);
    constexpr int most_shards = 1000;  // Slurm's default limit on the size of a job array
    request.shards = values.contains("shards")
                         ? values["shards"].as<int>()
                         : static_cast<int>(std::clamp(
                               worth, 1.0, std::min<double>(most_shards, static_cast<double>(plan.rows.size()))));
    if (request.shards < 1 || request.shards > most_shards)
        throw InputError(
            fmt::format("crackle campaign submit: --shards: found {}, expected 1 to {}", request.shards, most_shards));
    request.largest_share = largest_share(plan, request.shards);
    if (values.contains("verify")) request.options += " --verify";
    if (values.contains("retry")) request.options += " --retry";
    const std::string script = batch_script(request);
    if (values.contains("dry-run")) {
        print_bytes(script);
        return exit_done;
    }
    if (request.shards > worth && request.shards > 1)
        given.messages.notice(fmt::format("{} shares take only {:.2g} s each; {:.0f} would take five minutes each",
                                          request.shards, request.seconds / request.shards, std::max(1.0, worth)));
    const fs::path path = request.folder / "shards" / "submit.sh";
    make_folder(path.parent_path());
    replace_file(path, script);
    call_sbatch(path);
    return exit_done;
}

CommandLine describe_campaign_gather() {
    return {
        .synopses = {"crackle campaign gather DIR"},
        .description =
            "Merges the results of the shares in DIR/shards into DIR/campaign.sqlite. It can be called any number of "
            "times. On a network file system, call it only after all shares have ended. Exit codes are those of "
            "crackle campaign. To repeat tests that ended with a system error, run the command of their share again.",
        .operand = "DIR",
        .examples = {{"crackle campaign gather out/plan"}}};
}

int campaign_gather(const Invocation& given) {
    if (given.operands.empty())
        throw InputError("crackle campaign gather: argument DIR is missing, expected a campaign's folder");
    const fs::path folder = given.operands.front();
    const Gathered gathered = gather_shards(folder);
    if (!given.messages.quiet())
        print_out("{} from {}; {} of {} done, {}: crackle campaign show {}\n", counted(gathered.tests, "test"),
                  counted(gathered.shards, "share"), gathered.counts.done, gathered.counts.tests,
                  spoken_wrong(gathered.counts.gone_wrong, gathered.counts.failures), folder.string());
    return exit_code_of(gathered.counts.gone_wrong, gathered.counts.failures);
}

}  // namespace crackle::tools
