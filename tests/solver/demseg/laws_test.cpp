// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a continued run has the contact law and integrator of the previous run, which the text files do not
// contain.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>

#include "solver/demseg/deck_run.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

using namespace testing;

/// Two squares, one on top of the other.
class KeptLaw : public ::testing::Test {
  protected:
    KeptLaw() {
        std::filesystem::create_directories(folder_);
        std::ofstream(folder_ / "in_gm.dat")
            << "1 0 0\n1e-5 0 -980\n1\n2.5 1e8 0.25e8 100 100 20\n-10 10 0 20 0.1\n0 2 0\n"
               "1 1 4\n0 0 0\n1 0 0.05\n4 0.05\n2 4 0.05\n4 4.05\n3 4 4.05\n0 4.05\n4 0 4.05\n0 0.05\n"
               "2 1 4\n0 0 0\n1 1 4.1\n3 4.1\n2 3 4.1\n3 6.1\n3 3 6.1\n1 6.1\n4 1 6.1\n1 4.1\n";
        std::ofstream(folder_ / "in_bc.dat") << "3 0 200 100 10\n0\n0\n";
    }
    DeckOptions options(bool goes_on) const {
        DeckOptions result;
        result.folder = folder_;
        result.goes_on = goes_on;
        result.steps = 100;
        return result;
    }
    DeckRun run(std::optional<SegmentLaw> law) const {
        DeckOptions first = options(false);
        first.law = law;
        DeckRun deck(first);
        deck.run();
        return deck;
    }
    void edit(const std::string& name, const std::string& what, const std::string& by) const {
        std::string text = read_file(folder_ / name);
        const std::size_t at = text.find(what);
        ASSERT_NE(at, std::string::npos) << text;
        std::ofstream(folder_ / name) << text.replace(at, what.size(), by);
    }
    /// Number of notices that contain these words.
    static std::ptrdiff_t said(const DeckRun& deck, const std::string& words) {
        for (const std::string& notice : deck.notices()) fmt::print("  {}\n", notice);
        return std::ranges::count_if(deck.notices(), [&](const std::string& n) { return n.find(words) != n.npos; });
    }
    static SegmentLaw law_of(const DeckRun& deck) { return deck.world().settings.segment_law; }

    ScratchFolder scratch_;
    std::filesystem::path folder_ = scratch_ / "deck";
};

TEST_F(KeptLaw, IsSaidWhereItIsChosenAndWhereItIsMet) {
    EXPECT_EQ(said(run(SegmentLaw::demseg), "--law demseg: recorded in " + (folder_ / "new_state.bin").string()), 1);
    const DeckRun next(options(true));
    EXPECT_EQ(law_of(next), SegmentLaw::demseg);
    EXPECT_EQ(said(next, "--law demseg, as in the previous run according to "), 1);
}

TEST_F(KeptLaw, HoldsWhereTheTextsWereEdited) {
    run(SegmentLaw::demseg_mean);
    edit("new_in_bc.dat", " 100 10\n", " 50 5\n");
    const DeckRun next(options(true));
    EXPECT_EQ(said(next, "ignored, because in_bc.dat has changed"), 1);
    EXPECT_EQ(said(next, "--law demseg_mean, as in the previous run according to "), 1);
    EXPECT_EQ(law_of(next), SegmentLaw::demseg_mean);
}

TEST_F(KeptLaw, HoldsForRenamedFilesAndForTheirBackTensions) {
    run(SegmentLaw::demseg);
    for (const char* name : {"in_gm.dat", "in_bc.dat", "in_cf.dat", "in_cf0.dat"})
        std::filesystem::rename(folder_ / (std::string("new_") + name), folder_ / name);
    DeckOptions next = options(false);
    next.output = scratch_ / "next";
    EXPECT_EQ(law_of(DeckRun(next)), SegmentLaw::demseg);
    edit("in_bc.dat", "1 100 ", "3 0 ");  // a new start with bonds
    const DeckRun repeated(next);
    EXPECT_EQ(law_of(repeated), SegmentLaw::demseg);
    EXPECT_GT(repeated.world().bonds.initial, 0);
    edit("in_bc.dat", "3 0 ", "0 0 ");  // a new start uses nothing from the previous run
    EXPECT_EQ(law_of(DeckRun(next)), SegmentLaw::rounded);
}

TEST_F(KeptLaw, IsNotThatOfOtherContacts) {
    run(SegmentLaw::demseg);
    std::ofstream(folder_ / "new_in_cf.dat") << "1 0\n2 0\n";
    EXPECT_EQ(law_of(DeckRun(options(true))), SegmentLaw::rounded);
}

TEST_F(KeptLaw, ContradictedIsAnErrorThatNamesBoth) {
    run(SegmentLaw::demseg);
    DeckOptions next = options(true);
    next.law = SegmentLaw::rounded;
    for (const bool edited : {false, true}) {
        if (edited) edit("new_in_bc.dat", " 100 10\n", " 50 5\n");
        const std::string said = refusal([&] { DeckRun{next}; });
        EXPECT_NE(said.find("--law: found rounded, expected demseg, as recorded "), std::string::npos);
        EXPECT_NE(said.find("new_state.bin"), std::string::npos);
    }
    next.law = SegmentLaw::demseg;
    EXPECT_NO_THROW(DeckRun{next});
    next.integrator = Integrator::consistent;
    EXPECT_NE(refusal([&] { DeckRun{next}; }).find("--integrator: found consistent, expected leapfrog, as recorded "),
              std::string::npos);
}

TEST_F(KeptLaw, IsNotMentionedWhereNobodyChoseAny) {
    EXPECT_EQ(said(run(std::nullopt), "--"), 0);
    edit("new_in_bc.dat", " 100 10\n", " 50 5\n");
    const DeckRun next(options(true));
    EXPECT_EQ(said(next, "--"), 0);
    EXPECT_EQ(law_of(next), SegmentLaw::rounded);
}

}  // namespace
}  // namespace crackle
