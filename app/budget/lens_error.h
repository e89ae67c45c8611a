#pragma once

#include <cstdint>
#include <vector>

#include "kernels/launch/launch.h"
#include "render/accuracy/lenses/pixel_lens.h"
#include "render/accuracy/references/pixel_reference.h"
#include "render/frame/show_renderer.h"
#include "render/lens/lens_source.h"

namespace ergodome {

//! Pixels of some rows of a picture; lenses evaluate whole rows.
struct RowSamples {
  std::vector<int> rows;             //!< in ascending order
  int columns = 0;                   //!< pixels in each row
  std::vector<std::int64_t> pixels;  //!< row by row: row * width + column
};

//! Picks a random row in each of `rows` bands of a picture, and a random pixel in each of `columns`
//! parts of each row. Both numbers are clamped from 1 to the picture's size. The same seed gives
//! the same pixels on every machine.
RowSamples row_samples(const Projection& projection, int rows, int columns, std::uint64_t seed);

//! Measures lenses against exact rays for some pixels of a picture.
class LensErrors {
 public:
  //! `pixel` is the angle that counts as an error of one pixel [rad].
  LensErrors(const EyeCamera& eye, const Projection& projection, RowSamples samples, double pixel);

  //! Returns the displacements on the screen [px] at the pixels where the lens or the exact ray
  //! sees the sky; skips others, and those that PixelReference::counts() excludes.
  //!
  //! `lens` is the lens of the eye, in the memory of `backend`. `need`: what the lens computes, as
  //! for the picture; footprints are not compared.
  [[nodiscard]] std::vector<double> errors(Backend backend, const LensSource& lens, PixelNeed need) const;

 private:
  Projection projection_;
  RowSamples samples_;
  PixelReference reference_;
};

//! Errors of a show's frames at random times: 99 % quantiles over the pixels of each frame [px].
struct BudgetCheck {
  int moments = 0;
  double median_px = 0.0;
  double worst_px = 0.0;
  double worst_time_s = 0.0;  //!< show time of the frame with the largest error
};

//! Number of rows to measure per frame, and of pixels in each, enough for a 99 % quantile.
inline constexpr int usual_checked_rows = 96;

//! Measures the lenses of frames of width `size_px` (0: the show's) at random times of the show
//! that the renderer was made for, against rays in closed form. The same seed gives the same times
//! and pixels on every machine. `rows` is the number of rows to measure, and of pixels in each.
//! Leaves `quality` set in the renderer.
BudgetCheck check_error(ShowRenderer& renderer, const Show& show, const FrameQuality& quality, int size_px, int moments,
                        std::uint64_t seed, int rows = usual_checked_rows);

}  // namespace ergodome
