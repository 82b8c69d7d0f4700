// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/test_case.hpp"

namespace crackle {

namespace fs = std::filesystem;

fs::path TestCase::resolve_path(const std::string& key, const std::string& written) const {
    const std::string& where = position.at(key);
    return (fs::path(where.substr(0, where.rfind(':'))).parent_path() / written).lexically_normal();
}

InputError key_needs(const TestCase& test, const std::string& key, const std::string& what) {
    return InputError(test.at(key) + " needs " + what + "; add that, or remove the key");
}

InputError key_without_room(const TestCase& test, const std::string& key, const std::string& because) {
    return InputError(test.at(key) + " cannot be given here: " + because + "; remove the key");
}

}  // namespace crackle
