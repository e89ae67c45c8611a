#pragma once

#include "kernels/spacetime/trace/trace_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"

namespace ergodome {

//! A shell that rays are followed to.
struct WatchedShell {
  float u;      //!< 1 / r [1/M]
  bool opaque;  //!< nothing is seen behind it
};

//! A block of rows of one image, whose rays are followed to what they see by any integrator, to tell what that takes: past the last shell that
//! they meet, or where they meet none, to the sky.
struct FollowBatch {
  PixelBatch pixels;           //!< out: coverage (of the image, where a ray sees any of that), error_estimate and steps
  TraceMethod method;          //!< one that takes steps
  const WatchedShell* shells;  //!< the outermost first; outside the horizon
  int shell_count;
};

}  // namespace ergodome
