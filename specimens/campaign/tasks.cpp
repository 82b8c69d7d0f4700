// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/tasks.hpp"

#include <algorithm>
#include <map>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/identity.hpp"
#include "specimens/making/hooks.hpp"

namespace crackle {

Tasks tasks_of(const Plan& plan, const Shard& shard, const std::function<bool()>& interrupted) {
    Tasks all;
    FileHashes files;
    std::map<std::string, std::size_t> groups, seen;
    std::vector<Task> tasks;
    for (std::size_t k = 0; k < plan.rows.size(); ++k) {
        if (interrupted && k % 100 == 0 && interrupted()) throw TestInterrupted();
        const ResolvedCase test = plan.test_of(plan.rows[k]);
        all.identities.push_back(identity_of(test, files));
        const auto [known, is_new] = seen.emplace(all.identities.back(), tasks.size());
        if (!is_new) {
            if (plan.rows[k].variant == Variant::as_asked) tasks[known->second].row = k;
            continue;
        }
        const bool packs = test.packing() != nullptr;
        // A test without a packing forms a group of its own.
        const std::string group = packs ? packing_identity(test, files) : all.identities.back();
        const auto [at, added] = groups.emplace(group, groups.size());
        if (added) all.groups.push_back(packs ? group : "");
        tasks.push_back({k, all.identities.back(), at->second, !test.data_files.empty()});
    }
    // Distributes whole packings over the shards if there are enough of them, otherwise single tests.
    const auto shares = static_cast<std::size_t>(shard.whole() ? 1 : shard.of);
    const auto own = static_cast<std::size_t>(shard.whole() ? 0 : shard.number - 1);
    const bool by_group = all.groups.size() >= shares;
    for (std::size_t k = 0; k < tasks.size(); ++k)
        if ((by_group ? tasks[k].group : k) % shares == own) all.tasks.push_back(tasks[k]);
    return all;
}

TaskQueue::TaskQueue(const Tasks& tasks, const std::vector<std::size_t>& open, const std::filesystem::path& packings)
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
        // A packing used by a single test is made by that test.
        groups_[group].first = left.back();
        groups_[group].made = packing.empty() || left.size() == 1 || is_file(packings / (packing + ".json"));
    }
}

std::optional<std::size_t> TaskQueue::next(std::optional<std::size_t> before) {
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

std::size_t TaskQueue::take(std::size_t number) {
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

}  // namespace crackle
