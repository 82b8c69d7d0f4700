// SPDX-License-Identifier: GPL-3.0-or-later
// Prepares a test from its case up to the start of loading.
//
//   make_and_bond()   case → specimen → platens → world → bonds
//   bond_test()       additionally computes the forces and the linear solution, and confines the specimen
//   prepare_test()    additionally starts the loading motion
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include <functional>

#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/parts/resolved_case.hpp"
#include "specimens/setup/platen.hpp"

namespace crackle {

/// Called with the linear solution and the world for which it was computed: the test's own world or, if its platens are
/// frictional, a copy with bonded platens.
using SolutionVisitor = std::function<void(const World&, const TestSetup&, const Moduli&)>;

/// A test whose bonds have been made, with the specimen and the platens from which it was made.
struct BondedTest {
    VirtualTest test;
    Specimen specimen;
    Platens platens;
    std::function<void()> while_solving;  ///< throws TestInterrupted after an interrupt
};

/// Makes the specimen, its platens, the world and the bonds.
/// @throws InputError if the specimen cannot be made or bonded; TestInterrupted
BondedTest make_and_bond(const ResolvedCase& description, const TestHooks& hooks);

/// Prepares a test up to the start of the loading motion. @throws InputError if the case cannot be tested for any
/// reason; TestInterrupted
VirtualTest bond_test(const ResolvedCase& description, const TestHooks& hooks = {}, const SolutionVisitor& visit = {});

/// Prepares a test and starts the loading motion. @throws the exceptions of bond_test()
VirtualTest prepare_test(const ResolvedCase& description, const TestHooks& hooks = {},
                         const SolutionVisitor& visit = {});
/// Prepares a bonded test, whose forces have been computed, and starts the loading motion.
/// @throws the exceptions of bond_test()
VirtualTest prepare_test(BondedTest bonded, const ResolvedCase& description, const TestHooks& hooks,
                         const SolutionVisitor& visit = {});

/// The linear solution of a test, computed now if it was skipped because the test is large.
/// @throws InputError if there is no solution
Moduli moduli_of(const VirtualTest& test);

}  // namespace crackle
