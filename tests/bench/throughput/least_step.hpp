// SPDX-License-Identifier: GPL-3.0-or-later
// The least step: a step with only the operations that discs need, with which the engine's step is compared if a scene
// lacks a feature.
//
// It computes forces with the engine's contact kernels for the given features, sums them, and applies kick and drift as
// the engine does for discs without gravity. It also finds the largest speed and checks that it is finite, since the
// neighbour list and the health checks need it. Everything else is left out: checks of the list, threads, a profile,
// gravity, rotating frames, driven bodies, losses, breaks. It gives the same bytes as step() as long as none of these
// matters.
// Tested by tests/bench_tests/throughput/feature_costs_test.cpp.
#pragma once

#include "solver/contact/pass.hpp"
#include "solver/world/world.hpp"

namespace crackle::throughput {

/// Runs the least step for a world of single circles that has already taken its first step, on one thread.
void least_step(World& world, const ContactFeatures& features);

/// Allocates the arrays that kernels with these features store per point, for a world that lacks some of the features.
/// Absent bonds, friction and dashpots have no effect.
void make_room_for(World& world, const ContactFeatures& features);

}  // namespace crackle::throughput
