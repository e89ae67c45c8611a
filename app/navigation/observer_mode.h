#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/navigation/camera_place.h"
#include "content/show/show.h"

namespace ergodome {

//! Who looks, as a visitor chooses: the motion that goes with the way of flying, or one of the others wherever the camera is.
enum class ObserverMode { natural, zamo, fixed, geodesic, retrograde, rain };

//! The next of them, round and round.
ObserverMode next_observer(ObserverMode mode);

//! An observer's velocity in the ZAMO frame, and whether another one stands in for it.
struct NearestVelocity {
  Vector3<double> velocity{};
  bool nearest = false;
};

//! Speed [c] in the ZAMO frame that stand-ins have.
inline constexpr double fastest_stand_in = 0.99;

//! The velocity of an observer, or the nearest to it that is possible.
//!
//! Where none can be as it should (at rest against the stars in the ergosphere, on a circular orbit inside that of light), the velocity
//! in the frame of the space that is dragged along is cut to 0.99 c in the same direction. Of all that are that slow this one is nearest
//! to what it stands in for: inside the ergosphere it is the one that the stars see turn most slowly. It sets in a little before the
//! border (γ = 7), so that a camera that crosses it sees no jump.
NearestVelocity nearest_velocity(ObserverMotion motion, double spin, double r, double theta);

//! What the renderer has to be told, and what the screen says.
struct ObserverView {
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double> velocity{};  //!< in the ZAMO frame, for ObserverMotion::velocity
  bool nearest = false;        //!< stands in for one that cannot be
  std::string name;            //!< "static observer"
  std::string sentence;        //!< the name, the speed, and what stands in for what
};

//! The observer at a place. `shown` is the show's, for ObserverMode::natural, unless `own` says how the camera itself moves
//! (on an orbit, hovering). `language`: "de", or English.
ObserverView observer_view(ObserverMode mode, const CameraSettings& shown, const std::optional<ObserverView>& own,
                           double spin, double r, double theta, std::string_view language = "en");

//! An observer by its motion, as observer_view has them.
ObserverView observer_of(ObserverMotion motion, const Vector3<double>& given, double spin, double r, double theta,
                         std::string_view language = "en");

//! The observer of a camera that a show lets fall, at its velocity in the ZAMO frame.
ObserverView falling_observer(const Vector3<double>& velocity, std::string_view language = "en");

//! The same within the horizon, where there is no ZAMO.
ObserverView falling_within(std::string_view language = "en");

//! The observer of a visitor's camera that falls into the hole, at a radius [M] outside the horizon or within it. `in_zamo` is its velocity
//! outside, `left` its own time to the deepest place, where that is known [M].
ObserverView falling_into_hole(double r, double spin, const Vector3<double>& in_zamo, std::optional<double> left,
                               std::string_view language = "en");

//! Brings an observer's velocity from one to the next within a second: the sky slides where it would jump.
class ObserverFade {
 public:
  //! Call once a frame with the observer that is wanted where the camera is. The motion is `velocity` while it fades, and what it was given
  //! before and after. Observers are told apart by their names.
  ObserverView advance(double seconds, const ObserverView& wanted, double spin, const CameraPose& pose);

  //! Whether the last of them was not yet the one that was wanted.
  [[nodiscard]] bool fading() const;

 private:
  std::string name_;
  glm::dvec3 shown_{0.0};  //!< in directions that do not turn, for a camera that goes over the axis meanwhile
  glm::dvec3 from_{0.0};
  double elapsed_s_ = 1e9;
};

}  // namespace ergodome
