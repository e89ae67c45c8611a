#pragma once

#include <optional>

#include "kernels/core/vector3.h"
#include "render/present/output.h"

namespace ergodome {

//! Measures how the observer of successive frames moves, from their positions.
class FrameMotion {
 public:
  //! Takes a frame that arrives at a time [s].
  void note(const OutputFrame& frame, double now_s);

  //! Returns the observer's speed [distances to the hole's center per second]. It falls to 0 if
  //! frames stop.
  [[nodiscard]] double speed(double now_s) const;
  //! Returns whether the observer has jumped since the last call.
  [[nodiscard]] bool take_cut();

 private:
  struct Noted {
    Vector3<double> position;  //!< [M]
    double r;                  //!< [M]
    double time_s;
  };
  std::optional<Noted> last_;
  double speed_ = 0.0;
  bool cut_ = false;
};

}  // namespace ergodome
