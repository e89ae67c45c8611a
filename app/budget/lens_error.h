#pragma once

#include <cstdint>
#include <vector>

#include "kernels/launch/launch.h"
#include "render/accuracy/pixel_lens.h"
#include "render/accuracy/pixel_reference.h"
#include "render/lens/lens_source.h"

namespace ergodome {

//! Pixels of some rows of a picture: lenses are asked for whole rows.
struct RowSamples {
  std::vector<int> rows;             //!< in ascending order
  int columns = 0;                   //!< pixels of each row
  std::vector<std::int64_t> pixels;  //!< row by row: row times width plus column
};

//! One row at random in each of `rows` bands of a picture, and one pixel at random in each of `columns` parts of each row. The seed means the
//! same pixels everywhere.
RowSamples row_samples(const Projection& projection, int rows, int columns, std::uint64_t seed);

//! What some pixels of a picture see exactly, and what lenses miss it by.
class LensErrors {
 public:
  //! `pixel`: the angle that errors are counted in [rad].
  LensErrors(const EyeCamera& eye, const Projection& projection, RowSamples samples, double pixel);

  //! Displacements on the screen, of the pixels that see something or should [px]; others say nothing.
  //!
  //! `lens`: of the eye, in the memory of `backend`. `need`: what the picture asks of it, too.
  [[nodiscard]] std::vector<double> errors(Backend backend, const LensSource& lens, PixelNeed need) const;

 private:
  Projection projection_;
  RowSamples samples_;
  PixelReference reference_;
};

}  // namespace ergodome
