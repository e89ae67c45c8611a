#pragma once

#include <map>
#include <string>
#include <vector>

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/ray.h"

// Reads the reference tables in tests/data: rays, points of the shadow's edge, and crossings of the
// disk.
namespace ergodome::test {

//! A row of tests/data/rays.csv.
struct ReferenceRay {
  int id;
  std::string kind;
  double a, r, theta;
  ObserverMotion motion;
  Vector3<double> beta;
  Vector3<double> n;
  LightEnd status;
  Vector3<double> sky;
  double g, mino_time;
  double edge_distance;  //!< angle from the edge of the shadow [rad]; -1 if not computed
  double magnification;  //!< 0 if not computed
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
//! Returns the rows of tests/data/within_horizon.csv. As results, this table contains only the sky
//! direction and g.
const std::vector<ReferenceRay>& reference_rays_within();
const std::vector<ReferenceEdgePoint>& reference_edge();
const std::vector<ReferenceCrossing>& reference_crossings();
//! Returns the rows of tests/data/within_horizon_disk.csv; g_kepler is 0 inside the innermost
//! stable orbit.
const std::vector<ReferenceCrossing>& reference_crossings_within();

//! Returns the largest error of the sky direction [rad] that a ray may have because its input is
//! rounded to double; the error grows near the edge of the shadow.
double allowed_sky_error(const ReferenceRay& ray);

double length(const Vector3<double>& v);

template <class Row>
CameraStation station_of(const Row& row) {
  return make_camera_station(Spacetime{row.a}, row.r, row.theta, 0.0, row.motion, row.beta);
}

}  // namespace ergodome::test
