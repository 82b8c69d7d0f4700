// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the head of the pages of campaigns and calibrations.

#include "tools/campaign/page/html_page.hpp"

#include <gtest/gtest.h>

namespace crackle::tools {
namespace {

TEST(HtmlPage, RunsNoScriptAndFetchesNothing) {
    const std::string head = page_head("<script>", "one & two");
    const std::size_t policy = head.find("<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; ");
    ASSERT_NE(policy, std::string::npos) << head;
    EXPECT_LT(policy, head.find("<title>")) << "the policy must precede what it restricts";
    EXPECT_EQ(head.find("script-src"), std::string::npos);
    EXPECT_NE(head.find("<h1>&lt;script&gt;</h1>"), std::string::npos);
}

}  // namespace
}  // namespace crackle::tools
