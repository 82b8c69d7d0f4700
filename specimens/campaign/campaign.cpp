// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/campaign.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/files/new_file.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/campaign/crew.hpp"
#include "specimens/campaign/tasks.hpp"
#include "specimens/making/packed_circles.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

/// Largest number of attempts at a test whose process is killed by a signal. SIGKILL may have a cause other than the
/// test. Any other signal comes from the program itself and is likely to recur.
constexpr int most_tries(int signal) { return signal == SIGKILL ? 3 : 2; }
// The campaign stops when the number of consecutive system failures reaches the number of workers plus this value,
// because further tests would fail in the same way.
constexpr std::int64_t most_failures_in_a_row = 3;

std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string packed(const RowResult& r) {
    Json figures = Json::object();
    for (const auto& [name, value] : r.figures)
        std::visit([&, &key = name](const auto& known) { figures[key] = known; }, value);
    const Json json{{"identity", r.identity},
                    {"state", r.state},
                    {"exit", r.exit},
                    {"message", r.message},
                    {"notices", r.notices},
                    {"processor_seconds", r.processor_seconds},
                    {"wall_seconds", r.wall_seconds},
                    {"figures", figures},
                    {"curve_sha256", r.curve_sha256},
                    {"summary_sha256", r.summary_sha256}};
    const std::vector<std::uint8_t> bytes = Json::to_cbor(json);
    return {bytes.begin(), bytes.end()};
}

RowResult unpacked(const Json& json) {
    RowResult r;
    r.identity = json.at("identity");
    r.state = json.at("state");
    r.exit = json.at("exit");
    r.message = json.at("message");
    r.notices = json.at("notices").get<std::vector<std::string>>();
    r.processor_seconds = json.at("processor_seconds");
    r.wall_seconds = json.at("wall_seconds");
    for (const auto& [name, value] : json.at("figures").items()) {
        if (value.is_string())
            r.figures.emplace_back(name, value.get<std::string>());
        else
            r.figures.emplace_back(name, value.get<double>());
    }
    r.curve_sha256 = json.at("curve_sha256");
    r.summary_sha256 = json.at("summary_sha256");
    return r;
}

/// Runs a test or makes a packing in a worker process. The answer is a result in CBOR, or the reason why the whole
/// campaign must stop.
class RowWorker {
  public:
    RowWorker(const Plan& plan, const CampaignOptions& options)
        : plan_(plan),
          place_{options.folder, options.endless},
          kept_(options.folder),
          packings_(options.folder / "packings", files_) {}

    std::string test(const Task& task) {
        try {
            return answer_of_test(task);
        } catch (const SystemFailure& error) {
            RowResult failed;
            failed.identity = task.identity;
            failed.state = row_failed;
            failed.exit = 4;
            failed.message = error.what();
            return packed(failed);
        }
    }
    std::string packing(const Task& task) {
        return answer([&] {
            TestHooks hooks;
            const ResolvedCase test = plan_.test_of(plan_.rows[task.row]);
            hooks.keep_packing = packings_.keeping(test);
            try {
                packing_of(test, 1, test.places, hooks);  // a worker process uses one processor and starts no threads
            } catch (const OutputError&) {
                throw;
            } catch (const std::exception&) {  // each test that needs this packing will report the error
                return std::string();
            }
            return std::string();
        });
    }

  private:
    std::string answer_of_test(const Task& task) {
        return answer([&] {
            const PlanRow& row = plan_.rows[task.row];
            const Keep keep = row.variant == Variant::as_asked ? plan_.keep : Keep::figures;
            const ResolvedCase test = plan_.test_of(row);
            const std::string name = kept_.name(task.identity).value_or(kept_name(plan_, row, task.identity));
            const RowResult result = run_row(test, {task.identity, name}, keep, place_, packings_);
            if (kind_of_row(result.state) != RowKind::failure && task.reads_files && is_changed(test, task.identity))
                throw OutputError(fmt::format(
                    "{}: found a change in a file that its tests read, expected no change while the campaign "
                    "runs; earlier results are kept",
                    plan_.kind_of(row).file.string()));
            return packed(result);
        });
    }

    /// Whether files read by the test have changed or are missing.
    static bool is_changed(const ResolvedCase& test, const std::string& identity) {
        FileHashes now;
        try {
            return identity_of(test, now) != identity;
        } catch (const InputError&) {
            return true;
        }
    }

