#pragma once

#include "kernels/image/lens_pixels.h"
#include "kernels/launch/kernel.h"
#include "kernels/projection/projection.h"
#include "kernels/spacetime/geodesic/integration_settings.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/shadow/edge_curve.h"

// Batches of pixels, one ray each.
namespace ergodome {

//! A block of rows of one image, one light ray per pixel.
struct PixelBatch {
  CameraStationOf<float> camera;
  ProjectionOf<float> projection;
  float frame_from_view[3][3];  //!< columns: the view's x (right), y (up), z (back), in e_r, e_θ, e_φ
  EdgeCurve edge;
  //! Range of the cosine between a pixel's direction and the chart's center. Only pixels in it may
  //! touch the shadow's edge.
  float edge_cosine_lowest;
  float edge_cosine_highest;
  IntegrationSettings settings;
  int first_row;  //!< first row of the image in this block
  int row_count;
  LensPixels out;  //!< row_count * width elements per channel
};

template <>
struct Kernel<PixelBatch> : KernelDefaults {
  static const char* name(const PixelBatch& batch) {
    return has_footprints(batch.out) ? "trace_pixels, footprints" : "trace_pixels";
  }
  static PixelRows rows(const PixelBatch& batch) { return {batch.projection.width_px, batch.row_count}; }

  template <class Visit>
  static void visit_outputs(const PixelBatch& batch, const Visit& visit) {
    visit_channels(batch.out, element_count(batch), visit);
  }
};

}  // namespace ergodome
