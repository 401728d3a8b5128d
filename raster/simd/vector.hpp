// Vectors of 32-bit lanes, as wide as the instruction set that the including file is compiled for. Only for
// files of this folder: everything here has internal linkage, since an inline function that other files share
// might be linked in the variant for instructions that the processor does not have.
#pragma once

#include <cstdint>
#include <immintrin.h>

namespace triptych {
namespace {

#if defined(__AVX512F__) && defined(__AVX512DQ__)
constexpr int32_t lanes = 16;
#elif defined(__AVX2__)
constexpr int32_t lanes = 8;
#elif defined(__SSE4_2__)
constexpr int32_t lanes = 4;
#else
#error "raster/simd is compiled for SSE4.2, AVX2 or AVX-512"
#endif

// Compilers make one instruction of each operator: all of them round as IEEE has it.
using Floats [[gnu::vector_size(lanes * 4)]] = float;
using Ints [[gnu::vector_size(lanes * 4)]] = int32_t;

[[gnu::always_inline]] inline Ints splat(int32_t value) { return Ints{} + value; }
[[gnu::always_inline]] inline Floats splat(float value) { return Floats{} + value; }
[[gnu::always_inline]] inline Floats to_float(Ints value) { return __builtin_convertvector(value, Floats); }
/// The bits of floats.
[[gnu::always_inline]] inline Ints bits_of(Floats value) { return (Ints)value; }

/// Masks have all bits of a lane set, or none.
[[gnu::always_inline]] inline Ints select(Ints mask, Ints yes, Ints no) {
  return (mask & yes) | (~mask & no);
}
[[gnu::always_inline]] inline Floats select(Ints mask, Floats yes, Floats no) {
  return (Floats)select(mask, bits_of(yes), bits_of(no));
}

template <typename Word>
[[gnu::always_inline]] inline Ints load(const Word* from) {
  Ints result;
  __builtin_memcpy(&result, from, sizeof result);
  return result;
}
template <typename Word>
[[gnu::always_inline]] inline void store(Ints value, Word* to) {
  __builtin_memcpy(to, &value, sizeof value);
}

// to_nearest: of what 32 bits hold. lane_numbers: 0, 1, 2 …; odd: every second lane of two vectors, from the
// second on; low_pairs, high_pairs: lanes of two vectors in turn, those of their lower or upper halves.
#if defined(__AVX512F__) && defined(__AVX512DQ__)
[[gnu::always_inline]] inline bool any(Ints mask) {
  return _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask) != 0;
}
[[gnu::always_inline]] inline Ints to_nearest(Floats value) {
  return (Ints)_mm512_maskz_cvtps_epi32(0xffff, (__m512)value);
}
constexpr Ints lane_numbers = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
[[gnu::always_inline]] inline Ints odd(Ints a, Ints b) {
  return __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
}
[[gnu::always_inline]] inline Ints low_pairs(Ints a, Ints b) {
  return __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
}
[[gnu::always_inline]] inline Ints high_pairs(Ints a, Ints b) {
  return __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
}
#elif defined(__AVX2__)
[[gnu::always_inline]] inline bool any(Ints mask) {
  return !_mm256_testz_si256((__m256i)mask, (__m256i)mask);
}
[[gnu::always_inline]] inline Ints to_nearest(Floats value) {
  return (Ints)_mm256_cvtps_epi32((__m256)value);
}
constexpr Ints lane_numbers = {0, 1, 2, 3, 4, 5, 6, 7};
[[gnu::always_inline]] inline Ints odd(Ints a, Ints b) {
  return __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
}
[[gnu::always_inline]] inline Ints low_pairs(Ints a, Ints b) {
  return __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
}
[[gnu::always_inline]] inline Ints high_pairs(Ints a, Ints b) {
  return __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
}
#else
[[gnu::always_inline]] inline bool any(Ints mask) { return !_mm_testz_si128((__m128i)mask, (__m128i)mask); }
[[gnu::always_inline]] inline Ints to_nearest(Floats value) { return (Ints)_mm_cvtps_epi32((__m128)value); }
constexpr Ints lane_numbers = {0, 1, 2, 3};
[[gnu::always_inline]] inline Ints odd(Ints a, Ints b) { return __builtin_shufflevector(a, b, 1, 3, 5, 7); }
[[gnu::always_inline]] inline Ints low_pairs(Ints a, Ints b) {
  return __builtin_shufflevector(a, b, 0, 4, 1, 5);
}
[[gnu::always_inline]] inline Ints high_pairs(Ints a, Ints b) {
  return __builtin_shufflevector(a, b, 2, 6, 3, 7);
}
#endif

}  // namespace
}  // namespace triptych
