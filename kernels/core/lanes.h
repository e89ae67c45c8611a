#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "kernels/core/arithmetic.h"

// How kernels read and write arrays: one index of a kernel covers as many adjacent elements as a
// real number has lanes.
namespace ergodome::inline ERGO_TARGET {

//! Reads elements first, first + 1, ... of an array of `count`; lanes past the end repeat the last
//! element.
template <class T>
ERGO_HD T load_lanes(const ScalarOf<T>* from, int first, int count) {
  if constexpr (RealTraits<T>::lane_count == 1) {
    return from[first];
  } else {
    T value;
    if (first + RealTraits<T>::lane_count <= count) {
      std::memcpy(&value, from + first, sizeof value);
    } else {
      for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
        set_lane(value, i, from[first + i < count ? first + i : count - 1]);
      }
    }
    return value;
  }
}

//! Writes the lanes to elements first, first + 1, ... of an array of `count`, except for lanes past
//! its end. Does nothing if the pointer is null, which means that this output channel is not
//! requested.
template <class T>
ERGO_HD void store_lanes(ScalarOf<T>* to, int first, int count, const T& value) {
  if (to == nullptr) {
    return;
  }
  if constexpr (RealTraits<T>::lane_count == 1) {
    to[first] = value;
  } else if (first + RealTraits<T>::lane_count <= count) {
    std::memcpy(to + first, &value, sizeof value);
  } else {
    for (int i = 0; first + i < count; ++i) {
      to[first + i] = lane(value, i);
    }
  }
}

//! Returns 0, 1, 2, ... in the lanes.
template <class T>
ERGO_HD T lane_numbers() {
  T value(ScalarOf<T>(0));
  for (int i = 1; i < RealTraits<T>::lane_count; ++i) {
    set_lane(value, i, static_cast<ScalarOf<T>>(i));
  }
  return value;
}

//! Returns a mask in which lane i is set if bit i of `bits` is set.
template <class T>
ERGO_HD MaskOf<T> mask_from_bits(unsigned bits) {
  T flags(ScalarOf<T>(0));
  for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
    set_lane(flags, i, static_cast<ScalarOf<T>>((bits >> static_cast<unsigned>(i)) & 1U));
  }
  return flags > T(ScalarOf<T>(0));
}

//! Returns a bit mask of the lanes that are inside the array, for a register that begins at element
//! `first` of `count`.
template <class T>
ERGO_HD unsigned bits_within(int first, int count) {
  constexpr int lanes = RealTraits<T>::lane_count;
  const int inside = count - first < lanes ? count - first : lanes;
  return (1U << static_cast<unsigned>(inside)) - 1U;
}

//! A selection of lanes of a register, which can be stored contiguously.
template <class T>
class ChosenLanes {
 public:
  //! Selects the lanes whose bits are set.
  ERGO_HD explicit ChosenLanes(unsigned bits) : bits_(bits) {
#if !defined(__AVX512F__)
    for (unsigned left = bits; left != 0; left &= left - 1) {
      from_[count_] = lowest_bit(left);
      ++count_;
    }
#else
    count_ = std::popcount(bits);
#endif
  }

  [[nodiscard]] ERGO_HD int count() const { return count_; }

  //! Writes the selected lanes contiguously. `to` must have room for a whole register; the elements
  //! after the selected ones are undefined.
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
