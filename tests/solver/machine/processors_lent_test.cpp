// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that processors are counted as available to the process: by affinity, and by the quota of control groups of
// both versions.
#include "solver/machine/processors_lent.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace crackle {
namespace {

namespace fs = std::filesystem;

class ProcessorQuota : public ::testing::Test {
  protected:
    ProcessorQuota() { fs::create_directories(root_ / "proc/self"); }
    ~ProcessorQuota() override { fs::remove_all(root_); }

    void write(const fs::path& file, const std::string& text) const {
        fs::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file) << text;
    }
    void groups(const std::string& cgroup, const std::string& mountinfo) const {
        write("proc/self/cgroup", cgroup);
        write("proc/self/mountinfo", "27 1 254:0 / / rw,relatime - ext4 /dev/vda rw,discard\n" + mountinfo);
    }

    const fs::path root_ = fs::path(::testing::TempDir()) / ("quota_" + std::to_string(::getpid()));
};

constexpr const char* unified = "30 23 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";
constexpr const char* of_version_one =
    "32 31 0:29 / /sys/fs/cgroup/cpuset rw - cgroup cgroup rw,cpuset\n"
    "33 31 0:30 / /sys/fs/cgroup/cpu,cpuacct rw - cgroup cgroup rw,cpu,cpuacct\n";

TEST_F(ProcessorQuota, IsThatOfItsGroup) {
    groups("0::/job\n", unified);
    write("sys/fs/cgroup/job/cpu.max", "150000 100000\n");
    EXPECT_EQ(processor_quota(root_), 1.5);
}

TEST_F(ProcessorQuota, IsTheSmallestOfTheGroupsAbove) {
    groups("0::/slice/user/job\n", unified);
    write("sys/fs/cgroup/slice/cpu.max", "400000 100000\n");
    write("sys/fs/cgroup/slice/user/cpu.max", "200000 100000\n");
    write("sys/fs/cgroup/slice/user/job/cpu.max", "max 100000\n");
    EXPECT_EQ(processor_quota(root_), 2.0);
}

TEST_F(ProcessorQuota, IsNothingWhereNoneIsSet) {
    EXPECT_EQ(processor_quota(root_), std::nullopt) << "without control groups";
    groups("0::/\n", unified);
    EXPECT_EQ(processor_quota(root_), std::nullopt) << "no file";
    write("sys/fs/cgroup/cpu.max", "max 100000\n");
    EXPECT_EQ(processor_quota(root_), std::nullopt);
}

TEST_F(ProcessorQuota, IsReadFromVersionOne) {
    groups("5:cpu,cpuacct:/docker/a1\n4:cpuset:/docker/other\n0::/\n", of_version_one);
    write("sys/fs/cgroup/cpu,cpuacct/docker/a1/cpu.cfs_quota_us", "300000\n");
    write("sys/fs/cgroup/cpu,cpuacct/docker/a1/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(processor_quota(root_), 3.0);
    write("sys/fs/cgroup/cpu,cpuacct/docker/a1/cpu.cfs_quota_us", "-1\n");
    EXPECT_EQ(processor_quota(root_), std::nullopt);
}

// A container sees its own group at the mount, while /proc names it as seen from the machine.
TEST_F(ProcessorQuota, OfAContainerIsAtItsMount) {
    groups("5:cpu,cpuacct:/docker/a1\n",
           "33 31 0:30 /docker/a1 /sys/fs/cgroup/cpu,cpuacct rw - cgroup cgroup rw,cpu,cpuacct\n");
    write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "50000\n");
    write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(processor_quota(root_), 0.5);
    groups("0::/../../system.slice/job\n", unified);
    write("sys/fs/cgroup/cpu.max", "250000 100000\n");
    EXPECT_EQ(processor_quota(root_), 2.5);
}

TEST_F(ProcessorQuota, IsFoundBehindABlankInThePath) {
    groups("0::/my job\n", "30 23 0:26 / /groups\\040here rw - cgroup2 cgroup2 rw\n");
    write("groups here/my job/cpu.max", "700000 100000\n");
    EXPECT_EQ(processor_quota(root_), 7.0);
}

TEST(ProcessorsLent, AreThoseOfTheAffinity) {
    EXPECT_GE(processors_lent(), 1);
    const pid_t child = fork();
    if (child == 0) {
        cpu_set_t all, one;
        if (sched_getaffinity(0, sizeof all, &all) != 0) _exit(255);
        CPU_ZERO(&one);
        for (int k = 0; CPU_COUNT(&one) == 0; ++k)
            if (CPU_ISSET(k, &all)) CPU_SET(k, &one);
        if (sched_setaffinity(0, sizeof one, &one) != 0) _exit(255);
        _exit(processors_lent());
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
}

}  // namespace
}  // namespace crackle
