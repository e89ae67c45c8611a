#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "content/sky/environment_image.h"
#include "render/passes/sky/temperature_fit.h"

namespace ergodome {

//! A position on a meridian of a map: the sine of its declination, and the row of texels that
//! contains it.
struct ColumnPlace {
  double sine;
  int row;
};

//! Cumulative sums of an equirectangular map down its columns, rows weighted by solid angle. The
//! light between two positions of a column is a difference of two sums, however far apart they are
//! (Verbraeck & Eisemann 2021, section 4.2).
//!
//! Sums are double: each of the last rows before the lower pole contributes only about 1e-6 of the
//! sum, which float would lose (test ColumnSums.InFloatTheLowerPoleWouldBeLost). Takes 24 bytes per
//! texel, or 32 with temperatures.
class ColumnSums {
 public:
  //! `fit`, if given, adds the fourth component of cube map texels (kernels/sky/cube_map.h);
  //! otherwise that component is 0.
  ColumnSums(const EnvironmentImage& image, const TemperatureFit* fit);

  //! Returns the size of the sums for an image of a given width [bytes]; `fitted`: with
  //! temperatures.
  static long bytes_for(int map_width, bool fitted);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  [[nodiscard]] ColumnPlace place_of(double sine) const;

  //! Adds the light above a line through a column to `sum`, exactly for texels of constant light.
  //! The line is straight in longitude and sine of the declination (an equal-area map). `part` is
  //! its width in columns, negative if it runs backwards. A whole column of light 1 gives 2.
  void add_above(int column, const ColumnPlace& from, const ColumnPlace& to, double part, glm::dvec4& sum) const;

  //! Returns the sum over all columns.
  [[nodiscard]] const glm::dvec4& whole() const { return whole_; }

 private:
  [[nodiscard]] const double* sums_at(int column, int row) const {
    return sums_.data() + static_cast<std::size_t>(parts_) *
                              (static_cast<std::size_t>(column) * static_cast<std::size_t>(height_ + 1) +
                               static_cast<std::size_t>(row));
  }

  //! Adds `part` times the light above a position.
  void add_at(int column, const ColumnPlace& place, double part, glm::dvec4& sum) const;

  int width_;
  int height_;
  int parts_;                  //!< components of light: three or four
  std::vector<double> sines_;  //!< at the upper ends of rows, and at the lower pole
  std::vector<double> sums_;   //!< of all rows above; index order: column, row, component
  glm::dvec4 whole_{0.0};
};

}  // namespace ergodome
