#pragma once

#include "kernels/spacetime/kerr/camera_station.h"

// Frames of observers without angular momentum, in which surfaces are lit.
namespace ergodome {

//! A point with its observer without angular momentum.
struct LocalFrame {
  CameraStation camera;
  Vector3<double> axes[3];  //!< e_r, e_θ, e_φ, pseudo-Cartesian
  //! Factors that convert the components of a surface normal along `axes` to those that the
  //! observer measures.
  Vector3<double> normal_by;
};

inline namespace ERGO_TARGET {

ERGO_HD Vector3<double> in_axes(const LocalFrame& frame, const Vector3<double>& v) {
  return {dot(frame.axes[0], v), dot(frame.axes[1], v), dot(frame.axes[2], v)};
}

//! Returns the frame at a pseudo-Cartesian point outside the horizon.
ERGO_HD LocalFrame local_frame(Spacetime spacetime, const Vector3<double>& point) {
  const double r = ::sqrt(dot(point, point));
  const double beside = ::sqrt(point.x * point.x + point.y * point.y);
  const double sine = beside / r;
  const double cosine = point.z / r;
  const double cosine_phi = beside > 0.0 ? point.x / beside : 1.0;
  const double sine_phi = beside > 0.0 ? point.y / beside : 0.0;
  const KerrFunctions f = kerr_functions(spacetime, r, ::atan2(beside, point.z));
  LocalFrame frame{};
  frame.camera =
      make_camera_station(spacetime, r, ::atan2(beside, point.z), ::atan2(sine_phi, cosine_phi), ObserverMotion::zamo);
  frame.axes[0] = {sine * cosine_phi, sine * sine_phi, cosine};
  frame.axes[1] = {cosine * cosine_phi, cosine * sine_phi, -sine};
  frame.axes[2] = {-sine_phi, cosine_phi, 0.0};
  frame.normal_by = {::sqrt(f.delta / f.sigma), r / ::sqrt(f.sigma), r * ::sqrt(f.sigma / f.area)};
  return frame;
}

//! Returns a surface's unit normal as the frame's observer measures it.
ERGO_HD Vector3<double> measured_normal(const LocalFrame& frame, const Vector3<double>& normal) {
  const Vector3<double> n = in_axes(frame, normal);
  const Vector3<double> by = {n.x * frame.normal_by.x, n.y * frame.normal_by.y, n.z * frame.normal_by.z};
  return (1.0 / ::sqrt(dot(by, by))) * by;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
