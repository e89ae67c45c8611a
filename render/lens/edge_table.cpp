#include "render/lens/edge_table.h"

#include <algorithm>

#include "kernels/core/angles.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/shadow/critical_curve.h"

namespace ergodome {

namespace {

Vector3<float> narrowed(const Vector3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

std::vector<float> solve_edge(const CameraStation& camera, const ShadowChart& chart, int count, bool mirrored) {
  std::vector<float> polar_angle(static_cast<std::size_t>(count));
  parallel_for(mirrored ? count / 2 + 1 : count, 64, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      polar_angle[static_cast<std::size_t>(i)] =
          static_cast<float>(edge_polar_angle(camera, chart, full_turn * i / count));
    }
  });
  for (int i = count / 2 + 1; mirrored && i < count; ++i) {
    polar_angle[static_cast<std::size_t>(i)] = polar_angle[static_cast<std::size_t>(count - i)];
  }
  return polar_angle;
}

EdgeCurve edge_view(const ShadowChart& chart, const std::vector<float>& polar_angle) {
  const auto [smallest, largest] = std::minmax_element(polar_angle.begin(), polar_angle.end());
  return {narrowed(chart.centre),
          narrowed(chart.first),
          narrowed(chart.second),
          polar_angle.data(),
          static_cast<int>(polar_angle.size()),
          *smallest,
          *largest};
}

EdgeTable::EdgeTable(Backend backend, const CameraStation& camera, int count) {
  const ShadowChart chart = make_shadow_chart(camera);
  if (backend == Backend::cpu) {
    *this = EdgeTable(backend, chart, solve_edge(camera, chart, count));
    return;
  }
  polar_angle_ = Buffer<float>(backend, static_cast<std::size_t>(count), "shadow edge");
  solve_edge_cuda({camera, chart, count, polar_angle_.data()});
  std::vector<float> polar_angle(polar_angle_.size());
  polar_angle_.read(polar_angle.data(), polar_angle.size());
  curve_ = edge_view(chart, polar_angle);
}

EdgeTable::EdgeTable(Backend backend, const ShadowChart& chart, const std::vector<float>& polar_angle)
    : curve_(edge_view(chart, polar_angle)), polar_angle_(backend, polar_angle, "shadow edge") {}

EdgeCurve EdgeTable::view() const {
  EdgeCurve curve = curve_;
  curve.polar_angle = polar_angle_.data();
  return curve;
}

}  // namespace ergodome
