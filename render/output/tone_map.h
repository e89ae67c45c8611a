#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "content/show/show.h"
#include "kernels/image/tone_curve.h"
#include "render/picture/picture.h"

// Display values of pictures, and automatic exposure.

namespace ergodome {

//! Returns the tone of settings, without automatic exposure.
inline Tone tone_of(const ToneSettings& settings) {
  return {settings.curve, std::exp2(static_cast<float>(settings.exposure_stops)), static_cast<float>(settings.white),
          static_cast<float>(settings.gamma)};
}

//! Returns a picture as display-referred sRGB, three bytes per pixel.
//!
//! Applies the picture's tone; heat maps are colors already and are only encoded.
std::vector<std::uint8_t> tone_mapped(const Picture& picture);

//! Returns the same with 16 bits per channel.
std::vector<std::uint16_t> tone_mapped_finely(const Picture& picture);

//! Returns the picture's coverage, 0 to 1, one value per pixel.
std::vector<float> coverage_of(const Picture& picture);

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
