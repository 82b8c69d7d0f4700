// SPDX-License-Identifier: GPL-3.0-or-later
// The subcommands of `crackle campaign`.
// Tested by tests/tools/campaign/campaign_test.cpp.
#pragma once

#include <cstdint>

#include "tools/commands/commands.hpp"

namespace crackle::tools {

/// Exit code of a finished campaign.
/// @param gone_wrong number of tests that ended without a result, including `failures`
/// @param failures number of tests that ended with a system error, such as lack of memory
int exit_code_of(std::int64_t gone_wrong, std::int64_t failures);

CommandLine describe_campaign_show();
int campaign_show(const Invocation& given);
CommandLine describe_campaign_gather();
int campaign_gather(const Invocation& given);
CommandLine describe_campaign_submit();
int campaign_submit(const Invocation& given);

}  // namespace crackle::tools
