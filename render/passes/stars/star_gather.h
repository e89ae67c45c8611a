#pragma once

#include <cstdint>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/passes/stars/search/star_finder.h"
#include "render/passes/stars/search/star_tree.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! A star in the polygon that a pixel covers on the sky.
struct GatheredStar {
  int star;  //!< in the field
  int x_px;  //!< column and row of the pixel
  int y_px;
  float x_inside;              //!< where in the pixel, 0 to 1, as far as the map is straight across it
  float y_inside;              //!< downwards
  float frequency_ratio;       //!< g = ν_observed / ν_emitted, mean of the pixel's corners
  float magnification;         //!< of the solid angle, mean over the pixel; negative where the image is turned over
  Vector3<float> illuminance;  //!< linear sRGB whose luminance part is in lx
};

//! What the pixels of a picture gather.
struct GatheredStars {
  std::vector<GatheredStar> stars;   //!< by rows, in these by columns
  std::int64_t shadowed_pixels = 0;  //!< left out: a corner has no light from the sky
  std::int64_t stretched_pixels =
      0;  //!< left out: the polygon is wider than half a radian, and says nothing of what lies between
};

//! Finds the stars that shine into each pixel: the published way (Verbraeck & Eisemann, IEEE TVCG 27 (2021), sections 4.2 and 4.4), a
//! baseline, and a check of find_star_images that shares nothing with it but the stars' light.
//!
//! The light rays of a pixel's corners, traced in double, span a polygon on the sky; a star inside is as much brighter as the pixel's
//! solid angle is greater than the polygon's. So images next to the shadow are lost, and images next to caustics are wrong. In float,
//! the rounding of rays would be a percent of the area of polygons 1e-4 rad wide.
//!
//! Corners of an eye that turns with the direction are seen by a camera each: stars are as bright as its picture magnifies them.
//!
//! Of `settings` only `faintest`, `redshift` and `magnification` matter. Pixels wholly outside the circle of a dome gather nothing.
GatheredStars gather_stars(const StarField& field, const StarTree& tree, const BlackbodyTable& colours,
                           const StarEye& eye, const Projection& projection, const StarSettings& settings);

//! Gathered stars as images, to be drawn like those of find_star_images; without a spread, each one's light goes to the pixel that gathered it.
std::vector<StarImage> star_images(const std::vector<GatheredStar>& gathered, const EyeCamera& eye,
                                   const Projection& projection);

}  // namespace ergodome
