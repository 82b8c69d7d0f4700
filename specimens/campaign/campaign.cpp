// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/campaign.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <csignal>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/campaign/crew.hpp"
#include "specimens/making/specimen.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr int most_tries_of_killed = 3;

std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string packed(const RowResult& r) {
    Json figures = Json::object();
    for (const auto& [name, value] : r.figures)
        std::visit([&, &key = name](const auto& known) { figures[key] = known; }, value);
    const Json json{
        {"identity", r.identity},         {"state", r.state},     {"exit", r.exit},
        {"message", r.message},           {"notices", r.notices}, {"processor_seconds", r.processor_seconds},
        {"wall_seconds", r.wall_seconds}, {"figures", figures}};
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
    return r;
}

/// Tests of a plan by what they are, and which of them start from the same packing.
struct Task {
    std::size_t row;  // of the plan that it answers: one that is as asked, where there is one
    std::string identity;
    std::size_t group;
    bool reads_files = false;  // beside its case
};

struct Tasks {
    std::vector<std::string> identities;  // of the plan's rows
    std::vector<Task> tasks;              // of this share
    std::vector<std::string> groups;      // identity of the packing; empty: there is none to be made
};

Tasks tasks_of(const Plan& plan, const Shard& shard, const std::function<bool()>& interrupted) {
    Tasks all;
    FileHashes files;
    std::map<std::string, std::size_t> groups, seen;
    std::vector<Task> tasks;
    for (std::size_t k = 0; k < plan.rows.size(); ++k) {
        if (interrupted && k % 100 == 0 && interrupted()) throw TestInterrupted();
        const TestCase test = plan.test_of(plan.rows[k]);
        all.identities.push_back(identity_of(test, files));
        const auto [known, is_new] = seen.emplace(all.identities.back(), tasks.size());
        if (!is_new) {
            if (plan.rows[k].variant == Variant::as_asked) tasks[known->second].row = k;
            continue;
        }
        const bool packs = test.has_table("packing");
        // One without a packing is a group by itself.
        const std::string group = packs ? packing_identity(test, files) : all.identities.back();
        const auto [at, added] = groups.emplace(group, groups.size());
        if (added) all.groups.push_back(packs ? group : "");
        tasks.push_back({k, all.identities.back(), at->second, files_read(test).size() > test.inputs.size()});
    }
    // Whole packings are dealt out where there are enough of them, else single tests.
    const auto shares = static_cast<std::size_t>(shard.of), own = static_cast<std::size_t>(shard.number - 1);
    const bool by_group = all.groups.size() >= shares;
    for (std::size_t k = 0; k < tasks.size(); ++k)
        if ((by_group ? tasks[k].group : k) % shares == own) all.tasks.push_back(tasks[k]);
    return all;
}

/// Which piece comes next. Pieces below the number of tasks are tests, those above it the packings of their groups.
class Queue {
  public:
    /// @param open tasks that are to be run
    Queue(const Tasks& tasks, const std::vector<std::size_t>& open, const fs::path& packings)
        : tasks_(tasks), groups_(tasks.groups.size()) {
        for (const std::size_t task : open) {
            const std::size_t group = tasks.tasks[task].group;
            if (groups_[group].left.empty()) order_.push_back(group);
            groups_[group].left.push_back(task);
        }
        for (const std::size_t group : order_) {
            std::vector<std::size_t>& left = groups_[group].left;
            std::reverse(left.begin(), left.end());
            const std::string& packing = tasks.groups[group];
            // Where one test needs it, that one makes it.
            groups_[group].first = left.back();
            groups_[group].made = packing.empty() || left.size() == 1 || is_file(packings / (packing + ".json"));
        }
    }

    bool is_packing(std::size_t piece) const { return piece >= tasks_.tasks.size(); }
    /// A task by which the case of a packing piece is known.
    std::size_t task_of_packing(std::size_t piece) const { return groups_[group_of(piece)].first; }

    /// Of the packing that the worker has in memory; else of one that nobody has begun; else of any.
    std::optional<std::size_t> next(std::optional<std::size_t> before) {
        if (before && can_give(group_of(*before))) return take(group_of(*before));
        while (first_ < order_.size() && groups_[order_[first_]].left.empty()) ++first_;
        std::optional<std::size_t> shared;
        for (std::size_t k = first_; k < order_.size(); ++k) {
            if (!can_give(order_[k])) continue;
            if (!groups_[order_[k]].begun) return take(order_[k]);
            if (!shared) shared = order_[k];
        }
        return shared ? std::optional(take(*shared)) : std::nullopt;
    }
    void packing_ended(std::size_t piece) {
        groups_[group_of(piece)].made = true;
        groups_[group_of(piece)].making = false;
    }
    void again(std::size_t task) {
        groups_[group_of(task)].left.push_back(task);
        first_ = 0;  // its group may lie before those that are begun
    }

