// Vectors of 32-bit lanes, as wide as the instruction set that the including
// file is compiled for. Only for files of this folder: everything here has
// internal linkage, since an inline function that other files share might be
// linked in the variant for instructions that the processor does not have.
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

// Compilers make one instruction of each operator: all of them round as IEEE
// has it.
using Floats [[gnu::vector_size(lanes * 4)]] = float;
using Ints [[gnu::vector_size(lanes * 4)]] = int32_t;
// Of half as many lanes.
using HalfInts [[gnu::vector_size(lanes * 2)]] = int32_t;
using HalfFloats [[gnu::vector_size(lanes * 2)]] = float;
using Doubles [[gnu::vector_size(lanes * 4)]] = double;

[[gnu::always_inline]] inline Ints splat(int32_t value) { return Ints{} + value; }
[[gnu::always_inline]] inline Floats splat(float value) { return Floats{} + value; }
[[gnu::always_inline]] inline Floats to_float(Ints value) { return __builtin_convertvector(value, Floats); }
[[gnu::always_inline]] inline Floats magnitude(Floats value) { return (Floats)((Ints)value & 0x7fffffff); }
/// The bits of floats.
[[gnu::always_inline]] inline Ints bits_of(Floats value) { return (Ints)value; }

// The standard library's would be shared with other files.
[[gnu::always_inline]] inline int32_t lesser(int32_t a, int32_t b) { return a < b ? a : b; }
[[gnu::always_inline]] inline int32_t greater(int32_t a, int32_t b) { return a > b ? a : b; }

[[gnu::always_inline]] inline Floats lesser(Floats a, Floats b) { return b < a ? b : a; }
[[gnu::always_inline]] inline Floats greater(Floats a, Floats b) { return a < b ? b : a; }
[[gnu::always_inline]] inline Ints lesser(Ints a, Ints b) { return b < a ? b : a; }
[[gnu::always_inline]] inline Ints greater(Ints a, Ints b) { return a < b ? b : a; }

/// Masks have all bits of a lane set, or none.
[[gnu::always_inline]] inline Ints select(Ints mask, Ints yes, Ints no) { return mask ? yes : no; }
[[gnu::always_inline]] inline Floats select(Ints mask, Floats yes, Floats no) { return mask ? yes : no; }

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

[[gnu::always_inline]] inline Doubles splat_double(double value) { return Doubles{} + value; }
[[gnu::always_inline]] inline Doubles to_double(HalfInts value) {
  return __builtin_convertvector(value, Doubles);
}
/// Without what is behind the point.
[[gnu::always_inline]] inline HalfInts to_int(Doubles value) {
  return __builtin_convertvector(value, HalfInts);
}
/// The lower half of the lanes in doubles, or the upper.
[[gnu::always_inline]] inline Doubles half(Ints value, bool upper) {
  HalfInts result;
  __builtin_memcpy(&result, (const char*)&value + (upper ? sizeof result : 0), sizeof result);
  return to_double(result);
}
[[gnu::always_inline]] inline Doubles half(Floats value, bool upper) {
  HalfFloats result;
  __builtin_memcpy(&result, (const char*)&value + (upper ? sizeof result : 0), sizeof result);
  return __builtin_convertvector(result, Doubles);
}
[[gnu::always_inline]] inline Doubles magnitude(Doubles value) { return value < 0 ? -value : value; }

