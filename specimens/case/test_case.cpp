// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/test_case.hpp"

namespace crackle {

namespace fs = std::filesystem;

std::string TestCase::at(const std::string& key) const {
    const auto found = position.find(key);
    if (found != position.end()) return found->second + ": " + key;
    const auto table = position.find(key.substr(0, key.find('.')));
    return (table == position.end() ? source.string() : table->second) + ": " + key;
}

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

std::vector<std::filesystem::path> files_read(const TestCase& test) {
    std::vector<std::filesystem::path> files = test.inputs;
    const auto add = [&](const std::string& key, const std::optional<std::string>& file) {
        if (file) files.push_back(test.resolve_path(key, *file));
    };
    add("particles.file", test.particles.file);
    add("packing.sieve", test.packing.sieve);
    add("minerals.labels", test.minerals.labels);
    add("minerals.image", test.minerals.image);
    for (std::size_t k = 0; k < test.trace.size(); ++k)
        add("trace[" + std::to_string(k + 1) + "].file", test.trace[k].file);
    return files;
}

}  // namespace crackle