  private:
    struct Group {
        std::vector<std::size_t> left;  // tasks, the next one last
        std::size_t first = 0;
        bool begun = false, made = false, making = false;
    };

    std::size_t group_of(std::size_t piece) const {
        return is_packing(piece) ? piece - tasks_.tasks.size() : tasks_.tasks[piece].group;
    }
    bool can_give(std::size_t group) const { return !groups_[group].left.empty() && !groups_[group].making; }
    std::size_t take(std::size_t number) {
        Group& group = groups_[number];
        group.begun = true;
        if (!group.made) {
            group.making = true;
            return tasks_.tasks.size() + number;
        }
        const std::size_t task = group.left.back();
        group.left.pop_back();
        return task;
    }

    const Tasks& tasks_;
    std::vector<Group> groups_;
    std::vector<std::size_t> order_;  // of groups
    std::size_t first_ = 0;           // of these with something left
};

/// What a worker does with a piece. Its answer is a result in CBOR, or why the whole campaign has to stop.
class RowWorker {
  public:
    RowWorker(const Plan& plan, const CampaignOptions& options)
        : plan_(plan),
          place_{options.folder, options.endless},
          kept_(options.folder),
          packings_(options.folder / "packings", files_) {}

    std::string test(const Task& task) {
        return answer([&] {
            const PlanRow& row = plan_.rows[task.row];
            const Keep keep = row.variant == Variant::as_asked ? plan_.keep : Keep::figures;
            const TestCase test = plan_.test_of(row);
            const std::string name = kept_.name(task.identity).value_or(kept_name(plan_, row, task.identity));
            const RowResult result = run_row(test, {task.identity, name}, keep, place_, packings_);
            FileHashes now;
            if (task.reads_files && identity_of(test, now) != task.identity)
                throw OutputError(
                    fmt::format("{}: a file that its tests read was changed while the campaign ran, "
                                "expected it left alone; what was run of it before is kept",
                                plan_.kind_of(row).file.string()));
            return packed(result);
        });
    }
    std::string packing(const Task& task) {
        return answer([&] {
            TestHooks hooks;
            hooks.keep_packing = [&](const TestCase& of, const PackingRequest& request, const auto& make) {
                return packings_.get(of, request, make);
            };
            TestCase test = plan_.test_of(plan_.rows[task.row]);
            test.numerics.threads = 1;  // as of tests: a worker is one processor's, and a forked process has no others
            try {
                packing_of(test, hooks);
            } catch (const OutputError&) {
                throw;
            } catch (const std::exception&) {  // each of its tests will say why
                return std::string();
            }
            return std::string();
        });
    }

  private:
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
    result.message =
        end.how == PieceEnd::How::killed
            ? fmt::format("its process was ended by signal {} ({}){}", end.code, ::strsignal(end.code),
                          end.code == SIGKILL ? fmt::format(" {} times: not enough memory?", most_tries_of_killed) : "")
            : fmt::format("its process ended by itself with code {}", end.code);
    return result;
}

/// Whether what the plan keeps of a test is there.
bool is_kept(const KeptTests& kept, Keep keep, const std::string& identity) {
    if (keep == Keep::figures) return true;
    if (keep == Keep::curves && kept.curve(identity)) return true;
    const std::optional<fs::path> folder = kept.folder(identity);
    return folder && is_file(*folder / "summary.json");
}

constexpr std::size_t identity_digits = 12, all_digits = 32;

/// The digits of the identity that an entry of curves/ or tests/ is named by.
std::string digits_of(const std::string& name) {
    const std::size_t dash = name.rfind('-');
    if (dash != std::string::npos) return name.substr(dash + 1);
    return name.size() == all_digits ? name.substr(0, identity_digits) : "";
}

std::string name_of_kept(const fs::path& path) {
    return (path.extension() == ".csv" ? path.stem() : path.filename()).string();
}

/// As a file's name has it: of "mineral[1].cohesion" "mineral1.cohesion", of "confinement.pressure" "pressure".
std::string short_key(const std::string& key) {
    if (key.find('[') == std::string::npos) return key.substr(key.rfind('.') + 1);
    std::string text = key;
    std::erase_if(text, [](char c) { return c == '[' || c == ']'; });
    return text;
}

}  // namespace

