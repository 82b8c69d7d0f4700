// SPDX-License-Identifier: GPL-3.0-or-later
// The tests of a campaign: which of them are to be run, and the order in which workers take them.
// Tested by tests/specimens/campaign/campaign_test.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "specimens/campaign/plan.hpp"

namespace crackle {

/// One of `of` shards of a plan's tests; `number` counts from 1. Packings are assigned to the shards in turn, or single
/// tests if there are too few packings. Even a single shard, 1 of 1, has its own ledger.
struct Shard {
    int number = 0, of = 0;
    bool whole() const { return of == 0; }  ///< whether this is the whole plan rather than a shard
};

/// A test to be run, for all rows of the plan with the same identity.
struct Task {
    std::size_t row;  // row of the plan; one with Variant::as_asked if there is one
    std::string identity;
    std::size_t group;
    bool reads_files = false;  // whether the case names further files
};

/// The tests of a shard.
struct Tasks {
    std::vector<std::string> identities;  // identity of each row of the plan
    std::vector<Task> tasks;              // tasks of this shard
    std::vector<std::string> groups;      // identity of each group's packing; empty if the group needs no packing
};

/// Finds the tests of a shard. @throws TestInterrupted
Tasks tasks_of(const Plan& plan, const Shard& shard, const std::function<bool()>& interrupted);

/// Chooses the next piece of work. Indices below the number of tasks stand for tests; higher indices stand for making
/// the packing of a group.
class TaskQueue {
  public:
    /// @param open  tasks to be run @param packings  folder of packings that are already made
    TaskQueue(const Tasks& tasks, const std::vector<std::size_t>& open, const std::filesystem::path& packings);

    /// Whether a piece is a packing rather than a test.
    bool is_packing(std::size_t piece) const { return piece >= tasks_.tasks.size(); }
    /// A task whose case describes the packing of `piece`.
    std::size_t task_of_packing(std::size_t piece) const { return groups_[group_of(piece)].first; }

    /// Next test for a worker. It prefers a test with the packing that the worker has in memory, then one with a
    /// packing that no worker has begun, then any test.
    std::optional<std::size_t> next(std::optional<std::size_t> before);
    /// Call this when a packing has been made, or could not be made; its tests can then be run.
    void packing_ended(std::size_t piece) {
        groups_[group_of(piece)].made = true;
        groups_[group_of(piece)].making = false;
    }
    /// Puts a test back into the queue, to be run again.
    void again(std::size_t task) {
        groups_[group_of(task)].left.push_back(task);
        first_ = 0;  // the test's group may lie before first_ in order_
    }

  private:
    struct Group {
        std::vector<std::size_t> left;  // remaining tasks; the last one is taken next
        std::size_t first = 0;
        bool begun = false, made = false, making = false;
    };

    std::size_t group_of(std::size_t piece) const {
        return is_packing(piece) ? piece - tasks_.tasks.size() : tasks_.tasks[piece].group;
    }
    bool can_give(std::size_t group) const { return !groups_[group].left.empty() && !groups_[group].making; }
    std::size_t take(std::size_t number);

    const Tasks& tasks_;
    std::vector<Group> groups_;
    std::vector<std::size_t> order_;  // groups in the order in which they are begun
    std::size_t first_ = 0;           // first position in order_ whose group has tasks left
};

}  // namespace crackle
