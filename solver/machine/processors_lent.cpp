// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/machine/processors_lent.hpp"

#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace crackle {
namespace {

namespace fs = std::filesystem;

enum class Version { one, two };

/// Mount of control groups (cgroups) that limit processor time. There are two versions of control groups.
struct Mount {
    Version version = Version::one;
    std::string shown;  ///< control group that is visible at `place`, the mount point
    std::string place;
};

/// Whether a comma-separated list contains `word`.
bool lists(std::string_view words, std::string_view word) {
    while (!words.empty()) {
        const std::size_t comma = std::min(words.find(','), words.size());
        if (words.substr(0, comma) == word) return true;
        words.remove_prefix(std::min(comma + 1, words.size()));
    }
    return false;
}

/// A path from mountinfo with its escapes resolved; for example, a space is written as \040.
std::string unescaped(const std::string& path) {
    std::string plain;
    for (std::size_t k = 0; k < path.size(); ++k) {
        const std::string digits = path[k] == '\\' ? path.substr(k + 1, 3) : "";
        if (digits.size() == 3 && digits.find_first_not_of("01234567") == std::string::npos) {
            plain += static_cast<char>(std::stoi(digits, nullptr, 8));
            k += 3;
        } else {
            plain += path[k];
        }
    }
    return plain;
}

std::vector<Mount> mounted_groups(const fs::path& root) {
    std::vector<Mount> mounts;
    std::ifstream file(root / "proc/self/mountinfo");
    for (std::string line; std::getline(file, line);) {
        // Fields: id, parent, device, shown, place, options, optional fields, "-", type, source, options of the type.
        std::istringstream fields(line);
        std::string skipped, shown, place, type, source, options;
        fields >> skipped >> skipped >> skipped >> shown >> place;
        while (fields >> skipped && skipped != "-") {
        }
        fields >> type >> source >> options;
        if (type == "cgroup2") mounts.push_back({Version::two, unescaped(shown), unescaped(place)});
        if (type == "cgroup" && lists(options, "cpu"))
            mounts.push_back({Version::one, unescaped(shown), unescaped(place)});
    }
    return mounts;
}

/// Control groups of this process, by cgroup version.
std::map<Version, std::string> own_groups(const fs::path& root) {
    std::map<Version, std::string> groups;
    std::ifstream file(root / "proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {  // line format: number:controllers:path
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
        if (controllers.empty()) groups[Version::two] = path;
        if (lists(controllers, "cpu")) groups[Version::one] = path;
    }
    return groups;
}

std::optional<double> quota_over_period(double quota, double period) {
    if (quota > 0.0 && period > 0.0) return quota / period;
    return std::nullopt;  // -1 means no limit
}

std::optional<double> quota_of_group(const fs::path& folder, Version version) {
    double quota = 0.0, period = 0.0;
    if (version == Version::two) {  // "max 100000" means no limit; reading "max" as a number fails
        if (std::ifstream(folder / "cpu.max") >> quota >> period) return quota_over_period(quota, period);
        return std::nullopt;
    }
    if (std::ifstream(folder / "cpu.cfs_quota_us") >> quota && std::ifstream(folder / "cpu.cfs_period_us") >> period)
        return quota_over_period(quota, period);
    return std::nullopt;
}

/// Path of a control group relative to the group that is visible at a mount; "" for the visible group itself. A
/// container may see only its own group; a path from outside the container has no meaning there.
std::string below_shown(const std::string& group, const std::string& shown) {
    const std::string start = shown == "/" ? "" : shown;
    if (!group.starts_with(start) || group.find("/..") != std::string::npos) return "";
    const std::string rest = group.substr(start.size());
    return rest.empty() || rest.front() == '/' ? rest : "";
}

int processors_of_affinity() {
    constexpr int most = 1 << 20;
    for (int room = 1024; room <= most; room *= 2) {
        cpu_set_t* set = CPU_ALLOC(static_cast<std::size_t>(room));
        if (set == nullptr) break;
        const std::size_t bytes = CPU_ALLOC_SIZE(static_cast<std::size_t>(room));
        const bool known = sched_getaffinity(0, bytes, set) == 0;
        const bool too_small = !known && errno == EINVAL;
        const int count = known ? CPU_COUNT_S(bytes, set) : 0;
        CPU_FREE(set);
        if (count > 0) return count;
        if (!too_small) break;
    }
    return static_cast<int>(std::thread::hardware_concurrency());
}

}  // namespace

std::optional<double> processor_quota(const fs::path& root) {
    const std::map<Version, std::string> groups = own_groups(root);
    std::optional<double> least;
    for (const Mount& mount : mounted_groups(root)) {
        const auto own = groups.find(mount.version);
        if (own == groups.end()) continue;
        const fs::path top = root / fs::path(mount.place).relative_path();
        std::string below = below_shown(own->second, mount.shown);
        while (true) {
            const std::optional<double> quota = quota_of_group(top / fs::path(below).relative_path(), mount.version);
            if (quota && (!least || *quota < *least)) least = quota;
            if (below.empty()) break;
            below.erase(below.rfind('/'));
        }
    }
    return least;
}

int processors_lent() {
    int lent = std::max(1, processors_of_affinity());
    if (const std::optional<double> quota = processor_quota(); quota && *quota < lent)
        lent = std::max(1, static_cast<int>(std::ceil(*quota)));
    return lent;
}

}  // namespace crackle