void check_campaign_folder(const fs::path& folder) {
    if (!is_there(folder)) return;
    if (!is_folder(folder))
        throw InputError(
            fmt::format("{}: found a file, expected a folder or none; choose another -o", folder.string()));
    for (const char* made : {"campaign.sqlite", "shards", "packings"})
        if (is_there(folder / made)) return;
    if (fs::is_empty(folder)) return;
    throw InputError(
        fmt::format("{}: found files that no campaign made, expected a new folder or a campaign's; choose another -o",
                    folder.string()));
}

fs::path ledger_file(const fs::path& folder, const Shard& shard) {
    if (shard.whole()) return folder / "campaign.sqlite";
    return folder / "shards" / fmt::format("{}.sqlite", shard.number);
}

std::string kept_name(const Plan& plan, const PlanRow& row, const std::string& identity) {
    constexpr std::size_t longest = 80;  // of a point's settings
    std::string settings;
    for (const CaseSetting& setting : plan.points[row.point].settings)
        settings += fmt::format("-{}={}", short_key(setting.key), value_text(setting.value));
    if (settings.size() > longest) settings = fmt::format("-point{}", row.point + 1);
    std::string name = fmt::format("{}{}-packing{}", plan.kind_of(row).name, settings, row.seed);
    std::erase(name, '"');
    const auto plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               std::string_view("-_=.+").find(c) != std::string::npos;
    };
    for (char& c : name)
        if (!plain(c)) c = '_';
    return name + '-' + identity.substr(0, identity_digits);
}

KeptTests::KeptTests(const fs::path& folder) {
    const auto list = [](const fs::path& room, auto& entries) {
        std::error_code error;  // where nothing was kept there is no such folder
        for (const auto& entry : fs::directory_iterator(room, error)) {
            const fs::path& path = entry.path();
            const std::string digits = digits_of(name_of_kept(path));
            if (!digits.empty()) entries[digits] = path;
        }
    };
    list(folder / "curves", curves_);
    list(folder / "tests", folders_);
}

std::optional<std::string> KeptTests::name(const std::string& identity) const {
    for (const auto* entries : {&folders_, &curves_}) {
        const auto found = entries->find(identity.substr(0, identity_digits));
        if (found != entries->end()) return name_of_kept(found->second);
    }
    return std::nullopt;
}

std::optional<fs::path> KeptTests::curve(const std::string& identity) const {
    if (const auto alone = curves_.find(identity.substr(0, identity_digits)); alone != curves_.end())
        return alone->second;
    const std::optional<fs::path> all = folder(identity);
    return all && is_file(*all / "curve.csv") ? std::optional(*all / "curve.csv") : std::nullopt;
}

std::optional<fs::path> KeptTests::folder(const std::string& identity) const {
    const auto found = folders_.find(identity.substr(0, identity_digits));
    return found == folders_.end() ? std::nullopt : std::optional(found->second);
}

