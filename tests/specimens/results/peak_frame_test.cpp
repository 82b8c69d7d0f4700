// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the frame at the peak, stored in memory or for a large specimen on disc, gives the same files and
// checkpoints.

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <string>

#include "solver/files/read_file.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/results/checkpoint.hpp"
#include "specimens/results/files.hpp"
#include "specimens/results/output_folder.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/folder_contents.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using Contents = std::map<std::string, std::string>;

constexpr std::size_t always = 0, never = std::numeric_limits<std::size_t>::max();

class PeakFrame : public ::testing::Test {
  protected:
    /// Runs a test for several calls of the clock, resumes it with new files as after a restart, until its peak is
    /// passed.
    /// @param large_frame size from which frames are stored on disc
    Contents loaded(std::size_t large_frame) {
        testing::SmallCase wanted;
        wanted.kind = "compression";
        VirtualTest test = bond_test(read_case(testing::write_small_case(scratch_ / "", wanted)));
        const fs::path folder = scratch_ / std::to_string(large_frame);
        const OutputFolder output = OutputFolder::create(folder, Earlier::refused, {});
        std::int64_t kept = -1;
        for (const bool first : {true, false}) {
            TestFiles files(output, "", test.state, {.large_frame = large_frame});
            EXPECT_EQ(test.state.peak_frame.bodies.empty(), first || large_frame == always);
            TestHooks hooks;
            hooks.interrupted = [&, looks = 0]() mutable {
                return first && test.state.failure.peak_row > 0 && ++looks > 3;
            };
            load_specimen(test, hooks, &files);
            EXPECT_EQ(test.state.peak_frame.bodies.empty(), large_frame == always);
            if (!first) files.add_peak(test.setup, test.state, test.world);
            test.state.step_seconds = 0.0;
            files.write_checkpoint(test.setup, test.state, test.world);
            EXPECT_EQ(test.state.peak_frame.bodies.empty(), large_frame == always)
                << "still in memory after the checkpoint";
            if (first) {
                std::ifstream in(folder / "checkpoint", std::ios::binary);
                test.state = load_test(in, "checkpoint").state;
                kept = test.state.peak_frame.row;
                EXPECT_EQ(kept, test.state.failure.peak_row);
                fs::copy(folder / "checkpoint", folder / "first_checkpoint");
            }
        }
        EXPECT_GT(test.state.failure.peak_row, kept) << "no peak after the restart";
        EXPECT_GT(test.world.bonds.broken, 0);
        return testing::contents(folder);
    }

  private:
    testing::ScratchFolder scratch_;
};

TEST_F(PeakFrame, OnTheDiscGivesTheBytesOfOneInMemory) {
    const Contents in_memory = loaded(never);
    EXPECT_TRUE(in_memory.contains("first_checkpoint"));
    testing::expect_same(loaded(always), in_memory, "on the disc");
}

}  // namespace
}  // namespace crackle
