// SPDX-License-Identifier: GPL-3.0-or-later
// The dense stiffness that verification claims use, under the tests' name.
#pragma once

#include "tests/support/measures.hpp"
#include "tools/bench/verify/scenes/dense_stiffness.hpp"
