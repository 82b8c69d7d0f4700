// SPDX-License-Identifier: GPL-3.0-or-later
// Tests workers: every piece ends exactly once, whatever happens to its process.

#include "specimens/campaign/crew.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <new>
#include <string>
#include <thread>
#include <vector>

namespace crackle {
namespace {

/// Hands out pieces 0, 1, … in order.
CrewWork counting(std::size_t pieces, std::size_t& next, std::map<std::size_t, std::vector<PieceEnd>>& ends) {
    CrewWork crew;
    crew.work = [](std::size_t piece) { return "piece " + std::to_string(piece); };
    crew.next = [pieces, &next](std::optional<std::size_t> /*before*/) {
        return next < pieces ? std::optional(next++) : std::nullopt;
    };
    crew.ended = [&ends](std::size_t piece, const PieceEnd& end) { ends[piece].push_back(end); };
    return crew;
}

TEST(Crew, AnswersEveryPieceOnce) {
    std::size_t next = 0;
    std::map<std::size_t, std::vector<PieceEnd>> ends;
    CrewWork crew = counting(200, next, ends);
    crew.work = [](std::size_t piece) { return std::string(piece * 1000, 'x'); };  // larger than a pipe holds
    EXPECT_TRUE(run_crew(3, crew));
    ASSERT_EQ(ends.size(), 200U);
    for (const auto& [piece, all] : ends) {
        ASSERT_EQ(all.size(), 1U);
        EXPECT_EQ(all[0].how, PieceEnd::How::answered);
        EXPECT_EQ(all[0].answer.size(), piece * 1000);
    }
}

TEST(Crew, TellsHowAProcessEndedAndGoesOnWithTheOthers) {
    std::size_t next = 0;
    std::map<std::size_t, std::vector<PieceEnd>> ends;
    CrewWork crew = counting(6, next, ends);
    crew.work = [](std::size_t piece) {
        if (piece == 1) ::kill(::getpid(), SIGKILL);
        if (piece == 2) std::_Exit(7);
        return std::string("done");
    };
    EXPECT_TRUE(run_crew(2, crew));
    ASSERT_EQ(ends.size(), 6U);
    EXPECT_EQ(ends[1].at(0).how, PieceEnd::How::killed);
    EXPECT_EQ(ends[1].at(0).code, SIGKILL);
    EXPECT_EQ(ends[2].at(0).how, PieceEnd::How::ended);
    EXPECT_EQ(ends[2].at(0).code, 7);
    for (const std::size_t piece : {std::size_t{0}, std::size_t{3}, std::size_t{4}, std::size_t{5}})
        EXPECT_EQ(ends[piece].at(0).answer, "done") << piece;
}

TEST(Crew, GoesOnWhereTheOnlyProcessEndedBetweenTwoPieces) {
    std::size_t next = 0;
    std::map<std::size_t, std::vector<PieceEnd>> ends;
    CrewWork crew = counting(4, next, ends);
    crew.work = [](std::size_t) { return std::to_string(::getpid()); };
    crew.ended = [&](std::size_t piece, const PieceEnd& end) {
        ends[piece].push_back(end);
        if (piece != 0) return;
        const int idle = std::stoi(end.answer);
        ::kill(idle, SIGKILL);
        siginfo_t state{};
        ::waitid(P_PID, static_cast<id_t>(idle), &state, WEXITED | WNOWAIT);
    };
    EXPECT_TRUE(run_crew(1, crew));
    ASSERT_EQ(ends.size(), 4U);
    EXPECT_EQ(ends[1].at(0).how, PieceEnd::How::killed);
    EXPECT_EQ(ends[3].at(0).how, PieceEnd::How::answered);
}

TEST(Crew, AProcessWithoutMemorySaysSo) {
    std::size_t next = 0;
    std::map<std::size_t, std::vector<PieceEnd>> ends;
    CrewWork crew = counting(1, next, ends);
    crew.work = [](std::size_t) -> std::string { throw std::bad_alloc(); };
    EXPECT_TRUE(run_crew(1, crew));
    EXPECT_EQ(ends[0].at(0).how, PieceEnd::How::ended);
    EXPECT_EQ(ends[0].at(0).code, worker_without_memory);
}

TEST(Crew, EndsWhatTakesTooLong) {
    std::size_t next = 0;
    std::map<std::size_t, std::vector<PieceEnd>> ends;
    CrewWork crew = counting(3, next, ends);
    crew.work = [](std::size_t piece) {
        if (piece == 0) std::this_thread::sleep_for(std::chrono::seconds(600));
        return std::string("done");
    };
    crew.time_limit = 0.5;
    EXPECT_TRUE(run_crew(1, crew));
    EXPECT_EQ(ends[0].at(0).how, PieceEnd::How::timed_out);
    EXPECT_GE(ends[0].at(0).seconds, 0.5);
    EXPECT_EQ(ends[2].at(0).answer, "done");
}

TEST(Crew, LeavesPiecesAtWorkWhenInterrupted) {
    std::size_t next = 0;
    std::map<std::size_t, std::vector<PieceEnd>> ends;
    CrewWork crew = counting(4, next, ends);
    crew.work = [](std::size_t piece) {
        if (piece == 1) std::this_thread::sleep_for(std::chrono::seconds(600));
        return std::string("done");
    };
    crew.interrupted = [&] { return ends.contains(0) && next > 1; };
    EXPECT_FALSE(run_crew(1, crew));
    EXPECT_TRUE(ends.contains(0));
    EXPECT_FALSE(ends.contains(1));
}

TEST(Crew, GivesAWorkerWhatGoesWithItsLastPiece) {
    std::vector<std::pair<std::optional<std::size_t>, std::size_t>> given;
    std::size_t next = 0;
    CrewWork crew;
    crew.work = [](std::size_t) { return std::string(); };
    crew.next = [&](std::optional<std::size_t> before) -> std::optional<std::size_t> {
        if (next == 3) return std::nullopt;
        given.emplace_back(before, next);
        return next++;
    };
    crew.ended = [](std::size_t, const PieceEnd&) {};
    EXPECT_TRUE(run_crew(1, crew));
    ASSERT_EQ(given.size(), 3U);
    EXPECT_FALSE(given[0].first.has_value());
    EXPECT_EQ(given[1].first, 0U);
    EXPECT_EQ(given[2].first, 1U);
}

}  // namespace
}  // namespace crackle
