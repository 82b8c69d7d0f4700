// SPDX-License-Identifier: GPL-3.0-or-later
// Determines which call of a process fails and how, as set in the environment (plan.cpp).
// Tested by tests/faults/library_test.py.
#pragma once

#include <climits>
#include <cstddef>

namespace crackle::faults {

/// Kinds of calls; each kind is counted separately. memory: memory that malloc and similar functions request from the
/// system (by mmap); thread: the start of a thread; fork: a process. A forked process continues counting on its own.
enum class Call {
    open,
    read,
    write,
    fsync,
    rename,
    unlink,
    mkdir,
    truncate,
    mmap,
    close,
    opendir,
    readdir,
    stat,
    flock,
    memory,
    thread,
    fork,
    last_
};

/// An absolute path without "." and "..".
struct Path {
    char text[PATH_MAX];
};

/// Path of a name relative to a folder's descriptor or to AT_FDCWD. Symbolic links in it are not followed.
Path path_at(int folder, const char* name);
/// Path of an open file; empty if it has none.
Path path_of(int descriptor);

/// Counts a call on a path. @return whether it is to fail; errno is then set
bool fails(Call call, const Path& path);
bool fails(Call call, const char* name);
bool fails(Call call, int descriptor);
/// Counts an allocation of `bytes`, if it is large enough to be counted.
bool memory_fails(std::size_t bytes);
bool thread_fails();
bool fork_fails();

/// Whether the path is in the observed folder.
bool looked_at(const Path& path);

}  // namespace crackle::faults
