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

//! Adds two adjacent quads at `first` and two at `second`, times a weight for each of the four.
//! `weights` and the quads must be 16-byte aligned.
inline void add_weighted(QuadBlock& sum, const float* weights, const float* first, const float* second) {
#if defined(__AVX512F__)
  // The variants of intrinsics with masks, because GCC 12 warns about the others.
  const __mmask16 all = 0xffff;
  const __m512i each = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
  const __m512 factors =
      _mm512_maskz_permutexvar_ps(all, each, _mm512_maskz_broadcast_f32x4(all, _mm_load_ps(weights)));
  const __m512 quads =
      _mm512_maskz_insertf32x8(all, _mm512_castps256_ps512(_mm256_loadu_ps(first)), _mm256_loadu_ps(second), 1);
  sum.quads = _mm512_fmadd_ps(factors, quads, sum.quads);
#elif defined(__AVX2__)
  const __m256 all = _mm256_castps128_ps256(_mm_load_ps(weights));
  const __m256 of_first = _mm256_permutevar8x32_ps(all, _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1));
  const __m256 of_second = _mm256_permutevar8x32_ps(all, _mm256_setr_epi32(2, 2, 2, 2, 3, 3, 3, 3));
  sum.pairs[0] = _mm256_fmadd_ps(of_first, _mm256_loadu_ps(first), sum.pairs[0]);
  sum.pairs[1] = _mm256_fmadd_ps(of_second, _mm256_loadu_ps(second), sum.pairs[1]);
#else
  sum.quads[0] = sum.quads[0] + weights[0] * load_quad(first);
  sum.quads[1] = sum.quads[1] + weights[1] * load_quad(first + 4);
  sum.quads[2] = sum.quads[2] + weights[2] * load_quad(second);
  sum.quads[3] = sum.quads[3] + weights[3] * load_quad(second + 4);
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

//! Four numbers for each lane of a register, side by side.
template <class T>
class LaneQuads {
 public:
  LaneQuads(const T& a, const T& b, const T& c, const T& d) {
    constexpr int lanes = RealTraits<T>::lane_count;
#if defined(__x86_64__)
    // A transposition of 4 x 4 numbers in each part of 16 bytes.
    const auto store = [this](int row, const T& value) { std::memcpy(numbers_ + row * lanes, &value, sizeof value); };
    const T ab = interleaved<false>(a, b);
    const T cd = interleaved<false>(c, d);
    const T ab_upper = interleaved<true>(a, b);
    const T cd_upper = interleaved<true>(c, d);
    store(0, halves<false>(ab, cd));
    store(1, halves<true>(ab, cd));
    store(2, halves<false>(ab_upper, cd_upper));
    store(3, halves<true>(ab_upper, cd_upper));
#else
    for (int i = 0; i < lanes; ++i) {
      float* const to = numbers_ + 4 * slot(i);
      to[0] = lane(a, i);
      to[1] = lane(b, i);
      to[2] = lane(c, i);
      to[3] = lane(d, i);
    }
#endif
  }

  //! Returns the four numbers of a lane, 16-byte aligned.
  [[nodiscard]] const float* of(int i) const { return numbers_ + 4 * slot(i); }

 private:
  static constexpr int lanes_ = RealTraits<T>::lane_count;

  static constexpr int slot(int i) { return i % 4 * (lanes_ / 4) + i / 4; }

#if defined(__x86_64__)
  template <bool Upper>
  static T interleaved(const T& a, const T& b) {
    return shuffled(a, b, [](int i) {
      const int in_part = i % 4;
      return i - in_part + (Upper ? 2 : 0) + in_part / 2 + (in_part % 2 == 0 ? 0 : lanes_);
    });
  }

  template <bool Upper>
  static T halves(const T& a, const T& b) {
    return shuffled(a, b, [](int i) {
      const int in_part = i % 4;
      return i - in_part + (Upper ? 2 : 0) + in_part % 2 + (in_part / 2 == 0 ? 0 : lanes_);
    });
  }

  //! Returns the lanes of a, then b, whose numbers are from(0), from(1), ...
  template <class From>
  static T shuffled(const T& a, const T& b, const From& from) {
    IntegerOf<T> numbers;
    for (int i = 0; i < lanes_; ++i) {
      numbers[i] = from(i);
    }
#if defined(__clang__)
    T result;
    for (int i = 0; i < lanes_; ++i) {
      result.lanes[i] = numbers[i] < lanes_ ? a.lanes[numbers[i]] : b.lanes[numbers[i] - lanes_];
    }
    return result;
#else
    return T(__builtin_shuffle(a.lanes, b.lanes, numbers));
#endif
  }
#endif

  alignas(64) float numbers_[4 * lanes_];
};

}  // namespace ergodome::inline ERGO_TARGET
