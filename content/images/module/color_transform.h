#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "content/images/module/color_metadata.h"

namespace ergodome {

//! Converts the numbers of a file's pixels to linear light with the primaries of Rec. 709, adapted
//! to a D65 white point.
class ColorTransform {
 public:
  //! Creates the transform from a file's metadata; `color_channels` is 1 for gray and 3 for RGB.
  //! Sets `problem` if the profile is damaged or describes other channels.
  ColorTransform(const ColorMetadata& metadata, int color_channels, std::string& problem);

  //! is_srgb() returns true if the result is the sRGB decoding of the numbers; is_identity() if it
  //! is the numbers themselves.
  [[nodiscard]] bool is_srgb() const { return is_srgb_; }
  [[nodiscard]] bool is_identity() const { return is_identity_; }

  //! Returns true if colors that are premultiplied by alpha can be converted without dividing by
  //! it.
  [[nodiscard]] bool is_linear() const { return is_linear_; }

  //! Converts the colors of `count` pixels with `channels` numbers each, in place. If `alpha` is a
  //! channel (0 or more), divides the colors by it first, and does not multiply them again. Uses
  //! all CPU threads for large images.
  void apply(float* pixels, std::size_t count, int channels, int alpha) const;

 private:
  void apply_here(float* pixels, std::size_t count, int channels, int alpha) const;
  void convert(float* colors, std::size_t count) const;
  void find_kind();

  int color_channels_;
  std::function<float(float)> decode_;  //!< applied to each number before the conversion; may be empty
  std::shared_ptr<void> conversion_;    //!< the transform of LittleCMS, or null
  std::vector<float> scale_;            //!< factor of each color before the conversion; may be empty
  bool is_srgb_ = false;
  bool is_identity_ = false;
  bool is_linear_ = false;
};

}  // namespace ergodome
