// SPDX-License-Identifier: GPL-3.0-or-later
// The subcommands of `crackle campaign`.
// Tested by tests/tools/campaign/campaign_test.cpp.
#pragma once

#include "tools/commands/commands.hpp"

namespace crackle::tools {

CommandLine describe_campaign_show();
int campaign_show(const Invocation& given);
CommandLine describe_campaign_gather();
int campaign_gather(const Invocation& given);
CommandLine describe_campaign_submit();
int campaign_submit(const Invocation& given);

}  // namespace crackle::tools
