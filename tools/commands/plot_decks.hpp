// SPDX-License-Identifier: GPL-3.0-or-later
// The part of `crackle plot` that draws curves of deck runs.
// Tested by tests/tools/commands/plot_decks_test.cpp.
#pragma once

#include "tools/commands/plot_look.hpp"

namespace crackle::tools {

class Messages;

/// Whether all paths are deck runs. @throws InputError if only some are, since their diagrams have no axes in common
bool are_runs_of_decks(const Words& paths);

/// Draws curves of deck runs; several runs share panels.
void plot_decks(const po::variables_map& given, const Words& folders, const Look& look, Messages& messages);

}  // namespace crackle::tools
