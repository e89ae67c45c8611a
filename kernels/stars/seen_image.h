#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"
#include "kernels/sky/blackbody.h"
#include "kernels/stars/field_star.h"

namespace ergodome {

//! An image of a star on a camera's sky.
struct StarImage {
  int star;  //!< in the field
  Vector3<float>
      direction;  //!< unit vector in the observer's frame (e_r, e_θ, e_φ); of an eye that turns, in the view's axes
  float magnification;         //!< of the solid angle; negative where the image is turned over
  float frequency_ratio;       //!< g = ν_observed / ν_emitted
  Vector3<float> illuminance;  //!< linear sRGB whose luminance part is in lx
};

//! An image with what tells it from another.
struct SeenImage {
  StarImage image;
  float arc;    //!< how far it stretches because its star is a disk [rad]
  bool capped;  //!< by its star's disk: which side it turns to means nothing
};

//! The longest arc that an image is taken for [rad].
inline constexpr float longest_arc = 1.5F;

//! How images shine.
struct StarLook {
  float faintest;      //!< illuminance of an image, below which it is left out [lx]
  bool redshift;       //!< light is shifted and beamed
  bool magnification;  //!< images are as bright as the lens makes them; else as bright as the star
};

inline namespace ERGO_TARGET {

ERGO_HD float luminance_of(const Vector3<float>& light) {
  return 0.2126729F * light.x + 0.7151522F * light.y + 0.0721750F * light.z;
}

//! The image of star `number` where the sky's solid angle over the observer's is `solid_angle`, signed by parity, and as it is capped by the star's
//! disk. False where it is too faint.
ERGO_HD bool shining_image(const BlackbodyTable& colours, const StarLook& look, int number, const FieldStar& star,
                           const Vector3<float>& direction, float frequency_ratio, float solid_angle, float capped,
                           StarImage& image) {
  const Vector3<float> light = star_light(colours, star.log_temperature, star.illuminance,
                                          look.redshift ? frequency_ratio : 1.0F, 1.0F / capped);
  if (!(luminance_of(light) >= look.faintest)) {
    return false;
  }
  image = {number, direction, (solid_angle < 0.0F ? -1.0F : 1.0F) / capped, frequency_ratio,
           look.magnification ? light : capped * light};
  return true;
}

//! An image that needs no rays: away from folds no star's disk shows, and both singular values of the map count as one. False where it is too faint.
ERGO_HD bool exact_image(const BlackbodyTable& colours, const StarLook& look, int number, const FieldStar& star,
                         const Vector3<float>& direction, float frequency_ratio, float solid_angle, SeenImage& found) {
  const float size = ::fabsf(solid_angle);
  const float root = ::sqrtf(size);
  const float capped = maximum(size, 0.5F * star.radius * root);
  const float most = longest_arc;
  found.arc = minimum(star.radius / maximum(root, 1e-15F), most);
  found.capped = capped > size;
  return shining_image(colours, look, number, star, direction, frequency_ratio, solid_angle, capped, found.image);
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