    template <class Work>
    static std::string answer(const Work& work) {
        try {
            return work();
        } catch (const OutputError& error) {
            const std::vector<std::uint8_t> bytes = Json::to_cbor(Json{{"stop", error.what()}});
            return {bytes.begin(), bytes.end()};
        }
    }

    const Plan& plan_;
    RowPlace place_;
    KeptTests kept_;
    FileHashes files_;
    PackingStore packings_;
};

RowResult result_of(const std::string& identity, const PieceEnd& end, double time_limit) {
    RowResult result;
    result.identity = identity;
    result.wall_seconds = end.seconds;
    result.exit = end.code;
    if (end.how == PieceEnd::How::timed_out) {
        result.state = row_timed_out;
        result.message = fmt::format("took more than time_limit = {:g} s", time_limit);
        return result;
    }
    result.state = row_crashed;
    if (end.how == PieceEnd::How::ended && end.code == worker_without_memory) {
        result.state = row_failed;
        result.message = no_memory;
        return result;
    }
    result.message = spoken_end(end);
    if (end.how == PieceEnd::How::killed)
        result.message += fmt::format(" in each of {} tries{}", most_tries(end.code),
                                      end.code == SIGKILL ? ", as happens when memory runs out; use fewer --workers"
                                                          : ", because of a defect in the program; report it, and "
                                                            "leave these values out of the plan until it is fixed");
    return result;
}

}  // namespace

void check_campaign_folder(const fs::path& folder, const Plan& plan) {
    std::vector<fs::path> inputs{plan.file};
    for (const PlannedTest& test : plan.tests) inputs.push_back(test.file);
    refuse_folder_of_inputs(folder, inputs);
    remove_leftovers(folder, Leftovers::old);
    if (is_file(folder / "campaign.sqlite") || is_folder(folder / "shards") || is_folder(folder / "packings")) return;
    refuse_foreign_files(folder, "a new or empty folder, or the folder of a campaign; choose another with -o");
}

fs::path ledger_file(const fs::path& folder, const Shard& shard) {
    if (shard.whole()) return folder / "campaign.sqlite";
    return folder / "shards" / fmt::format("{}.sqlite", shard.number);
}

namespace {

/// The folder that a run locks; each shard has its own.
fs::path folder_to_lock(const CampaignOptions& options) {
    return options.shard.whole() ? options.folder : options.folder / "shards" / fmt::format("{}", options.shard.number);
}

/// State of a call of run_campaign(): the ledger, the tests still to be run, and the results returned by workers.
class CampaignRun {
  public:
    /// Opens the ledger and finds the tests of the plan. Requires a locked folder.
    CampaignRun(const Plan& plan, const CampaignOptions& options, const CampaignHooks& hooks)
        : plan_(plan),
          options_(options),
          hooks_(hooks),
          tasks_(tasks_of(plan, options.shard, hooks.interrupted)),
          file_(ledger_file(options.folder, options.shard)),
          ledger_(opened(file_, options.shard)) {
        outcome_.ledger = file_;
    }

    CampaignOutcome run() {
        ledger_.set_plan(plan_, tasks_.identities);
        for (const std::string& damaged : ledger_.drop_damaged())
            say(fmt::format("{}: {}: found values that differ from those recorded; the test is run again",
                            file_.string(), damaged));
        const std::vector<std::size_t> open = open_tasks();
        CampaignProgress& progress = outcome_.progress;
        progress.tests = static_cast<std::int64_t>(tasks_.tasks.size());
        progress.left = static_cast<std::int64_t>(open.size());
        progress.tests_per_second = progress.seconds_left = std::numeric_limits<double>::quiet_NaN();
        workers_ = static_cast<int>(std::clamp<std::int64_t>(progress.left, 1, options_.workers));
        TaskQueue queue(tasks_, open, options_.folder / "packings");
        RowWorker worker(plan_, options_);
        loading_ = Clock::now();
        if (hooks_.progress) hooks_.progress(progress);
        if (!open.empty()) outcome_.interrupted = !run_crew(workers_, crew(queue, worker)) && stop_by_system_.empty();
        refuse_unfinished();
        outcome_.wall_seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
        return outcome_;
    }

  private:
    static CampaignLedger opened(const fs::path& file, const Shard& shard) {
        refuse_no_plain_file(file);
        return CampaignLedger::open(file, shard.whole() ? Journal::beside : Journal::within);
    }

