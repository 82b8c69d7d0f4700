// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle plot` with too little memory for fonts and the sheet.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "tests/support/program_call.hpp"
#include "tests/support/sample_results.hpp"

namespace crackle {
namespace {

using namespace testing;

class PlotWithoutRoom : public ProgramCall {
  protected:
    PlotWithoutRoom() : ProgramCall("plot") {
        SampleTest tension;
        tension.kind = "tension";
        write_sample_results(folder_ / "pulled", tension);
    }
};

#ifndef __SANITIZE_ADDRESS__  // which takes terabytes of addresses
// Libraries for fonts and drawing end the process by a signal if they run out of memory.
TEST_F(PlotWithoutRoom, EndsByALineAndExitCode4) {
    int drawn = 0, refused = 0;
    for (int limit = 70; limit <= 310; limit += 20) {  // MiB of address space
        for (const char* kind : {"svg", "png"}) {
            const int status = std::system(
                fmt::format("cd '{}' && ulimit -c 0 && ulimit -v {} && '{}' plot pulled --what curve ae specimen -o "
                            "{}.{} > out.txt 2> err.txt",
                            folder_.string(), limit * 1024, CRACKLE_PROGRAM, limit, kind)
                    .c_str());
            const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
            const std::string err = read("err.txt");
            EXPECT_TRUE(code == 0 || code == 4) << limit << ' ' << kind << ": " << code << ' ' << err;
            EXPECT_EQ(std::ranges::count(err, '\n'), code == 0 ? 0 : 1) << err;
            ++(code == 0 ? drawn : refused);
        }
    }
    EXPECT_GT(drawn, 0);
    EXPECT_GT(refused, 0);
}
#endif

}  // namespace
}  // namespace crackle
