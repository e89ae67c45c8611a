#include "render/lens/edge_table.h"

#include <algorithm>
#include <vector>

#include "kernels/launch/parallel_for.h"
#include "kernels/shadow/critical_curve.h"

namespace ergodome {

namespace {

Vector3<float> narrowed(const Vector3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

EdgeTable::EdgeTable(Backend backend, const CameraStation& camera, int count) {
  constexpr double full_turn = 6.28318530717958647692;
  std::vector<float> polar_angle(static_cast<std::size_t>(count));
  const ShadowChart chart = make_shadow_chart(camera);
  parallel_for(count, 64, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      polar_angle[static_cast<std::size_t>(i)] =
          static_cast<float>(edge_polar_angle(camera, chart, full_turn * i / count));
    }
  });
  const auto [smallest, largest] = std::minmax_element(polar_angle.begin(), polar_angle.end());
  curve_ = {narrowed(chart.centre), narrowed(chart.first), narrowed(chart.second), nullptr, count, *smallest, *largest};
  polar_angle_ = Buffer<float>(backend, polar_angle);
}

EdgeCurve EdgeTable::view() const {
  EdgeCurve curve = curve_;
  curve.polar_angle = polar_angle_.data();
  return curve;
}

}  // namespace ergodome
