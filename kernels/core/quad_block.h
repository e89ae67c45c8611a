#pragma once

#include "kernels/core/lanes.h"
#include "kernels/core/quad.h"

// Four quads at once on the CPU, such as the texels of a bilinear look-up. Device code never includes
// this header: there each thread adds its own quads.
namespace ergodome::inline ERGO_TARGET {

//! Four quads in SIMD registers: sums that are weighted quad by quad.
struct QuadBlock {
#if defined(__AVX512F__)
  __m512 quads;
#elif defined(__AVX2__)
  __m256 pairs[2];
#else
  Quad quads[4];
#endif
};

inline QuadBlock zero_block() {
#if defined(__AVX512F__)
  return {_mm512_setzero_ps()};
#elif defined(__AVX2__)
  return {{_mm256_setzero_ps(), _mm256_setzero_ps()}};
#else
  return {{quad_of(0.0F), quad_of(0.0F), quad_of(0.0F), quad_of(0.0F)}};
#endif
}

//! Returns the sum of the four quads.
inline Quad total(const QuadBlock& sum) {
#if defined(__AVX512F__)
  const __m256 pair = _mm256_add_ps(__builtin_shufflevector(sum.quads, sum.quads, 0, 1, 2, 3, 4, 5, 6, 7),
                                    _mm512_maskz_extractf32x8_ps(0xff, sum.quads, 1));
#elif defined(__AVX2__)
  const __m256 pair = _mm256_add_ps(sum.pairs[0], sum.pairs[1]);
#endif
#if defined(__AVX2__)
  const __m128 quad = _mm_add_ps(_mm256_castps256_ps128(pair), _mm256_extractf128_ps(pair, 1));
  return {static_cast<Quad::Register>(quad)};
#else
  return sum.quads[0] + sum.quads[1] + sum.quads[2] + sum.quads[3];
#endif
}

//! Writes the sums of the quads of four blocks.
inline void totals(const QuadBlock (&sums)[4], Quad* to) {
#if defined(__AVX512F__)
  const auto pairs = [](const QuadBlock& a, const QuadBlock& b) {
    return _mm512_maskz_shuffle_f32x4(0xffff, a.quads, b.quads, 0x44) +
           _mm512_maskz_shuffle_f32x4(0xffff, a.quads, b.quads, 0xee);
  };
  const __m512 ab = pairs(sums[0], sums[1]);
  const __m512 cd = pairs(sums[2], sums[3]);
  const __m512 all =
      _mm512_maskz_shuffle_f32x4(0xffff, ab, cd, 0x88) + _mm512_maskz_shuffle_f32x4(0xffff, ab, cd, 0xdd);
  std::memcpy(to, &all, sizeof all);
#else
  for (int i = 0; i < 4; ++i) {
    to[i] = total(sums[i]);
  }
#endif
}

//! Four weights for each lane of a register.
template <class T>
class LaneWeights {
 public:
  LaneWeights() = default;

  //! The weights of a lane are its numbers in a, b, c and d.
  [[gnu::always_inline]] LaneWeights(const T& a, const T& b, const T& c, const T& d) {
#if defined(__x86_64__)
    // A transposition of 4 x 4 numbers in each part of 16 bytes: row j has the weights of lanes j, 4 +
    // j, ...
    const T ab = interleaved<false>(a, b);
    const T cd = interleaved<false>(c, d);
    const T ab_upper = interleaved<true>(a, b);
    const T cd_upper = interleaved<true>(c, d);
    rows_[0] = halves<false>(ab, cd);
    rows_[1] = halves<true>(ab, cd);
    rows_[2] = halves<false>(ab_upper, cd_upper);
    rows_[3] = halves<true>(ab_upper, cd_upper);
#else
    for (int i = 0; i < lanes; ++i) {
      set_lane(rows_[i % 4], i - i % 4, lane(a, i));
      set_lane(rows_[i % 4], i - i % 4 + 1, lane(b, i));
      set_lane(rows_[i % 4], i - i % 4 + 2, lane(c, i));
      set_lane(rows_[i % 4], i - i % 4 + 3, lane(d, i));
    }
#endif
  }

