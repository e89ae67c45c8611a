#pragma once

#include "content/images/image_library.h"

namespace ergodome {

//! How the numbers of a file's pixels encode light. Files must be opened with
//! `Wishes::separate_alpha`.
struct LightCoding {
  int channels = 3;
  int alpha = -1;         //!< index of the alpha channel, or -1
  bool decoded = false;   //!< the colors must be decoded from sRGB
  bool separate = false;  //!< the colors are not premultiplied by alpha

  //! Returns the alpha of a pixel of `channels` numbers; 1 without an alpha channel.
  [[nodiscard]] float alpha_of(const float* pixel) const;

  //! Returns how many of a pixel's numbers put_light() reads: the colors, and alpha if it needs it.
  [[nodiscard]] int light_channels() const;

  //! Computes a pixel's linear red, green and blue premultiplied by alpha: what is seen of it over
  //! black. The sRGB curve applies to unpremultiplied colors, so alpha multiplies the decoded ones.
  void put_light(const float* pixel, float* rgb) const;
};

//! Returns the coding of an image of this shape.
LightCoding light_coding(const ImageShape& shape);

}  // namespace ergodome
