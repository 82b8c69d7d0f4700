// SPDX-License-Identifier: GPL-3.0-or-later
// The arrays in files of frames, each declared once with its unit and meaning.
// Tested by tests/tools/readme_test.py.
#pragma once

#include <span>

#include "solver/base/quantity.hpp"

namespace crackle {

/// Quantities that each file states for the whole frame, in file order.
std::span<const Quantity> frame_fields();
/// Arrays with a value for each particle, in file order.
std::span<const Quantity> particle_arrays();
/// Arrays with a value for each contact, in file order.
std::span<const Quantity> contact_arrays();
/// Arrays with a value for each crack, in file order.
std::span<const Quantity> crack_arrays();
/// Arrays with a value for each face on a joint, in file order.
std::span<const Quantity> joint_arrays();

}  // namespace crackle
