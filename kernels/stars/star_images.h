#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/lens/lens_chart.h"
#include "kernels/spacetime/geodesic/integration_settings.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"

// The batch that refines approximate images of stars by traced rays.
namespace ergodome {

//! The chart of a camera's sky, in which the lens is smooth up to the shadow's edge.
template <class S>
struct StarChartOf {
  LensChart chart;             //!< the chart; if it has no edge points, the shadow's edge is unknown
  AberrationOf<S> aberration;  //!< aberration from the camera's frame to the chart's
};

//! Newton's method ends once an image's magnification is known to within this fraction.
inline constexpr double max_magnification_change = 0.005;

//! Refines approximate images of stars by traced rays. Arrays have `count` elements.
//!
//! Directions are in the camera's observer's frame, or for omnidirectional stereo (OmniCameraOf) in
//! the view's axes.
template <class S, class Camera = CameraStationOf<S>>
struct StarImageBatch {
  Camera camera;  //!< camera at φ = 0; the stars' directions refer to this azimuth
  StarChartOf<S> chart;
  IntegrationSettings settings;
  S tolerance;  //!< maximum angle on the camera's sky between an image and its exact position [rad]
  int rounds;   //!< maximum number of Newton steps
  int count;
  const S* star[3];  //!< unit vectors to the stars on the sky, for a camera at φ = 0
  //! Approximate angle from the shadow's edge to the image [rad], the scale on which the map to the
  //! sky changes.
  const S* edge_distance;
  //! Radii of the stars' disks [rad]; next to a caustic any point within a disk is as good as its
  //! center.
  const S* radius;
  //! Unit vectors to the images on the camera's sky; in: approximate, out: refined.
  S* direction[3];
  //! The sky's solid angle over the camera's, signed by parity; the magnification is its inverse.
  S* solid_angle;
  //! Sum of the squares of both singular values of the map from the camera's sky to the stars'.
  S* stretch;
  S* frequency_ratio;  //!< g = ν_observed / ν_emitted
  //! Estimated angle on the camera's sky between the image and its exact position [rad]; huge if no
  //! light arrives.
  S* miss;
  //! Estimated relative error of its magnification; 0 if the last step was within `tolerance`, or
  //! if no light arrives.
  S* change;
};

template <class S, class Camera>
struct Kernel<StarImageBatch<S, Camera>> : KernelDefaults {
  using Real = S;
  static constexpr bool counted = false;
  static const char* name(const StarImageBatch<S, Camera>& /*batch*/) { return "find_star_images"; }
  static int elements(const StarImageBatch<S, Camera>& batch) { return batch.count; }
};

}  // namespace ergodome
