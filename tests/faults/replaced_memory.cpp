// SPDX-License-Identifier: GPL-3.0-or-later
// Allocations that can fail according to the plan (plan.cpp): large ones, for which malloc requests memory from the
// system.
#include <malloc.h>

#include <cerrno>
#include <cstdlib>

#include "tests/faults/plan.hpp"

using crackle::faults::memory_fails;

extern "C" {

// The C library's own allocation functions under their internal names, since looking up the usual names would allocate
// memory.
void* __libc_malloc(size_t bytes);
void* __libc_calloc(size_t count, size_t bytes);
void* __libc_realloc(void* old, size_t bytes);
void* __libc_memalign(size_t alignment, size_t bytes);

void* malloc(size_t bytes) noexcept { return memory_fails(bytes) ? nullptr : __libc_malloc(bytes); }
void* calloc(size_t count, size_t bytes) noexcept {
    return memory_fails(count * bytes) ? nullptr : __libc_calloc(count, bytes);
}
void* realloc(void* old, size_t bytes) noexcept { return memory_fails(bytes) ? nullptr : __libc_realloc(old, bytes); }
void* aligned_alloc(size_t alignment, size_t bytes) noexcept {
    return memory_fails(bytes) ? nullptr : __libc_memalign(alignment, bytes);
}
void* memalign(size_t alignment, size_t bytes) noexcept { return aligned_alloc(alignment, bytes); }
int posix_memalign(void** room, size_t alignment, size_t bytes) noexcept {
    *room = aligned_alloc(alignment, bytes);
    return *room == nullptr ? ENOMEM : 0;
}

}  // extern "C"
