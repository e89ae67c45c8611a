#pragma once

#include <memory>
#include <optional>

#include "content/trajectory/lens_station.h"
#include "content/trajectory/trajectory.h"
#include "kernels/lens/look_up.h"
#include "render/backend/buffer.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/stations/lens_position.h"

namespace ergodome {

//! Holds a lens station in memory that a backend's kernels can read.
class StationBuffers {
 public:
  StationBuffers(Backend backend, LensStation station);

  //! Returns the station with its position, chart and edge. The other arrays are empty, except for
  //! the nodes and, if the station has them, their derivatives along the camera's r and θ.
  [[nodiscard]] const LensStation& station() const { return station_; }

  [[nodiscard]] bool has_derivatives() const { return !station_.nodes_along_r.empty(); }

  //! Returns the memory used [bytes].
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

  //! Returns the memory [bytes] that a station of a trajectory will use as StationBuffers.
  static std::size_t expected_bytes(const StationEntry& entry, bool derivatives);

  //! Returns the grid; it points into this object.
  [[nodiscard]] LensGrid view() const;

 private:
  std::size_t bytes_;
  LensStation station_;
  Buffer<float> edge_;
  Buffer<int> tree_;
  Buffer<int> leaves_;
  Buffer<float> nodes_;
};

//! The lens at a station, beside it, or at a position between two stations.
//!
//! Charts have the shadow's edge as a coordinate line: at equal (γ, s) all stations see the same
//! part of the sky, however often light winds around the hole, so that linear blending moves the
//! shadow and its surroundings along with the camera. The rotation of the sky between the camera
//! positions is removed first, see frame_rotation(). Stations that have derivatives along the
//! camera's r and θ are blended by a cubic. To first order they also give the lens beside the line
//! between them, for the two eyes of a head on the path.
class StationBlend {
 public:
  //! Uses the lens of a station for its own position.
  explicit StationBlend(std::shared_ptr<const StationBuffers> station);

  //! Uses a station, which must have derivatives along the camera's r and θ, for a position beside
  //! it.
  StationBlend(Backend backend, std::shared_ptr<const StationBuffers> station, const LensPosition& position);

  //! Blends two stations for a position between them or, if they have derivatives along the
  //! camera's r and θ, also for one beside the line between them.
  StationBlend(Backend backend, std::shared_ptr<const StationBuffers> first,
               std::shared_ptr<const StationBuffers> second, const LensPosition& position);

  //! Returns the lens as kernels read it; it points into this object.
  [[nodiscard]] LensBlend view() const;

 private:
  void set_chart(Backend backend, Spacetime spacetime, const LensPosition& position, float range);
  void take_derivatives(Backend backend, const LensPosition& position);

  std::shared_ptr<const StationBuffers> first_;
  std::shared_ptr<const StationBuffers> second_;
  float second_weight_ = 0.0F;
  float turn_[2][3][3] = {};
  LensChart chart_{};
  std::optional<EdgeTable> edge_;
  //! Nodes extrapolated from each station by its derivatives along r and θ.
  Buffer<float> nodes_[2];
};

}  // namespace ergodome
