#pragma once

#include "kernels/launch/launch.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/lens_source.h"

namespace ergodome {

//! An eye as its rays start there.
CameraStation station_of(const EyeCamera& eye);

//! What every lens source needs to know of an eye and its image. The edge is left to the source. `tolerance_px` is the error of a
//! traced pixel's direction that is accepted, as a displacement on the screen.
PixelBatch pixel_batch(const EyeCamera& eye, const Projection& projection, double tolerance_px);

//! Lets a batch's rays, where they are followed to the sky alone, take no more steps than any takes that ends. Outside the horizon of a hole of spin 0.999 and
//! less that are 50 at the most, in pictures of up to 8192 px more than 48 for one pixel of 50 million; about faster holes light circles for longer, as its
//! orbits next to the horizon are the less unstable. All of a device waits for the last ray.
void set_sky_steps(PixelBatch& batch, const EyeCamera& eye);

//! Gives a batch the edge that its pixels are covered by, and the directions that may touch it.
void set_edge(PixelBatch& batch, const EdgeCurve& edge, const Projection& projection);

//! The exact lens: one light ray a pixel, with its footprint, and the coverage of the shadow's edge.
class DirectLens : public LensSource {
 public:
  DirectLens(Backend backend, const EyeCamera& eye, const Projection& projection, double tolerance_px);

  void fill(int first_row, int row_count, const LensPixels& out) const override;
  [[nodiscard]] const char* name() const override { return "direct"; }

 private:
  Backend backend_;
  EdgeTable edge_;
  PixelBatch prototype_;
};

}  // namespace ergodome
