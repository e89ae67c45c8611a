#include "render/frame/near_distances.h"

#include <cmath>

#include "kernels/disk/crossing_layers.h"
#include "kernels/geodesic/affine_distance.h"
#include "kernels/near_field/near_pixels.h"
#include "render/disk/disk_camera.h"
#include "render/disk/disk_pass.h"
#include "render/lens/direct_lens.h"

namespace ergodome {

namespace {

constexpr double ray_tolerance = 1e-7;

void add_disk(const Show& show, const CameraStation& camera, const Vector3<double>& n, std::vector<double>& distances) {
  const DiskSettings& disk = *show.disk;
  const double inner = inner_edge(disk, show.spin);
  LayerLimits<double> limits = layer_limits(show.spin, inner, disk.outer);
  limits.tolerance = ray_tolerance;
  CrossingLayer<double> layers[crossing_orders];
  trace_layers<near_order, NearParts::distance>(show.spin, start_near_ray(camera, n), limits, layers);
  for (const CrossingLayer<double>& layer : layers) {
    if (layer.u >= 1.0 / disk.outer && layer.u <= 1.0 / inner) {
      distances.push_back(layer.distance);
    }
  }
}

}  // namespace

std::vector<double> near_distances(const Show& show, const EyeCamera& head, const Vector3<double>& view) {
  const CameraStation camera = station_of(head);
  const double(&m)[3][3] = head.frame_from_view;
  const auto row = [&](int i) { return m[i][0] * view.x + m[i][1] * view.y + m[i][2] * view.z; };
  const Vector3<double> n = {row(0), row(1), row(2)};
  std::vector<double> distances;
  if (show.disk && show.disk->opacity > 0.0) {
    add_disk(show, camera, n, distances);
  }
  for (const ShellSettings& shell : show.shells) {
    const double distance = affine_distance(camera, n, shell.radius);
    if (is_visible(shell) && std::isfinite(distance)) {
      distances.push_back(distance);
    }
  }
  return distances;
}

}  // namespace ergodome