  //! Adds two adjacent quads at `first` and two at `second`, times the weights of a lane.
  void add(QuadBlock& sum, int i, const HalfQuad* first, const HalfQuad* second) const {
#if defined(__AVX512F__)
    // Uses the variants of intrinsics with masks, because GCC 12 warns about the others.
    const __mmask16 all = 0xffff;
    const int part = i / 4 * 4;
    const __m512i from = _mm512_setr_epi32(part, part, part, part, part + 1, part + 1, part + 1, part + 1, part + 2,
                                           part + 2, part + 2, part + 2, part + 3, part + 3, part + 3, part + 3);
    const __m512 factors = _mm512_maskz_permutexvar_ps(all, from, static_cast<__m512>(rows_[i % 4].lanes));
    const __m512 quads =
        _mm512_maskz_cvtph_ps(all, _mm256_inserti128_si256(_mm256_castsi128_si256(pair(first)), pair(second), 1));
    sum.quads = _mm512_fmadd_ps(factors, quads, sum.quads);
#elif defined(__AVX2__)
    const __m256 row = static_cast<__m256>(rows_[i % 4].lanes);
    const int part = i / 4 * 4;
    const __m256 of_first = _mm256_permutevar8x32_ps(
        row, _mm256_setr_epi32(part, part, part, part, part + 1, part + 1, part + 1, part + 1));
    const __m256 of_second = _mm256_permutevar8x32_ps(
        row, _mm256_setr_epi32(part + 2, part + 2, part + 2, part + 2, part + 3, part + 3, part + 3, part + 3));
    sum.pairs[0] = _mm256_fmadd_ps(of_first, _mm256_cvtph_ps(pair(first)), sum.pairs[0]);
    sum.pairs[1] = _mm256_fmadd_ps(of_second, _mm256_cvtph_ps(pair(second)), sum.pairs[1]);
#else
    const T& row = rows_[i % 4];
    const int part = i / 4 * 4;
    sum.quads[0] = sum.quads[0] + lane(row, part) * load_quad(first);
    sum.quads[1] = sum.quads[1] + lane(row, part + 1) * load_quad(first + 1);
    sum.quads[2] = sum.quads[2] + lane(row, part + 2) * load_quad(second);
    sum.quads[3] = sum.quads[3] + lane(row, part + 3) * load_quad(second + 1);
#endif
  }

 private:
  static constexpr int lanes = RealTraits<T>::lane_count;

#if defined(__F16C__)
  //! Loads two adjacent quads.
  static __m128i pair(const HalfQuad* from) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from)); }
#endif

#if defined(__x86_64__)
  template <bool Upper>
  static T interleaved(const T& a, const T& b) {
    return shuffled(a, b, [](int i) {
      const int in_part = i % 4;
      return i - in_part + (Upper ? 2 : 0) + in_part / 2 + (in_part % 2 == 0 ? 0 : lanes);
    });
  }

  template <bool Upper>
  static T halves(const T& a, const T& b) {
    return shuffled(a, b, [](int i) {
      const int in_part = i % 4;
      return i - in_part + (Upper ? 2 : 0) + in_part % 2 + (in_part / 2 == 0 ? 0 : lanes);
    });
  }

  //! Returns the lanes of a, then b, whose numbers are from(0), from(1), ...
  template <class From>
  static T shuffled(const T& a, const T& b, const From& from) {
#if defined(__clang__)
    T result;
    for (int i = 0; i < lanes; ++i) {
      result.lanes[i] = from(i) < lanes ? a.lanes[from(i)] : b.lanes[from(i) - lanes];
    }
    return result;
#else
    IntegerOf<T> numbers;
    for (int i = 0; i < lanes; ++i) {
      numbers[i] = from(i);
    }
    return T(__builtin_shuffle(a.lanes, b.lanes, numbers));
#endif
  }
#endif

  T rows_[4];
};

}  // namespace ergodome::inline ERGO_TARGET
