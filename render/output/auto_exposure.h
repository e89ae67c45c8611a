#pragma once

#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Sum of the logarithms of a picture's light, to tell what is in its middle. Pictures of both eyes add up.
class LightMeter {
 public:
  //! Adds the pixels that the image circle covers; light below 1e-5 counts as that, what is no number not at all.
  void add(const Picture& picture);

  //! Geometric mean of the luminances; 0 when there are none.
  [[nodiscard]] double middle_light() const;

 private:
  double sum_ = 0.0;
  double count_ = 0.0;
};

//! Exposure that follows the light within limits.
class AutoExposure {
 public:
  explicit AutoExposure(const AutoExposureSettings& settings) : settings_(settings) {}

  //! Follows otherwise from now on, from where it is.
  void set(const AutoExposureSettings& settings) { settings_ = settings; }

  //! Goes on from stops that pictures before have had.
  void go_on_from(double stops);

  //! The stops of the last pictures.
  [[nodiscard]] double stops() const { return stops_; }

  //! The stops to add for pictures of a middle light, `seconds` after those before; the first is met at once.
  double follow(double middle_light, double seconds);

 private:
  AutoExposureSettings settings_;
  bool started_ = false;
  double stops_ = 0.0;
};

}  // namespace ergodome
