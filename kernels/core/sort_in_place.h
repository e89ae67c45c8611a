#pragma once

#include "kernels/core/host_device.h"

namespace ergodome::inline ERGO_TARGET {

//! Sorts a short list in one thread by Shell's method; plain insertion sort would take quadratic
//! time.
template <class T, class Before>
ERGO_HD void sort_in_place(T* list, int count, const Before& is_before) {
  int gap = 1;
  while (gap < count / 3) {
    gap = 3 * gap + 1;
  }
  for (; gap > 0; gap /= 3) {
    for (int i = gap; i < count; ++i) {
      const T value = list[i];
      int at = i;
      for (; at >= gap && is_before(value, list[at - gap]); at -= gap) {
        list[at] = list[at - gap];
      }
      list[at] = value;
    }
  }
}

}  // namespace ergodome::inline ERGO_TARGET
