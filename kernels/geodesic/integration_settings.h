#pragma once

namespace ergodome {

//! What an integrator is asked for.
struct IntegrationSettings {
  double tolerance;  //!< error of the sky direction that the caller accepts [rad]
  int step_limit;    //!< steps after which a ray counts as not converged
};

}  // namespace ergodome
