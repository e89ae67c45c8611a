#pragma once

#include <vector>

#include "content/show/show.h"
#include "kernels/near_rays/follow_rays.h"
#include "render/lens/direct_lens.h"

// The lens for heat maps of rays.

namespace ergodome {

//! How the rays of a heat map of steps or errors are traced, and to which shells.
struct FollowedRays {
  TraceMethod method = TraceMethod::taylor;
  //! Visible shells, outermost first. A ray that meets them is followed until it is past the last
  //! one.
  std::vector<WatchedShell> shells;
  bool logarithmic = false;  //!< true: the number of steps is given as its base-10 logarithm
};

//! Returns the visible shells of a show, in the form that the ray tracer needs.
std::vector<WatchedShell> watched_shells(const std::vector<ShellSettings>& shells);

//! The lens for heat maps of the cost of tracing: one ray per pixel, traced by any integrator until
//! it hits something. Fills only coverage, error estimate and number of steps; runs on the CPU.
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
