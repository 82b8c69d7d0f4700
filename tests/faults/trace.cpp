// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/faults/trace.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

namespace crackle::faults {
namespace {

long trace() {
    static const long file = [] {
        const char* name = std::getenv("CRACKLE_FAULT_TRACE");
        return name == nullptr ? -1L : syscall(SYS_open, name, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    }();
    return file;
}

std::mutex& order() {
    static std::mutex one;
    return one;
}

void put(std::string_view text) { syscall(SYS_write, trace(), text.data(), text.size()); }

}  // namespace

Recorded::Recorded() {
    if (trace() >= 0) lock_ = std::unique_lock(order());
}

void Recorded::add(const char* kind, const Path& path, long offset, std::string_view data) const {
    if (!wanted() || !looked_at(path)) return;
    const int kept = errno;
    const std::string_view name(path.text);
    char line[96];
    std::snprintf(line, sizeof line, "%s %ld %zu %zu\n", kind, offset, name.size(), data.size());
    put(line);
    put(name);
    put(data);
    put("\n");
    errno = kept;
}

}  // namespace crackle::faults
