#pragma once

#include <map>
#include <string>
#include <vector>

#include "kernels/spacetime/geodesic/ray.h"
#include "kernels/spacetime/kerr/camera_station.h"

namespace ergodome::test {

//! A row of tests/data/rays.csv.
struct ReferenceRay {
  int id;
  std::string kind;
  double a, r, theta;
  ObserverMotion motion;
  Vector3<double> beta;
  Vector3<double> n;
  RayStatus status;
  Vector3<double> sky;
  double g, mino_time;
  double edge_distance;  //!< -1 where none was computed
  double magnification;  //!< 0 where none was computed
};

//! A row of tests/data/edge.csv.
struct ReferenceEdgePoint {
  int camera;
  double a, r, theta;
  ObserverMotion motion;
  Vector3<double> beta;
  Vector3<double> n;
};

//! A row of tests/data/disk.csv.
struct ReferenceCrossing {
  int id;
  double a, r, theta;
  ObserverMotion motion;
  Vector3<double> beta;
  Vector3<double> n;
  int order;
  double r_hit, phi_hit, delay, g_kepler;
};

const std::vector<ReferenceRay>& reference_rays();
//! Those of tests/data/within_horizon.csv, which know nothing but the sky and g.
const std::vector<ReferenceRay>& reference_rays_within();
const std::vector<ReferenceEdgePoint>& reference_edge();
const std::vector<ReferenceCrossing>& reference_crossings();
//! Those of tests/data/within_horizon_disk.csv; g_kepler is 0 within the innermost stable orbit.
const std::vector<ReferenceCrossing>& reference_crossings_within();

//! The error of a sky direction that double-precision input allows near the edge [rad].
double allowed_sky_error(const ReferenceRay& ray);

double length(const Vector3<double>& v);

template <class Row>
CameraStation station_of(const Row& row) {
  return make_camera_station(row.a, row.r, row.theta, 0.0, row.motion, row.beta);
}

}  // namespace ergodome::test
