#pragma once

#include <array>
#include <optional>

#include "kernels/disk/disk_emitter.h"
#include "kernels/disk/equatorial_crossings.h"

// Traces rays to the disk, for the channels of the disk.

namespace ergodome {

//! A point where a ray meets the disk.
struct DiskCrossing {
  double r;                //!< Boyer-Lindquist radius of the point [M]
  double azimuth_deg;      //!< Boyer-Lindquist φ, in [0, 360)
  double frequency_ratio;  //!< ν_observed / ν_emitted for the disk's matter
  double delay;            //!< coordinate time of the light from the crossing to the camera [M]
};

//! A ray's first crossings of the equatorial plane; crossings outside the disk's edges are empty.
using DiskCrossings = std::array<std::optional<DiskCrossing>, crossing_orders>;

//! Radii of a disk's edges [M].
struct DiskEdges {
  double inner;
  double outer;
};

//! Traces single rays of a camera to the disk, in double precision.
class DiskTracer {
 public:
  DiskTracer(const CameraStation& camera, const DiskEdges& edges);

  //! Returns where the light that the camera sees in direction `n` (e_r, e_θ, e_φ) crosses the
  //! disk, by order; nothing if the ray does not converge.
  [[nodiscard]] std::optional<DiskCrossings> trace(const Vector3<double>& n) const;

 private:
  CameraStation camera_;
  DiskEdges edges_;
  DiskFlow<double> flow_;
};

}  // namespace ergodome
