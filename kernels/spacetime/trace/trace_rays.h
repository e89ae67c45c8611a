#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/launch/kernel.h"
#include "kernels/spacetime/geodesic/integration_settings.h"
#include "kernels/spacetime/kerr/camera_station.h"

// Batches of single rays.
namespace ergodome {

//! Integration methods.
enum class TraceMethod : std::int32_t { taylor, rk34, cash_karp, closed_form, baseline_rk34 };

//! Many rays of one camera. Arrays have `count` elements; null outputs are not written.
template <class Scalar>
struct RayBatch {
  CameraStationOf<Scalar> camera;
  IntegrationSettings settings;
  TraceMethod method;
  int count;
  const Scalar* direction[3];  //!< unit vectors in the observer's frame (e_r, e_θ, e_φ)
  Scalar* sky[3];              //!< unit vectors to the sources, rotated by camera φ; 0 unless LightEnd::sky
  Scalar* frequency_ratio;     //!< g = ν_observed / ν_emitted; for captured rays this is formally 1 / E
  Scalar* status;              //!< LightEnd as a number
  Scalar* steps;               //!< number of integration steps
  Scalar* error_estimate;      //!< the integrator's estimate of the error of `sky` [rad]
  Scalar* mino_time;           //!< Mino time from the camera to infinity [1/M]
};

template <class Scalar>
struct Kernel<RayBatch<Scalar>> : KernelDefaults {
  using Real = Scalar;
  static const char* name(const RayBatch<Scalar>& /*batch*/) {
    return std::is_same_v<Scalar, double> ? "trace_rays, double" : "trace_rays";
  }
  static int elements(const RayBatch<Scalar>& batch) { return batch.count; }

  template <class Visit>
  static void visit_outputs(const RayBatch<Scalar>& batch, const Visit& visit) {
    for (const Scalar* sky : batch.sky) {
      visit("sky", sky, batch.count);
    }
    visit("frequency_ratio", batch.frequency_ratio, batch.count);
    visit("status", batch.status, batch.count);
    visit("steps", batch.steps, batch.count);
    visit("error_estimate", batch.error_estimate, batch.count);
    visit("mino_time", batch.mino_time, batch.count);
  }
};

}  // namespace ergodome
