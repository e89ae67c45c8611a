#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/navigation/camera_placement.h"
#include "content/show/show.h"

namespace ergodome {

//! The observer that a visitor chooses: `natural` is the camera's own motion, or else the show's
//! observer; the others move in the named way wherever the camera is.
enum class ObserverMode { natural, zamo, fixed, geodesic, retrograde, rain };

//! Returns the next mode, cyclically.
ObserverMode next_observer(ObserverMode mode);

//! An observer's velocity in the ZAMO frame, and whether it replaces an impossible one.
struct NearestVelocity {
  Vector3<double> velocity{};
  bool nearest = false;
};

//! Speed [c] in the ZAMO frame of replacements for impossible observers.
inline constexpr double fastest_stand_in = 0.99;

//! Returns the velocity of an observer, or the nearest possible one.
//!
//! If an observer cannot exist (at rest relative to the stars in the ergosphere, on a circular
//! orbit inside the photon orbit), its velocity in the ZAMO frame is limited to 0.99 c in the same
//! direction. Of all velocities with this limit it is the closest: inside the ergosphere, the one
//! that sees the stars rotate most slowly. The limit starts slightly before the border (γ = 7), so
//! that a camera that crosses it sees no jump.
NearestVelocity nearest_velocity(ObserverMotion motion, Spacetime spacetime, double r, double theta);

//! The observer for the renderer, and its description for the screen.
struct ObserverView {
  ObserverMotion motion = ObserverMotion::zamo;
  //! Velocity in the ZAMO frame, if `motion` is ObserverMotion::velocity.
  Vector3<double> velocity{};
  bool nearest = false;  //!< true if it replaces an impossible observer
  std::string name;      //!< name of the observer, such as "static observer"
  std::string sentence;  //!< the name, the speed, and whether it is a replacement
};

//! Returns the observer at a position. For ObserverMode::natural, this is the observer of the show,
//! given by `shown`, unless `own` gives the motion of the camera itself (on an orbit, hovering).
//! `language`: "de", otherwise English.
ObserverView observer_view(ObserverMode mode, const CameraSettings& shown, const std::optional<ObserverView>& own,
                           Spacetime spacetime, double r, double theta, std::string_view language = "en");

//! Returns the observer with a motion, its possible replacement included. `given` is the velocity
//! in the ZAMO frame for ObserverMotion::velocity, otherwise unused.
ObserverView observer_of(ObserverMotion motion, const Vector3<double>& given, Spacetime spacetime, double r,
                         double theta, std::string_view language = "en");

//! Returns the observer of a camera in a show's free fall, at its velocity in the ZAMO frame.
ObserverView falling_observer(const Vector3<double>& velocity, std::string_view language = "en");

//! Returns the observer of a camera in a show's free fall inside the horizon, where there is no
//! ZAMO to measure its velocity.
ObserverView falling_within(std::string_view language = "en");

//! Returns the observer of a visitor's camera that falls into the hole, at a radius [M] outside or
//! inside the horizon. `in_zamo` is its velocity outside, `left` its proper time to the smallest
//! radius, if known [M].
ObserverView falling_into_hole(double r, Spacetime spacetime, const Vector3<double>& in_zamo,
                               std::optional<double> left, std::string_view language = "en");

//! Blends an observer's velocity to the next one's within a second, so that the sky does not jump.
class ObserverFade {
 public:
  //! Returns the observer to render; call it once per frame with the wanted observer at the
  //! camera's position. The motion is `velocity` during a fade, otherwise that of `wanted`.
  //! Observers are distinguished by their names.
  ObserverView advance(double seconds, const ObserverView& wanted, Spacetime spacetime, const CameraPose& pose);

  //! Returns whether the last observer was not yet the wanted one.
  [[nodiscard]] bool fading() const;

 private:
  std::string name_;
  //! Velocity of the last observer along axes fixed in space, so that the camera may cross the spin
  //! axis during a fade.
  glm::dvec3 shown_{0.0};
  glm::dvec3 from_{0.0};
  double elapsed_s_ = 1e9;
};

}  // namespace ergodome
