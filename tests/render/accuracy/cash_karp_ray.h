#pragma once

#include "kernels/launch/launch.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "render/eyes/eye_camera.h"

namespace ergodome::test {

//! Returns the sky direction of a ray, traced by the Runge-Kutta pair of Cash & Karp. This method
//! is independent of closed form and Taylor series, which produce the references.
inline Vector3<double> cash_karp_sky(const EyeCamera& eye, const Vector3<double>& n) {
  const double direction[3] = {n.x, n.y, n.z};
  double sky[3] = {};
  RayBatch<double> batch{};
  batch.camera = make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
  batch.settings = {1e-12, 1'000'000};
  batch.method = TraceMethod::cash_karp;
  batch.count = 1;
  for (int i = 0; i < 3; ++i) {
    batch.direction[i] = &direction[i];
    batch.sky[i] = &sky[i];
  }
  launch(Backend::cpu, batch);
  return {sky[0], sky[1], sky[2]};
}

}  // namespace ergodome::test
