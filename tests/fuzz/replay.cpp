// SPDX-License-Identifier: GPL-3.0-or-later
// Passes each file FOLDER/TARGET/* to its target, to check that faults found earlier remain fixed. Needs neither clang
// nor libFuzzer.
//   fuzz_replay FOLDER | fuzz_replay TARGET FILE...

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "tests/fuzz/targets.hpp"

namespace {

namespace fs = std::filesystem;
using Target = void (*)(std::string_view);

Target target_named(const std::string& name) {
#define CRACKLE_FUZZ_NAMED(target) \
    if (name == #target) return crackle::fuzz::target;
    CRACKLE_FUZZ_TARGETS(CRACKLE_FUZZ_NAMED)
#undef CRACKLE_FUZZ_NAMED
    return nullptr;
}

// Limits, the same as `run` sets for libFuzzer.
constexpr double most_seconds = 5.0;
constexpr rlim_t most_memory = rlim_t{1} << 30;

bool holds(const std::string& name, const fs::path& file) {
    const Target target = target_named(name);
    if (target == nullptr) {
        fmt::print("{}: found no target '{}', expected one of tests/fuzz/targets.hpp\n", file.string(), name);
        return false;
    }
    const auto start = std::chrono::steady_clock::now();
    std::string outcome = "read";
    bool good = true;
    try {
        target(crackle::read_file(file));
    } catch (const crackle::InputError& error) {
        outcome = fmt::format("refused: {:.200}", error.what());
        good = std::strlen(error.what()) < 4096;  // longer messages are not useful
    } catch (const std::exception& error) {
        outcome = fmt::format("FOUND an exception that is no InputError: {:.200}", error.what());
        good = false;
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds > most_seconds) good = false, outcome += fmt::format("; FOUND {:.1f} s", seconds);
    fmt::print("{}: {}\n", file.string(), outcome);
    static_cast<void>(std::fflush(stdout));  // the next input may crash
    return good;
}

std::vector<fs::path> sorted(const fs::path& folder) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

}  // namespace

int main(int count, char** words) {
    if (count < 2) {
        fmt::print(stderr, "usage: fuzz_replay FOLDER | fuzz_replay TARGET FILE...\n");
        return 2;
    }
#if !defined(__SANITIZE_ADDRESS__)  // which takes terabytes of addresses
    const rlimit limit{most_memory, most_memory};
    static_cast<void>(setrlimit(RLIMIT_AS, &limit));
#endif
    std::vector<std::pair<std::string, fs::path>> cases;
    if (count == 2) {
        for (const fs::path& folder : sorted(words[1]))
            for (const fs::path& file : sorted(folder)) cases.emplace_back(folder.filename().string(), file);
    }
    for (int k = 2; k < count; ++k) cases.emplace_back(words[1], words[k]);
    std::size_t good = 0;
    for (const auto& [name, file] : cases) good += holds(name, file) ? 1 : 0;
    fmt::print("{} of {} inputs are read or refused as they should\n", good, cases.size());
    return good == cases.size() && good > 0 ? 0 : 1;
}
