// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "specimens/loading/check.hpp"

namespace crackle {
namespace {

/// Mean processor time of finished tests, s, by name of the test.
std::map<std::string, double> measured_seconds(const CampaignLedger& ledger) {
    std::map<std::string, double> seconds;
    const LedgerTable table = ledger.query(
        "SELECT point.test, avg(test.processor_seconds) FROM plan JOIN point ON point.number = plan.point JOIN test "
        "USING(identity) WHERE test.state = 'done' GROUP BY point.test");
    for (const auto& row : table.rows) {
        const auto* test = std::get_if<std::string>(&row[0]);
        const auto* mean = std::get_if<double>(&row[1]);
        if (test != nullptr && mean != nullptr) seconds.emplace(*test, *mean);
    }
    return seconds;
}

/// Processor time of one test as estimated by --check, s.
double checked_seconds(ResolvedCase description, const TestHooks& hooks, std::vector<std::string>& warnings) {
    description.numerics.threads = 1;
    const TestCheck check = check_test(description, hooks);
    for (const std::string& warning : check.warnings)
        if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
    return check.test.specimen_seconds + (check.to_strength ? *check.to_strength : check.to_end).seconds;
}

/// A job name that has only characters accepted by Slurm.
std::string job_name(const std::string& text) {
    std::string name = "crackle-";
    for (const char letter : text)
        name += std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-' ? letter : '_';
    return name;
}

/// Quotes an argument for the shell.
std::string shell_word(const std::string& text) {
    std::string word = "'";
    for (const char letter : text) {
        if (letter == '\'')
            word += "'\\''";
        else
            word += letter;
    }
    return word + '\'';
}

std::string clock_text(double seconds) {
    const auto minutes = static_cast<std::int64_t>(std::ceil(seconds / 60.0));
    return fmt::format("{}:{:02}:00", minutes / 60, minutes % 60);
}

}  // namespace

PlanEstimate estimate_plan(const Plan& plan, const CampaignLedger* ledger, const TestHooks& hooks) {
    const std::map<std::string, double> measured =
        ledger != nullptr ? measured_seconds(*ledger) : std::map<std::string, double>{};
    PlanEstimate estimate;
    for (std::size_t test = 0; test < plan.tests.size(); ++test) {
        KindEstimate kind;
        kind.test = plan.tests[test].name;
        const PlanRow *first = nullptr, *last = nullptr;
        // Number of rows; companions at half the step or half the rate count twice, since they take twice as long.
        double weight = 0.0;
        for (const PlanRow& row : plan.rows) {
            if (plan.points[row.point].test != test) continue;
            ++kind.rows;
            weight += row.variant == Variant::as_asked ? 1.0 : 2.0;
            if (row.variant != Variant::as_asked) continue;
            if (first == nullptr) first = &row;
            if (row.seed == first->seed) last = &row;
        }
        if (const auto known = measured.find(kind.test); known != measured.end()) {
            kind.seconds = known->second;
            kind.measured = true;
            weight = static_cast<double>(kind.rows);  // the measured mean includes the companions
        } else if (first != nullptr) {
            const double of_first = checked_seconds(plan.test_of(*first), hooks, kind.warnings);
            const bool alike = first->point == last->point;
            kind.seconds =
                alike ? of_first : 0.5 * (of_first + checked_seconds(plan.test_of(*last), hooks, kind.warnings));
        }
        estimate.seconds += kind.seconds * weight;
        estimate.kinds.push_back(std::move(kind));
    }
    return estimate;
}

double largest_share(const Plan& plan, int shards) {
    const auto of = [&](double pieces) { return std::ceil(pieces / shards) / pieces; };
    const auto packings = static_cast<double>(plan.packings), rows = static_cast<double>(plan.rows.size());
    return of(packings >= shards ? packings : rows);
}

double wall_limit(const BatchRequest& request) {
    constexpr double margin = 3.0, beginning = 300.0;
    return beginning + margin * request.seconds * request.largest_share / request.workers;
}

std::string batch_script(const BatchRequest& request) {
    return fmt::format(
        "#!/bin/bash\n"
        "# Made by `crackle campaign submit`: each task runs one shard; if submitted again, all tasks resume.\n"
        "#SBATCH --job-name={}\n"
        "#SBATCH --array=1-{}\n"
        "#SBATCH --ntasks=1\n"
        "#SBATCH --cpus-per-task={}\n"
        "#SBATCH --time={}\n"
        "#SBATCH --requeue\n"
        "#SBATCH --output=/dev/null\n"
        "exec >{}/\"$SLURM_ARRAY_TASK_ID.log\" 2>&1\n"
        "exec {} campaign {} -o {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --workers {}{} -q\n",
        job_name(request.plan.stem().string()), request.shards, request.workers, clock_text(wall_limit(request)),
        shell_word((request.folder / "shards").string()), shell_word(request.program.string()),
        shell_word(request.plan.string()), shell_word(request.folder.string()), request.shards, request.workers,
        request.options);
}

}  // namespace crackle
