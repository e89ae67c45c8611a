#pragma once

#include <vector>

#include "kernels/projection/projection.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! Ray through a pixel corner.
struct CornerRay {
  Vector3<double> sky;
  double frequency_ratio;
  bool seen;  //!< true if the ray was traced and its light comes from the sky
};

//! Rays through the corners of some rows of pixels. Each corner is traced once, so that neighboring
//! pixels have bit-identical common edges.
class CornerRows {
 public:
  CornerRows(const StarEye& eye, const Projection& projection)
      : eye_(eye), projection_(projection), width_(static_cast<std::size_t>(projection.width_px) + 1) {}

  //! Traces the corners of rows of pixels, which must directly follow those of the previous call.
  void trace(int first_row, int row_count);

  //! Returns the index of the top left corner of a pixel. If the picture covers a full turn, its
  //! right edge is the same as its left one.
  [[nodiscard]] int number(int row, int column) const {
    const bool turned = wraps_around(projection_) && column == projection_.width_px;
    return (row - first_row_) * (projection_.width_px + 1) + (turned ? 0 : column);
  }

  [[nodiscard]] const CornerRay& operator[](int number) const { return corners_[static_cast<std::size_t>(number)]; }

 private:
  [[nodiscard]] double column_of(std::size_t i) const { return static_cast<double>(i % width_); }
  [[nodiscard]] double row_of(std::size_t i) const {
    const std::size_t row = i / width_;
    return first_row_ + static_cast<double>(row);
  }

  //! Returns whether one of the pixels around the corner is at least partly inside the image.
  [[nodiscard]] bool is_needed(std::size_t i) const;
  void trace(const std::vector<std::size_t>& asked);

  const StarEye& eye_;
  const Projection& projection_;
  std::size_t width_;  //!< corners per row
  int first_row_ = 0;
  std::vector<CornerRay> corners_;
};

}  // namespace ergodome
