// SPDX-License-Identifier: GPL-3.0-or-later
// SIMD vectors with one number (lane) per contact point, and conversions between records and lanes.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "solver/base/instruction_set.hpp"

#define CRACKLE_INLINE inline __attribute__((always_inline))

namespace crackle {

// Number of lanes: as many as a register holds, since compilers generate poor code for wider vectors. Tests set
// CRACKLE_LANES to try widths that the machine may not support.
#if defined(CRACKLE_LANES)
inline constexpr int lane_count = CRACKLE_LANES;
#elif defined(__AVX512F__)
inline constexpr int lane_count = 8;
#elif defined(__AVX__)
inline constexpr int lane_count = 4;
#else
inline constexpr int lane_count = 2;
#endif

using Lanes = double __attribute__((vector_size(8 * lane_count)));
using LaneBits = decltype(Lanes{} < Lanes{});  // result of comparing Lanes: 0 or -1 in each lane
using LaneBit = std::remove_cvref_t<decltype(LaneBits{}[0])>;
using Eight = double __attribute__((vector_size(64)));
using Quad = double __attribute__((vector_size(32)));
using Pair = double __attribute__((vector_size(16)));

/// Call this at the entry of kernels compiled without AVX. If a library has left values in the upper halves of the
/// vector registers, every vector instruction of such a kernel depends on them (three times slower on Zen).
CRACKLE_INLINE void clear_upper_halves() {
#if defined(__SSE2__) && !defined(__AVX__)
    if (has_wider_registers()) asm volatile("vzeroupper");
#endif
}

/// Type of the result of comparing two Numbers: bool for doubles, LaneBits for Lanes.
template <class Number>
using Condition = decltype(Number{} < Number{});

/// Loads a vector of eight-byte numbers from any address. memcpy() is not used, because g++ does not merge its loads
/// into shuffle instructions.
template <class V>
CRACKLE_INLINE V load_as(const void* from) {
    typedef V Loose __attribute__((aligned(8), may_alias));
    return *static_cast<const Loose*>(from);
}
template <class V>
CRACKLE_INLINE void store_as(void* to, const V& v) {
    typedef V Loose __attribute__((aligned(8), may_alias));
    *static_cast<Loose*>(to) = v;
}

/// Loads one float, or one float per lane; stores numbers after rounding them to floats.
template <class Number>
CRACKLE_INLINE Number load_floats(const float* from) {
    if constexpr (std::is_same_v<Number, double>) {
        return *from;
    } else {
        typedef float Floats __attribute__((vector_size(4 * lane_count)));
        typedef Floats Loose __attribute__((aligned(4), may_alias));
        return __builtin_convertvector(*reinterpret_cast<const Loose*>(from), Lanes);
    }
}
CRACKLE_INLINE void store_floats(float* to, double v) { *to = static_cast<float>(v); }
CRACKLE_INLINE void store_floats(float* to, const Lanes& v) {
    typedef float Floats __attribute__((vector_size(4 * lane_count)));
    typedef Floats Loose __attribute__((aligned(4), may_alias));
    *reinterpret_cast<Loose*>(to) = __builtin_convertvector(v, Floats);
}

/// A Number with `value` in every lane.
template <class Number>
CRACKLE_INLINE Number all_of(double value) {
    return value - Number{};
}

/// Whether a condition does not hold.
CRACKLE_INLINE bool opposite(bool condition) { return !condition; }
CRACKLE_INLINE LaneBits opposite(const LaneBits& condition) { return ~condition; }

/// Whether at least one of two conditions holds.
CRACKLE_INLINE bool either(bool a, bool b) { return a || b; }
CRACKLE_INLINE LaneBits either(const LaneBits& a, const LaneBits& b) { return a | b; }

/// Returns a where the condition holds, otherwise b.
CRACKLE_INLINE double select(bool condition, double a, double b) { return condition ? a : b; }
CRACKLE_INLINE Lanes select(const LaneBits& condition, const Lanes& a, const Lanes& b) { return condition ? a : b; }

CRACKLE_INLINE double root(double v) { return std::sqrt(v); }
CRACKLE_INLINE Lanes root(const Lanes& v) {
    Lanes result;
    const char* from = reinterpret_cast<const char*>(&v);
    char* to = reinterpret_cast<char*>(&result);
#if defined(__AVX512F__)
    // _mm512_sqrt_pd() is not used, because g++ 12 warns of an uninitialised value in it.
    store_as(to, _mm512_maskz_sqrt_pd(0xff, load_as<__m512d>(from)));
#elif defined(__AVX__)
    for (std::size_t k = 0; k < sizeof v; k += 32) store_as(to + k, _mm256_sqrt_pd(load_as<__m256d>(from + k)));
#elif defined(__SSE2__)
    for (std::size_t k = 0; k < sizeof v; k += 16) store_as(to + k, _mm_sqrt_pd(load_as<__m128d>(from + k)));
#else
    for (std::size_t k = 0; k < sizeof v; k += 8) store_as(to + k, std::sqrt(load_as<double>(from + k)));
#endif
    return result;
}

CRACKLE_INLINE LaneBits bits_of(const Lanes& v) { return load_as<LaneBits>(&v); }
CRACKLE_INLINE Lanes lanes_of(const LaneBits& v) { return load_as<Lanes>(&v); }

/// Loads consecutive four-byte integers of any type and widens them to eight bytes.
CRACKLE_INLINE LaneBits widened(const void* from) {
    typedef std::uint32_t Words __attribute__((vector_size(4 * lane_count)));
    typedef Words Loose __attribute__((aligned(4), may_alias));
    return __builtin_convertvector(*static_cast<const Loose*>(from), LaneBits);
}

inline constexpr LaneBit sign_bit = std::numeric_limits<LaneBit>::min();
CRACKLE_INLINE double magnitude(double v) { return std::abs(v); }
CRACKLE_INLINE Lanes magnitude(const Lanes& v) { return lanes_of(bits_of(v) & ~sign_bit); }
CRACKLE_INLINE double with_sign(double size, double sign) { return std::copysign(size, sign); }
CRACKLE_INLINE Lanes with_sign(const Lanes& size, const Lanes& sign) {
    LaneBits bit = LaneBits{} + sign_bit;
#if defined(__clang__) && defined(__AVX512F__)
    asm("" : "+v"(bit));  // hides the value from clang 14, which miscompiles a masked copysign (to 2^-1022)
#endif
    return lanes_of((bits_of(size) & ~bit) | (bits_of(sign) & bit));
}

/// A condition as a bit mask, one bit per lane.
CRACKLE_INLINE unsigned mask_of(const LaneBits& v) {
    const char* from = reinterpret_cast<const char*>(&v);
#if defined(__AVX512F__)
    return _mm512_cmp_epi64_mask(load_as<__m512i>(from), _mm512_setzero_si512(), _MM_CMPINT_LT);
#else
    unsigned mask = 0;
#if defined(__AVX__)
    for (std::size_t k = 0; k < lane_count; k += 4)
        mask |= static_cast<unsigned>(_mm256_movemask_pd(load_as<__m256d>(from + 8 * k))) << k;
#elif defined(__SSE2__)
    for (std::size_t k = 0; k < lane_count; k += 2)
        mask |= static_cast<unsigned>(_mm_movemask_pd(load_as<__m128d>(from + 8 * k))) << k;
#else
    for (std::size_t k = 0; k < lane_count; ++k) mask |= (load_as<LaneBit>(from + 8 * k) < 0 ? 1u : 0u) << k;
#endif
    return mask;
#endif
}

/// Number of points for which a condition holds.
CRACKLE_INLINE std::uint32_t count_of(bool condition) { return condition ? 1 : 0; }
CRACKLE_INLINE std::uint32_t count_of(const LaneBits& v) {
    return static_cast<std::uint32_t>(__builtin_popcount(mask_of(v)));
}

/// Whether a condition holds in at least one lane.
CRACKLE_INLINE bool any(bool condition) { return condition; }
CRACKLE_INLINE bool any(const LaneBits& condition) { return mask_of(condition) != 0; }

/// Looks up a table entry for each lane. @param table eight numbers
CRACKLE_INLINE Lanes looked_up(const double* table, const LaneBits& index) {
#if defined(__AVX512F__)
    const __m512d found = _mm512_maskz_permutexvar_pd(0xff, load_as<__m512i>(&index), load_as<__m512d>(table));
    return load_as<Lanes>(&found);
#else
    Lanes result;
    for (int l = 0; l < lane_count; ++l) result[l] = table[index[l]];
    return result;
#endif
}

/// Whether all bits of all lanes are 0.
CRACKLE_INLINE bool none_of(bool condition) { return !condition; }
CRACKLE_INLINE bool none_of(const LaneBits& v) {
#if defined(__AVX512F__)
    const __m512i all = load_as<__m512i>(&v);
    return _mm512_test_epi64_mask(all, all) == 0;
#elif defined(__SSE2__)
    const char* from = reinterpret_cast<const char*>(&v);
    bool none = true;
#if defined(__AVX__)
    for (std::size_t k = 0; k < sizeof v; k += 32) {
        const __m256i some = load_as<__m256i>(from + k);
        none = none && _mm256_testz_si256(some, some) != 0;
    }
#else
    for (std::size_t k = 0; k < sizeof v; k += 16)
        none = none && _mm_movemask_epi8(_mm_cmpeq_epi8(load_as<__m128i>(from + k), _mm_setzero_si128())) == 0xffff;
#endif
    return none;
#else
    LaneBit some = 0;
    for (int l = 0; l < lane_count; ++l) some |= v[l];
    return some == 0;
#endif
}

/// Loads two pairs of numbers and joins them into one vector.
CRACKLE_INLINE Quad join(const double* a, const double* b) {
#if defined(__AVX__)
    // An intrinsic is used, because g++ does not merge the load of the second half into a shuffle.
    return (Quad)_mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(a)), _mm_loadu_pd(b), 1);
