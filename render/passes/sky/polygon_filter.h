#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "kernels/image/lens_pixels.h"
#include "render/passes/sky/column_sums.h"

namespace ergodome {

//! The map's light over the outlines of pixels on the sky, as Verbraeck & Eisemann (2021, section 4.2) filter it: summed exactly over the
//! columns of the equirectangular map that an outline covers. A reference for the elliptic filter, on the processor.
//!
//! What is theirs: sums down columns, weighted with the rows' solid angles; a pixel's light is the mean over the quadrangle of its corners.
//! What is not: corners are the pixel's own derivatives from its middle, half a pixel each way, and need no rays; sides are great circles,
//! and parts of texels count as parts, not whole. An outline is summed along its sides, light above each side with its direction as the
//! sign, columns counted on across the map's seam. So the seam takes no cut and the upper pole no case of its own, and wide outlines need
//! no bounding quad in their place: they cost what their sides cost. Outlines too wide for a hemisphere, which near the shadow cover the
//! sky many times, have the mean of the sky.
class PolygonFilter {
 public:
  //! `sky_from_map`: rotation from the map's axes to the hole's. `fit`: as for ColumnSums.
  PolygonFilter(const EnvironmentImage& image, const glm::dmat3& sky_from_map, const TemperatureFit* fit);

  //! Mean light over a pixel that looks in a direction (unit vector), with its derivatives per pixel to the right and down.
  [[nodiscard]] glm::dvec4 light(const glm::dvec3& direction, const glm::dvec3& along_x,
                                 const glm::dvec3& along_y) const;

  //! Mean light over the whole sky.
  [[nodiscard]] glm::dvec4 mean() const;

  //! The light of `count` pixels, four floats each, as ShadeBatch::rgba wants it; 0 where the coverage is. All in host memory.
  void filter(const LensPixels& lens, int count, float* rgba) const;

 private:
  //! What the sides of an outline add up to, all in columns times sine of the declination.
  struct Sum {
    glm::dvec4 light{0.0};
    double area = 0.0;
    double tolerance = 0.0;  //!< angle that a side may be off, times 8 [rad]
    double turn = 0.0;       //!< columns that the outline goes forwards in all: a full turn when it goes round a pole
  };

  //! A place on an outline; `column` runs on across the seam.
  struct Place {
    glm::dvec3 direction;
    double column;
    ColumnPlace in_column;
  };

  [[nodiscard]] double column_of(const glm::dvec3& direction) const;
  //! Adds what lies above a piece of a side inside one column. Halves it until it is straight there, `depth` times at the most.
  void add_piece(int column, const Place& from, const Place& to, int depth, Sum& sum) const;
  void add_side(const glm::dvec3& from, const glm::dvec3& to, Sum& sum) const;

  ColumnSums sums_;
  glm::dmat3 map_from_sky_;
  std::vector<glm::dvec2> normals_;  //!< of the meridians where columns begin, in the plane of the equator
};

}  // namespace ergodome