    void say(const std::string& text) const {
        if (hooks_.told) hooks_.told(text);
    }

    /// Finds the tests to be run, and counts the others as done or gone wrong.
    std::vector<std::size_t> open_tasks() {
        std::map<std::string, std::string> ended = ledger_.ended();
        std::map<std::string, KeptHashes> hashes = ledger_.kept_hashes();
        if (!options_.shard.whole() && is_file(ledger_file(options_.folder))) {
            // Besides the tests in this shard's ledger, those already gathered in the campaign's ledger are not run
            // again.
            const CampaignLedger gathered = CampaignLedger::read(ledger_file(options_.folder));
            hashes.merge(gathered.kept_hashes());
            for (const auto& [identity, state] : gathered.ended())
                if (state == row_done) ended[identity] = state;
        }
        const KeptTests kept(options_.folder, std::move(hashes));
        std::vector<std::size_t> open;
        for (std::size_t k = 0; k < tasks_.tasks.size(); ++k) {
            const std::string& identity = tasks_.tasks[k].identity;
            const auto at = ended.find(identity);
            const bool ran = at != ended.end() && at->second == row_done;
            const bool asked = plan_.rows[tasks_.tasks[k].row].variant == Variant::as_asked;
            const std::string fault = ran && asked ? kept.fault_of(identity, plan_.keep) : "";
            if (!fault.empty() && kept.name(identity)) say(fault);
            const bool done = ran && fault.empty();
            const bool wrong = at != ended.end() && kind_of_row(at->second) == RowKind::verdict && !options_.retry;
            outcome_.progress.done += done ? 1 : 0;
            outcome_.progress.gone_wrong += wrong ? 1 : 0;
            if (!done && !wrong) open.push_back(k);
        }
        return open;
    }

    CrewWork crew(TaskQueue& queue, RowWorker& worker) {
        CrewWork crew;
        crew.time_limit = plan_.time_limit;
        crew.work = [&](std::size_t piece) {
            if (queue.is_packing(piece)) return worker.packing(tasks_.tasks[queue.task_of_packing(piece)]);
            return worker.test(tasks_.tasks[piece]);
        };
        crew.next = [&](std::optional<std::size_t> before) { return queue.next(before); };
        crew.ended = [&](std::size_t piece, const PieceEnd& end) { take_end(queue, piece, end); };
        crew.interrupted = [&] {
            return !stop_.empty() || !stop_by_system_.empty() || (hooks_.interrupted && hooks_.interrupted());
        };
        return crew;
    }

    void take_end(TaskQueue& queue, std::size_t piece, const PieceEnd& end) {
        if (end.how == PieceEnd::How::answered) {
            const Json json = end.answer.empty() ? Json::object() : Json::from_cbor(end.answer);
            if (json.contains("stop")) {
                stop_ = json["stop"];
                return;
            }
            if (!queue.is_packing(piece)) take(piece, unpacked(json));
        } else if (!queue.is_packing(piece)) {
            if (end.how == PieceEnd::How::killed && ++killed_[{piece, end.code}] < most_tries(end.code))
                queue.again(piece);
            else
                take(piece, result_of(tasks_.tasks[piece].identity, end, plan_.time_limit));
        }
        if (queue.is_packing(piece)) queue.packing_ended(piece);
    }

    /// Records the result of a test.
    void take(std::size_t task, const RowResult& result) {
        CampaignProgress& progress = outcome_.progress;
        ledger_.record(result, host_);
        ++outcome_.run;
        outcome_.processor_seconds += result.processor_seconds;
        --progress.left;
        const RowKind kind = kind_of_row(result.state);
        ++(kind == RowKind::result ? progress.done : progress.gone_wrong);
        progress.failures += kind == RowKind::failure ? 1 : 0;
        if (kind == RowKind::failure) outcome_.failure = told(task, result);
        failures_in_a_row_ = kind == RowKind::failure ? failures_in_a_row_ + 1 : 0;
        if (failures_in_a_row_ >= workers_ + most_failures_in_a_row)
            stop_by_system_ = fmt::format("{} consecutive tests failed because of the system; the last one: {}",
                                          failures_in_a_row_, result.message);
        const double seconds = std::chrono::duration<double>(Clock::now() - loading_).count();
        progress.tests_per_second = static_cast<double>(outcome_.run) / seconds;
        progress.seconds_left = static_cast<double>(progress.left) / progress.tests_per_second;
        if (kind != RowKind::result) say(told(task, result));
        if (hooks_.progress) hooks_.progress(progress);
    }

