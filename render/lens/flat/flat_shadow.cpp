#include "render/lens/flat/flat_shadow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/eyes/flat/affine_distances.h"
#include "kernels/eyes/flat/eye_line.h"
#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/lens/grid/edge_table.h"

namespace ergodome {

namespace {

//! Maximum distance of an eye from the head, as a fraction of the distance to the horizon. For an
//! eye farther away, the horizon is beside it.
constexpr double farthest_eye = 0.5;

//! Only every fourth point of an eye's edge is computed exactly; the others are interpolated,
//! because the width of the crescent varies more slowly than the edge.
constexpr int solved_step = 4;

//! Evaluates the Catmull-Rom cubic through four neighboring values.
double cubic(double p0, double p1, double p2, double p3, double t) {
  const double b = 0.5 * (p2 - p0);
  const double c = p0 - 2.5 * p1 + 2.0 * p2 - 0.5 * p3;
  const double d = 0.5 * (p3 - p0) + 1.5 * (p1 - p2);
  return p1 + t * (b + t * (c + t * d));
}

//! Returns a direction, in the chart's axes, from its polar coordinates around the chart's center.
Vector3<double> chart_point(double alpha, double gamma) {
  return {std::cos(alpha), std::sin(alpha) * std::cos(gamma), std::sin(alpha) * std::sin(gamma)};
}

}  // namespace

FlatShadow::FlatShadow(const EyeCamera& head) {
  const CameraStation camera = make_camera_station(head.spacetime, head.r, head.theta, 0.0, head.motion, head.velocity);
  frame_chart_ = make_shadow_chart(camera);
  const ShadowChart& chart = frame_chart_;
  view_chart_ = {in_view(head, chart.centre), in_view(head, chart.first), in_view(head, chart.second)};
  right_ = {view_chart_.centre.x, view_chart_.first.x, view_chart_.second.x};
  edge_ = solve_edge(camera, chart, edge_points);
  curve_ = edge_view(view_chart_, edge_);
  constexpr std::size_t rays = std::size_t{spokes} * depths;
  distances_.resize(rays);
  // In order of depth first: rays of one depth need about equally many steps, and are traced side by
  // side.
  std::vector<double> parts(4 * rays);
  double* const direction[3] = {parts.data(), parts.data() + rays, parts.data() + 2 * rays};
  double* const traced = parts.data() + 3 * rays;
  parallel_for(spokes, 1, [&](int begin, int end) {
    for (int spoke = begin; spoke < end; ++spoke) {
      const double gamma = full_turn * spoke / spokes;
      const double edge = edge_polar_angle(camera, chart, gamma);
      for (int i = 0; i < depths; ++i) {
        const double alpha = -edge * std::expm1(-depth_step * i);
        const Vector3<double> n = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
        const int at = i * spokes + spoke;
        direction[0][at] = n.x;
        direction[1][at] = n.y;
        direction[2][at] = n.z;
      }
    }
  });
  launch(AffineDistanceBatch{
      camera, camera.horizon_r, static_cast<int>(rays), {direction[0], direction[1], direction[2]}, traced});
  for (int spoke = 0; spoke < spokes; ++spoke) {
    double* const row = distances_.data() + static_cast<std::ptrdiff_t>(spoke) * depths;
    for (int i = 0; i < depths; ++i) {
      const double distance = traced[i * spokes + spoke];
      // The edge is known only up to rounding errors. If a ray beside it misses the horizon, its
      // distance is extrapolated.
      row[i] = std::isfinite(distance) || i < 2 ? distance : 2.0 * row[i - 1] - row[i - 2];
    }
  }
  nearest_ = *std::ranges::min_element(distances_);
}

double FlatShadow::distance(double gamma, double depth) const {
  const double across = gamma / full_turn * spokes;
  const double whole = std::floor(across);
  const double down = std::clamp(depth / depth_step, 0.0, depths - 1.0);
  const int i = std::min(static_cast<int>(down), depths - 2);
  double at[4];
  for (int k = 0; k < 4; ++k) {
    const int spoke = ((static_cast<int>(whole) + k - 1) % spokes + spokes) % spokes;
    const double* row = distances_.data() + static_cast<std::ptrdiff_t>(spoke) * depths;
    // Extrapolates beyond the first depth (quadratically) and the last one (linearly).
    const double before = i > 0 ? row[i - 1] : 3.0 * row[0] - 3.0 * row[1] + row[2];
    const double after = i + 2 < depths ? row[i + 2] : 2.0 * row[i + 1] - row[i];
    at[k] = cubic(before, row[i], row[i + 1], after, down - i);
  }
  return cubic(at[0], at[1], at[2], at[3], across - whole);
}

double FlatShadow::edge_at(double gamma) const {
  float alpha = 0.0F;
  float slope = 0.0F;
  ergodome::edge_at(head_curve(), static_cast<float>(gamma), alpha, slope);
  return static_cast<double>(alpha);
}

double FlatShadow::farthest_out(const Vector3<double>& eye, double gamma) const {
  // Computes where an eye sees the point of the horizon that the head sees at a depth, and that the
  // eye sees at position angle `gamma`. The head's position angle for that point is found by
  // iteration, which converges faster if the eye is closer to the head. The last result is a guess
  // for the next depth.
  double guess = gamma;
  const auto seen_at = [&](double depth) {
    constexpr double precision = 1e-7;
    const double part = -std::expm1(-depth);
    double own = guess;
    Vector3<double> seen{};
    bool found = false;
    for (int round = 0; round < 4 && !found; ++round) {
      seen = seen_by_eye(chart_point(edge_at(own) * part, own), distance(own, depth), eye);
      const double miss = std::remainder(std::atan2(seen.z, seen.y) - gamma, full_turn);
      found = std::abs(miss) < precision;
      own -= miss;
    }
    guess = found ? own : gamma;
    return std::atan2(std::hypot(seen.y, seen.z), seen.x);
  };
  constexpr int samples = 16;
  int best = 1;
  double maximum = 0.0;
  for (int i = 1; i <= samples; ++i) {
    const double alpha = seen_at(deepest * i / samples);
    if (alpha > maximum) {
      maximum = alpha;
      best = i;
    }
  }
  // Golden-section search around the largest sample.
  constexpr double golden = 0.61803398874989484820;
  double low = deepest * (best - 1) / samples;
  double high = deepest * std::min(best + 1, samples) / samples;
  double first = high - golden * (high - low);
  double second = low + golden * (high - low);
  double at_first = seen_at(first);
  double at_second = seen_at(second);
  for (int round = 0; round < 14; ++round) {
    maximum = std::max({maximum, at_first, at_second});
    if (at_first > at_second) {
      high = second;
      second = first;
      at_second = at_first;
      first = high - golden * (high - low);
      at_first = seen_at(first);
    } else {
      low = first;
      first = second;
      at_first = at_second;
      second = low + golden * (high - low);
      at_second = seen_at(second);
    }
  }
  return maximum;
}

double FlatShadow::head_nearness(const Vector3<double>& n) const {
  const double alpha = std::atan2(std::hypot(n.y, n.z), n.x);
  const double gamma = std::atan2(n.z, n.y);
  const double edge = edge_at(gamma);
  return alpha < edge ? 1.0 / distance(gamma, -std::log1p(-alpha / edge)) : 0.0;
}

double FlatShadow::nearness_along(const Vector3<double>& m, const Vector3<double>& eye) const {
  const double max_w = 1.0 / ((1.0 - farthest_eye) * nearest_);
  // Returns how far the line of sight is beyond the horizon at nearness w, as a difference of
  // nearness [1/M]; negative in front of the horizon. The first point of the horizon on the line
  // (the one with the largest w) is the visible one.
  const auto beyond = [&](double w) {
    const Vector3<double> v = m + w * eye;
    const double length = std::sqrt(dot(v, v));
    return length * head_nearness((1.0 / length) * v) - w;
  };
  constexpr int samples = 24;
  double low = max_w;
  for (int i = samples - 1; i > 0 && beyond(low) < 0.0; --i) {
    low = max_w * i / samples;
  }
  if (beyond(low) < 0.0) {
    return 0.0;
  }
  double high = std::min(low + max_w / samples, max_w);
  for (int round = 0; round < 16; ++round) {
    const double middle = 0.5 * (low + high);
    (beyond(middle) < 0.0 ? high : low) = middle;
  }
  return low;
}

std::vector<float> FlatShadow::eye_nearness(double offset, const std::vector<float>& edge) const {
  static WorkCounter counter("see_horizon");
  const WorkScope work(counter, static_cast<long>(spokes) * depths);
  const Vector3<double> eye = offset * right_;
  const EdgeCurve curve = edge_view(view_chart_, edge);
  std::vector<float> nearness(static_cast<std::size_t>(spokes) * depths);
  parallel_for(spokes, 1, [&](int begin, int end) {
    for (int spoke = begin; spoke < end; ++spoke) {
      const double gamma = full_turn * spoke / spokes;
      float alpha = 0.0F;
      float slope = 0.0F;
      ergodome::edge_at(curve, static_cast<float>(gamma), alpha, slope);
      float* const row = nearness.data() + static_cast<std::ptrdiff_t>(spoke) * depths;
      for (int i = 0; i < depths; ++i) {
        row[i] = static_cast<float>(
            nearness_along(chart_point(-static_cast<double>(alpha) * std::expm1(-depth_step * i), gamma), eye));
      }
    }
  });
  return nearness;
}

double FlatShadow::max_baseline() const { return 2.0 * farthest_eye * nearest_; }

std::vector<float> FlatShadow::eye_edge(double offset) const {
  if (!(2.0 * std::abs(offset) <= max_baseline())) {
    throw Error("stereo.baseline",
                fmt::format("{:.6g} M is too large for the model flat: the horizon is {:.6g} M away",
                            2.0 * std::abs(offset), nearest_),
                "choose a smaller baseline, or model = \"physical\"");
  }
  std::vector<float> edge = edge_;
  if (offset == 0.0) {
    return edge;
  }
  const Vector3<double> eye = offset * right_;
  const int count = static_cast<int>(edge.size());
  const int solved = count / solved_step;
  std::vector<double> farther(static_cast<std::size_t>(solved), 0.0);
  parallel_for(solved, 4, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const double gamma = full_turn * i / solved;
      // The eye's shadow extends beyond the head's only on the side opposite to the eye's
      // displacement.
      if (eye.y * std::cos(gamma) + eye.z * std::sin(gamma) < 0.2 * std::abs(offset)) {
        farther[static_cast<std::size_t>(i)] = std::max(farthest_out(eye, gamma) - edge_at(gamma), 0.0);
      }
    }
  });
  for (int i = 0; i < count; ++i) {
    const auto at = [&](int k) { return farther[static_cast<std::size_t>((i / solved_step + k + solved) % solved)]; };
    const double t = static_cast<double>(i % solved_step) / solved_step;
    edge[static_cast<std::size_t>(i)] += static_cast<float>(std::max(cubic(at(-1), at(0), at(1), at(2), t), 0.0));
  }
  return edge;
}

}  // namespace ergodome
