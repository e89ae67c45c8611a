#pragma once

#include <list>
#include <optional>

#include "content/show/show.h"
#include "kernels/disk/disk_appearance.h"
#include "render/backend/buffer.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/lens_source.h"
#include "render/passes/disk/disk_grid_builder.h"

namespace ergodome {

//! A disk grid in memory that kernels can read.
class DiskGridBuffers {
 public:
  explicit DiskGridBuffers(const DiskStation& station);

  //! Returns the grid; it points into this object.
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

//! A picture's requirements for its disk grid.
struct DiskGridRequest {
  const EyeCamera& eye;
  const DiskAppearance& disk;
  double pixel;           //!< angle that a pixel of the screen subtends [rad]
  double budget_px;       //!< maximum error of the disk's position on the screen [px]
  double pixels;          //!< number of pixels of the picture
  bool asked;             //!< true: a grid is used even if rays are cheaper
  bool nearness = false;  //!< true: the grid has DiskGrid::nearness
};

//! Builds and caches disk grids for pictures. A camera that rotates or moves around the spin axis
//! uses its grid again, and so does one whose velocity changes slightly.
class DiskGrids {
 public:
  //! Returns the grid for a picture, owned by this object. Returns nothing if can_have_disk_grid()
  //! is false. Unless `asked`, also returns nothing if rays are cheaper: for small pictures, and if
  //! the grid would leave a quarter of the pixels or more to rays.
  std::optional<DiskGrid> grid_for(const DiskGridRequest& request);

  //! Returns the number of grids built so far.
  [[nodiscard]] int built() const { return built_; }

 private:
  //! A grid with the parameters that it was built for.
  struct Grid {
    Spacetime spacetime;
    double r;
    double theta;
    double inner_r;
    double outer_r;
    bool pattern;
    //! Budget of the disk's displacements on the screen for which the grid was built [rad].
    double error;
    ObserverMotion motion;
    Vector3<double> velocity;
    bool nearness;
    double traced_px;  //!< number of the picture's pixels that the grid leaves to rays
    DiskGridBuffers buffers;
  };

  static bool serves(const Grid& grid, const DiskGridRequest& request);
  Grid make(const DiskGridRequest& request);

  DiskGridTracer tracer_;
  std::list<Grid> grids_;  //!< most recently used first
  int built_ = 0;
};

//! Minimum number of pixels for which building a disk grid pays off, with or without a pattern.
//! Compare disk_picture/rays and disk_picture/live_grid in tests/bench.
inline constexpr double min_disk_grid_pixels = 130'000.0;

//! Returns whether building a disk grid for a picture is cheaper than tracing its pixels. On a GPU
//! it never is.
inline bool is_worth_a_disk_grid(Backend backend, double pixels) {
  return backend == Backend::cpu && pixels >= min_disk_grid_pixels;
}

//! Returns whether a show's disk may be read from a grid, if that is cheaper; for shows without
//! shells. Returns false on a GPU, if direct rays are requested, and with the published quadtree
//! grid, which has no disk.
inline bool may_read_disk_grid(Backend backend, LensChoice lens, GridScheme scheme) {
  return backend == Backend::cpu && lens != LensChoice::direct && scheme == GridScheme::conforming;
}

//! Returns whether a disk can be read from grids at all: if it has an outer edge and begins at or
//! outside the innermost stable orbit. The light of matter inside that orbit depends on the
//! direction of emission, which grids do not store.
bool can_have_disk_grid(const DiskAppearance& disk);

//! Returns whether a grid that was built for these edges [M], with azimuth and time if `pattern`,
//! can be used for a disk as it is currently shown. The inner edges and the need for a pattern must
//! be equal; the grid's outer edge must be 1 to 1.5 times the disk's.
bool serves_disk(double inner_r, double outer_r, bool pattern, const DiskAppearance& disk);

//! Returns the settings of a grid for an eye's picture of a disk: edges, pattern, pixel and
//! observer. The others keep their defaults.
DiskGridSettings disk_grid_settings(const EyeCamera& eye, const DiskAppearance& disk, double pixel);

}  // namespace ergodome
