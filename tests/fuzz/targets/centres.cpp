// SPDX-License-Identifier: GPL-3.0-or-later
// A list of centres for `crackle mesh`.

#include "tests/fuzz/targets.hpp"
#include "tools/commands/centre_list.hpp"

void crackle::fuzz::centres(std::string_view bytes) {
    if (tools::looks_like_centre_list(bytes)) tools::parse_centre_list("centres.txt", bytes);
}
