#pragma once

#include <memory>
#include <optional>

#include "content/trajectory/lens_station.h"
#include "content/trajectory/trajectory.h"
#include "kernels/lens/look_up.h"
#include "render/backend/buffer.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/stations/place_turn.h"

namespace ergodome {

//! A lens station where the kernels of a backend can read it.
class StationBuffers {
 public:
  StationBuffers(Backend backend, LensStation station);

  //! The station itself: where it is, and its chart; its large arrays are gone but for the nodes of one with derivatives.
  [[nodiscard]] const LensStation& station() const { return station_; }

  [[nodiscard]] bool has_derivatives() const { return !station_.nodes_along_r.empty(); }

  //! Memory that it takes.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

  //! What a station of a trajectory is going to take.
  static std::size_t expected_bytes(const StationEntry& entry, bool derivatives);

  //! The grid; it points into this object.
  [[nodiscard]] LensGrid view() const;

 private:
  std::size_t bytes_;
  LensStation station_;
  Buffer<float> edge_;
  Buffer<int> tree_;
  Buffer<int> leaves_;
  Buffer<float> nodes_;
};

//! The lens of a place between two stations, at one, or beside one.
//!
//! Charts have the shadow's edge as a coordinate line, so at equal (γ, s) the stations see the same part of the winding sky, and
//! plain mixing there moves the shadow and all that surrounds it along with the camera. What a camera's move turns of itself is taken
//! out first, see place_turn. Stations with derivatives are mixed by a cubic through both, and serve places beside their line to first
//! order: the eyes of a head that is on it.
class StationBlend {
 public:
  //! At a station.
  explicit StationBlend(std::shared_ptr<const StationBuffers> station);

  //! Beside a station with derivatives.
  StationBlend(Backend backend, std::shared_ptr<const StationBuffers> station, const LensPlace& place);

  //! For a place between two stations; with derivatives, also beside their line.
  StationBlend(Backend backend, std::shared_ptr<const StationBuffers> first,
               std::shared_ptr<const StationBuffers> second, const LensPlace& place);

  //! The lens as kernels read it; it points into this object.
  [[nodiscard]] LensBlend view() const;

 private:
  void set_chart(Backend backend, double spin, const LensPlace& place, float range);
  void take_derivatives(Backend backend, const LensPlace& place);

  std::shared_ptr<const StationBuffers> first_;
  std::shared_ptr<const StationBuffers> second_;
  float second_weight_ = 0.0F;
  float turn_[2][3][3] = {};
  LensChart chart_{};
  std::optional<EdgeTable> edge_;
  Buffer<float> nodes_[2];  //!< where derivatives have moved them
};

}  // namespace ergodome
