#pragma once

#include <memory>

#include "kernels/launch/launch.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/lens_source.h"
#include "render/published/quadtree_builder.h"

namespace ergodome {

//! A lens read from the published quadtree grid of the eye's own position and velocity. Other
//! lenses are compared with it; CPU only.
class QuadtreeSource : public LensSource {
 public:
  QuadtreeSource(std::shared_ptr<const QuadtreeLens> grid, const EyeCamera& eye, const Projection& projection,
                 double tolerance_px);

  void fill(int first_row, int row_count, const LensPixels& out) const override;
  [[nodiscard]] const char* name() const override { return "quadtree"; }

 private:
  std::shared_ptr<const QuadtreeLens> grid_;
  QuadtreePixelBatch prototype_;
};

}  // namespace ergodome
