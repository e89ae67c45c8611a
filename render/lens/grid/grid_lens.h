#pragma once

#include "kernels/launch/launch.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/lens_source.h"
#include "render/lens/stations/station_blend.h"

namespace ergodome {

//! A lens that is interpolated in grids of a camera position. The eye must be at that position, but
//! may turn, have any velocity and any azimuth.
class GridLens : public LensSource {
 public:
  //! `name`: the source of the grids (LensSource::name()); must outlive the lens. `behind`: result
  //! of LensSource::behind().
  GridLens(Backend backend, const char* name, StationBlend stations, const EyeCamera& eye, const Projection& projection,
           double tolerance_px, bool behind = false);

  void fill(int first_row, int row_count, const LensPixels& out) const override;
  [[nodiscard]] bool shares_work_with(const LensSource& other) const override;
  void fill_both(const LensSource& other, int first_row, int row_count, const LensPixels& out,
                 const LensPixels& of_other) const override;
  [[nodiscard]] const char* name() const override { return name_; }
  [[nodiscard]] bool behind() const override { return behind_; }

 private:
  [[nodiscard]] LookUpBatch rows(int first_row, int row_count, const LensPixels& out) const;

  Backend backend_;
  const char* name_;
  bool behind_;
  StationBlend stations_;
  LookUpBatch prototype_;
};

}  // namespace ergodome
