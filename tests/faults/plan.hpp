// SPDX-License-Identifier: GPL-3.0-or-later
// Which call of a process fails, and how; the environment says it (plan.cpp).
// Tested by tests/faults/library_test.py.
#pragma once

#include <climits>
#include <cstddef>

namespace crackle::faults {

/// Kinds of calls, counted each for itself. memory: what malloc and its kin take from the system (mmap, by itself);
/// thread: one that is begun; fork: a process. A process that is forked goes on counting by itself.
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

/// A path without relative parts.
struct Path {
    char text[PATH_MAX];
};

/// Path of a name relative to a folder's descriptor, or to AT_FDCWD. Links in it are not followed.
Path path_at(int folder, const char* name);
/// Path of an open file; empty if it has none.
Path path_of(int descriptor);

/// Counts a call on a path. @return whether it is to fail; errno is set then
bool fails(Call call, const Path& path);
bool fails(Call call, const char* name);
bool fails(Call call, int descriptor);
/// Counts an allocation of `bytes`, if it is large enough to be counted.
bool memory_fails(std::size_t bytes);
bool thread_fails();
bool fork_fails();

/// Whether the path lies in the folder that is looked at.
bool looked_at(const Path& path);

}  // namespace crackle::faults
