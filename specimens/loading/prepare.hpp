// SPDX-License-Identifier: GPL-3.0-or-later
// From a case to a test that is ready to be loaded.
//
//   bond_test()     case → specimen → platens → world → bonds → linear solution, at rest
//   prepare_test()  and the start of loading
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include <functional>

#include "specimens/case/case_file.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/hooks.hpp"

namespace crackle {

/// Sees the linear solution with its world: the test's, or its twin with bonded platens where those are frictional.
using SolutionVisitor = std::function<void(const World&, const TestSetup&, const Moduli&)>;

/// @throws InputError for everything that makes the case impossible; TestInterrupted.
VirtualTest bond_test(const TestCase& description, const TestHooks& hooks = {}, const SolutionVisitor& visit = {});

/// @throws as bond_test()
VirtualTest prepare_test(const TestCase& description, const TestHooks& hooks = {}, const SolutionVisitor& visit = {});

/// Its linear solution, solved now where it was left out for its size. @throws InputError where there is none
Moduli moduli_of(const VirtualTest& test);

}  // namespace crackle
