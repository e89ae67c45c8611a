#pragma once

#include "content/show/show.h"
#include "render/picture/picture.h"

// Automatic exposure.

namespace ergodome {

//! Accumulates the logarithms of pictures' light for their geometric mean. Pictures of both eyes
//! add up.
class LightMeter {
 public:
  //! Adds the pixels that the image covers; light below 1e-5 counts as 1e-5, and NaN is ignored.
  void add(const Picture& picture);

  //! Returns the geometric mean of the luminances; 0 without pixels.
  [[nodiscard]] double middle_light() const;

 private:
  double sum_ = 0.0;
  double count_ = 0.0;
};

//! Exposure that follows the light within limits.
class AutoExposure {
 public:
  explicit AutoExposure(const AutoExposureSettings& settings) : settings_(settings) {}

  //! Replaces the settings, keeping the current exposure.
  void set(const AutoExposureSettings& settings) { settings_ = settings; }

  //! Continues from the stops of earlier pictures.
  void go_on_from(double stops);

  //! Returns the stops of the last pictures.
  [[nodiscard]] double stops() const { return stops_; }

  //! Returns the stops to add for pictures with `middle_light`, `seconds` after the previous ones.
  //! The first call adapts at once.
  double follow(double middle_light, double seconds);

 private:
  AutoExposureSettings settings_;
  bool started_ = false;
  double stops_ = 0.0;
};

}  // namespace ergodome
