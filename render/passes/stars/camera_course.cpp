#include "render/passes/stars/camera_course.h"

#include <cmath>

#include "content/show/animated_show.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "render/lens/stations/lens_position.h"
#include "render/passes/stars/search/moving_patches.h"

namespace ergodome {

namespace {

//! Largest part of a cell that a camera may cross in a frame. The patches of a cell take as much
//! time as those of two positions.
constexpr double max_cell_part = 0.3;

//! Returns the course at a time of a show, from the camera's positions a frame before and after.
CameraCourse course_at(const Show& show, double time_s) {
  const double step_s = 1.0 / show.frame_rate_hz;
  const double before_s = time_s - step_s;
  const double after_s = time_s + step_s;
  const Spacetime spacetime = spacetime_at(show, before_s);
  if (!(spacetime == spacetime_at(show, after_s))) {
    return CameraCourse::any;
  }
  const CameraPose before = camera_pose(show, before_s);
  const CameraPose after = camera_pose(show, after_s);
  if (same_position({before.r, before.theta}, {after.r, after.theta})) {
    return CameraCourse::any;
  }
  const double horizon = horizon_radius(spacetime);
  const double of_height = std::log((after.r - horizon) / (before.r - horizon));
  const double frames = 2.0;
  const double part = std::hypot(of_height, after.theta - before.theta) / (frames * position_cell);
  // The comparison is also false for NaN, inside the horizon.
  return part <= max_cell_part ? CameraCourse::slow : CameraCourse::any;
}

}  // namespace

CameraCourse course_of(const EyePicture& picture) {
  const PictureSettings& settings = picture.settings;
  // The velocity of such observers may change everywhere, and the patches of a cell are for one.
  const bool steered =
      picture.eye.motion == ObserverMotion::velocity || picture.eye.motion == ObserverMotion::rain_boost;
  if (settings.omni || steered) {
    return CameraCourse::any;
  }
  if (settings.moment.time_s && settings.show != nullptr) {
    return course_at(*settings.show, *settings.moment.time_s);
  }
  return settings.moment.patience_s < ShowMoment::forever_s ? CameraCourse::unknown : CameraCourse::any;
}

}  // namespace ergodome
