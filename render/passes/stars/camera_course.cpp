#include "render/passes/stars/camera_course.h"

#include <cmath>

#include "content/show/animated_show.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "render/passes/stars/search/moving_patches.h"

namespace ergodome {

namespace {

//! Returns whether a camera that moves from one position to the other in some pictures moves
//! slowly, and does not stand.
bool moves_slowly(Spacetime spacetime, const LensPosition& from, const LensPosition& to, double pictures) {
  // Largest part of a cell that a camera may cross in a picture. The patches of a cell take as much
  // time as those of two positions.
  constexpr double max_cell_part = 0.3;
  if (same_position(from, to)) {
    return false;
  }
  const double horizon = horizon_radius(spacetime);
  const double of_height = std::log((to.r - horizon) / (from.r - horizon));
  // The comparison is false for NaN, inside the horizon.
  const double cells = std::hypot(of_height / position_cell_height, (to.theta - from.theta) / position_cell_theta);
  return cells / pictures <= max_cell_part;
}

//! Returns whether the camera moves slowly at a time of a show, from its positions a frame before
//! and after.
bool moves_slowly_at(const Show& show, double time_s) {
  const double step_s = 1.0 / show.frame_rate_hz;
  const double before_s = time_s - step_s;
  const double after_s = time_s + step_s;
  const Spacetime spacetime = spacetime_at(show, before_s);
  if (!(spacetime == spacetime_at(show, after_s))) {
    return false;
  }
  const CameraPose before = camera_pose(show, before_s);
  const CameraPose after = camera_pose(show, after_s);
  return moves_slowly(spacetime, {before.r, before.theta}, {after.r, after.theta}, 2.0);
}

}  // namespace

CameraCourse course_of(const EyePicture& picture) {
  const PictureSettings& settings = picture.settings;
  // The velocity of such observers may change everywhere, and the patches of a cell are for one.
  const bool steered =
      picture.eye.motion == ObserverMotion::velocity || picture.eye.motion == ObserverMotion::rain_boost;
  if (settings.omni || steered) {
    return {};
  }
  const ShowMoment& moment = settings.moment;
  const LensPosition here = {picture.eye.head_r, picture.eye.head_theta};
  CameraCourse course;
  if (moment.before) {
    course.slow = moves_slowly(picture.eye.spacetime, *moment.before, here, 1.0);
    course.step = {here.r - moment.before->r, here.theta - moment.before->theta};
  }
  if (moment.time_s && settings.show != nullptr) {
    course.slow = moves_slowly_at(*settings.show, *moment.time_s);
  }
  return course;
}

}  // namespace ergodome
