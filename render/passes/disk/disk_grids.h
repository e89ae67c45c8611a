#pragma once

#include <list>
#include <optional>

#include "content/show/show.h"
#include "render/backend/buffer.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/lens_source.h"
#include "render/passes/disk/disk_grid_builder.h"

namespace ergodome {

//! A disk's grid where kernels can read it.
class DiskGridBuffers {
 public:
  explicit DiskGridBuffers(const DiskStation& station);

  //! The grid; it points into this object.
  [[nodiscard]] DiskGrid view() const;

 private:
  LensGrid cells_{};
  Buffer<float> edge_;
  Buffer<int> tree_;
  Buffer<int> leaves_;
  Buffer<float> nodes_[layer_orders];
  Buffer<float> nearness_;
  Buffer<unsigned char> orders_;
};

//! What a picture wants of a disk's grid.
struct DiskGridRequest {
  const EyeCamera& eye;
  const DiskLook& disk;
  double pixel;           //!< angle of a pixel on the screen [rad]
  double budget_px;       //!< greatest displacement on the screen
  double pixels;          //!< of the picture
  bool asked;             //!< for a grid, however small the picture
  bool nearness = false;  //!< with DiskGrid::nearness
};

//! Makes the grids that pictures of a disk are drawn from, and keeps the last ones: a camera that turns, changes its motion or goes round the hole's
//! axis needs no new one.
class DiskGrids {
 public:
  //! The grid of a picture, kept here; nothing where rays are cheaper: in small pictures, and at places where most of a grid would be left to rays.
  std::optional<DiskGrid> grid_for(const DiskGridRequest& request);

  //! Number of grids built so far.
  [[nodiscard]] int built() const { return built_; }

 private:
  //! What a grid was built for.
  struct Grid {
    double spin;
    double r;
    double theta;
    double inner_r;
    double outer_r;
    bool pattern;
    double error;  //!< budget in radians
    ObserverMotion motion;
    Vector3<double> velocity;
    bool nearness;
    double traced_px;  //!< pixels that it leaves to rays
    DiskGridBuffers buffers;
  };

  static bool serves(const Grid& grid, const DiskGridRequest& request);
  Grid make(const DiskGridRequest& request);

  DiskGridTracer tracer_;
  std::list<Grid> grids_;  //!< the latest first
  int built_ = 0;
};

//! Below this many pixels a disk's grid that has to be made first is not worth its while, with a pattern or without; compare disk_picture/rays
//! and disk_picture/live_grid in tests/bench.
inline constexpr double least_disk_grid_pixels = 130'000.0;

//! Whether a picture's disk is cheaper by a grid that has to be made first. On a GPU a ray a pixel is cheap.
inline bool is_worth_a_disk_grid(Backend backend, double pixels) {
  return backend == Backend::cpu && pixels >= least_disk_grid_pixels;
}

//! Whether a disk that stands alone may be read from a grid, where that is worth its while: rays that are asked for are traced, and the published grid
//! has no disk.
inline bool may_read_disk_grid(Backend backend, LensChoice lens, GridScheme scheme) {
  return backend == Backend::cpu && lens != LensChoice::direct && scheme == GridScheme::conforming;
}

//! Whether a disk's pictures can be read from grids at all. Matter inside the last stable orbit shines by where light is going, which grids do not
//! hold.
bool can_have_disk_grid(const DiskLook& disk);

//! Whether a grid for a disk of these edges [M], with azimuth and time or without, serves a disk as it is seen now.
bool serves_disk(double inner_r, double outer_r, bool pattern, const DiskLook& disk);

//! What a grid for an eye's picture of a disk is built for. Budgets are left as they are.
DiskGridSettings disk_grid_settings(const EyeCamera& eye, const DiskLook& disk, double pixel);

}  // namespace ergodome
