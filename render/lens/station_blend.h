#pragma once

#include <memory>

#include "content/lens_station.h"
#include "kernels/lens/look_up.h"
#include "render/backend/buffer.h"
#include "render/lens/place_turn.h"

namespace ergodome {

//! A lens station where the kernels of a backend can read it.
class StationBuffers {
 public:
  StationBuffers(Backend backend, LensStation station);

  //! The station itself, without its large arrays: where it is, and its chart.
  [[nodiscard]] const LensStation& station() const { return station_; }

  //! The grid; it points into this object.
  [[nodiscard]] LensGrid view() const;

 private:
  LensStation station_;
  Buffer<float> edge_;
  Buffer<int> tree_;
  Buffer<int> leaves_;
  Buffer<float> nodes_;
};

//! The lens of a place between two stations, or at one.
//!
//! Both charts have the shadow's edge as a coordinate line, so at equal (γ, s) the stations see the same part of the winding sky, and
//! plain mixing there moves the shadow and all that surrounds it along with the camera. What a camera's move turns of itself is taken
//! out first: the sky turns with its θ, and about the axis with r, as a principal null ray does.
class StationBlend {
 public:
  explicit StationBlend(std::shared_ptr<const StationBuffers> station);

  //! For a place between the stations.
  StationBlend(Backend backend, std::shared_ptr<const StationBuffers> first,
               std::shared_ptr<const StationBuffers> second, const LensPlace& place);

  //! The lens as kernels read it; it points into this object.
  [[nodiscard]] LensBlend view() const;

 private:
  std::shared_ptr<const StationBuffers> first_;
  std::shared_ptr<const StationBuffers> second_;
  float second_weight_ = 0.0F;
  float turn_[2][3][3] = {};
  LensChart chart_{};
  Buffer<float> edge_;
};

}  // namespace ergodome
