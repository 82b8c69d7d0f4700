// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/machine/processors_lent_test.cpp.
#pragma once

#include <filesystem>
#include <optional>

namespace crackle {

/// Number of processors that this process may keep busy, at least 1. A batch system or container may allow fewer than
/// the machine has, by restricting which processors may be used (affinity) or how much processor time (control group
/// quota). A quota of 1.5 processors counts as 2, each busy three quarters of the time.
int processors_lent();

/// The smallest processor quota of this process's control groups and their parents, in processors; empty if none is
/// set. Both versions of control groups are supported (cpu.max, and cpu.cfs_quota_us / cpu.cfs_period_us).
/// @param root folder that contains proc/ and the mounted control groups; other than / only in tests
std::optional<double> processor_quota(const std::filesystem::path& root = "/");

}  // namespace crackle
