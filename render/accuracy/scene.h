#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "content/camera/camera_path.h"
#include "kernels/projection/projection.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! How much is measured.
struct AccuracySettings {
  int size_px = 0;                //!< width of the pictures; 0: as the show says, up to `most_px`
  int most_px = 1024;             //!< see size_px
  int moments = 3;                //!< of the show; one where it stands still
  int rounds = 5;                 //!< timed runs of everything, in turn
  int lattice = 200;              //!< one pixel of each cell of so many columns is compared
  bool quick = false;             //!< less of everything: what is slow beside the rest is left out
  std::vector<std::string> axes;  //!< names; empty: all that the show has
  std::uint64_t seed = 1;         //!< of the pixels that are compared
};

//! An instant of a show as it is measured.
struct AccuracyMoment {
  Show show;  //!< with its numbers of that time
  double time_s = 0.0;
  CameraPose pose{};  //!< of the head
  CameraPose next_pose{};
  EyeCamera eye{};   //!< of the head
  EyeCamera next{};  //!< a frame later; where the camera stands still, turned to the right by half a pixel
  Projection projection{};
  double pixel = 0.0;  //!< angle that errors are counted in [rad]
};

//! Where the middle of a pixel lies in a picture, as direction_from_pixel counts.
struct PixelMiddle {
  double x_px;
  double y_px;
};

//! Of a pixel that is told as row times width plus column.
inline PixelMiddle pixel_middle(std::int64_t pixel, int width_px) {
  const std::int64_t row = pixel / width_px;
  const std::int64_t column = pixel % width_px;
  return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
}

//! One pixel of each cell of a lattice over a picture, at random (with a fixed seed) within the cell.
struct PixelLattice {
  int columns = 0;
  int rows = 0;
  std::vector<std::int64_t> pixels;  //!< by cell: row times width plus column
};

//! The moments of a show that are looked at, evenly within its duration. Throws Error where the camera cannot be where the show puts it.
std::vector<AccuracyMoment> accuracy_moments(const Show& show, const AccuracySettings& settings);

//! `columns` columns and as many rows as the picture's shape asks for; no more than there are pixels.
PixelLattice pixel_lattice(const Projection& projection, int columns, std::uint64_t seed);

}  // namespace ergodome
