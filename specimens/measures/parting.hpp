// SPDX-License-Identifier: GPL-3.0-or-later
// Where a specimen broke apart. This shows whether the rock or the bonds to the platens limit its strength.
// Tested by tests/specimens/measures/parting_test.cpp.
#pragma once

#include <cstdint>
#include <optional>

#include "solver/base/names.hpp"
#include "specimens/observers/contact_history.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// Part of the specimen in which the largest crack lies.
enum class PartingPlace : std::uint8_t { platen, grip, gauge };
constexpr auto list_names(PartingPlace) { return in_order("platen", "grip", "gauge"); }

/// The crack with the most broken bonds; a crack is a group of broken bonds connected through common particles.
struct Parting {
    PartingPlace place = PartingPlace::gauge;
    double height = 0.0;         ///< m, mean initial height of the crack's bonds above the specimen's lower end
    std::int64_t bonds = 0;      ///< number of bonded points broken in this crack
    std::int64_t of_platen = 0;  ///< number of broken points in this crack that joined a particle to a platen
};

/// Location of the largest crack. It is `platen` if at least half of its bonds belong to a platen, and `grip` if it
/// lies within the grip depth of an end (BondRecord::grip). Otherwise it is `gauge`. Empty if no bond has broken.
std::optional<Parting> find_parting(const TestSetup& setup, const ContactHistory& history);

}  // namespace crackle
