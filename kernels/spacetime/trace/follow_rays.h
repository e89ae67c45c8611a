#pragma once

#include "kernels/spacetime/trace/trace_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"

// Measures what following rays costs: steps and errors of any integrator.
namespace ergodome {

//! A shell up to which rays are followed.
struct WatchedShell {
  float u;      //!< 1 / r [1/M]
  bool opaque;  //!< hides everything behind it
};

//! A block of rows of one image whose rays are followed by any integrator, to measure its steps and
//! errors. Rays end behind the last shell that they meet, or at the sky if they meet none.
struct FollowBatch {
  PixelBatch pixels;           //!< out: coverage (0 if a ray sees nothing), error_estimate, steps
  TraceMethod method;          //!< must take steps
  const WatchedShell* shells;  //!< the outermost first; outside the horizon
  int shell_count;
};

}  // namespace ergodome
