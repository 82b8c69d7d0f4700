// SPDX-License-Identifier: GPL-3.0-or-later
// The measures that verification claims use, under the tests' name.
#pragma once

#include "tools/bench/verify/scenes/measures.hpp"

namespace crackle::testing {

using namespace verification;

}  // namespace crackle::testing
