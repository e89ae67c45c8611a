#include "app/player/renderers/picture_error.h"

#include "app/budget/lens_error.h"
#include "kernels/projection/pixel_measure.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

namespace {

//! Number of rows in which errors are measured, and of pixels in each row: few enough not to delay
//! a frame.
constexpr int error_rows = 8;
constexpr int error_columns = 16;

}  // namespace

std::vector<double> picture_errors(ShowRenderer& renderer, const PictureRequest& request, const Projection& projection,
                                   const ShowMoment& moment) {
  const PlayerFrame& frame = request.frame;
  const auto lens =
      frame.mode == ViewMode::sky ? renderer.lens_of(frame.pose, projection, {moment.time_s, 0.0}) : nullptr;
  if (!lens || lens->behind()) {
    return {};
  }
  const Projection whole = make_projection(renderer.show().view, request.whole_px, frame.field_of_view_deg);
  const LensErrors exact(eye_camera(renderer.show(), frame.pose, 0.0), projection,
                         row_samples(projection, error_rows, error_columns, request.error_seed), pixel_angle(whole));
  return exact.errors(renderer.backend(), *lens, PixelNeed::footprint);
}

}  // namespace ergodome