CampaignOutcome run_campaign(const Plan& plan, const CampaignOptions& options, const CampaignHooks& hooks) {
    const Clock::time_point begun = Clock::now();
    check_campaign_folder(options.folder);
    const fs::path file = ledger_file(options.folder, options.shard);
    // A share has a folder of its own to be held by.
    const fs::path held =
        options.shard.whole() ? options.folder : options.folder / "shards" / fmt::format("{}", options.shard.number);
    make_folder(held);
    const FolderLock lock(held);
    const Tasks tasks = tasks_of(plan, options.shard, hooks.interrupted);
    CampaignLedger ledger = CampaignLedger::open(file, options.shard.whole() ? Journal::beside : Journal::within);
    ledger.set_plan(plan, tasks.identities);

    CampaignOutcome outcome;
    outcome.ledger = file;
    CampaignProgress& progress = outcome.progress;
    std::map<std::string, std::string> ended = ledger.ended();
    if (!options.shard.whole() && is_file(ledger_file(options.folder))) {
        // What was gathered, or run here before, need not be run again.
        for (const auto& [identity, state] : CampaignLedger::read(ledger_file(options.folder)).ended())
            if (state == row_done) ended[identity] = state;
    }
    const KeptTests kept(options.folder);
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < tasks.tasks.size(); ++k) {
        const auto at = ended.find(tasks.tasks[k].identity);
        const bool ran = at != ended.end() && at->second == row_done;
        const bool asked = plan.rows[tasks.tasks[k].row].variant == Variant::as_asked;
        const bool done = ran && (!asked || is_kept(kept, plan.keep, tasks.tasks[k].identity));
        const bool wrong = at != ended.end() && !ran && !options.retry;
        progress.done += done ? 1 : 0;
        progress.gone_wrong += wrong ? 1 : 0;
        if (!done && !wrong) open.push_back(k);
    }
    progress.tests = static_cast<std::int64_t>(tasks.tasks.size());
    progress.left = static_cast<std::int64_t>(open.size());
    progress.tests_per_second = progress.seconds_left = std::numeric_limits<double>::quiet_NaN();

    Queue queue(tasks, open, options.folder / "packings");
    RowWorker worker(plan, options);
    const std::string host = host_name();
    std::map<std::size_t, int> killed;
    std::string stop;
    const Clock::time_point loading = Clock::now();
    const auto told = [&](std::size_t task, const RowResult& result) {
        const PlanRow& row = plan.rows[tasks.tasks[task].row];
        std::string at;
        for (const CaseSetting& setting : plan.points[row.point].settings)
            at += fmt::format(", {} = {}", setting.key, value_text(setting.value));
        return fmt::format("{}{}, seed {}: {}: {}", plan.kind_of(row).name, at, row.seed, result.state, result.message);
    };
    const auto take = [&](std::size_t task, const RowResult& result) {
        ledger.record(result, host);
        ++outcome.run;
        outcome.processor_seconds += result.processor_seconds;
        --progress.left;
        ++(result.state == row_done ? progress.done : progress.gone_wrong);
        const double seconds = std::chrono::duration<double>(Clock::now() - loading).count();
        progress.tests_per_second = static_cast<double>(outcome.run) / seconds;
        progress.seconds_left = static_cast<double>(progress.left) / progress.tests_per_second;
        if (result.state != row_done && hooks.told) hooks.told(told(task, result));
        if (hooks.progress) hooks.progress(progress);
    };
    CrewWork crew;
    crew.time_limit = plan.time_limit;
    crew.work = [&](std::size_t piece) {
        if (queue.is_packing(piece)) return worker.packing(tasks.tasks[queue.task_of_packing(piece)]);
        return worker.test(tasks.tasks[piece]);
    };
    crew.next = [&](std::optional<std::size_t> before) { return queue.next(before); };
    crew.ended = [&](std::size_t piece, const PieceEnd& end) {
        if (end.how == PieceEnd::How::answered) {
            const Json json = end.answer.empty() ? Json::object() : Json::from_cbor(end.answer);
            if (json.contains("stop")) {
                stop = json["stop"];
                return;
            }
            if (!queue.is_packing(piece)) take(piece, unpacked(json));
        } else if (!queue.is_packing(piece)) {
            // Whoever kills a process need not mean its test.
            const bool by_others = end.how == PieceEnd::How::killed && end.code == SIGKILL;
            if (by_others && ++killed[piece] < most_tries_of_killed)
                queue.again(piece);
            else
                take(piece, result_of(tasks.tasks[piece].identity, end, plan.time_limit));
        }
        if (queue.is_packing(piece)) queue.packing_ended(piece);
    };
    crew.interrupted = [&] { return !stop.empty() || (hooks.interrupted && hooks.interrupted()); };
    if (hooks.progress) hooks.progress(progress);
    const int workers = static_cast<int>(std::clamp<std::int64_t>(progress.left, 1, options.workers));
    if (!open.empty()) outcome.interrupted = !run_crew(workers, crew);
    if (stop.empty() && !outcome.interrupted && progress.left > 0)
        throw std::logic_error(fmt::format("campaign: {} tests were never given to a worker", progress.left));
    if (!stop.empty()) throw OutputError(stop + "; the same command goes on");
    outcome.wall_seconds = std::chrono::duration<double>(Clock::now() - begun).count();
    return outcome;
}

Gathered gather_shards(const fs::path& folder) {
    std::vector<std::pair<int, fs::path>> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / "shards", error))
        if (entry.path().extension() == ".sqlite")
            files.emplace_back(std::atoi(entry.path().stem().c_str()), entry.path());
    if (files.empty())
        throw InputError(fmt::format("{}: found no shards/*.sqlite, expected some that `crackle campaign --shard` made",
                                     folder.string()));
    std::sort(files.begin(), files.end());
    Gathered gathered;
    const FolderLock lock(folder);
    // The folder may lie on a network file system.
    CampaignLedger ledger = CampaignLedger::open(ledger_file(folder), Journal::within);
    fs::path planned;
    std::string rows, others;
    for (const auto& [number, file] : files) {
        // Opened to be written: a share that was killed in the midst of a change takes it back by that.
        const std::string own = CampaignLedger::open(file, Journal::within).meta("rows");
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
            fmt::format("{}: found a share of another plan than {}, expected shares of one; all tests are "
                        "gathered, run these shares again with that plan, or `crackle campaign` without "
                        "--shard",
                        others, planned.string()));
    }
    gathered.counts = ledger.counts();
    return gathered;
}

}  // namespace crackle
