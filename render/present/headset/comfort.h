#pragma once

#include "content/show/headset_settings.h"

namespace ergodome {

//! Motion and requests since the last frame of a headset. Numbers out of range are clamped, and NaN
//! counts as 0.
struct ComfortInput {
  //! Speed of the camera since the last frame [1/s]: the length of its velocity, divided by its
  //! distance from the hole.
  double speed = 0.0;
  bool cut = false;        //!< the show was cut, or its time has jumped
  double snap_turn = 0.0;  //!< snap turns requested since the last frame; positive: to the right
  //! Requested smooth turn since the last frame, from -1 to 1; positive: to the right. Ignored
  //! unless HeadsetSettings::snap_turn_deg is 0.
  double smooth_turn = 0.0;
  double exposure_stops = 0.0;  //!< requested exposure, clamped to ±max_comfort_stops
};

//! Settings with which one frame is drawn.
struct ComfortState {
  //! Fraction of the light that is removed outside the clear part of the view, 0 to 1.
  double vignette = 0.0;
  double clear_half_angle_rad = 0.0;  //!< half angle of the clear part, around the axis of each eye's view
  double light = 1.0;                 //!< factor of a fade through black; 0: black
  //! Rotation of the camera's axes to the right relative to the viewer's room, from -π to π [rad].
  double yaw_rad = 0.0;
  double exposure_stops = 0.0;
};

//! Maximum exposure, up or down [stops]: the limits of a show's exposure and of automatic exposure
//! together.
inline constexpr double max_comfort_stops = 80.0;

//! Half angle of the clear part of the view [rad] for each value of ComfortState::vignette: from
//! 60° for 0 to 35° for 1.
double clear_half_angle_rad(double vignette);

//! Computes the vignette, fades through black, snap turns and limited exposure of a headset.
//!
//! Time passes only in advance(). The result does not depend on the frame rate, with one exception:
//! a frame in which the yaw jumps is always black, even if it is late.
class HeadsetComfort {
 public:
  //! Starts with full light. The first frame adopts the requested exposure.
  explicit HeadsetComfort(const HeadsetSettings& settings);

  //! Adopts other settings, for example of a show that was read again. Keeps the state.
  void change(const HeadsetSettings& settings);

  //! Returns the state for a frame that is shown `seconds` after the last one. Speed and smooth
  //! turns hold during this time; cuts and snap turns happen at its end.
  //!
  //! A cut makes the frame black, and the picture fades in over HeadsetSettings::fade_s. A snap
  //! turn fades out, turns in the dark and fades in, in fade_s together. Without fades, both happen
  //! in this frame.
  ComfortState advance(double seconds, const ComfortInput& input);

 private:
  //! Returns the time for which the view stays black around a snap turn [s].
  [[nodiscard]] double dark_s() const;
  //! Returns the duration of the fade before a snap turn, and of the one after it [s].
  [[nodiscard]] double snap_fade_s() const;
  void advance_vignette(double seconds, double speed, double smooth_turn);
  void advance_fade(double seconds);
  void advance_exposure(double seconds, double stops);
  void turn(double angle_rad);
  //! Turns the view by requested_rad_.
  void turn_as_requested();

  HeadsetSettings settings_;
  bool started_ = false;
  double vignette_ = 0.0;
  double light_ = 1.0;
  double fade_in_s_ = 0.0;      //!< duration of the fade from black to full light
  double dark_left_s_ = 0.0;    //!< time for which the view stays black after a snap turn
  double requested_rad_ = 0.0;  //!< snap turns that wait for the dark
  double yaw_rad_ = 0.0;
  double exposure_stops_ = 0.0;
};

}  // namespace ergodome
