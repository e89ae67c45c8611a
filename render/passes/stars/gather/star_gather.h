#pragma once

#include <cstdint>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/passes/stars/gather/star_tree.h"
#include "render/passes/stars/search/star_finder.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! A star inside the polygon of sky that a pixel covers.
struct GatheredStar {
  int star;  //!< index of the star in the field
  int x_px;  //!< column and row of the pixel
  int y_px;
  float x_inside;         //!< horizontal position in the pixel, 0 to 1, linearly interpolated
  float y_inside;         //!< vertical position in the pixel, 0 to 1 downwards, linearly interpolated
  float frequency_ratio;  //!< g = ν_observed / ν_emitted, mean of the pixel's corners
  //! Solid angle of the pixel divided by that of its polygon on the sky; negative for mirrored
  //! images.
  float magnification;
  Vector3<float> illuminance;  //!< linear sRGB whose luminance part is in lx
};

//! Stars that were gathered by the pixels of a picture.
struct GatheredStars {
  std::vector<GatheredStar> stars;  //!< row by row, in each row by column
  //! Pixels skipped because the light of a corner does not come from the sky.
  std::int64_t shadowed_pixels = 0;
  //! Pixels skipped because their polygon is too wide (half a radian) to describe the sky inside
  //! it.
  std::int64_t stretched_pixels = 0;
};

//! Finds the stars that shine into each pixel by the published method (Verbraeck & Eisemann, IEEE
//! TVCG 27 (2021), sections 4.2 and 4.4). Serves as a baseline, and as a check of find_star_images
//! that shares only the light of the stars with it.
//!
//! The light rays of a pixel's corners, traced in double precision, span a polygon on the sky. A
//! star inside is magnified by the ratio of the pixel's solid angle to that of the polygon. Images
//! next to the shadow are therefore lost, and images next to caustics are wrong. In single
//! precision, rounding would change the area of polygons 1e-4 rad wide by about one percent.
//!
//! For an ODS eye, each corner has its own camera; stars are magnified as that eye's picture is.
//!
//! Uses only `faintest`, `redshift` and `magnification` of `settings`. Pixels entirely outside the
//! circle of a dome gather nothing.
GatheredStars gather_stars(const StarField& field, const StarTree& tree, const BlackbodyTable& colours,
                           const StarEye& eye, const Projection& projection, const StarSettings& settings);

//! Converts gathered stars to images that are drawn like those of find_star_images. With a spread
//! of zero, the light of each star falls on the pixel that gathered it.
std::vector<StarImage> star_images(const std::vector<GatheredStar>& gathered, const EyeCamera& eye,
                                   const Projection& projection);

}  // namespace ergodome
