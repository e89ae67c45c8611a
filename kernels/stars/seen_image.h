#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"
#include "kernels/sky/blackbody.h"
#include "kernels/stars/field_star.h"

// Lensed images of stars: their direction, magnification and light.
namespace ergodome {

//! An image of a star on a camera's sky.
struct StarImage {
  int star;  //!< index of the star in its field (SearchedField::stars)
  //! Unit vector in the observer's frame (e_r, e_θ, e_φ); for omnidirectional stereo, in the view's
  //! axes.
  Vector3<float> direction;
  float magnification;         //!< magnification of the solid angle; negative for inverted parity
  float frequency_ratio;       //!< g = ν_observed / ν_emitted
  Vector3<float> illuminance;  //!< linear sRGB whose luminance is in lx
};

//! An image, with properties by which other images of the same star can be told from it.
struct SeenImage {
  StarImage image;
  //! Length on the camera's sky of the arc to which the star's disk is stretched [rad].
  float arc;
  bool capped;  //!< the star's disk limits the magnification: the image's parity means nothing
};

//! Maximum length of SeenImage::arc [rad].
inline constexpr float longest_arc = 1.5F;

//! Settings for the brightness of star images.
struct StarAppearance {
  float faintest;  //!< star images of lower illuminance at the camera are omitted [lx]
  bool redshift;   //!< light is shifted in frequency and beamed
  //! Images are as bright as the lens makes them; otherwise as bright as the star.
  bool magnification;
};

inline namespace ERGO_TARGET {

ERGO_HD float luminance_of(const Vector3<float>& light) {
  return 0.2126729F * light.x + 0.7151522F * light.y + 0.0721750F * light.z;
}

//! Computes the image of star `number`. Returns false if it is too faint. `solid_angle`: the sky's
//! solid angle over the observer's, signed by parity; `capped`: its size, raised to the minimum
//! that the size of the star's disk implies.
ERGO_HD bool shining_image(const BlackbodyTable& colours, const StarAppearance& appearance, int number,
                           const FieldStar& star, const Vector3<float>& direction, float frequency_ratio,
                           float solid_angle, float capped, StarImage& image) {
  const Vector3<float> light = star_light(colours, star.log_temperature, star.illuminance,
                                          appearance.redshift ? frequency_ratio : 1.0F, 1.0F / capped);
  if (!(luminance_of(light) >= appearance.faintest)) {
    return false;
  }
  image = {number, direction, (solid_angle < 0.0F ? -1.0F : 1.0F) / capped, frequency_ratio,
           appearance.magnification ? light : capped * light};
  return true;
}

//! Computes an image that needs no rays. Returns false if it is too faint. Away from folds, disks
//! of stars are not resolved, and both singular values of the map are taken as equal.
ERGO_HD bool exact_image(const BlackbodyTable& colours, const StarAppearance& appearance, int number,
                         const FieldStar& star, const Vector3<float>& direction, float frequency_ratio,
                         float solid_angle, SeenImage& found) {
  const float size = ::fabsf(solid_angle);
  const float root = ::sqrtf(size);
  const float capped = maximum(size, 0.5F * star.radius * root);
  const float max_value = longest_arc;
  found.arc = minimum(star.radius / maximum(root, 1e-15F), max_value);
  found.capped = capped > size;
  return shining_image(colours, appearance, number, star, direction, frequency_ratio, solid_angle, capped, found.image);
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
