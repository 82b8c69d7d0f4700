// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/base/processors_lent_test.cpp.
#pragma once

#include <filesystem>
#include <optional>

namespace crackle {

/// How many processors this process may keep busy, at least 1. A batch system or a container lends fewer than the
/// machine has in two ways: it names the processors (affinity), or it limits the processor time (quota of a control
/// group). A quota of 1.5 processors counts as 2: two are then busy three quarters of the time.
int processors_lent();

/// The smallest quota among the control groups of this process and those above them, in processors; nothing where
/// none is set. Both versions of control groups are read (cpu.max, and cpu.cfs_quota_us over cpu.cfs_period_us).
/// @param root folder that holds proc/ and the mounted groups: another one in tests
std::optional<double> processor_quota(const std::filesystem::path& root = "/");

}  // namespace crackle
