// SPDX-License-Identifier: GPL-3.0-or-later
// Environment variables:
//   CRACKLE_FAULT_FOLDER  only calls on paths in this folder count
//   CRACKLE_FAULT_LOG     file to which failed calls are appended, one line each: kind, number, path
//   CRACKLE_FAULT_CALL    kind of the call that fails; if unset, no call fails and the log lists all calls
//   CRACKLE_FAULT_AT      number of the call that fails, starting at 1
//   CRACKLE_FAULT_MODE    once (default), or on: all later calls fail as well
//   CRACKLE_FAULT_ERRNO   name of the error (default EIO)
//   CRACKLE_FAULT_SIGNAL  signal sent to the process just before the call, which is then executed; after PIPE and XFSZ
//                         the call fails as it would in the system
// Nothing here allocates memory, and system calls bypass the functions that are replaced.
#include "tests/faults/plan.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace crackle::faults {
namespace {

// glibc's own threshold: smaller allocations use memory that the process already has.
constexpr std::size_t least_counted = std::size_t{128} << 10;

constexpr auto call_count = static_cast<std::size_t>(Call::last_);
constexpr std::array<const char*, call_count> call_names{"open",  "read",     "write",  "fsync",  "rename",  "unlink",
                                                         "mkdir", "truncate", "mmap",   "close",  "opendir", "readdir",
                                                         "stat",  "flock",    "memory", "thread", "fork"};

struct Named {
    const char* name;
    int value;
};
constexpr std::array<Named, 10> errors{{{"EIO", EIO},
                                        {"EAGAIN", EAGAIN},
                                        {"ENOSPC", ENOSPC},
                                        {"EACCES", EACCES},
                                        {"EMFILE", EMFILE},
                                        {"ENOMEM", ENOMEM},
                                        {"EROFS", EROFS},
                                        {"EDQUOT", EDQUOT},
                                        {"ENOLCK", ENOLCK},
                                        {"EPERM", EPERM}}};
constexpr std::array<Named, 6> signals{
    {{"KILL", SIGKILL}, {"TERM", SIGTERM}, {"HUP", SIGHUP}, {"INT", SIGINT}, {"PIPE", SIGPIPE}, {"XFSZ", SIGXFSZ}}};

struct Plan {
    Path folder{};
    Path log{};
    int call = -1;  ///< -1: no call fails
    long at = 0;
    bool goes_on = false;
    int error = EIO;
    int signal = 0;
};
Plan plan;
std::atomic<bool> ready{false};
std::array<std::atomic<long>, call_count> counts{};

[[noreturn]] void refuse(const char* variable, const char* found) {
    std::fprintf(stderr, "injected faults: %s: found '%s', expected one that plan.cpp names\n", variable, found);
    std::abort();
}

const char* text_of(const char* variable) {
    const char* text = std::getenv(variable);
    return text == nullptr ? "" : text;
}

template <std::size_t n>
int value_of(const char* variable, const std::array<Named, n>& known, int otherwise) {
    const char* text = text_of(variable);
    if (*text == '\0') return otherwise;
    for (const Named& one : known)
        if (std::strcmp(one.name, text) == 0) return one.value;
    refuse(variable, text);
}

void copy(Path& to, const char* text) { std::snprintf(to.text, sizeof to.text, "%s", text); }

__attribute__((constructor)) void read_plan() {
    copy(plan.folder, text_of("CRACKLE_FAULT_FOLDER"));
    copy(plan.log, text_of("CRACKLE_FAULT_LOG"));
    if (const char* name = text_of("CRACKLE_FAULT_CALL"); *name != '\0') {
        for (std::size_t k = 0; k < call_count; ++k)
            if (std::strcmp(call_names[k], name) == 0) plan.call = static_cast<int>(k);
        if (plan.call < 0) refuse("CRACKLE_FAULT_CALL", name);
    }
    plan.at = std::atol(text_of("CRACKLE_FAULT_AT"));
    plan.goes_on = std::strcmp(text_of("CRACKLE_FAULT_MODE"), "on") == 0;
    plan.error = value_of("CRACKLE_FAULT_ERRNO", errors, EIO);
    plan.signal = value_of("CRACKLE_FAULT_SIGNAL", signals, 0);
    ready = true;
}

void append_to_log(std::size_t call, long number, const char* path) {
    if (plan.log.text[0] == '\0') return;
    char line[PATH_MAX + 64];
    const int length = std::snprintf(line, sizeof line, "%s %ld %s\n", call_names[call], number, path);
    const long log = syscall(SYS_open, plan.log.text, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    if (log < 0) return;
    syscall(SYS_write, log, line, static_cast<std::size_t>(length));
    syscall(SYS_close, log);
}

/// Counts a call. @return whether it is to fail
bool count(Call call, const char* path) {
    const auto kind = static_cast<std::size_t>(call);
    const long number = ++counts[kind];
    if (plan.call < 0) {
        const int kept = errno;
        append_to_log(kind, number, path);
        errno = kept;
        return false;
    }
    if (static_cast<int>(kind) != plan.call || number < plan.at || (number > plan.at && !plan.goes_on)) return false;
    const int kept = errno;
    append_to_log(kind, number, path);
    if (plan.signal == 0) {
        errno = plan.error;
        return true;
    }
    kill(getpid(), plan.signal);
    errno = plan.signal == SIGPIPE ? EPIPE : plan.signal == SIGXFSZ ? EFBIG : kept;
    return plan.signal == SIGPIPE || plan.signal == SIGXFSZ;
}

/// Removes "." and "..", and repeated and trailing slashes.
void make_plain(Path& path) {
    Path plain{};
    std::size_t length = 0;
    for (const char* at = path.text; *at != '\0';) {
        while (*at == '/') ++at;
        const std::size_t part = std::strcspn(at, "/");
        if (part == 2 && std::strncmp(at, "..", 2) == 0) {
            while (length > 0 && plain.text[--length] != '/') continue;
        } else if (part > 0 && !(part == 1 && *at == '.') && length + part + 2 < sizeof plain.text) {
            plain.text[length++] = '/';
            std::memcpy(plain.text + length, at, part);
            length += part;
        }
        plain.text[length] = '\0';
        at += part;
    }
    path = plain;
}

}  // namespace

Path path_of(int descriptor) {
    Path path{};
    char link[64];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const int kept = errno;
    const ssize_t length = readlink(link, path.text, sizeof path.text - 1);
    errno = kept;
    path.text[length > 0 ? length : 0] = '\0';
    return path;
}

Path path_at(int folder, const char* name) {
    Path path{};
    if (name == nullptr) return path;
    if (*name == '/') {
        copy(path, name);
    } else {
        Path base{};
        if (folder != AT_FDCWD) {
            base = path_of(folder);
        } else if (getcwd(base.text, sizeof base.text) == nullptr) {
            return path;
        }
        const std::size_t length = std::strlen(base.text);
        copy(path, base.text);
        std::snprintf(path.text + length, sizeof path.text - length, "/%s", name);
    }
    make_plain(path);
    return path;
}

bool looked_at(const Path& path) {
    const std::size_t length = std::strlen(plan.folder.text);
    return length > 0 && std::strncmp(path.text, plan.folder.text, length) == 0 &&
           (path.text[length] == '/' || path.text[length] == '\0');
}

bool fails(Call call, const Path& path) { return ready && looked_at(path) && count(call, path.text); }
bool fails(Call call, const char* name) { return ready && fails(call, path_at(AT_FDCWD, name)); }
bool fails(Call call, int descriptor) { return ready && fails(call, path_of(descriptor)); }

bool thread_fails() { return ready && count(Call::thread, "thread"); }

bool fork_fails() { return ready && count(Call::fork, "fork"); }

bool memory_fails(std::size_t bytes) { return ready && bytes >= least_counted && count(Call::memory, "memory"); }

}  // namespace crackle::faults
