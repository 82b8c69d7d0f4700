// SPDX-License-Identifier: GPL-3.0-or-later
// A step with nothing but what the discs of a world need: what the engine's step is compared with where a scene lacks a
// feature.
//
// Forces by the engine's contact kernels of given features, their sums, kick and drift as the engine compiles them for
// discs without gravity. The largest speed is found, and whether it is a number: neighbour list and health of a run
// depend on it. Everything else that a world can have is left out: a check of the list, threads, a profile, gravity,
// bodies that turn, driven bodies, losses, breaks. Same bytes as step() as long as nothing of that happens.
// Tested by tests/bench_tests/throughput/feature_costs_test.cpp.
#pragma once

#include "solver/contact/pass.hpp"
#include "solver/world/world.hpp"

namespace crackle::throughput {

/// The least step of a world of single circles that has taken its first step, on one thread.
void least_step(World& world, const ContactFeatures& features);

/// Makes room for what the kernels of these features remember of a point, in a world that lacks some of them. Bonds,
/// sliders and dashpots that are not there stay without effect.
void make_room_for(World& world, const ContactFeatures& features);

}  // namespace crackle::throughput
