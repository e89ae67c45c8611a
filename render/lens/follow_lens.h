#pragma once

#include <vector>

#include "content/show/show.h"
#include "kernels/near_rays/follow_rays.h"
#include "render/lens/direct_lens.h"

// The lens for heat maps of rays.

namespace ergodome {

//! Selects the rays that a heat map of steps or errors shows.
struct FollowedRays {
  TraceMethod method = TraceMethod::taylor;
  //! Outermost first; rays that meet them are followed past the last visible one.
  std::vector<WatchedShell> shells;
  bool logarithmic = false;  //!< give steps as their base-10 logarithm
};

//! Returns the visible shells of a show, in the form that the ray tracer needs.
std::vector<WatchedShell> watched_shells(const std::vector<ShellSettings>& shells);

//! The lens for heat maps: one ray per pixel, followed by any integrator to what it hits, with its
//! cost. Fills only coverage, error estimate and steps; runs on the CPU.
class FollowLens : public LensSource {
 public:
  FollowLens(Backend backend, const EyeCamera& eye, const Projection& projection, double tolerance_px,
             FollowedRays rays);

  void fill(int first_row, int row_count, const LensPixels& out) const override;
  [[nodiscard]] const char* name() const override { return "direct"; }

 private:
  Backend backend_;
  FollowedRays rays_;
  PixelBatch prototype_;
};

}  // namespace ergodome
