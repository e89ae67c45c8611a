#pragma once

namespace ergodome {

//! Accuracy and limits of an integrator.
struct IntegrationSettings {
  double tolerance;  //!< error of the sky direction that the caller accepts [rad]
  int step_limit;    //!< steps after which a ray counts as not converged
  //! Applies the tolerance to what a viewer sees: the displacement on the camera's sky. Near the
  //! critical curve, where the sky is wound up within a pixel, this displacement is much smaller
  //! than the error on the sky, and rays take half as many steps.
  bool on_screen = false;
};

}  // namespace ergodome
