#pragma once

#include "kernels/lens/lens_chart.h"
#include "kernels/spacetime/geodesic/integration_settings.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"

namespace ergodome {

//! The chart of a camera's sky, in which the lens is smooth up to the shadow's edge.
template <class S>
struct StarChartOf {
  LensChart chart;             //!< an edge of no points: none is known
  AberrationOf<S> aberration;  //!< from the camera's frame to the chart's
};

//! What the magnification of an image may be off by, as a part of it, before it is followed no more.
inline constexpr double most_magnification_change = 0.005;

//! Images of stars that are known roughly, to be found exactly. Arrays hold `count` elements.
//!
//! Directions are in the camera's observer's frame, or for eyes that turn with the direction (OmniCameraOf) in the view's axes.
template <class S, class Camera = CameraStationOf<S>>
struct StarImageBatch {
  Camera camera;  //!< stars are as from φ = 0
  StarChartOf<S> chart;
  IntegrationSettings settings;
  S tolerance;  //!< how far images may be from where they should be [rad]
  int rounds;   //!< of Newton's method, at the most
  int count;
  const S* star[3];  //!< unit vectors to the stars on the sky
  const S*
      edge_distance;  //!< angle from the shadow's edge to the image, about: the scale on which the map to the sky changes [rad]
  const S* radius;  //!< of the stars' disks [rad]: next to a caustic any place within is as good as the middle
  S* direction[3];  //!< unit vectors; near the image before, the image after
  S* solid_angle;  //!< signed by parity: the sky's solid angle over the camera's, so that 1 / |..| is the magnification
  S* stretch;      //!< sum of the squares of both singular values of the map from the camera's sky to the stars'
  S* frequency_ratio;  //!< g = ν_observed / ν_emitted
  S* miss;             //!< how far the image may still be from where it should be [rad]; huge where no light came
  S* change;           //!< and what its magnification may be off by, as a part of it; 0 below the tolerance
};

}  // namespace ergodome
