#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "content/sky/environment_image.h"
#include "render/passes/sky/temperature_fit.h"

namespace ergodome {

//! A position on a meridian of a map: the sine of its declination, and the index of the texel row
//! that contains it.
struct ColumnPosition {
  double sine;
  int row;
};

//! Cumulative sums of an equirectangular map down its columns, with rows weighted by solid angle.
//! The light between two positions of a column is the difference of two sums, however far apart
//! they are (Verbraeck & Eisemann 2021, section 4.2).
//!
//! Sums are double, because each of the last rows before the lower pole contributes only about 1e-6
//! of the sum, which would be lost in float (test ColumnSums.InFloatTheLowerPoleWouldBeLost). They
//! take 24 bytes per texel, or 32 with temperatures.
class ColumnSums {
 public:
  //! If `fit` is not null, also sums the fourth component of cube map texels
  //! (kernels/sky/cube_map.h); otherwise that component is 0.
  ColumnSums(const EnvironmentImage& image, const TemperatureFit* fit);

  //! Returns the memory of the sums for an image of a given width [bytes]. `fitted`: with the
  //! fourth component.
  static long bytes_for(int map_width, bool fitted);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  [[nodiscard]] ColumnPosition position_of(double sine) const;

  //! Adds the light above a line through a column to `sum`; exact if light is constant within each
  //! texel. The line is straight in longitude and sine of the declination (an equal-area map).
  //! `part` is the width of the line in columns, negative if the line runs backwards. A whole
  //! column of light 1 gives 2.
  void add_above(int column, const ColumnPosition& from, const ColumnPosition& to, double part, glm::dvec4& sum) const;

  //! Returns the sum over all columns.
  [[nodiscard]] const glm::dvec4& whole() const { return whole_; }

 private:
  [[nodiscard]] const double* sums_at(int column, int row) const {
    return sums_.data() + static_cast<std::size_t>(parts_) *
                              (static_cast<std::size_t>(column) * static_cast<std::size_t>(height_ + 1) +
                               static_cast<std::size_t>(row));
  }

  //! Adds `part` times the light above a position.
  void add_at(int column, const ColumnPosition& position, double part, glm::dvec4& sum) const;

  int width_;
  int height_;
  int parts_;  //!< number of components of the light: three or four
  //! Sine of the declination at the upper end of each row, and at the lower pole.
  std::vector<double> sines_;
  //! For each row, the sum of all rows above it; index order: column, row, component.
  std::vector<double> sums_;
  glm::dvec4 whole_{0.0};
};

}  // namespace ergodome
