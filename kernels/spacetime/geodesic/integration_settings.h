#pragma once

namespace ergodome {

//! What an integrator is asked for.
struct IntegrationSettings {
  double tolerance;  //!< error of the sky direction that the caller accepts [rad]
  int step_limit;    //!< steps after which a ray counts as not converged
  //! The tolerance is for what a viewer sees: the displacement on the camera's sky. Near the critical curve, where the sky winds
  //! within a pixel, that is much less than the error on the sky, and light takes half the steps.
  bool on_screen = false;
};

}  // namespace ergodome
