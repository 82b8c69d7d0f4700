// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of test between platens: the whole packing is pressed or pulled along y, with or without a pressure on its
// sides. The stress is the force divided by the width, and the strain the displacement divided by the height.
// Tested by tests/specimens/loading/virtual_test_test.cpp.

#include <array>

#include "specimens/kinds/test_kind.hpp"

namespace crackle {
namespace {

constexpr std::array biaxial_keys{KindKey{"confinement.pressure", "kind = \"biaxial\" needs this key"},
                                  KindKey{"confinement.side"}};

}  // namespace

extern constexpr TestKind compression_kind{.uniaxial = true, .shape = whole_packing};

extern constexpr TestKind tension_kind{.compression = false,
                                       .uniaxial = true,
                                       .bonded_because = "a platen that is not bonded cannot pull",
                                       .shape = whole_packing};

extern constexpr TestKind biaxial_kind{
    .uniaxial = true, .confined = true, .keys = biaxial_keys, .shape = whole_packing};

}  // namespace crackle
