// SPDX-License-Identifier: GPL-3.0-or-later
// Where a specimen parted: whether its strength is the rock's or that of what holds it.
// Tested by tests/specimens/measures/parting_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "specimens/observers/contact_history.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// The largest crack: broken bonds that share particles, by their number.
struct Parting {
    std::string place;           ///< "platen", "grip" or "gauge"
    double height = 0.0;         ///< m, mean height of its bonds at the start, above the lower end of the specimen
    std::int64_t bonds = 0;      ///< bonded points that broke in it
    std::int64_t of_platen = 0;  ///< of these, between a particle and a platen
};

/// Place of the largest crack: `platen` where half of its bonds or more are a platen's; `grip` where it lies within
/// TestSetup's grip depth of an end; else `gauge`. Nothing where no bond has broken.
std::optional<Parting> find_parting(const TestSetup& setup, const ContactHistory& history);

}  // namespace crackle
