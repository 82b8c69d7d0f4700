// SPDX-License-Identifier: GPL-3.0-or-later
// Prepares a test from its case up to the start of loading.
//
//   bond_test()      case → specimen → platens → world → bonds → linear solution, at rest
//   prepare_test()   additionally starts the loading motion
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include <functional>

#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// Called with the linear solution and the world for which it was computed: the test's own world or, if its platens are
/// frictional, a copy with bonded platens.
using SolutionVisitor = std::function<void(const World&, const TestSetup&, const Moduli&)>;

/// Prepares a test at rest. @throws InputError if the case cannot be tested for any reason; TestInterrupted
VirtualTest bond_test(const ResolvedCase& description, const TestHooks& hooks = {}, const SolutionVisitor& visit = {});

/// Prepares a test and starts the loading motion. @throws the exceptions of bond_test()
VirtualTest prepare_test(const ResolvedCase& description, const TestHooks& hooks = {},
                         const SolutionVisitor& visit = {});

/// The linear solution of a test, computed now if it was skipped because the test is large.
/// @throws InputError if there is no solution
Moduli moduli_of(const VirtualTest& test);

}  // namespace crackle
