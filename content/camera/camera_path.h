#pragma once

#include <glm/gtc/quaternion.hpp>

#include "content/camera/free_fall.h"
#include "content/show/show.h"

namespace ergodome {

//! Position, orientation and motion of the camera.
//!
//! `orientation` rotates the view's axes (x right, y up, z back, as in OpenGL) into the local frame
//! (e_r, e_θ, e_φ). With the view toward the hole, right is e_φ, up is -e_θ (toward the spin axis)
//! and back is e_r.
struct CameraPose {
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
  double phi;    //!< azimuth [rad]; inside the horizon, in ingoing Kerr coordinates
  glm::dquat orientation;
  //! Velocity of the observer in the ZAMO frame, below that of light; absent: the show's observer,
  //! or one that replaces it, defines the velocity.
  std::optional<Vector3<double>> velocity = std::nullopt;
  //! True if the velocity is in the rain frame and the axes are boosted from it, as for a camera
  //! that falls through the horizon.
  bool velocity_in_rain = false;
  //! For a camera that falls through the horizon: its Boyer-Lindquist time minus the show's time,
  //! which is then that of infalling observers [M]; see outer_lag(). Otherwise 0. The outside world
  //! is seen at Boyer-Lindquist time, which diverges at the horizon; inside, this lead is 0, and
  //! light is delayed in the time of infalling observers.
  double clock_lead = 0.0;
};

//! Returns the camera at a show time. It passes through the keys exactly, and stays at each for its
//! hold time.
//!
//! Between keys, log r, θ and φ follow quintics that do not overshoot, and the orientation follows
//! a quaternion spline. All have continuous second derivatives, except at keys with Ease::linear
//! and at ends of the path without easing. Before the first key and after the last one the camera
//! rests.
//!
//! Velocities of keys are interpolated by such quintics as proper velocities (proper_velocity.h).
//!
//! During a fall, the orbit defines position and velocity. The keys define the orientation relative
//! to a frame that is transported along the orbit (FallPosition::frame). During
//! FallSettings::ease_s before the fall, the velocity changes from the observer's to the fall's
//! initial one. After the fall the keys define the path again (keys_after_fall()), and the velocity
//! changes back in the same way.
CameraPose camera_pose(const Show& show, double time_s);

//! Returns the rotation of the view's axes into (e_r, e_θ, e_φ) at a key, as in CameraPose.
glm::dquat key_orientation(const CameraKey& key);

//! Returns the unit vectors e_r, e_θ, e_φ as the columns of a rotation, for polar coordinates
//! [rad].
glm::dquat spherical_frame(double theta, double phi);

//! Computes the fall of a show's camera until the fall ends, at most until a second after the
//! show's end. Returns nullptr if the camera does not fall. All numbers of the show must have been
//! read, and the camera must have a key at the beginning of the fall.
std::shared_ptr<const FreeFall> follow_fall(const Show& show);

//! Returns the camera's keys after its fall: the end of the fall as a key, then the keys after it.
//! Azimuths continue from the fall's, by the shorter way to the first key. Returns an empty list if
//! the camera does not fall, or falls until the end of the show.
std::vector<CameraKey> keys_after_fall(const Show& show);

//! Returns true if the camera falls through the horizon.
bool leads_within(const Show& show);

//! Returns true if the camera's position or orientation may change during the show.
bool camera_moves(const Show& show);

//! Returns the times between which r and θ are monotonic, in order, from the show's beginning to
//! its end [s]: the times of keys, the ends of their holds, the turning points of a fall's orbit,
//! the time when the fall's clock stops, and the times when the change of velocity to and from the
//! fall's begins or ends.
std::vector<double> path_ends_s(const Show& show);

}  // namespace ergodome
