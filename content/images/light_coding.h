#pragma once

#include "content/images/image_library.h"

namespace ergodome {

//! How the numbers of a file's pixels become light. Files are opened with `Wishes::separate_alpha` for it.
struct LightCoding {
  int channels = 3;
  int alpha = -1;         //!< its channel, or -1
  bool decoded = false;   //!< from sRGB
  bool separate = false;  //!< colours are not times alpha

  //! The alpha of a pixel of `channels` numbers; 1 where there is none.
  [[nodiscard]] float alpha_of(const float* pixel) const;

  //! How many of a pixel's numbers its light needs: colours, and alpha where it is not in them as it should be.
  [[nodiscard]] int light_channels() const;

  //! A pixel's red, green and blue light times its alpha, which over black is what is seen of it. The curve of sRGB is for colours as they are; so they are
  //! multiplied after it.
  void put_light(const float* pixel, float* rgb) const;
};

//! The coding of an image; alpha is what its file calls so.
LightCoding light_coding(const ImageShape& shape);

}  // namespace ergodome
