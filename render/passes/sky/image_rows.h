#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "content/sky/environment_image.h"

namespace ergodome {

//! Directions base + s * along, not normalized, for each s of a list: a row of samples on a cube
//! face.
struct DirectionRow {
  glm::dvec3 base;
  glm::dvec3 along;
  std::span<const float> s;
};

//! Computes the positions of a row of directions in an equirectangular map; directions are in the
//! map's axes. A single-precision, vectorized `map_from_direction` for maps of hundreds of millions
//! of samples.
//!
//! Writes column / width to `x`, in [-1/4, 3/4], and row / height to `y`, in [0, 1]; both are as
//! long as `row.s`. The error is below 2e-7, except for the columns of directions next to a pole,
//! where all columns meet.
void positions_in_map(const DirectionRow& row, std::span<float> x, std::span<float> y);

//! Samples an equirectangular image bilinearly along rows of directions.
class ImageRows {
 public:
  //! Keeps a reference to `image`.
  ImageRows(const EnvironmentImage& image, const glm::dmat3& map_from_sky)
      : image_(image), map_from_sky_(map_from_sky) {}

  //! Reads the light of a row of directions in the sky's axes; `light` is as long as `row.s`.
  void read(const DirectionRow& row, std::span<glm::vec3> light) const;

 private:
  [[nodiscard]] glm::vec3 between_texels(float x, float y) const;

  const EnvironmentImage& image_;
  glm::dmat3 map_from_sky_;
};

}  // namespace ergodome
