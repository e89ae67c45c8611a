#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "content/camera/camera_path.h"
#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"

// Settings of a measurement, and the instants and pixels that it compares.

namespace ergodome {

//! Extent of a measurement.
struct AccuracySettings {
  int size_px = 0;    //!< width of the pictures; 0: the show's, but at most `max_px`
  int max_px = 1024;  //!< maximum width if `size_px` is 0
  int moments = 3;    //!< number of instants of the show to measure; one if nothing moves
  int rounds = 5;     //!< number of timed runs of each method; methods take turns
  int lattice = 200;  //!< number of columns of the lattice; one pixel of each cell is compared
  //! Measures fewer settings, draws slow frames less often, and omits slow axes. quick_settings()
  //! also reduces the numbers of moments, rounds and compared pixels, and the pictures' width.
  bool quick = false;
  //! Names of the axes to measure; empty: all that apply to the show.
  std::vector<std::string> axes;
  std::uint64_t seed = 1;  //!< seed of the random choice of compared pixels
};

//! An instant of a show that is measured.
struct AccuracyMoment {
  Show show;  //!< the show with its animated numbers at `time_s`
  double time_s = 0.0;
  CameraPose pose{};  //!< the head's pose at `time_s`
  CameraPose next_pose{};
  EyeCamera eye{};  //!< the measured eye at `time_s`: the head; for the stereo axis, the left eye
  //! The same eye one frame later; if the camera stands still, turned to the right by half a pixel.
  EyeCamera next{};
  Projection projection{};
  double pixel = 0.0;  //!< angle that the pixel which is the unit of errors subtends [rad]
};

//! The center of a pixel in a picture, in the coordinates of direction_from_pixel.
struct PixelMiddle {
  double x_px;
  double y_px;
};

//! Returns the center of a pixel. `pixel`: row times width plus column.
inline PixelMiddle pixel_middle(std::int64_t pixel, int width_px) {
  const std::int64_t row = pixel / width_px;
  const std::int64_t column = pixel % width_px;
  return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
}

//! Pixels to compare: one in each cell of a lattice over a picture, chosen at random (with a fixed
//! seed).
struct PixelLattice {
  int columns = 0;
  int rows = 0;
  std::vector<std::int64_t> pixels;  //!< pixel of each cell: row times width plus column
};

//! Returns the moments of a show to measure, at equal intervals. Throws Error if the camera cannot
//! be at its position at one of them.
std::vector<AccuracyMoment> accuracy_moments(const Show& show, const AccuracySettings& settings);

//! Returns a lattice of `columns` columns, clamped to 1 ... the picture's width in pixels, with as
//! many rows as make its cells about square, and one random pixel of each cell.
PixelLattice pixel_lattice(const Projection& projection, int columns, std::uint64_t seed);

}  // namespace ergodome
