// SPDX-License-Identifier: GPL-3.0-or-later
// Array type for the simulation state. Large arrays use memory pages of 2 MiB. A step reads a dozen arrays in parallel.
// With pages of 4 KiB, the processor must translate an address every few points, and prefetching stops at the end of a
// page. For a million circles, this would take a sixth of the time of a step.
#pragma once

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <new>
#include <vector>

namespace crackle {

/// Allocator that requests pages of 2 MiB from the operating system for arrays that fill at least two of them.
template <class T>
struct LargePages {
    using value_type = T;

    static constexpr std::size_t page = std::size_t{2} << 20, fewest_pages = 2;

    LargePages() = default;
    /// Converts from the allocator of another element type; allocators have no state.
    template <class Other>
    constexpr LargePages(const LargePages<Other>& /*other*/) {}

    /// Allocates memory for `count` elements. @throws std::bad_array_new_length, std::bad_alloc
    T* allocate(std::size_t count) {
        if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
        void* const room = ::operator new(count * sizeof(T), alignment(count));
#if defined(__linux__)
        // Large pages are requested only for the part of the array that fills them, since a large page for the
        // remainder would waste memory. If the operating system refuses the request, only speed is lost.
        if (is_large(count)) static_cast<void>(madvise(room, count * sizeof(T) / page * page, MADV_HUGEPAGE));
#endif
        return static_cast<T*>(room);
    }
    /// Frees memory obtained from allocate(). @param count number of elements passed to allocate()
    void deallocate(T* room, std::size_t count) { ::operator delete(room, alignment(count)); }

    friend bool operator==(const LargePages& /*a*/, const LargePages& /*b*/) { return true; }

  private:
    static constexpr bool is_large(std::size_t count) { return count * sizeof(T) >= fewest_pages * page; }
    static constexpr std::align_val_t alignment(std::size_t count) {
        return std::align_val_t{is_large(count) ? page : alignof(T)};
    }
};

template <class T>
using Array = std::vector<T, LargePages<T>>;

}  // namespace crackle
