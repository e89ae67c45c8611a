#include "app/player/session_observer.h"

#include <algorithm>

#include "content/camera/rain_pose.h"
#include "content/timeline/key_curve.h"

namespace ergodome {

namespace {

bool is_within(const CameraPose& pose, Spacetime spacetime) { return !(pose.r > horizon_radius(spacetime)); }

//! Returns how the camera itself moves, if that determines the observer; `in_zamo` is its pose with
//! the velocity in the ZAMO frame.
std::optional<ObserverView> flight_observer(const ObserverScene& scene, const CameraPose& in_zamo) {
  const Navigator& navigator = scene.navigator;
  if (navigator.course() == Navigator::Course::free) {
    return navigator.flight_observer(scene.language);
  }
  if (is_within(in_zamo, scene.spacetime)) {
    return falling_within(scene.language);
  }
  // While returning to a path with velocities, the observer already moves as the path does, so that
  // nothing jumps when the path is reached.
  const std::optional<Vector3<double>> velocity =
      navigator.course() == Navigator::Course::returning
          ? in_zamo_frame(camera_pose(scene.show, scene.time_s), scene.spacetime).velocity
          : in_zamo.velocity;
  if (!velocity) {
    return std::nullopt;
  }
  return scene.show.camera.orbit != nullptr ? falling_observer(*velocity, scene.language)
                                            : observer_of(ObserverMotion::velocity, *velocity, scene.spacetime,
                                                          in_zamo.r, in_zamo.theta, scene.language);
}

}  // namespace

void SessionObserver::choose_next(const CameraPose& pose, Spacetime spacetime) {
  mode_ = is_within(pose, spacetime) ? mode_ : next_observer(mode_);
}

void SessionObserver::observe(double seconds, const ObserverScene& scene, PlayerFrame& frame) {
  const bool within = is_within(frame.pose, scene.spacetime);
  const ObserverMode mode = within ? ObserverMode::natural : mode_;
  const CameraPose in_zamo = in_zamo_frame(frame.pose, scene.spacetime);
  const ObserverView wanted = observer_view(mode, scene.show.camera, flight_observer(scene, in_zamo), scene.spacetime,
                                            frame.pose.r, frame.pose.theta, scene.language);
  frame.observer = fade_.advance(seconds, wanted, scene.spacetime, frame.pose);
  if (!frame.pose.velocity_in_rain) {
    plunge_start_r_ = frame.pose.r;
  }
  const bool on_path = scene.navigator.course() == Navigator::Course::path;
  const bool falls_off_path = !on_path && frame.pose.velocity_in_rain;
  if (mode != ObserverMode::natural || (falls_off_path && !within && fade_.fading())) {
    replace_observer(scene, in_zamo, frame);
  } else if (on_path) {
    // Baked lenses are for the show's observer, so the renderer gets exactly this one, without a
    // fade.
    frame.observer.motion = scene.show.camera.motion;
    frame.observer.velocity = scene.show.camera.velocity;
  }
}

void SessionObserver::replace_observer(const ObserverScene& scene, const CameraPose& in_zamo,
                                       PlayerFrame& frame) const {
  const double horizon = horizon_radius(scene.spacetime);
  const double nearest = 1.002 * horizon;
  const double farthest = std::min(1.3 * horizon, plunge_start_r_);
  const double r = in_zamo.r;
  const double nearness = !frame.pose.velocity_in_rain || r >= farthest ? 0.0
                          : r <= nearest                                ? 1.0
                                                                        : eased((farthest - r) / (farthest - nearest));
  if (nearness == 1.0) {
    return;
  }
  const Vector3<double> falls = in_zamo.velocity.value_or(Vector3<double>{});
  frame.pose = in_zamo;
  frame.pose.velocity.reset();
  if (nearness > 0.0) {
    const ObserverView& seen = frame.observer;
    const Vector3<double> other = observer_velocity(seen.motion, scene.spacetime, r, frame.pose.theta, seen.velocity);
    frame.pose.velocity = other + nearness * (falls - other);
  }
}

}  // namespace ergodome
