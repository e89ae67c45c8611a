#pragma once

#include <functional>
#include <vector>

#include "kernels/spacetime/shadow/shadow_chart.h"
#include "kernels/spacetime/trace/omni_camera.h"
#include "render/backend/buffer.h"
#include "render/eyes/eye_camera.h"

// The cameras of omnidirectional stereo (ODS).

namespace ergodome {

//! Function that returns the camera of an eye at an offset from the head, in the view's axes
//! (right, up, back) [M].
using EyeAtOffset = std::function<EyeCamera(const Vector3<double>& offset)>;

//! Settings of ODS eyes, which turn with the viewing azimuth.
struct OmniSettings {
  double half_baseline = 0.0;  //!< half of the baseline [M]
  double convergence = 0.0;    //!< distance of points without parallax [M]; 0: infinity
  double fade_from = 1.0;      //!< elevation at which the baseline begins to shrink [rad]
  double fade_to = 1.57;       //!< elevation at which the baseline is zero [rad]
  //! Accepted error of a direction seen by the fitted cameras [rad]; the fit aims at a tenth of it.
  double tolerance = 1e-5;
};

//! Error [rad] up to which fitted ODS cameras count as drawable. It does not depend on the
//! picture's size, so that the maximum baseline does not either.
inline constexpr double omni_min_exact = 1e-5;

//! Returns the settings of ODS eyes for a show's stereo settings and a baseline [M].
OmniSettings omni_settings(const StereoSettings& stereo, double baseline, double tolerance);

//! The cameras of ODS eyes around a head, as polynomials of the eye position. They are fitted by
//! least squares to exact cameras on the disk of all eye positions, with the lowest sufficient
//! degree. One fit serves both eyes and all pixels.
class OmniCamera {
 public:
  //! Fits the polynomials. Throws Error if none reaches omni_min_exact: the baseline is too large
  //! for this position.
  OmniCamera(Backend backend, const EyeAtOffset& eye_at, const OmniSettings& settings);

  //! Returns the cameras as kernels read them; `side` is -1 for the left eye, 1 for the right one.
  //! The result points into this object.
  [[nodiscard]] OmniCameraOf<float> view(double side) const;
  //! Returns the cameras of view() in host memory, whatever the backend.
  [[nodiscard]] OmniCameraOf<float> on_host(double side) const;
  //! Returns the cameras of view() in host memory and in double precision.
  [[nodiscard]] OmniCameraOf<double> exact(double side) const;

  //! Returns the coefficients of the omni_numbers polynomials that exact() uses.
  [[nodiscard]] const std::vector<double>& coefficients() const { return coefficients_; }

  [[nodiscard]] int degree() const { return camera_.degree; }

 private:
  OmniCameraOf<double> camera_{};
  std::vector<double> coefficients_;
  std::vector<float> coefficients_as_float_;
  Buffer<float> for_kernels_;
};

//! Returns a chart centered on the shadow that an ODS eye sees, in the view's axes.
ShadowChart omni_shadow_chart(const OmniCameraOf<double>& camera, const EyeAtOffset& eye_at);

//! Returns the angle of the shadow's edge from the chart's center [rad], at `count` evenly spaced
//! position angles γ from 0. Throws Error if the center is not in the shadow, or if the direction
//! opposite to it is.
std::vector<float> solve_omni_edge(const OmniCameraOf<double>& camera, const ShadowChart& chart, int count);

}  // namespace ergodome
