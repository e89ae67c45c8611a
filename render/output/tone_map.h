#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "content/show/show.h"
#include "kernels/image/tone_curve.h"
#include "render/picture/picture.h"

// Display values of pictures, and automatic exposure.

namespace ergodome {

//! Returns the tone for tone settings, without automatic exposure.
inline Tone tone_of(const ToneSettings& settings) {
  return {settings.curve, std::exp2(static_cast<float>(settings.exposure_stops)), static_cast<float>(settings.white),
          static_cast<float>(settings.gamma)};
}

//! Returns a picture as display-referred sRGB, three bytes per pixel.
//!
//! Applies the picture's tone. Heat maps already contain display colors, so they are only encoded.
std::vector<std::uint8_t> tone_mapped(const Picture& picture);

//! Returns the same as tone_mapped() with a fourth byte of 255 for each pixel.
std::vector<std::uint8_t> tone_mapped_rgba(const Picture& picture);

//! Returns the same as tone_mapped() with 16 bits per channel.
std::vector<std::uint16_t> tone_mapped_finely(const Picture& picture);

//! Returns the picture's coverage, 0 to 1, one value per pixel.
std::vector<float> coverage_of(const Picture& picture);

//! Computes the geometric mean of the light of one or several pictures, such as those of both eyes.
class LightMeter {
 public:
  //! Adds the pixels of a picture whose coverage exceeds 0.5. Light below 1e-5 counts as 1e-5.
  //! Non-finite light is ignored.
  void add(const Picture& picture);

  //! Returns the geometric mean of the luminances of all added pixels, or 0 without pixels.
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

  //! Returns the stops that were applied to the last pictures.
  [[nodiscard]] double stops() const { return stops_; }

  //! Returns the stops to apply to pictures whose mean light is `middle_light`, shown `seconds`
  //! after the previous ones. Approaches those that bring the light to the settings' target, within
  //! their limits, with the time constant adapt_s; the first call adapts at once. Light of 0 has no
  //! target: the stops are only limited.
  double follow(double middle_light, double seconds);

 private:
  AutoExposureSettings settings_;
  bool started_ = false;
  double stops_ = 0.0;
};

}  // namespace ergodome
