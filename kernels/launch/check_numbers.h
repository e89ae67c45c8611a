#pragma once

#include <string>

#include "kernels/launch/kernel.h"

// Checks the outputs of kernels for NaN and infinity.
namespace ergodome {

//! Returns whether every launch scans the outputs that its kernel lists in visit_outputs() for NaN
//! and infinity. Enabled by the environment variable ERGODOME_CHECK_NUMBERS (not empty and not 0)
//! or by set_numbers_checked(). Outputs on a GPU are first copied to the host.
bool numbers_are_checked();
void set_numbers_checked(bool on);

//! Throws Error with kernel, channel and index of the first non-finite value. Accepts null buffers.
void require_finite(const std::string& kernel, Backend backend, const char* channel, const float* values, long count);
void require_finite(const std::string& kernel, Backend backend, const char* channel, const double* values, long count);

//! Checks an output of a kernel, as require_finite() does; see KernelDefaults::visit_outputs().
struct OutputCheck {
  const char* kernel;
  Backend backend;

  template <class S>
  void operator()(const char* channel, const S* values, long count) const {
    require_finite(kernel, backend, channel, values, count);
  }
};

}  // namespace ergodome
