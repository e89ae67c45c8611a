#pragma once

#include "kernels/launch/launch.h"
#include "kernels/lens/tile_look_up.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/lens_source.h"
#include "render/lens/stations/station_blend.h"

namespace ergodome {

//! Which directions of a picture are read from a grid: those of all pixels, or a few on each tile of
//! the screen, between which the others are interpolated (kernels/lens/tile_look_up.h).
enum class GridReading { tiles, pixels };

//! A lens that is interpolated in grids of a camera position. The eye must be at that position, but
//! may turn, have any velocity and any azimuth.
class GridLens : public LensSource {
 public:
  //! `name`: the source of the grids (LensSource::name()); must outlive the lens. `tolerance_px`:
  //! accepted displacement by interpolation on tiles, and of traced pixels. `behind`: result of
  //! LensSource::behind(). On a GPU all pixels are read.
  GridLens(Backend backend, const char* name, StationBlend stations, const EyeCamera& eye, const Projection& projection,
           double tolerance_px, bool behind = false, GridReading reading = GridReading::tiles);

  void fill(int first_row, int row_count, const LensPixels& out) const override;
  bool shade(int first_row, int row_count, const ShadeBatch& shading) const override;
  [[nodiscard]] const char* name() const override { return name_; }
  [[nodiscard]] bool behind() const override { return behind_; }

 private:
  [[nodiscard]] TileLookUpBatch rows(int first_row, int row_count, const LensPixels& out) const;

  Backend backend_;
  const char* name_;
  bool behind_;
  GridReading reading_;
  StationBlend stations_;
  TileLookUpBatch prototype_;
};

}  // namespace ergodome
