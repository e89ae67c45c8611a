#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/spacetime/trace/trace_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"

// Measures what following rays costs: steps and errors of any integrator.
namespace ergodome {

//! A shell that rays are followed to.
struct WatchedShell {
  float u;      //!< 1 / r [1/M]
  bool opaque;  //!< hides everything behind it
};

//! A block of rows of one image whose rays are followed by any integrator, to measure its steps and
//! errors. Rays end behind the last shell that they meet, or at the sky if they meet none.
struct FollowBatch {
  PixelBatch pixels;           //!< out: coverage (0 if a ray sees nothing), error_estimate, steps
  TraceMethod method;          //!< must be an integrator with steps, not closed_form
  const WatchedShell* shells;  //!< the outermost first; outside the horizon
  int shell_count;
};

template <>
struct Kernel<FollowBatch> : KernelDefaults {
  static const char* name(const FollowBatch& /*batch*/) { return "follow_rays"; }
  static PixelRows rows(const FollowBatch& batch) { return Kernel<PixelBatch>::rows(batch.pixels); }

  template <class Visit>
  static void visit_outputs(const FollowBatch& batch, const Visit& visit) {
    visit("error_estimate", batch.pixels.out.error_estimate, element_count(batch));
  }
};

}  // namespace ergodome
