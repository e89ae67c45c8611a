#pragma once

#include <algorithm>

#include "kernels/projection/make_projection.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "kernels/spacetime/trace/trace_pixels.h"
#include "tests/gpu/harness.cuh"

// Scenes of a dome for checks of kernels on a GPU.
namespace ergodome::gpu_check {

inline constexpr int channel_count = 14;

inline LensPixels lens_at(float* store, std::size_t pixels) {
  LensPixels lens{};
  float** const channels[channel_count] = {
      &lens.sky[0],          &lens.sky[1],         &lens.sky[2],         &lens.sky_along_x[0], &lens.sky_along_x[1],
      &lens.sky_along_x[2],  &lens.sky_along_y[0], &lens.sky_along_y[1], &lens.sky_along_y[2], &lens.coverage,
      &lens.frequency_ratio, &lens.steps,          &lens.error_estimate, &lens.half_orbits};
  for (int i = 0; i < channel_count; ++i) {
    *channels[i] = store + static_cast<std::size_t>(i) * pixels;
  }
  return lens;
}

//! Solves the edge of a camera's shadow and copies it to the device.
inline void solve_edge(const CameraStation& camera, const ShadowChart& chart, Twin<float>& edge) {
  const auto count = static_cast<double>(edge.host.size());
  for (std::size_t i = 0; i < edge.host.size(); ++i) {
    edge.host[i] =
        static_cast<float>(edge_polar_angle(camera, chart, 6.283185307179586 * static_cast<double>(i) / count));
  }
  edge.upload();
}

//! Returns the edge as kernels on the host read it.
inline EdgeCurve edge_curve(const ShadowChart& chart, const Twin<float>& edge_table) {
  const auto narrow = [](const Vector3<double>& v) {
    return Vector3<float>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  const auto [minimum, maximum] = std::minmax_element(edge_table.host.begin(), edge_table.host.end());
  return {narrow(chart.centre),
          narrow(chart.first),
          narrow(chart.second),
          edge_table.host.data(),
          static_cast<int>(edge_table.host.size()),
          *minimum,
          *maximum};
}

//! Returns the batch of a dome picture at r = 5 M from a fast-spinning hole, as a show would
//! request it.
inline PixelBatch dome_batch(int size, const Twin<float>& edge_table, const ShadowChart& chart) {
  PixelBatch batch{};
  batch.camera =
      converted_station<float>(make_camera_station(Spacetime{0.999}, 5.0, 1.5707963, 0.0, ObserverMotion::zamo));
  batch.projection = converted_projection<float>(make_dome_projection(size, 3.14159265358979, 0.5));
  const float at_hole[3][3] = {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}};
  std::copy(&at_hole[0][0], &at_hole[0][0] + 9, &batch.frame_from_view[0][0]);
  batch.edge = edge_curve(chart, edge_table);
  batch.edge_cosine_highest = std::cos(batch.edge.smallest - 0.01F);
  batch.edge_cosine_lowest = std::cos(batch.edge.largest + 0.01F);
  batch.settings = {3e-5, 200};
  batch.row_count = size;
  return batch;
}

}  // namespace ergodome::gpu_check
