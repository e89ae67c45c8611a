#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "kernels/core/lanes.h"

namespace ergodome::inline ERGO_TARGET {

//! A selection of lanes of a register, which can be stored contiguously.
template <class T>
class ChosenLanes {
 public:
  //! Selects the lanes whose bits are set.
  ERGO_HD explicit ChosenLanes(unsigned bits) : bits_(bits) {
#if !defined(__AVX512F__)
    for (unsigned left = bits; left != 0; left &= left - 1) {
      from_[count_] = std::countr_zero(left);
      ++count_;
    }
#else
    count_ = std::popcount(bits);
#endif
  }

  [[nodiscard]] ERGO_HD int count() const { return count_; }

  //! Writes the selected lanes contiguously. A whole register is written; elements after them are
  //! undefined.
  ERGO_HD void store(float* to, const T& value) const {
    if constexpr (RealTraits<T>::lane_count == 1) {
      *to = value;
    } else {
#if defined(__AVX512F__)
      _mm512_storeu_ps(to, _mm512_maskz_compress_ps(static_cast<__mmask16>(bits_), static_cast<__m512>(value.lanes)));
#elif defined(__AVX2__)
      __m256i from;
      std::memcpy(&from, from_, sizeof from);
      _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(static_cast<__m256>(value.lanes), from));
#else
      for (int i = 0; i < count_; ++i) {
        to[i] = lane(value, from_[i]);
      }
#endif
    }
  }

 private:
  unsigned bits_;
  int count_ = 0;
#if !defined(__AVX512F__)
  std::int32_t from_[RealTraits<T>::lane_count] = {};
#endif
};

}  // namespace ergodome::inline ERGO_TARGET
