#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "content/sky/environment_image.h"
#include "render/passes/sky/temperature_fit.h"

namespace ergodome {

//! A place on a meridian of a map: the sine of its declination, and the row of texels that it lies in.
struct ColumnPlace {
  double sine;
  int row;
};

//! An equirectangular map summed down its columns, rows weighted with their solid angles: the light between two places of a column is the
//! difference of two sums, however far they are apart (Verbraeck & Eisemann 2021, section 4.2).
//!
//! Sums are double: in float those of the last rows before the lower pole are lost, for each is some 1e-6 of what has been summed up by
//! then (test ColumnSums.InFloatTheLowerPoleWouldBeLost). 24 bytes a texel, with temperatures 32.
class ColumnSums {
 public:
  //! `fit`: for light with a fourth part as cube maps' texels have it (kernels/sky/cube_map.h); nullptr: its fourth part is 0.
  ColumnSums(const EnvironmentImage& image, const TemperatureFit* fit);

  //! Memory of the sums of an image of a width; `fitted`: with temperatures.
  static long bytes_for(int map_width, bool fitted);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  [[nodiscard]] ColumnPlace place_of(double sine) const;

  //! The light above a line through a column, added to `sum`: texels are areas of constant light, the line is straight in longitude and
  //! sine of the declination (equal areas) from one place to another, and `part` is its width in columns, negative when it runs backwards.
  //! Exact. A whole column of light 1 gives 2.
  void add_above(int column, const ColumnPlace& from, const ColumnPlace& to, double part, glm::dvec4& sum) const;

  //! The light of all columns.
  [[nodiscard]] const glm::dvec4& whole() const { return whole_; }

 private:
  [[nodiscard]] const double* sums_at(int column, int row) const {
    return sums_.data() + static_cast<std::size_t>(parts_) *
                              (static_cast<std::size_t>(column) * static_cast<std::size_t>(height_ + 1) +
                               static_cast<std::size_t>(row));
  }

  //! Adds `part` times the light above a place.
  void add_at(int column, const ColumnPlace& place, double part, glm::dvec4& sum) const;

  int width_;
  int height_;
  int parts_;                  //!< of light: three or four
  std::vector<double> sines_;  //!< at the upper ends of rows, and the lower pole
  std::vector<double> sums_;   //!< of the rows above, by column, row and part
  glm::dvec4 whole_{0.0};
};

}  // namespace ergodome
