// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the effect of a first and a second signal on work that does not poll for interrupts.
#include "tools/terminal/interrupt.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

namespace crackle::tools {
namespace {

/// A process that receives a signal and continues to work for some time, as in a library call.
class DeafWork {
  public:
    /// @param last_words as for end_unheard() @param asks whether it polls for interrupts once, at the beginning
    DeafWork(int signal, std::chrono::milliseconds longer, const char* last_words = nullptr, bool asks = false) {
        int errors[2];
        EXPECT_EQ(pipe(errors), 0);
        child_ = fork();
        if (child_ == 0) {
            dup2(errors[1], STDERR_FILENO);
            close(errors[0]);
            close(errors[1]);
            watch_interrupts();
            end_unheard(last_words);
            raise(signal);
            if (asks && !interrupted()) _exit(2);
            const auto end = std::chrono::steady_clock::now() + longer;
            while (std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(5));
            _exit(interrupted() ? 130 : 1);
        }
        close(errors[1]);
        errors_ = errors[0];
    }
    ~DeafWork() { close(errors_); }

    std::string line() const {
        std::string text;
        char letter = 0;
        while (::read(errors_, &letter, 1) == 1 && letter != '\n') text += letter;
        return text;
    }
    void send(int signal) const { kill(child_, signal); }
    int status() const {
        int status = 0;
        EXPECT_EQ(waitpid(child_, &status, 0), child_);
        return status;
    }

  private:
    pid_t child_ = -1;
    int errors_ = -1;
};

TEST(Interrupt, ThatIsNotHeardTellsOfTheSecondWhichEndsTheProcess) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const DeafWork work(signal, std::chrono::seconds(60));
        EXPECT_EQ(work.line(),
                  "crackle: will end when the current solve or file is done; press Ctrl-C again to end at once");
        work.send(signal);
        const int status = work.status();
        ASSERT_TRUE(WIFSIGNALED(status));
        EXPECT_EQ(WTERMSIG(status), signal);
    }
}

TEST(Interrupt, EndsWorkThatNobodyCanAskAndThatLeavesNothing) {
    const auto begun = std::chrono::steady_clock::now();
    const DeafWork work(SIGTERM, std::chrono::seconds(60), "interrupted, nothing is written");
    EXPECT_EQ(work.line(),
              "crackle: will end in three seconds, or when the current solve is done; press Ctrl-C again to end at "
              "once");
    EXPECT_EQ(work.line(), "crackle: interrupted, nothing is written");
    const int status = work.status();
    ASSERT_TRUE(WIFEXITED(status)) << "by itself";
    EXPECT_EQ(WEXITSTATUS(status), 130);
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(30));
}

TEST(Interrupt, LetsWorkThatHasHeardItWriteToItsEnd) {
    const DeafWork work(SIGTERM, std::chrono::seconds(7), "interrupted, nothing is written", true);
    EXPECT_EQ(work.line(),
              "crackle: will end when the current solve or file is done; press Ctrl-C again to end at once");
    EXPECT_EQ(work.line(), "");
    EXPECT_EQ(WEXITSTATUS(work.status()), 130);
}

TEST(Interrupt, ThatIsHeardSoonSaysNothing) {
    const DeafWork work(SIGINT, std::chrono::milliseconds(100));
    EXPECT_EQ(work.line(), "");
    const int status = work.status();
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 130);
}

TEST(Interrupt, AHostThatHearsSignalsItselfKeepsThem) {
    bool wanted = false;
    hear_interrupts_by([&] { return wanted; });
    watch_interrupts();
    EXPECT_EQ(std::signal(SIGINT, SIG_DFL), SIG_DFL) << "as it was";
    EXPECT_FALSE(interrupted());
    wanted = true;
    EXPECT_TRUE(interrupted());
    hear_interrupts_by({});
    EXPECT_FALSE(interrupted());
}

}  // namespace
}  // namespace crackle::tools