// join: both halves. gather: of each lane what stands at its index. bits: a bit
// for each lane of a mask, the first lane's lowest. to_nearest: of what 32 bits
// hold. lane_numbers: 0, 1, 2 …
#if defined(__AVX512F__) && defined(__AVX512DQ__)
[[gnu::always_inline]] inline Floats square_root(Floats value) {
  return (Floats)_mm512_maskz_sqrt_ps(0xffff, (__m512)value);
}
[[gnu::always_inline]] inline bool any(Ints mask) {
  return _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask) != 0;
}
[[gnu::always_inline]] inline uint32_t bits(Ints mask) { return _mm512_movepi32_mask((__m512i)mask); }
[[gnu::always_inline]] inline Ints to_nearest(Floats value) {
  return (Ints)_mm512_maskz_cvtps_epi32(0xffff, (__m512)value);
}
[[gnu::always_inline]] inline Floats join(HalfFloats low, HalfFloats high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
constexpr Ints lane_numbers = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
constexpr HalfInts half_lane_numbers = {0, 1, 2, 3, 4, 5, 6, 7};
[[gnu::always_inline]] inline Ints gather(const int32_t* from, Ints index) {
  return (Ints)_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, (__m512i)index, from, 4);
}
#elif defined(__AVX2__)
[[gnu::always_inline]] inline Floats square_root(Floats value) {
  return (Floats)_mm256_sqrt_ps((__m256)value);
}
[[gnu::always_inline]] inline bool any(Ints mask) {
  return !_mm256_testz_si256((__m256i)mask, (__m256i)mask);
}
[[gnu::always_inline]] inline uint32_t bits(Ints mask) {
  return static_cast<uint32_t>(_mm256_movemask_ps((__m256)mask));
}
[[gnu::always_inline]] inline Ints to_nearest(Floats value) {
  return (Ints)_mm256_cvtps_epi32((__m256)value);
}
[[gnu::always_inline]] inline Floats join(HalfFloats low, HalfFloats high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
constexpr Ints lane_numbers = {0, 1, 2, 3, 4, 5, 6, 7};
constexpr HalfInts half_lane_numbers = {0, 1, 2, 3};
[[gnu::always_inline]] inline Ints gather(const int32_t* from, Ints index) {
  return (Ints)_mm256_i32gather_epi32(from, (__m256i)index, 4);
}
#else
[[gnu::always_inline]] inline Floats square_root(Floats value) { return (Floats)_mm_sqrt_ps((__m128)value); }
[[gnu::always_inline]] inline bool any(Ints mask) { return !_mm_testz_si128((__m128i)mask, (__m128i)mask); }
[[gnu::always_inline]] inline uint32_t bits(Ints mask) {
  return static_cast<uint32_t>(_mm_movemask_ps((__m128)mask));
}
[[gnu::always_inline]] inline Ints to_nearest(Floats value) { return (Ints)_mm_cvtps_epi32((__m128)value); }
[[gnu::always_inline]] inline Floats join(HalfFloats low, HalfFloats high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3);
}
constexpr Ints lane_numbers = {0, 1, 2, 3};
constexpr HalfInts half_lane_numbers = {0, 1};
[[gnu::always_inline]] inline Ints gather(const int32_t* from, Ints index) {
  const Ints result = {from[index[0]], from[index[1]], from[index[2]], from[index[3]]};
  return result;
}
#endif

// Some of the lanes, as the processor has its masks: compilers do not find a
// short way from a vector to these. Each lane of `among` for which a comparison
// holds; and a bit for each, the first lane's lowest.
#if defined(__AVX512F__) && defined(__AVX512DQ__)
using Mask = __mmask16;
constexpr Mask all_lanes = 0xffff;
[[gnu::always_inline]] inline Mask where_greater(Mask among, Ints a, Ints b) {
  return _mm512_mask_cmpgt_epi32_mask(among, (__m512i)a, (__m512i)b);
}
[[gnu::always_inline]] inline Mask where_equal(Mask among, Ints a, Ints b) {
  return _mm512_mask_cmpeq_epi32_mask(among, (__m512i)a, (__m512i)b);
}
[[gnu::always_inline]] inline Ints choose(Mask mask, Ints yes, Ints no) {
  return (Ints)_mm512_mask_blend_epi32(mask, (__m512i)no, (__m512i)yes);
}
[[gnu::always_inline]] inline uint32_t mask_bits(Mask mask) { return mask; }
#else
using Mask = Ints;
constexpr Mask all_lanes = Ints{} - 1;
[[gnu::always_inline]] inline Mask where_greater(Mask among, Ints a, Ints b) { return among & (a > b); }
[[gnu::always_inline]] inline Mask where_equal(Mask among, Ints a, Ints b) { return among & (a == b); }
[[gnu::always_inline]] inline Ints choose(Mask mask, Ints yes, Ints no) { return select(mask, yes, no); }
[[gnu::always_inline]] inline uint32_t mask_bits(Mask mask) { return bits(mask); }
#endif

/// Of the lanes that have a bit, one behind the other; and perhaps, behind
/// them, others: a vector of them in all.
[[gnu::always_inline]] inline void store_some(uint32_t wanted, Ints value, uint32_t* to) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  store((Ints)_mm512_maskz_compress_epi32(static_cast<__mmask16>(wanted), (__m512i)value), to);
#else
  for (; wanted != 0; wanted &= wanted - 1) *to++ = static_cast<uint32_t>(value[__builtin_ctz(wanted)]);
#endif
}

/// Both halves, each rounded to nearest.
[[gnu::always_inline]] inline Floats to_float(Doubles lower, Doubles upper) {
  return join(__builtin_convertvector(lower, HalfFloats), __builtin_convertvector(upper, HalfFloats));
}

[[gnu::always_inline]] inline int32_t least_of(Ints value) {
  int32_t result = value[0];
  for (int32_t i = 1; i < lanes; ++i) result = lesser(result, value[i]);
  return result;
}

}  // namespace
}  // namespace triptych
