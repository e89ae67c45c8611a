#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "content/sky/environment_image.h"

namespace ergodome {

//! Directions base + s along, not of unit length, for each s of a list: a row of samples on a face of a cube.
struct DirectionRow {
  glm::dvec3 base;
  glm::dvec3 along;
  std::span<const float> s;
};

//! Places in an equirectangular map of a row of directions, given in the map's axes: what `map_from_direction` says, in single precision and many at a
//! time, for maps of hundreds of millions of samples.
//!
//! `x` are columns by the map's width, in [-1/4, 3/4]; `y` rows by its height, in [0, 1]; both as long as `row.s`. Within 2e-7 of the exact ones, but for the
//! columns of directions next to a pole, which meet there.
void places_in_map(const DirectionRow& row, std::span<float> x, std::span<float> y);

//! Reads an equirectangular image between its texels along rows of directions.
class ImageRows {
 public:
  //! `image` is not copied.
  ImageRows(const EnvironmentImage& image, const glm::dmat3& map_from_sky)
      : image_(image), map_from_sky_(map_from_sky) {}

  //! The light of a row of directions in the sky's axes; `light` is as long as `row.s`.
  void read(const DirectionRow& row, std::span<glm::vec3> light) const;

 private:
  [[nodiscard]] glm::vec3 between_texels(float x, float y) const;

  const EnvironmentImage& image_;
  glm::dmat3 map_from_sky_;
};

}  // namespace ergodome
