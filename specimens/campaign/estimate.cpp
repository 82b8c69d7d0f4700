// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/estimate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "specimens/loading/check.hpp"

namespace crackle {
namespace {

/// Mean processor seconds of tests that are done, by what they are called.
std::map<std::string, double> measured_seconds(const Ledger& ledger) {
    std::map<std::string, double> seconds;
    const LedgerTable table = ledger.query(
        "SELECT point.test, avg(test.processor_seconds) FROM plan JOIN point ON point.number = plan.point JOIN test "
        "USING(identity) WHERE test.state = 'done' GROUP BY point.test");
    for (const auto& row : table.rows) seconds.emplace(std::get<std::string>(row[0]), std::get<double>(row[1]));
    return seconds;
}

/// In single quotes, as a shell reads it.
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

PlanEstimate estimate_plan(const Plan& plan, const Ledger* ledger, const TestHooks& hooks) {
    const std::map<std::string, double> measured =
        ledger != nullptr ? measured_seconds(*ledger) : std::map<std::string, double>{};
    PlanEstimate estimate;
    for (std::size_t test = 0; test < plan.tests.size(); ++test) {
        KindEstimate kind;
        kind.test = plan.tests[test].name;
        const PlanRow* first = nullptr;
        for (const PlanRow& row : plan.rows) {
            if (plan.points[row.point].test != test) continue;
            ++kind.rows;
            if (first == nullptr) first = &row;
        }
        if (const auto known = measured.find(kind.test); known != measured.end()) {
            kind.seconds = known->second;
            kind.measured = true;
        } else if (first != nullptr) {
            TestCase description = plan.test_of(*first);
            description.numerics.threads = 1;
            const TestCheck check = check_test(description, hooks);
            kind.seconds =
                check.test.specimen_seconds + (check.to_strength ? *check.to_strength : check.to_end).seconds;
            kind.warnings = check.warnings;
        }
        estimate.seconds += kind.seconds * static_cast<double>(kind.rows);
        estimate.kinds.push_back(std::move(kind));
    }
    return estimate;
}

double wall_limit(const BatchRequest& request) {
    constexpr double margin = 3.0, beginning = 300.0;
    return beginning + margin * request.seconds / request.shards / request.workers;
}

std::string batch_script(const BatchRequest& request) {
    const std::string shards = (request.folder / "shards").string();
    return fmt::format(
        "#!/bin/bash\n"
        "# Made by `crackle campaign submit`: each task runs one share; submitted again, all go on where they were.\n"
        "#SBATCH --job-name={}\n"
        "#SBATCH --array=1-{}\n"
        "#SBATCH --ntasks=1\n"
        "#SBATCH --cpus-per-task={}\n"
        "#SBATCH --time={}\n"
        "#SBATCH --requeue\n"
        "#SBATCH --output={}/%a.log\n"
        "exec {} campaign {} -o {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --workers {}{} -q\n",
        "crackle-" + request.plan.stem().string(), request.shards, request.workers, clock_text(wall_limit(request)),
        shards, shell_word(request.program.string()), shell_word(request.plan.string()),
        shell_word(request.folder.string()), request.shards, request.workers, request.options);
}

}  // namespace crackle
