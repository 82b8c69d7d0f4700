// SPDX-License-Identifier: GPL-3.0-or-later
// The dense stiffness that verification claims use, under the tests' name.
#pragma once

#include "specimens/verification/dense_stiffness.hpp"
#include "tests/support/measures.hpp"
