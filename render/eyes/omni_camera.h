#pragma once

#include <functional>
#include <vector>

#include "kernels/eyes/omni/omni_camera.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/backend/buffer.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! The camera of an eye at a place beside the head, in the view's axes (right, up, back) [M].
using EyePlace = std::function<EyeCamera(const Vector3<double>& offset)>;

//! What is asked of eyes that turn with the azimuth one looks at.
struct OmniSettings {
  double half_baseline = 0.0;  //!< [M]
  double convergence = 0.0;    //!< [M]; 0: infinity
  double fade_from = 1.0;      //!< elevation from which the baseline gets smaller [rad]
  double fade_to = 1.57;       //!< and at which it is gone
  double tolerance = 1e-5;     //!< error of cameras that is aimed at a tenth of, as that of a direction [rad]
};

//! What cameras of such eyes may be off by, in pictures of whatever size [rad]: where eyes fit does not hang on that.
inline constexpr double omni_least_exact = 1e-5;

//! What a show's settings ask of such eyes so far apart [M].
OmniSettings omni_settings(const StereoSettings& stereo, double baseline, double tolerance);

//! The cameras of such eyes about a head, as polynomials of their place: fitted by least squares to exact cameras on the disk of all places,
//! of the lowest degree that is exact enough. Both eyes, and all pixels, are served by one fit.
class OmniCamera {
 public:
  //! Throws Error where no polynomial is as exact as omni_least_exact: the baseline is too large for this place.
  OmniCamera(Backend backend, const EyePlace& eye_at, const OmniSettings& settings);

  //! As kernels read it; `side` -1 for the left eye, 1 for the right one. It points into this object.
  [[nodiscard]] OmniCameraOf<float> view(double side) const;
  //! The same on the host, whatever the backend.
  [[nodiscard]] OmniCameraOf<float> on_host(double side) const;
  //! The same on the host, in double.
  [[nodiscard]] OmniCameraOf<double> exact(double side) const;

  //! What exact() reads: omni_numbers polynomials.
  [[nodiscard]] const std::vector<double>& coefficients() const { return coefficients_; }

  [[nodiscard]] int degree() const { return camera_.degree; }

 private:
  OmniCameraOf<double> camera_{};
  std::vector<double> coefficients_;
  std::vector<float> narrowed_;
  Buffer<float> for_kernels_;
};

//! A chart about the middle of the shadow that such an eye sees, in the view's axes.
ShadowChart omni_shadow_chart(const OmniCameraOf<double>& camera, const EyePlace& eye_at);

//! The shadow's edge about it at `count` position angles [rad]. Throws Error where the shadow does not lie about the chart's middle.
std::vector<float> solve_omni_edge(const OmniCameraOf<double>& camera, const ShadowChart& chart, int count);

}  // namespace ergodome
