#pragma once

#include <vector>

#include "content/show/show.h"
#include "kernels/spacetime/trace/follow_rays.h"
#include "render/lens/direct_lens.h"

namespace ergodome {

//! Which rays a heat map of steps or errors shows.
struct FollowedRays {
  TraceMethod method = TraceMethod::taylor;
  std::vector<WatchedShell>
      shells;                //!< the outermost first; rays that meet them are followed past the last that is seen
  bool logarithmic = false;  //!< steps are given as their logarithms to the base 10
};

//! The shells of a show that are seen, as rays are followed to them.
std::vector<WatchedShell> watched_shells(const std::vector<ShellSettings>& shells);

//! For heat maps: a ray a pixel, followed by any integrator to what it sees, and what that took. No more than coverage, error estimate
//! and steps is filled; rays are followed on the processor.
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
