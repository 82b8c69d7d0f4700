// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/places/places.hpp"

#include <algorithm>

namespace crackle {

std::string WrittenPlaces::at(const std::string& key) const {
    const auto found = position.find(key);
    if (found != position.end()) return found->second + ": " + key;
    const auto table = position.find(key.substr(0, key.find('.')));
    return (table == position.end() ? source.string() : table->second) + ": " + key;
}

std::string Places::at(CaseKey key, std::size_t entry) const {
    std::string label = name_of(key);
    label.insert(std::min(label.find('.'), label.size()), "[" + std::to_string(entry + 1) + "]");
    return named(label);
}

}  // namespace crackle