    /// Message about a test that ended without results.
    std::string told(std::size_t task, const RowResult& result) const {
        const PlanRow& row = plan_.rows[tasks_.tasks[task].row];
        std::string at;
        for (const CaseSetting& setting : plan_.points[row.point].settings)
            at += fmt::format(", {} = {}", setting.key, value_text(setting.value));
        return fmt::format("{}{}, seed {}: {}: {}", plan_.kind_of(row).name, at, row.seed, result.state,
                           result.message);
    }

    void refuse_unfinished() const {
        if (!stop_.empty()) throw OutputError(stop_ + "; run the same command again to resume");
        const std::int64_t left = outcome_.progress.left;
        if (!stop_by_system_.empty() && left > 0)
            throw SystemFailure(stop_by_system_ + "; run the same command again to resume");
        if (!outcome_.interrupted && left > 0)
            throw std::logic_error(fmt::format("campaign: {} tests were never given to a worker", left));
    }

    const Plan& plan_;
    const CampaignOptions& options_;
    const CampaignHooks& hooks_;
    const Clock::time_point begun_ = Clock::now();
    Tasks tasks_;
    fs::path file_;
    CampaignLedger ledger_;
    CampaignOutcome outcome_;
    std::string host_ = host_name();
    Clock::time_point loading_;
    std::map<std::pair<std::size_t, int>, int> killed_;  // how often a signal killed a task's process
    std::string stop_, stop_by_system_;                  // reason for stopping the campaign; empty while it runs
    std::int64_t failures_in_a_row_ = 0;
    int workers_ = 1;
};

}  // namespace

CampaignOutcome run_campaign(const Plan& plan, const CampaignOptions& options, const CampaignHooks& hooks) {
    check_campaign_folder(options.folder, plan);
    const fs::path held = folder_to_lock(options);
    make_folder(held);
    const FolderLock lock(held);
    return CampaignRun(plan, options, hooks).run();
}

Gathered gather_shards(const fs::path& folder) {
    std::vector<std::pair<int, fs::path>> files;
    for (const fs::path file : names_in(folder / "shards"))
        if (file.extension() == ".sqlite") files.emplace_back(std::atoi(file.stem().c_str()), folder / "shards" / file);
    if (files.empty())
        throw InputError(fmt::format("{}: found no shards/*.sqlite, expected files made by `crackle campaign --shard`",
                                     folder.string()));
    std::sort(files.begin(), files.end());
    Gathered gathered;
    const FolderLock lock(folder);
    // The folder may lie on a network file system.
    CampaignLedger ledger = CampaignLedger::open(ledger_file(folder), Journal::within);
    fs::path planned;
    std::string rows, others, damaged;
    for (const std::string& row : ledger.drop_damaged())
        damaged += fmt::format("{}{}: {}", damaged.empty() ? "" : ", ", ledger_file(folder).string(), row);
    for (const auto& [number, file] : files) {
        // Opening the ledger for writing rolls back an incomplete transaction of a killed shard.
        CampaignLedger share = CampaignLedger::open(file, Journal::within);
        share.require_whole_plan();
        for (const std::string& row : share.drop_damaged())
            damaged += fmt::format("{}{}: {}", damaged.empty() ? "" : ", ", file.string(), row);
        const std::string own = share.meta("rows");
        const bool first = planned.empty() && !own.empty();
        if (first) {
            planned = file;
            rows = own;
        }
        if (!own.empty() && own != rows) others += (others.empty() ? "" : ", ") + file.string();
        gathered.tests += ledger.gather(file, first);
        ++gathered.shards;
    }
    if (!others.empty()) {
        throw InputError(
            fmt::format("{}: found a shard of another plan than {}, expected shards of the same plan; all tests were "
                        "gathered. Run these shards again with that plan, or run `crackle campaign` without "
                        "--shard",
                        others, planned.string()));
    }
    if (!damaged.empty()) {
        throw InputError(fmt::format(
            "{}: found values that differ from those recorded, expected values that match their hashes; all other "
            "tests were gathered. Run these shards again with the same commands, then gather again",
            damaged));
    }
    gathered.counts = ledger.counts();
    return gathered;
}

}  // namespace crackle
