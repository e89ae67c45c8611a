#pragma once

#include <memory>

#include "content/lens_station.h"
#include "kernels/launch/launch.h"
#include "render/backend/buffer.h"
#include "render/lens/eye_camera.h"
#include "render/lens/lens_source.h"

namespace ergodome {

//! A lens station where the kernels of a backend can read it.
class StationBuffers {
 public:
  StationBuffers(Backend backend, const LensStation& station);

  //! The grid; it points into this object.
  [[nodiscard]] LensGrid view() const;

 private:
  LensGrid grid_;
  Buffer<float> edge_;
  Buffer<int> tree_;
  Buffer<int> leaves_;
  Buffer<float> nodes_;
};

//! A lens read from a grid; the eye may move and turn as it likes at the station's place, at any azimuth.
class GridLens : public LensSource {
 public:
  GridLens(Backend backend, std::shared_ptr<const StationBuffers> station, const EyeCamera& eye,
           const Projection& projection, double tolerance_px);

  void fill(int first_row, int row_count, const LensPixels& out) const override;
  [[nodiscard]] const char* name() const override { return "live"; }

 private:
  Backend backend_;
  std::shared_ptr<const StationBuffers> station_;
  LookUpBatch prototype_;
};

}  // namespace ergodome
