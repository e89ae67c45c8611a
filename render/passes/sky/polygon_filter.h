#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "kernels/image/lens_pixels.h"
#include "render/passes/sky/column_sums.h"

namespace ergodome {

//! Filters the map over the outlines of pixels on the sky (Verbraeck & Eisemann 2021, section 4.2):
//! exact sums over the columns of the equirectangular map that an outline covers. A CPU reference
//! for the elliptic filter.
//!
//! Taken from the paper: sums down columns, weighted by the solid angles of the rows; a pixel's
//! light is the mean over the quadrangle of its corners.
//!
//! Different from the paper: corners follow from the derivatives at the pixel's center, half a
//! pixel each way, and need no rays. Sides are great circles, and texels are counted by fraction.
//! An outline is summed along its sides, as the light above each side, signed by the side's
//! direction, with columns continued across the map's seam. So neither the seam nor the upper pole
//! is a special case, and the cost of wide outlines depends on their sides only. Outlines that
//! reach more than 1.25 rad from their center, which near the shadow cover the sky many times, get
//! the mean of the sky.
class PolygonFilter {
 public:
  //! `sky_from_map`: rotation from the map's axes to the hole's sky axes. `fit`: as for ColumnSums.
  PolygonFilter(const EnvironmentImage& image, const glm::dmat3& sky_from_map, const TemperatureFit* fit);

  //! Returns the mean light over the area of the sky that a pixel covers. `direction`: unit vector
  //! at the pixel's center. `along_x`, `along_y`: its derivatives per pixel to the right and down.
  [[nodiscard]] glm::dvec4 light(const glm::dvec3& direction, const glm::dvec3& along_x,
                                 const glm::dvec3& along_y) const;

  //! Returns the mean light over the whole sky.
  [[nodiscard]] glm::dvec4 mean() const;

  //! Computes the light of `count` pixels, four floats each, as in ShadeBatch::rgba; 0 where the
  //! coverage is 0. All pointers are to host memory.
  void filter(const LensPixels& lens, int count, float* rgba) const;

 private:
  //! The light above the sides of an outline, summed over the sides one after the other. Areas are
  //! in columns times sine of the declination.
  struct Sum {
    glm::dvec4 light{0.0};
    double area = 0.0;
    double tolerance = 0.0;  //!< eight times the accepted angular error of an outline's side [rad]
    //! Number of columns by which the outline advances in total; a full turn if it encircles a
    //! pole.
    double turn = 0.0;
  };

  //! A position on an outline; `column` continues across the seam.
  struct OutlinePoint {
    glm::dvec3 direction;
    double column;
    ColumnPosition in_column;
  };

  [[nodiscard]] double column_of(const glm::dvec3& direction) const;
  //! Adds the light above a piece of a side within one column. Halves the piece until it is
  //! straight enough, at most `depth` times.
  void add_piece(int column, const OutlinePoint& from, const OutlinePoint& to, int depth, Sum& sum) const;
  void add_side(const glm::dvec3& from, const glm::dvec3& to, Sum& sum) const;

  ColumnSums sums_;
  glm::dmat3 map_from_sky_;
  //! Normals of the meridian planes at the left edges of columns; the normals are in the equatorial
  //! plane.
  std::vector<glm::dvec2> normals_;
};

}  // namespace ergodome
