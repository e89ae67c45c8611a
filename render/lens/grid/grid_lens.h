#pragma once

#include "kernels/launch/launch.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/lens_source.h"
#include "render/lens/stations/station_blend.h"

namespace ergodome {

//! A lens read from grids. The eye may turn, move at any velocity and have any azimuth at the
//! grids' position.
class GridLens : public LensSource {
 public:
  //! `name` is the source of the grids and must outlive the lens. For `behind` see
  //! LensSource::behind().
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