#else
    return __builtin_shufflevector(load_as<Pair>(a), load_as<Pair>(b), 0, 1, 2, 3);
#endif
}

CRACKLE_INLINE Eight join(const double* a, const double* b, const double* c, const double* d) {
    return __builtin_shufflevector(join(a, b), join(c, d), 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Repeats each number in four lanes, or in all lanes if there are fewer.
CRACKLE_INLINE Lanes lanes_of_fours(const double (&numbers)[1]) { return all_of<Lanes>(numbers[0]); }
CRACKLE_INLINE Eight lanes_of_fours(const double (&numbers)[2]) {
    return __builtin_shufflevector(all_of<Quad>(numbers[0]), all_of<Quad>(numbers[1]), 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Loads two adjacent numbers from each address. Pairs are combined while loading, which saves shuffles.
CRACKLE_INLINE void gather_pairs(const double* const (&at)[2], Pair& first, Pair& second) {
    const Pair a = load_as<Pair>(at[0]), b = load_as<Pair>(at[1]);
    first = __builtin_shufflevector(a, b, 0, 2);
    second = __builtin_shufflevector(a, b, 1, 3);
}
CRACKLE_INLINE void gather_pairs(const double* const (&at)[4], Quad& first, Quad& second) {
    const Quad even = join(at[0], at[2]), odd = join(at[1], at[3]);
    first = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
    second = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
}
CRACKLE_INLINE void gather_pairs(const double* const (&at)[8], Eight& first, Eight& second) {
    const Eight even = join(at[0], at[2], at[4], at[6]), odd = join(at[1], at[3], at[5], at[7]);
    first = __builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14);
    second = __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15);
}

/// Stores records of four numbers consecutively, one record per lane.
CRACKLE_INLINE void store_quads(void* to, const Pair& a, const Pair& b, const Pair& c, const Pair& d) {
    char* out = static_cast<char*>(to);
    store_as(out, __builtin_shufflevector(a, b, 0, 2));
    store_as(out + 16, __builtin_shufflevector(c, d, 0, 2));
    store_as(out + 32, __builtin_shufflevector(a, b, 1, 3));
    store_as(out + 48, __builtin_shufflevector(c, d, 1, 3));
}
CRACKLE_INLINE void store_quads(void* to, const Quad& a, const Quad& b, const Quad& c, const Quad& d) {
    const Quad ab02 = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab13 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Quad cd02 = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd13 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    char* out = static_cast<char*>(to);
    store_as(out, __builtin_shufflevector(ab02, cd02, 0, 1, 4, 5));
    store_as(out + 32, __builtin_shufflevector(ab13, cd13, 0, 1, 4, 5));
    store_as(out + 64, __builtin_shufflevector(ab02, cd02, 2, 3, 6, 7));
    store_as(out + 96, __builtin_shufflevector(ab13, cd13, 2, 3, 6, 7));
}
CRACKLE_INLINE void store_quads(void* to, const Eight& a, const Eight& b, const Eight& c, const Eight& d) {
    const Eight ab0 = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);  // records 0, 2, 4, 6
    const Eight ab1 = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight cd0 = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight cd1 = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight even04 = __builtin_shufflevector(ab0, cd0, 0, 1, 8, 9, 4, 5, 12, 13);  // records 0 and 4
    const Eight even26 = __builtin_shufflevector(ab0, cd0, 2, 3, 10, 11, 6, 7, 14, 15);
    const Eight odd15 = __builtin_shufflevector(ab1, cd1, 0, 1, 8, 9, 4, 5, 12, 13);
    const Eight odd37 = __builtin_shufflevector(ab1, cd1, 2, 3, 10, 11, 6, 7, 14, 15);
    char* out = static_cast<char*>(to);
    store_as(out, __builtin_shufflevector(even04, odd15, 0, 1, 2, 3, 8, 9, 10, 11));
    store_as(out + 64, __builtin_shufflevector(even26, odd37, 0, 1, 2, 3, 8, 9, 10, 11));
    store_as(out + 128, __builtin_shufflevector(even04, odd15, 4, 5, 6, 7, 12, 13, 14, 15));
    store_as(out + 192, __builtin_shufflevector(even26, odd37, 4, 5, 6, 7, 12, 13, 14, 15));
}

}  // namespace crackle
