// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays of a world, on large pages where they are large: a step runs through a dozen of them side by side, and pages
// of 4 KB have the processor look up an address every few points and stop fetching ahead there (a sixth of the step of
// a million circles).
// Tested by tests/solver/base/array_test.cpp.
#pragma once

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <new>
#include <vector>

namespace crackle {

template <class T>
struct LargePages {
    using value_type = T;

    static constexpr std::size_t page = std::size_t{2} << 20, fewest_pages = 2;

    LargePages() = default;
    template <class Other>
    constexpr LargePages(const LargePages<Other>& /*other*/) {}

    T* allocate(std::size_t count) {
        if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
        void* const room = ::operator new(count * sizeof(T), alignment(count));
#if defined(__linux__)
        // Whole pages alone: the rest of the last one would be memory for nothing. A refusal costs time, no more.
        if (is_large(count)) static_cast<void>(madvise(room, count * sizeof(T) / page * page, MADV_HUGEPAGE));
#endif
        return static_cast<T*>(room);
    }
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
