#include "render/lens/grid/edge_table.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "kernels/spacetime/shadow/edge_kernel.h"

namespace ergodome {

namespace {

Vector3<float> narrowed(const Vector3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vector3<double> edge_axis(const Vector3<float>& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

//! Returns whether an observer moves so slowly relative to the rain frame that no part of the edge
//! table is much magnified.
bool sees_all_alike(const Aberration& to_rain) {
  // A table is accurate to 1e-7 rad, and a boost magnifies this error at most by its Doppler
  // factor.
  constexpr double slow = 16.0;
  return to_rain.zamo_from_observer.stretch * to_rain.rain_from_zamo.stretch < slow;
}

bool moves_and_stands_alike(const EyeCamera& a, const EyeCamera& b) {
  return a.spacetime == b.spacetime && a.r == b.r && a.theta == b.theta && a.motion == b.motion &&
         a.velocity.x == b.velocity.x && a.velocity.y == b.velocity.y && a.velocity.z == b.velocity.z;
}

}  // namespace

std::vector<float> solve_edge(const CameraStation& camera, const ShadowChart& chart, int count, bool mirrored) {
  std::vector<float> polar_angle(static_cast<std::size_t>(count));
  parallel_for(mirrored ? count / 2 + 1 : count, 64, [&](int begin, int end) {
    // The last two edges predict the next one.
    double last = 0.0;
    double before = 0.0;
    for (int i = begin; i < end; ++i) {
      const double gamma = full_turn * i / count;
      const double guess = i == begin + 1 ? last : 2.0 * last - before;
      bool exact = false;
      double alpha = i > begin ? edge_near_guess(camera, chart, gamma, guess, exact) : 0.0;
      if (!exact) {
        alpha = edge_polar_angle(camera, chart, gamma);
      }
      before = last;
      last = alpha;
      polar_angle[static_cast<std::size_t>(i)] = static_cast<float>(alpha);
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

double EdgeMiss::of(const EyeCamera& eye) {
  constexpr std::size_t kept_eyes = 2;
  // Up to this spin, tables are accurate to 3e-5 rad for observers at 0.999 c and for static ones
  // 1e-5 M above the horizon.
  constexpr double fastest_smooth = 0.999;
  if (std::abs(eye.spacetime.spin) <= fastest_smooth) {
    return 0.0;
  }
  const Aberration to_rain = aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity);
  if (sees_all_alike(to_rain)) {
    return 0.0;
  }
  const auto found =
      std::ranges::find_if(known_, [&](const Known& known) { return moves_and_stands_alike(known.eye, eye); });
  if (found != known_.end()) {
    return found->miss;
  }
  const EdgeTable table(Backend::cpu, make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, ObserverMotion::rain),
                        edge_points);
  const CameraStation observer = make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity);
  if (known_.size() == kept_eyes) {
    known_.erase(known_.begin());
  }
  known_.push_back({eye, edge_miss(table.view(), observer, to_rain)});
  return known_.back().miss;
}

double edge_miss(const EdgeCurve& table, const CameraStation& observer, const Aberration& to_rain) {
  if (sees_all_alike(to_rain)) {
    return 0.0;
  }
  constexpr int circles = 96;
  const ShadowChart seen = make_shadow_chart(observer);
  const ShadowChart of_table = {edge_axis(table.centre), edge_axis(table.first), edge_axis(table.second)};
  double worst = 0.0;
  for (int i = 0; i < circles; ++i) {
    const double gamma = full_turn * (i + 0.5) / circles;
    const double alpha = edge_polar_angle(observer, seen, gamma);
    double energy = 1.0;
    const Vector3<double> n =
        rain_direction(to_rain, chart_direction<double>(seen, std::cos(alpha), std::sin(alpha), gamma), energy);
    float there = 0.0F;
    float slope = 0.0F;
    edge_at(table, static_cast<float>(chart_position_angle(of_table, n)), there, slope);
    const double along = static_cast<double>(slope) / std::max(std::sin(static_cast<double>(there)), 1e-30);
    const double across =
        std::abs(chart_polar_angle(of_table, n) - static_cast<double>(there)) / std::hypot(1.0, along);
    const double miss = across * energy;
    // NaN means that no edge was found.
    worst = std::isnan(miss) ? INFINITY : std::max(worst, miss);
  }
  return worst;
}

EdgeTable::EdgeTable(Backend backend, const CameraStation& camera, int count) {
  const ShadowChart chart = make_shadow_chart(camera);
  if (backend == Backend::cpu) {
    *this = EdgeTable(backend, chart, solve_edge(camera, chart, count));
    return;
  }
  polar_angle_ = Buffer<float>(backend, static_cast<std::size_t>(count), "shadow edge");
  launch_on_cuda(EdgeBatch{camera, chart, count, polar_angle_.data()});
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
