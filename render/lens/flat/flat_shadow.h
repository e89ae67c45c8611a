#pragma once

#include <vector>

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/shadow/edge_curve.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! The shadow as a thing in the head's flat tangent space: the horizon in each dark direction at the affine distance at which its ray comes
//! there (kernels/geodesic/affine_distance.h), for the stereo model `flat`.
//!
//! Towards the shadow's edge rays circle ever longer before they fall in, and the distance grows without end, as the logarithm of the angle
//! from the edge. So the edge itself has no parallax, like the sky beside it; what moves is the dark inside, and on one side it comes out
//! before the sky: an eye's shadow is the head's, and a crescent more.
class FlatShadow {
 public:
  //! Traces the distances of a head's dark directions.
  explicit FlatShadow(const EyeCamera& head);

  //! Position angles of the traced distances, and depths towards the edge, where they grow by the same for each.
  static constexpr int spokes = 48;
  static constexpr int depths = 49;
  static constexpr double deepest = 16.0;
  static constexpr double depth_step = deepest / (depths - 1);

  //! The chart of the head's shadow, in the view's axes, and its edge there [rad].
  [[nodiscard]] const ShadowChart& chart() const { return view_chart_; }
  [[nodiscard]] const std::vector<float>& head_edge() const { return edge_; }
  //! The same chart in the observer's frame.
  [[nodiscard]] const ShadowChart& frame_chart() const { return frame_chart_; }

  //! How far two eyes may be apart [M]: no farther than the horizon is away.
  [[nodiscard]] double greatest_baseline() const;

  //! The edge that an eye sees, about the same chart at the same position angles; `offset` is to the right of the head [M]. Throws Error for
  //! an eye so far off that the horizon is not well before it.
  [[nodiscard]] std::vector<float> eye_edge(double offset) const;

  //! FlatHorizon::nearness of that eye, whose edge is given: of `spokes` and `depths`.
  [[nodiscard]] std::vector<float> eye_nearness(double offset, const std::vector<float>& edge) const;

  //! Affine distance to the horizon [M]: at a position angle, and at exp(-depth) of the way from the edge to the chart's middle. Cubic between
  //! traced rays.
  [[nodiscard]] double distance(double gamma, double depth) const;

 private:
  [[nodiscard]] EdgeCurve head_curve() const {
    EdgeCurve curve = curve_;
    curve.polar_angle = edge_.data();
    return curve;
  }
  [[nodiscard]] double edge_at(double gamma) const;
  [[nodiscard]] double head_nearness(const Vector3<double>& n) const;
  [[nodiscard]] double nearness_along(const Vector3<double>& m, const Vector3<double>& eye) const;
  [[nodiscard]] double farthest_out(const Vector3<double>& eye, double gamma) const;

  ShadowChart frame_chart_{};
  ShadowChart view_chart_{};
  Vector3<double> right_{};  //!< the view's right in the chart's axes
  std::vector<float> edge_;
  EdgeCurve curve_{};  //!< of it, but for where its angles lie
  std::vector<double> distances_;
  double nearest_ = 0.0;
};

}  // namespace ergodome
