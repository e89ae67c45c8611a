#pragma once

#include <vector>

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/shadow/edge_curve.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! The shadow in the head's flat tangent space, for the stereo model `flat`: in each dark
//! direction, the horizon is placed at the affine distance at which the ray reaches it
//! (kernels/spacetime/geodesic/affine_distance.h).
//!
//! Towards the shadow's edge, rays circle longer before they fall in, and the affine distance grows
//! without bound, as the logarithm of the angle from the edge. Therefore the edge has no parallax,
//! like the sky beside it. The interior of the shadow has parallax: an eye to the right of the head
//! sees it moved to the left, beyond the left edge that the head sees, and an eye to the left sees
//! the reverse. So an eye's shadow is the head's shadow plus a crescent on the side away from the
//! eye.
class FlatShadow {
 public:
  //! Traces the affine distances in the head's dark directions.
  explicit FlatShadow(const EyeCamera& head);

  //! Numbers of position angles (`spokes`) and of depths along each at which rays are traced. The
  //! depth is the negative logarithm of the fraction of the way from the edge to the chart's
  //! center, so equal steps of depth increase the affine distance by equal amounts near the edge.
  static constexpr int spokes = 48;
  static constexpr int depths = 49;
  static constexpr double deepest = 16.0;
  static constexpr double depth_step = deepest / (depths - 1);

  //! chart() returns the chart of the head's shadow in the view's axes, head_edge() the shadow's
  //! edge in that chart [rad].
  [[nodiscard]] const ShadowChart& chart() const { return view_chart_; }
  [[nodiscard]] const std::vector<float>& head_edge() const { return edge_; }
  //! Returns the chart of the head's shadow in the observer's frame.
  [[nodiscard]] const ShadowChart& frame_chart() const { return frame_chart_; }

  //! Returns the maximum baseline [M]: the affine distance from the head to the nearest part of the
  //! horizon.
  [[nodiscard]] double max_baseline() const;

  //! Computes the shadow edge that an eye sees: its angles from the center of the head's shadow
  //! chart [rad], at the same position angles as the head's edge. The eye is `offset` to the right
  //! of the head [M]. Throws Error if 2 |offset| exceeds max_baseline().
  [[nodiscard]] std::vector<float> eye_edge(double offset) const;

  //! Computes FlatHorizon::nearness for the eye at `offset` [M], whose shadow edge is `edge`: in
  //! `spokes` times `depths` directions of its shadow, the inverse of the affine distance at which
  //! the line of sight meets the horizon [1/M].
  [[nodiscard]] std::vector<float> eye_nearness(double offset, const std::vector<float>& edge) const;

  //! Returns the affine distance to the horizon [M] at a position angle [rad] and at the fraction
  //! exp(-depth) of the way from the edge to the chart's middle. Interpolates traced rays with
  //! cubics.
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
  Vector3<double> right_{};  //!< direction to the right in the view, in the chart's axes
  std::vector<float> edge_;
  EdgeCurve curve_{};  //!< curve of edge_; its pointer polar_angle is set by head_curve()
  std::vector<double> distances_;
  double nearest_ = 0.0;
};

}  // namespace ergodome
