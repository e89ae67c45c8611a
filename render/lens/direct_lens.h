#pragma once

#include "kernels/launch/launch.h"
#include "kernels/spacetime/trace/trace_pixels.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/lens_source.h"

// Traces the lens of an eye with one ray per pixel.

namespace ergodome {

//! Returns the CameraStation from which an eye's rays are traced: its position and velocity,
//! prepared for kernels.
CameraStation station_of(const EyeCamera& eye);

//! Returns the part of the kernels' batch settings that all lens sources share; the source itself
//! sets the shadow's edge. `tolerance_px`: accepted displacement of a traced pixel on the screen.
PixelBatch pixel_batch(const EyeCamera& eye, const Projection& projection, double tolerance_px);

//! Limits the rays of a batch to 48 steps, for spins up to 0.999 and eyes outside the horizon.
//! Otherwise does nothing. The rays must be traced to the sky only. A single longer ray would delay
//! the whole GPU, and at 8192 px only one pixel in 50 million needs more. At higher spins light
//! circles longer, because orbits near the horizon are less unstable.
void set_sky_steps(PixelBatch& batch, const EyeCamera& eye);

//! Sets the shadow edge from which a batch computes pixel coverage, and the range of directions in
//! which a pixel can touch that edge.
void set_edge(PixelBatch& batch, const EdgeCurve& edge, const Projection& projection);

//! The exact lens: one light ray per pixel, with its footprint and its coverage by the shadow.
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
